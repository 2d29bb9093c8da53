// Photons in the colours of what they went through: a dot's colour is looked up where its
// photon is, counts are compared with the tables and with storage's own report.
#include "command.h"
#include "photon_classes.h"
#include "photon_table.h"
#include "room.h"
#include "scene_read.h"
#include "seen.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#define HEADER "x,y,z,dx,dy,dz,r,g,b,map,path,bounce,light\n"

static const pm_vec3 first = {5.2, 5.3, 4.6};
static const pm_vec3 second = {4.8, 4.9, 4.7};
static const pm_vec3 third = {4.8, 5.3, 4.7};

static const char rows[] = HEADER "5.2,5.3,4.6,0,0,-1,2,0,0,global,LD,0,0\n"
                                  "4.8,4.9,4.7,0,0,-1,2,0,0,caustic,LSSD,2,0\n"
                                  "4.8,5.3,4.7,0,0,-1,2,0,0,volume,LDDDDDDV,6,0\n";

static pm_seen look(const char *options, const char *text)
{
    char line[256];
    const char *csv = pm_command_write("photons.csv", text);
    snprintf(line, sizeof line, "view photons {S} --scene {O} --size 640x480 %s", options);
    return pm_seen_look(line, csv, pm_room_scene());
}

static void check_dot(const pm_seen *seen, pm_vec3 at, pm_colour want)
{
    CHECK_COLOUR(pm_seen_pixel(seen, 0, at), (double)want.r, (double)want.g, (double)want.b,
                 2.0);
}

static void bounces_have_their_colours(void)
{
    pm_seen s = look("--by bounce", rows);
    pm_photon_classes classes = pm_photon_classes_make(PM_BY_BOUNCE, NULL);
    check_dot(&s, first, classes.list[0].colour);
    check_dot(&s, second, classes.list[2].colour);
    check_dot(&s, third, classes.list[5].colour); // six bounces: among "5 or more"
    CHECK_NEAR(pm_seen_number(&s, "classes.none"), 1.0, 0.0);
    CHECK_NEAR(pm_seen_number(&s, "classes.2"), 1.0, 0.0);
    CHECK_NEAR(pm_seen_number(&s, "classes.5 or more"), 1.0, 0.0);
    CHECK_NEAR(pm_seen_number(&s, "classes.1"), 0.0, 0.0);
    pm_seen_free(&s);
}

static void maps_have_their_colours(void)
{
    pm_seen s = look("--by map", rows);
    check_dot(&s, first, pm_colour_named(PM_COLOUR_SKY));
    check_dot(&s, second, pm_colour_named(PM_COLOUR_ORANGE));
    check_dot(&s, third, pm_colour_named(PM_COLOUR_GREEN));
    CHECK_CONTAINS(
        pm_seen_text(&s, "note"),
        "global map: 1 stored   |   caustic map: 1 stored   |   volume map: 1 stored");
    pm_seen_free(&s);
}

static void lights_have_their_ids(void)
{
    pm_test_ran ran = pm_command_run("storage {S} -n 400 --dump {O} --json",
                                     "scenes/lights.xml", pm_command_path("l.csv"));
    CHECK_THAT(ran.exit_code == 0, "%s", ran.err);
    pm_seen s = pm_seen_look("view photons {S} --scene {O} --size 640x480 --by light",
                             pm_command_path("l.csv"), "scenes/lights.xml");
    json_t *report = json_loads(ran.out, 0, NULL);
    json_t *stored = NULL;
    CHECK(json_unpack(report, "{s:{s:{s:o}}}", "maps", "global", "stored", &stored) == 0);
    CHECK_NEAR(pm_seen_number(&s, "drawn"), json_number_value(stored), 0.0);
    static const char *const ids[] = {"classes.strong", "classes.stage-light", "classes.weak",
                                      "classes.sky"};
    double sum = 0.0;
    for (size_t i = 0; i < sizeof ids / sizeof ids[0]; i++) {
        sum += pm_seen_number(&s, ids[i]);
    }
    CHECK_NEAR(sum, json_number_value(stored), 0.0);
    json_decref(report);
    pm_test_ran_free(&ran);
    pm_seen_free(&s);
}

static void tables_look_as_files_do(void)
{
    pm_seen table = look("", HEADER "5.2,5.3,4.6,0,0,-1,2,0,0,global,LD,0,0\n"
                                    "4.8,4.9,4.7,0,0,-1,0,0,2,global,LDD,1,0\n");
    CHECK_COLOUR(pm_seen_pixel(&table, 0, first), 255.0, 0.0, 0.0, 2.0);
    CHECK_COLOUR(pm_seen_pixel(&table, 0, second), 0.0, 0.0, 255.0, 2.0);
    CHECK_NEAR(pm_seen_number(&table, "scales.0.low"), 0.0, 0.0);
    CHECK_NEAR(pm_seen_number(&table, "scales.0.high"), 2.0, 1e-6);
    CHECK_COLOUR(pm_seen_scale(&table, 0, 0.97), 252.0, 252.0, 252.0, 4.0);
    pm_seen_free(&table);
}

static void check_refused(const char *file, const char *options, const char *part)
{
    char line[512];
    struct stat there;
    snprintf(line, sizeof line, "view photons {S} --scene {O} %s -o %s", options,
             pm_command_path("out.png"));
    pm_test_ran ran = pm_command_run(line, file, pm_room_scene());
    pm_command_check_refusal(part, &ran, part);
    CHECK_THAT(stat(pm_command_path("out.png"), &there) != 0, "%s: a picture is left", part);
    pm_test_ran_free(&ran);
}

static void broken_tables_are_refused(void)
{
    static const struct {
        const char *text, *part;
    } bad[] = {
        {"x,y,z\n", "p.csv:1: the header must be"},
        {HEADER "5,5,5,0,0,-1,1,1,1,globe,LD,0,0\n", "p.csv:2: map must be global, caustic"},
        {HEADER "5,5,5,0,0,-1,1,1,1,global,SD,0,0\n", "p.csv:2: path must go from L"},
        {HEADER "5,5,5,0,0,-1,1,1,1,global,LDS,1,0\n", "p.csv:2: path must go from L"},
        {HEADER "5,5,5,0,0,-1,1,1,1,global,L,0,0\n", "p.csv:2: path must go from L"},
        {HEADER "5,5,5,0,0,-1,1,1,1,global,LSD,0,0\n", "p.csv:2: the path LSD has 1 events"},
        {HEADER "5,5,5,0,0,-1,1,1,1,global,LD,0,1\n", "p.csv:2: light must be a whole number"},
        {HEADER "5,5,5,0,0,-1,1,-1,1,global,LD,0,0\n", "p.csv:2: g must be >= 0"},
        {HEADER "5,5,5,0,0,-1,1e39,1,1,global,LD,0,0\n", "p.csv:2: r is too large"},
        {HEADER "5,5,5,0,nan,-1,1,1,1,global,LD,0,0\n", "p.csv:2: dy must be a finite"},
        {HEADER "900,5,5,0,0,-1,1,1,1,global,LD,0,0\n", "p.csv:2: the point 900,5,5 lies far"},
        {HEADER "5,5,5,0,0,-1,1,1,1,global,LD,0,0", "p.csv:2: the file ends in the middle"},
    };
    pm_scene scene;
    pm_photon_cloud clouds[PM_MAP_COUNT];
    CHECK_OK(pm_scene_read(pm_room_scene(), NULL, 0, false, &scene));
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        const char *csv = pm_command_write("p.csv", bad[i].text);
        CHECK_FAILS(pm_photon_table_read(csv, &scene, clouds), PM_EINPUT, bad[i].part);
    }
    pm_scene_free(&scene);
    check_refused(pm_command_write("p.csv", bad[1].text), "", bad[1].part);
}

static void files_without_the_answer_are_refused(void)
{
    const char *map = pm_room_map("a.ply", &first, 1, pm_gray(1.0), false);
    check_refused(map, "--by bounce", "the global map does not say the bounce of its photons");
    check_refused(map, "--by light", "the global map does not say the light of its photons");
    check_refused(map, "--by event", "--by must be power, map, bounce or light");
}

static void a_table_without_photons_is_a_picture(void)
{
    pm_seen s = look("--by bounce", HEADER);
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "global map: 0 stored");
    pm_seen_free(&s);
}

PM_TESTS({"view_photons.1", "photons by bounce have the colour of their number of events",
          bounces_have_their_colours},
         {"view_photons.2", "photons by map have the colour of their map",
          maps_have_their_colours},
         {"view_photons.3", "photons by light are counted under their lights' ids",
          lights_have_their_ids},
         {"view_photons.4", "a table is drawn as a photon file is", tables_look_as_files_do},
         {"view_photons.5", "broken tables are refused with file and line",
          broken_tables_are_refused},
         {"view_photons.6", "what a file does not say cannot be asked for",
          files_without_the_answer_are_refused},
         {"view_photons.7", "a table without photons is drawn, empty",
          a_table_without_photons_is_a_picture})
