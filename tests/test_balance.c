// The tree against its invariant, for photons in every awkward order.
#include "balance.h"
#include "clouds.h"
#include "photon_map.h"
#include "test.h"

#include <math.h>
#include <string.h>
#include <time.h>

static pm_photon_map tree_of(pm_cloud_kind kind, uint32_t count, double scale)
{
    pm_photon_map map = pm_cloud_make(kind, count, scale, false);
    CHECK_OK(pm_balance_build(&map));
    CHECK(map.balanced && map.count == count);
    return map;
}

// --- shape ----------------------------------------------------------------------------------

/// Nodes below `node` of a heap of `count`, itself included.
static uint32_t heap_size(uint32_t node, uint32_t count)
{
    return node > count ? 0 : 1 + heap_size(2 * node, count) + heap_size(2 * node + 1, count);
}

static void left_share_is_that_of_a_heap(void)
{
    for (uint32_t count = 1; count <= 2000; count++) {
        CHECK(pm_balance_left(count) == heap_size(2, count));
    }
    // Full rows, one less and one more, where arithmetic could overflow.
    CHECK(pm_balance_left(PM_MAP_MAX) == (1u << 30) - 1);
    CHECK(pm_balance_left(PM_MAP_MAX - 1) == (1u << 30) - 1);
    CHECK(pm_balance_left(1u << 30) == 1u << 29);
    CHECK(pm_balance_left((1u << 30) - 1) == (1u << 29) - 1);
    CHECK(pm_balance_left((1u << 30) + (1u << 29)) == (1u << 30) - 1);
}

typedef struct {
    float low[3], high[3];
} region;

/// Every photon below `node` lies in `within`, and the axis is a longest side of their box.
static region walk(const pm_photon_map *map, uint64_t node, region within)
{
    const pm_photon *photon = &map->photons[node - 1];
    int axis = photon->flags & PM_PHOTON_AXIS;
    CHECK(axis < 3);
    region box;
    for (int a = 0; a < 3; a++) {
        float x = photon->position[a];
        CHECK(x >= within.low[a] && x <= within.high[a]);
        box.low[a] = box.high[a] = x;
    }
    for (uint64_t child = 2 * node; child <= 2 * node + 1 && child <= map->count; child++) {
        region part = within;
        *(child & 1 ? &part.low[axis] : &part.high[axis]) = photon->position[axis];
        region below = walk(map, child, part);
        for (int a = 0; a < 3; a++) {
            box.low[a] = fminf(box.low[a], below.low[a]);
            box.high[a] = fmaxf(box.high[a], below.high[a]);
        }
    }
    for (int a = 0; a < 3; a++) {
        CHECK(box.high[axis] - box.low[axis] >= box.high[a] - box.low[a]);
    }
    return box;
}

static const region everywhere = {{-HUGE_VALF, -HUGE_VALF, -HUGE_VALF},
                                  {HUGE_VALF, HUGE_VALF, HUGE_VALF}};

static void nodes_keep_the_invariant(void)
{
    for (pm_cloud_kind kind = 0; kind < PM_CLOUD_COUNT; kind++) {
        for (uint32_t count = 1; count <= 200; count++) {
            pm_photon_map map = tree_of(kind, count, 1.0);
            (void)walk(&map, 1, everywhere);
            pm_photon_map_free(&map);
        }
        pm_photon_map map = tree_of(kind, 30000, 1.0);
        (void)walk(&map, 1, everywhere);
        pm_photon_map_free(&map);
    }
}

static void no_photon_is_lost(void)
{
    enum { COUNT = 5000 };
    static bool seen[COUNT];
    pm_photon_map map = pm_cloud_make(PM_CLOUD_LATTICE, COUNT, 1.0, true);
    pm_photon_map before = pm_cloud_make(PM_CLOUD_LATTICE, COUNT, 1.0, true);
    CHECK_OK(pm_balance_build(&map));
    for (uint32_t i = 0; i < COUNT; i++) {
        // The exact power tells which photon it was; bytes and exact values moved together.
        uint32_t was = (uint32_t)map.exact[i].power[0] - 1;
        CHECK(was < COUNT && !seen[was]);
        seen[was] = true;
        pm_photon photon = map.photons[i];
        photon.flags &= (uint16_t)~PM_PHOTON_AXIS;
        CHECK(memcmp(&photon, &before.photons[was], sizeof photon) == 0);
    }
    pm_photon_map_free(&map);
    pm_photon_map_free(&before);
}

static void the_same_map_gives_the_same_bytes(void)
{
    pm_photon_map first = tree_of(PM_CLOUD_SITES, 20000, 1.0);
    pm_photon_map second = tree_of(PM_CLOUD_SITES, 20000, 1.0);
    CHECK(memcmp(first.photons, second.photons, 20000 * sizeof *first.photons) == 0);
    CHECK_OK(pm_balance_build(&second)); // once more changes nothing
    CHECK(memcmp(first.photons, second.photons, 20000 * sizeof *first.photons) == 0);
    pm_photon_map_free(&first);
    pm_photon_map_free(&second);
}

static double seconds_to_build(pm_cloud_kind kind)
{
    pm_photon_map map = pm_cloud_make(kind, 50000, 1.0, false);
    clock_t start = clock();
    CHECK_OK(pm_balance_build(&map));
    double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    pm_photon_map_free(&map);
    return seconds;
}

static void no_input_builds_quadratically(void)
{
    // Quadratic selection is more than 1000 times slower here; the bound is for busy machines.
    double usual = seconds_to_build(PM_CLOUD_RANDOM);
    for (pm_cloud_kind kind = 0; kind < PM_CLOUD_COUNT; kind++) {
        double seconds = seconds_to_build(kind);
        CHECK_THAT(seconds < 20.0 * usual + 0.1, "%s takes %g s, random order %g s",
                   pm_cloud_name(kind), seconds, usual);
    }
}

static void photons_nowhere_are_refused(void)
{
    pm_photon_map map = pm_cloud_make(PM_CLOUD_RANDOM, 100, 1.0, false);
    map.photons[42].position[1] = NAN;
    CHECK_FAILS(pm_balance_build(&map), PM_EINPUT, "photon 42");
    map.photons[42].position[1] = INFINITY;
    CHECK_FAILS(pm_balance_build(&map), PM_EINPUT, "not finite");
    CHECK(!map.balanced);
    pm_photon_map_free(&map);
    pm_photon_map large = {.count = PM_MAP_MAX + 1u};
    CHECK_FAILS(pm_balance_build(&large), PM_ELIMIT, "at most 2147483647");
}

PM_TESTS({"balance.1", "the left subtree has the share of a left-balanced heap",
          left_share_is_that_of_a_heap},
         {"balance.2", "every node splits its photons along its longest side",
          nodes_keep_the_invariant},
         {"balance.3", "balancing loses no photon and no exact value", no_photon_is_lost},
         {"balance.4", "the same map gives the same bytes", the_same_map_gives_the_same_bytes},
         {"balance.5", "no order of photons makes building quadratic",
          no_input_builds_quadratically},
         {"balance.6", "photons that are nowhere are refused", photons_nowhere_are_refused})
