// What one query looks at: the driver writes what the search tells, the picture shows it in its
// order.
#include "command.h"
#include "room.h"
#include "scene_read.h"
#include "seen.h"

#include "visit_table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define HEADER                                                                                 \
    "tree,photons,k,at_x,at_y,at_z,order,photon,depth,axis,x,y,z,distance,kept,found,radius,"  \
    "x0,y0,z0,x1,y1,z1\n"
#define ALL ",4.5,4.5,4.5,5.5,5.5,5.5\n"
#define RIGHT ",4.7,4.5,4.5,5.5,5.5,5.5\n"
#define LOW ",4.7,4.5,4.5,5.5,5.1,5.5\n"

/// The two nearest of five photons around the middle: the first one is kept, and lost again.
#define VISIT(tree, order) tree ",5,2,5,5,5," order
#define FIRST(tree) VISIT(tree, "1,0,0,x,4.7,5,5,0.3,1,0,none" ALL)
#define SECOND(tree) VISIT(tree, "2,2,1,y,5.1,5.1,5,0.141421356,1,1,0.3" RIGHT)
#define THIRD(tree) VISIT(tree, "3,3,2,z,5,4.9,5,0.1,1,1,0.141421356" LOW)
#define BALANCED FIRST("balanced") SECOND("balanced") THIRD("balanced")
#define GROWN                                                                                  \
    FIRST("unbalanced")                                                                        \
    VISIT("unbalanced", "2,4,1,z,5.3,4.7,5,0.424264069,1,0,0.424264069" RIGHT)                 \
    VISIT("unbalanced", "3,2,2,y,5.1,5.1,5,0.141421356,1,1,0.3" RIGHT)                         \
    VISIT("unbalanced", "4,3,3,z,5,4.9,5,0.1,1,1,0.141421356" LOW)

static const pm_vec3 lost = {4.7, 5.0, 5.0};
static const pm_vec3 last = {5.0, 4.9, 5.0};
static const uint8_t white[3] = {245, 245, 245};

static pm_seen look(const char *text)
{
    return pm_seen_look("view search {S} --scene {O} --size 640x480",
                        pm_command_write("visits.csv", text), pm_room_scene());
}

static void check_like_scale(const pm_seen *s, int panel, pm_vec3 photon, double position)
{
    const uint8_t *want = pm_seen_scale(s, 0, position);
    CHECK_COLOUR(pm_seen_pixel(s, panel, photon), (double)want[0], (double)want[1],
                 (double)want[2], 12.0);
}

static void photons_have_the_colour_of_their_order(void)
{
    pm_seen s = look(HEADER GROWN BALANCED);
    check_like_scale(&s, 0, lost, 0.0);
    for (int panel = 0; panel < 2; panel++) {
        check_like_scale(&s, panel, pm_vec(5.1, 5.1, 5.0), 0.5);
        check_like_scale(&s, panel, last, 1.0);
    }
    CHECK_NEAR(pm_seen_number(&s, "scales.0.low"), 1.0, 0.0);
    CHECK_NEAR(pm_seen_number(&s, "scales.0.high"), 3.0, 0.0);
    pm_seen_free(&s);
}

/// A ring stands 8.5 pixels of 900 from its photon; beside it, no ball's circle runs here.
static bool has_ring(const pm_seen *s, int panel, pm_vec3 photon)
{
    int x = 0;
    int y = 0;
    pm_seen_place(s, panel, photon, &x, &y);
    return pm_seen_near(s, x + 4, y, 1, white, 60);
}

static void nearest_have_rings(void)
{
    pm_seen s = look(HEADER GROWN BALANCED);
    CHECK(has_ring(&s, 0, last) && has_ring(&s, 1, last));
    CHECK(!has_ring(&s, 0, lost));
    // The ball in the end, whose radius is the farther one's distance.
    int x = 0;
    int y = 0;
    pm_seen_place(&s, 1, pm_vec(5.0, 5.1414, 5.0), &x, &y);
    CHECK(pm_seen_near(&s, x, y, 2, white, 60));
    pm_seen_free(&s);
}

static void cells_are_cut_open(void)
{
    pm_seen s = look(HEADER GROWN BALANCED);
    int x = 0;
    int y = 0;
    pm_seen_place(&s, 1, pm_vec(4.9, 5.1, 5.0), &x, &y); // the edge of the last cell
    CHECK(pm_seen_near(&s, x, y, 2, pm_seen_scale(&s, 0, 1.0), 60));
    pm_seen_place(&s, 1, pm_vec(4.9, 5.05, 5.0), &x, &y);
    CHECK(!pm_seen_near(&s, x, y, 2, pm_seen_scale(&s, 0, 1.0), 60));
    pm_seen_free(&s);
}

static bool curve_is_at(const pm_seen *s, double order, double radius, const uint8_t *colour)
{
    int x = 0;
    int y = 0;
    pm_seen_chart(s, 0, order, radius, &x, &y);
    return pm_seen_near(s, x, y, 2, colour, 60);
}

static void counts_and_radii_are_the_searches(void)
{
    static const uint8_t sky[3] = {86, 180, 233};
    static const uint8_t orange[3] = {230, 159, 0};
    pm_seen s = look(HEADER GROWN BALANCED);
    CHECK_CONTAINS(pm_seen_text(&s, "note"),
                   "3 of 5 photons looked at to find the 2 nearest; 4 in the tree that is not");
    CHECK(pm_seen_number(&s, "drawn") == 3.0);
    CHECK(pm_seen_number(&s, "balanced.visited") == 3.0);
    CHECK(pm_seen_number(&s, "unbalanced.visited") == 4.0);
    CHECK(curve_is_at(&s, 2.5, 0.3, sky) && !curve_is_at(&s, 2.5, 0.3, orange));
    CHECK(curve_is_at(&s, 2.5, 0.424, orange) && curve_is_at(&s, 3.5, 0.3, orange));
    pm_seen_free(&s);
}

// --- the driver -----------------------------------------------------------------------------

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a;
    double y = *(const double *)b;
    return (x > y) - (x < y);
}

#define K 8

/// Distances of the photons found, ascending.
static void distances_of(const pm_visit_set *search, double distance[K])
{
    int count = 0;
    CHECK(search->found == K && search->k == K);
    for (uint64_t i = 0; i < search->count; i++) {
        if (search->visits[i].found) {
            CHECK(search->visits[i].kept);
            distance[count++] = search->visits[i].distance;
        }
    }
    qsort(distance, K, sizeof *distance, by_value);
}

static void check_search(const pm_visit_set *search, const double distance[K])
{
    double end = search->visits[search->count - 1].radius;
    CHECK_NEAR(end, distance[K - 1], 1e-8);
    CHECK(search->visits[0].depth == 0 && search->visits[0].photon == 0);
    for (uint64_t i = 0; i < search->count; i++) {
        const pm_visited *visit = &search->visits[i];
        CHECK(visit->found || visit->distance >= end - 1e-8);
        CHECK(isfinite(visit->radius) == (i + 1 >= K));
    }
}

/// Two searches that share no line of code but what they tell agree on the nearest.
static void both_trees_find_the_same(void)
{
    static const char path[] = "scenes/cornell-diffuse.xml";
    const char *csv = pm_command_path("visits.csv");
    pm_test_ran ran =
        pm_command_run("balancing {S} -n 2000 -k 8 --at 0,0.01,0.1 --visits {O}", path, csv);
    CHECK_THAT(ran.exit_code == 0, "exit %d: %s", ran.exit_code, ran.err);
    pm_scene scene;
    pm_visit_set searches[PM_TREE_KINDS];
    double distance[PM_TREE_KINDS][K];
    CHECK_OK(pm_scene_read(path, NULL, 0, false, &scene));
    CHECK_OK(pm_visit_table_read(csv, &scene, searches));
    for (int kind = 0; kind < PM_TREE_KINDS; kind++) {
        distances_of(&searches[kind], distance[kind]);
        check_search(&searches[kind], distance[kind]);
    }
    for (int i = 0; i < K; i++) {
        CHECK_NEAR(distance[0][i], distance[1][i], 1e-8);
    }
    CHECK(searches[0].count < searches[0].photons / 4);
    pm_visit_table_free(&searches[0]);
    pm_visit_table_free(&searches[1]);
    pm_scene_free(&scene);
    pm_test_ran_free(&ran);
}

static void options_belong_together(void)
{
    pm_test_ran ran = pm_command_run("balancing {S} -n 10 --visits {O}", "scenes/furnace.xml",
                                     pm_command_path("v.csv"));
    pm_command_check_refusal("--visits", &ran, "--visits needs --at X,Y,Z");
    pm_test_ran_free(&ran);
    ran = pm_command_run("balancing {S} -n 10 --at 0,0,0", "scenes/furnace.xml", NULL);
    pm_command_check_refusal("--at", &ran, "--at is for --visits");
    pm_test_ran_free(&ran);
}

// --- refusals -------------------------------------------------------------------------------

static void check_refused(const char *files, const char *part)
{
    char line[512];
    snprintf(line, sizeof line, "view search %s --scene {S} -o {O}", files);
    pm_test_ran ran = pm_command_run(line, pm_room_scene(), pm_command_path("out.png"));
    pm_command_check_refusal(files, &ran, part);
    struct stat there;
    CHECK_THAT(stat(pm_command_path("out.png"), &there) != 0, "%s: a picture was left", part);
    pm_test_ran_free(&ran);
}

static void bad_tables_are_refused(void)
{
    static const struct {
        const char *text, *part;
    } bad[] = {
        {"tree,photons\n", "x.csv:1: the header must be"},
        {HEADER, "x.csv:2: the file ends without a search in the balanced tree"},
        {HEADER BALANCED, "x.csv:5: the file ends without a search in the unbalanced tree"},
        {HEADER FIRST("oak"), "x.csv:2: tree must be balanced or unbalanced"},
        {HEADER SECOND("balanced"), "x.csv:2: the next visit is number 1, got 2"},
        {HEADER FIRST("balanced") GROWN SECOND("balanced"), "x.csv:7: the visits of a search"},
        {HEADER FIRST(
             "balanced") "balanced,6,2,5,5,5,2,2,1,y,5.1,5.1,5,0.141421356,1,1,0.3" RIGHT,
         "x.csv:3: photons, k and at must be the same"},
        {HEADER VISIT("balanced", "1,5,0,x,4.7,5,5,0.3,1,0,none" ALL),
         "x.csv:2: photon must be a whole number from 0 to 4"},
        {HEADER VISIT("balanced", "1,0,0,x,4.7,5,5,0.4,1,0,none" ALL),
         "x.csv:2: distance must be that of x,y,z from at_x,at_y,at_z, 0.3, got 0.4"},
        {HEADER VISIT("balanced", "1,0,0,x,4.6,5,5,0.4,1,0,none" RIGHT),
         "x.csv:2: the photon lies outside of its cell"},
        {HEADER VISIT("balanced", "1,0,0,x,4.7,5,5,0.3,1,0,-1" ALL),
         "x.csv:2: radius must be >= 0"},
        {HEADER VISIT("balanced", "1,0,0,x,4.7,5,5,0.3,1,2,none" ALL),
         "x.csv:2: found must be a whole number from 0 to 1"},
        {HEADER FIRST("balanced") SECOND("balanced")
             VISIT("balanced", "3,3,2,z,5,4.9,5,0.1,1,1,0.4" LOW),
         "x.csv:4: the radius of a search never grows"},
        {HEADER VISIT("balanced", "1,0,0,x,4.7,5,5,0.3,1,1,none" ALL) SECOND("balanced")
             THIRD("balanced"),
         "x.csv:4: more photons are found than k asks for"},
        {HEADER BALANCED "unbalanced,5,3,5,5,5,1,0,0,x,4.7,5,5,0.3,1,0,none" ALL,
         "photons, k and at must be the same in both trees"},
    };
    pm_scene scene;
    pm_visit_set searches[PM_TREE_KINDS];
    CHECK_OK(pm_scene_read(pm_room_scene(), NULL, 0, false, &scene));
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        const char *csv = pm_command_write("x.csv", bad[i].text);
        CHECK_FAILS(pm_visit_table_read(csv, &scene, searches), PM_EINPUT, bad[i].part);
    }
    pm_scene_free(&scene);
    check_refused(pm_command_write("x.csv", bad[0].text), bad[0].part);
}

static void photons_must_be_the_same(void)
{
    static const pm_vec3 places[] = {
        {4.8, 4.7, 4.8}, {5.2, 4.6, 5.2}, {4.9, 4.6, 5.2}, {5.3, 4.6, 5.2}, {5.4, 4.6, 5.2}};
    char files[512];
    const char *csv = pm_command_write("visits.csv", HEADER GROWN BALANCED);
    snprintf(files, sizeof files, "%s %s", csv,
             pm_room_map("two.ply", places, 2, pm_gray(1.0), true));
    check_refused(files, "two.ply: this map holds 2 photons");
    snprintf(files, sizeof files, "%s %s", csv,
             pm_room_map("five.ply", places, 5, pm_gray(1.0), true));
    check_refused(files, "visits.csv: photon 0 lies elsewhere in");
}

PM_TESTS({"view_search.1", "photons that were looked at have the colour of their order",
          photons_have_the_colour_of_their_order},
         {"view_search.2",
          "the nearest have rings, and the last ball reaches to the farther one",
          nearest_have_rings},
         {"view_search.3", "around the point, cells are seen where its plane cuts them",
          cells_are_cut_open},
         {"view_search.4", "counts and radii are those of the searches",
          counts_and_radii_are_the_searches},
         {"view_search.5", "searches in both trees tell of the same nearest photons",
          both_trees_find_the_same},
         {"view_search.6", "--visits and --at belong together", options_belong_together},
         {"view_search.7", "a table that is no search is refused with file and line",
          bad_tables_are_refused},
         {"view_search.8", "photons behind a search must be those it looked at",
          photons_must_be_the_same})
