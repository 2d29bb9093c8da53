// What `view` computes before anything is drawn: where the camera stands, how a tree's planes
// lie, what a table's field may hold.
#include "balance.h"
#include "photon_map.h"
#include "rng.h"
#include "store.h"
#include "test.h"

#include "csv.h"
#include "photon_cloud.h"
#include "tree_split.h"
#include "viewpoint.h"

#include <stdio.h>

static pm_rng draws(uint64_t index)
{
    pm_rng_source source = {.seed = 1, .stream = PM_STREAM_TEST, .pass = 0};
    return pm_rng_at(&source, index, 0);
}

static double between(pm_rng *rng, double low, double high)
{
    return low + (high - low) * pm_rng_draw(rng);
}

/// A scene that is a box of random proportions, and a camera anywhere near it, inside or
/// outside.
static pm_scene random_box(pm_rng *rng)
{
    pm_scene scene = {.has_camera = true};
    double x = between(rng, 0.01, 3.0);
    double y = between(rng, 0.01, 3.0);
    double z = between(rng, 0.01, 3.0);
    scene.high = pm_vec(x, y, z);
    scene.low = pm_vec_negate(scene.high);
    scene.radius = pm_vec_length(scene.high);
    double px = between(rng, -9.0, 9.0);
    double py = between(rng, -9.0, 9.0);
    double pz = between(rng, -9.0, 9.0);
    double wobble = between(rng, -0.3, 0.3);
    pm_frame frame = pm_frame_around(pm_vec_normalize(pm_vec(px, py + wobble, pz)));
    scene.camera = (pm_camera){.position = pm_vec(px, py, pz),
                               .right = frame.s,
                               .up = frame.t,
                               .forward = pm_vec_negate(frame.n)};
    return scene;
}

static void whole_scene_is_in_the_free_part(void)
{
    pm_rng rng = draws(1);
    for (int i = 0; i < 500; i++) {
        pm_scene scene = random_box(&rng);
        pm_viewpoint v = pm_viewpoint_of(&scene, 1200, 900);
        for (int corner = 0; corner < 8; corner++) {
            double x = 0.0;
            double y = 0.0;
            CHECK(pm_viewpoint_project(&v,
                                       pm_vec(corner & 1 ? scene.high.x : scene.low.x,
                                              corner & 2 ? scene.high.y : scene.low.y,
                                              corner & 4 ? scene.high.z : scene.low.z),
                                       &x, &y));
            CHECK_THAT(x >= 1200.0 * PM_VIEWPOINT_LEFT - 1e-6 &&
                           x <= 1200.0 * (1.0 - PM_VIEWPOINT_RIGHT) + 1e-6 &&
                           y >= 900.0 * PM_VIEWPOINT_TOP - 1e-6 &&
                           y <= 900.0 * (1.0 - PM_VIEWPOINT_BOTTOM) + 1e-6,
                       "scene %d, corner %d lands at %g, %g", i, corner, x, y);
        }
    }
}

static pm_photon_map random_map(uint32_t count)
{
    pm_rng rng = draws(2);
    pm_photon_map map = {.kind = PM_MAP_GLOBAL};
    for (uint32_t i = 0; i < count; i++) {
        pm_deposit deposit = {.direction = {0.0, 0.0, 1.0}, .normal = {0.0, 0.0, 1.0}};
        deposit.position.x = between(&rng, -1.0, 1.0);
        deposit.position.y = between(&rng, -0.5, 2.0);
        deposit.position.z = between(&rng, 0.0, 1.0);
        deposit.power = pm_gray(i + 1.0);
        CHECK_OK(pm_store_push(&map, &deposit));
    }
    CHECK_OK(pm_store_scale(&map, 1));
    CHECK_OK(pm_balance_build(&map));
    return map;
}

/// Is `split` on its side of the plane of one of the nodes above it?
static bool on_its_side(const pm_tree_split *split, const pm_tree_split *above, bool left)
{
    double plane = pm_vec_axis(above->corner[0], above->axis);
    for (int i = 0; i < 4; i++) {
        double at = pm_vec_axis(split->corner[i], above->axis);
        if (left ? at > plane : at < plane) {
            return false;
        }
    }
    return true;
}

static void planes_stay_in_their_cells(void)
{
    pm_photon_map map = random_map(1000);
    pm_tree_split_set set;
    CHECK_OK(pm_tree_split_make(&map, "map", 7, &set));
    CHECK(set.count == 127 && set.depths == 7 && set.height == 10);
    for (uint32_t node = 1; node <= set.count; node++) {
        const pm_tree_split *split = &set.splits[node - 1];
        double through = (double)map.photons[node - 1].position[split->axis];
        for (int i = 0; i < 4; i++) {
            CHECK_NEAR(pm_vec_axis(split->corner[i], split->axis), through, 0.0);
        }
        CHECK(node >> split->depth == 1);
        for (uint32_t child = node; child > 1; child /= 2) {
            CHECK(on_its_side(split, &set.splits[child / 2 - 1], child % 2 == 0));
        }
    }
    pm_tree_split_free(&set);
    pm_photon_map_free(&map);
}

static void damaged_tree_is_refused(void)
{
    pm_photon_map map = random_map(100);
    pm_tree_split_set set;
    map.photons[4].flags |= PM_PHOTON_AXIS;
    CHECK_FAILS(pm_tree_split_make(&map, "map.ply", 7, &set), PM_EINPUT,
                "map.ply: photon 4 lies outside of its tree cell");
    pm_photon_map_free(&map);
    map = random_map(100);
    pm_photon swapped = map.photons[1];
    map.photons[1] = map.photons[2];
    map.photons[2] = swapped;
    CHECK_FAILS(pm_tree_split_make(&map, "map.ply", 7, &set), PM_EINPUT, "it is no kd-tree");
    pm_photon_map_free(&map);
}

static void small_trees_have_all_their_planes(void)
{
    for (uint32_t count = 0; count < 9; count++) {
        pm_photon_map map = random_map(count);
        pm_tree_split_set set;
        CHECK_OK(pm_tree_split_make(&map, "map", 16, &set));
        CHECK(set.count == count);
        CHECK((1u << set.height) > count && count >= 1u << set.height >> 1);
        pm_tree_split_free(&set);
        pm_photon_map_free(&map);
    }
}

static void cloud_keeps_powers_and_steps_evenly(void)
{
    pm_photon_map map = random_map(1000);
    pm_photon_cloud all;
    pm_photon_cloud some;
    CHECK_OK(pm_photon_cloud_make(&map, PM_MAP_MAX, &all));
    CHECK_OK(pm_photon_cloud_make(&map, 10, &some));
    CHECK(all.count == 1000 && all.stored == 1000 && some.count == 10 && some.stored == 1000);
    // Powers are 1 to 1000 W, packed to 8 bits: the 99th percentile is 990 W within 1 %.
    CHECK_NEAR(all.full_power, 990.0, 10.0);
    for (uint32_t i = 0; i < 10; i++) {
        for (int c = 0; c < 3; c++) {
            CHECK(some.position[i][c] == all.position[(size_t)i * 100][c]);
            CHECK(some.power[i][c] == all.power[(size_t)i * 100][c]);
        }
    }
    pm_photon_cloud_free(&all);
    pm_photon_cloud_free(&some);
    pm_photon_map_free(&map);
}

static void fields_are_plain_numbers(void)
{
    char path[1200];
    snprintf(path, sizeof path, "%s/x.csv", pm_test_folder());
    FILE *file = fopen(path, "w");
    CHECK(file != NULL && fputs("a,b,c,d,e,f\n1.5e-3, 1,0x10,inf,,1e999\n", file) >= 0);
    CHECK(fclose(file) == 0);
    pm_csv csv;
    bool more = false;
    double value = 0.0;
    CHECK_OK(pm_csv_open(path, "a,b,c,d,e,f", "nobody", &csv));
    CHECK_OK(pm_csv_next(&csv, &more));
    CHECK(more);
    CHECK_OK(pm_csv_number(&csv, 0, &value));
    CHECK_NEAR(value, 1.5e-3, 0.0);
    for (int column = 1; column < 6; column++) {
        CHECK_FAILS(pm_csv_number(&csv, column, &value), PM_EINPUT, "must be a finite number");
    }
    CHECK_NEAR(value, 1.5e-3, 0.0);
    CHECK_OK(pm_csv_next(&csv, &more));
    CHECK(!more);
    pm_csv_close(&csv);
}

PM_TESTS({"visualize.1", "the whole scene lies beside title and legend, from any camera",
          whole_scene_is_in_the_free_part},
         {"visualize.2", "a split plane goes through its photon and stays inside its cell",
          planes_stay_in_their_cells},
         {"visualize.3", "a file that only says it is a tree is refused",
          damaged_tree_is_refused},
         {"visualize.4", "trees of 0 to 8 photons have a plane for each",
          small_trees_have_all_their_planes},
         {"visualize.5", "a thinned cloud takes photons at even steps",
          cloud_keeps_powers_and_steps_evenly},
         {"visualize.6", "a table's field is a decimal number and nothing else",
          fields_are_plain_numbers})
