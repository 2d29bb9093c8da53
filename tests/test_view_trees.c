// Two trees side by side: what `balancing --dump` writes is what the picture shows.
#include "command.h"
#include "room.h"
#include "scene_read.h"
#include "seen.h"

#include "tree_table.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define HEADER "tree,row,depth,photons,visited_mean,axis,position,x0,y0,z0,x1,y1,z1\n"
#define BOX "4.6,4.6,4.6,5.4,5.4,5.4\n"

/// Three photons: balanced across z first, grown across x, y and z into a chain.
#define BALANCED                                                                               \
    "balanced,tree,1,3,2.5,,,,,,,,\n"                                                          \
    "balanced,level,0,1,,,,,,,,,\n"                                                            \
    "balanced,level,1,2,,,,,,,,,\n"                                                            \
    "balanced,split,0,,,z,5," BOX "balanced,split,1,,,x,5,4.6,4.6,4.6,5.4,5.4,5\n"
#define CHAIN                                                                                  \
    "unbalanced,tree,2,3,3,,,,,,,,\n"                                                          \
    "unbalanced,level,0,1,,,,,,,,,\n"                                                          \
    "unbalanced,level,1,1,,,,,,,,,\n"                                                          \
    "unbalanced,level,2,1,,,,,,,,,\n"                                                          \
    "unbalanced,split,0,,,x,4.7," BOX

static const uint8_t sky[3] = {86, 180, 233};
static const uint8_t orange[3] = {230, 159, 0};
static const uint8_t vermillion[3] = {213, 94, 0};

static pm_seen look(const char *text, const char *option)
{
    char line[128];
    snprintf(line, sizeof line, "view trees {S} --scene {O} --size 640x480 %s", option);
    return pm_seen_look(line, pm_command_write("trees.csv", text), pm_room_scene());
}

static void each_panel_has_its_planes(void)
{
    pm_seen s = look(HEADER CHAIN BALANCED, "");
    const pm_vec3 on_plane = {5.15, 5.2, 5.0};
    const uint8_t *with = pm_seen_pixel(&s, 0, on_plane);
    const uint8_t *without = pm_seen_pixel(&s, 1, on_plane);
    for (int c = 0; c < 3; c++) {
        CHECK_NEAR((double)with[c], 0.67 * without[c] + 0.33 * sky[c], 12.0);
    }
    // The edge of the chain's first plane that is nearest to the camera.
    int x = 0;
    int y = 0;
    pm_seen_place(&s, 1, pm_vec(4.7, 5.05, 5.4), &x, &y);
    CHECK(pm_seen_near(&s, x, y, 2, vermillion, 40));
    pm_seen_place(&s, 0, pm_vec(4.7, 5.05, 5.4), &x, &y);
    CHECK(!pm_seen_near(&s, x, y, 2, vermillion, 40));
    CHECK(pm_seen_number(&s, "drawn") == 3.0);
    pm_seen_free(&s);
}

static bool curve_is_at(const pm_seen *s, double depth, double photons, const uint8_t *colour)
{
    int x = 0;
    int y = 0;
    pm_seen_chart(s, 0, depth, photons, &x, &y);
    return pm_seen_near(s, x, y, 2, colour, 60);
}

static void levels_and_numbers_are_the_tables(void)
{
    pm_seen s = look(HEADER CHAIN BALANCED, "--depth 1");
    CHECK(pm_seen_number(&s, "drawn") == 2.0);
    CHECK(curve_is_at(&s, 1.0, 2.0, sky) && !curve_is_at(&s, 1.0, 2.0, orange));
    CHECK(curve_is_at(&s, 1.5, 1.0, orange) && !curve_is_at(&s, 1.5, 1.0, sky));
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "3 photons, twice");
    CHECK_NEAR(pm_seen_number(&s, "balanced.visited_mean"), 2.5, 0.0);
    CHECK_NEAR(pm_seen_number(&s, "unbalanced.visited_mean"), 3.0, 0.0);
    CHECK_NEAR(pm_seen_number(&s, "balanced.height"), 1.0, 0.0);
    CHECK_NEAR(pm_seen_number(&s, "unbalanced.height"), 2.0, 0.0);
    pm_seen_free(&s);
}

/// What the program says of its trees in JSON is what it writes down of them.
static void tables_agree_with_the_report(void)
{
    static const char path[] = "scenes/cornell-diffuse.xml";
    const char *csv = pm_command_path("trees.csv");
    pm_test_ran ran =
        pm_command_run("balancing {S} -n 3000 -k 20 --dump {O} --json", path, csv);
    CHECK_THAT(ran.exit_code == 0, "exit %d: %s", ran.exit_code, ran.err);
    json_t *report = json_loads(ran.out, 0, NULL);
    pm_scene scene;
    pm_tree_table trees[PM_TREE_KINDS];
    CHECK_OK(pm_scene_read(path, NULL, 0, false, &scene));
    CHECK_OK(pm_tree_table_read(csv, &scene, trees));
    const pm_tree_table *balanced = &trees[PM_TREE_BALANCED];
    const pm_tree_table *grown = &trees[PM_TREE_UNBALANCED];
    CHECK(balanced->photons ==
          (uint64_t)json_integer_value(json_object_get(report, "photons")));
    CHECK(balanced->height == (uint64_t)json_integer_value(json_object_get(report, "height")));
    CHECK_NEAR(balanced->visited_mean,
               json_number_value(json_object_get(report, "visited_mean")), 1e-6);
    CHECK_NEAR(grown->visited_mean,
               json_number_value(json_object_get(report, "visited_mean_unbalanced")), 1e-6);
    CHECK(grown->height > balanced->height && grown->photons == balanced->photons);
    CHECK(balanced->splits.depths == 8 && balanced->splits.count == 255);
    for (uint64_t depth = 0; depth < balanced->height; depth++) {
        CHECK(balanced->level[depth] == UINT64_C(1) << depth);
    }
    pm_tree_table_free(&trees[0]);
    pm_tree_table_free(&trees[1]);
    pm_scene_free(&scene);
    json_decref(report);
    pm_test_ran_free(&ran);
}

static void check_refused(const char *files, const char *part)
{
    char line[512];
    snprintf(line, sizeof line, "view trees %s --scene {S} -o {O}", files);
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
        {"tree,row\n", "x.csv:1: the header must be"},
        {HEADER, "x.csv:2: the file ends without the balanced tree"},
        {HEADER BALANCED, "x.csv:7: the file ends without the unbalanced tree"},
        {HEADER "leaning,tree,1,3,2,,,,,,,,\n", "x.csv:2: tree must be balanced or unbalanced"},
        {HEADER "balanced,leaf,1,3,2,,,,,,,,\n", "x.csv:2: a tree begins with its row"},
        {HEADER BALANCED "balanced,leaf,1,3,2,,,,,,,,\n",
         "x.csv:7: row must be tree, level or"},
        {HEADER BALANCED BALANCED, "x.csv:7: this tree was there before"},
        {HEADER "balanced,tree,3,3,2,,,,,,,,\n", "x.csv:2: a tree has at least one photon on"},
        {HEADER "balanced,tree,1,3,-2,,,,,,,,\n", "x.csv:2: visited_mean must be >= 0"},
        {HEADER "balanced,tree,1,3,2,x,,,,,,,\n", "x.csv:2: a row \"tree\" has no axis"},
        {HEADER "balanced,tree,1,3,2,,,,,,,,\nbalanced,level,1,1,,,,,,,,,\n",
         "x.csv:3: the next level is 0, got 1"},
        {HEADER "balanced,tree,1,3,2,,,,,,,,\nbalanced,level,0,2,,,,,,,,,\n",
         "x.csv:3: level 0 holds 1 to 1 photons, got 2"},
        {HEADER "balanced,tree,1,3,2,,,,,,,,\nbalanced,level,0,1,,,,,,,,,\n" CHAIN,
         "x.csv:4: the tree before this has 3 photons on 2 levels, and its levels hold 1 on 1"},
        {HEADER BALANCED "balanced,split,1,,,w,5," BOX, "x.csv:7: axis must be one of x y z"},
        {HEADER BALANCED "balanced,split,1,,,x,5.5," BOX, "x.csv:7: the plane lies outside"},
        {HEADER BALANCED "balanced,split,0,,,x,nan," BOX, "x.csv:7: position must be a finite"},
        {HEADER BALANCED "balanced,split,1,,,x,5,5,5,5,4.9,5,5\n", "x.csv:7: a cell goes from"},
        {HEADER CHAIN "unbalanced,split,2,,,x,5," BOX, "x.csv:7: planes must be ordered by"},
        {HEADER BALANCED "unbalanced,tree,0,1,1,,,,,,,,\nunbalanced,level,0,1,,,,,,,,,\n",
         "the two trees hold different numbers of photons"},
    };
    pm_scene scene;
    pm_tree_table trees[PM_TREE_KINDS];
    CHECK_OK(pm_scene_read(pm_room_scene(), NULL, 0, false, &scene));
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        const char *csv = pm_command_write("x.csv", bad[i].text);
        CHECK_FAILS(pm_tree_table_read(csv, &scene, trees), PM_EINPUT, bad[i].part);
    }
    pm_scene_free(&scene);
    check_refused(pm_command_write("x.csv", bad[0].text), bad[0].part);
}

static void photons_must_be_the_same(void)
{
    static const pm_vec3 places[] = {{4.8, 4.7, 4.8}, {5.2, 4.6, 5.2}};
    char files[512];
    const char *map = pm_room_map("two.ply", places, 2, pm_gray(1.0), true);
    snprintf(files, sizeof files, "%s %s", pm_command_write("trees.csv", HEADER CHAIN BALANCED),
             map);
    check_refused(files, "two.ply: this map holds 2 photons, the trees of");
}

PM_TESTS({"view_trees.1", "each tree's planes are seen in its own panel",
          each_panel_has_its_planes},
         {"view_trees.2", "levels and numbers are the table's, and --depth limits the planes",
          levels_and_numbers_are_the_tables},
         {"view_trees.3", "the table of both trees agrees with the report",
          tables_agree_with_the_report},
         {"view_trees.4", "a table that is no tree is refused with file and line",
          bad_tables_are_refused},
         {"view_trees.5", "photons behind the trees must be as many as the trees hold",
          photons_must_be_the_same})
