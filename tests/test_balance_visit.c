// Whoever watches a search sees all of it, and changes nothing.
#include "balance.h"
#include "clouds.h"
#include "photon_map.h"
#include "test.h"

#include <math.h>

#define COUNT 3000u
#define K 20u

typedef struct {
    bool seen[COUNT];
    uint64_t count;
    double limit2;
} watcher;

static void watch(void *witness, uint32_t index, double limit2)
{
    watcher *w = witness;
    CHECK_THAT(index < COUNT && !w->seen[index], "photon %u is told of twice", index);
    CHECK_THAT(index == 0 || w->seen[(index - 1) / 2], "photon %u comes before its parent",
               index);
    CHECK_THAT(limit2 <= w->limit2, "the limit grows from %g to %g", w->limit2, limit2);
    w->seen[index] = true;
    w->limit2 = limit2;
    w->count++;
}

static void check_cloud(pm_cloud_kind kind, double radius2)
{
    pm_photon_map map = pm_cloud_make(kind, COUNT, 1.0, false);
    CHECK_OK(pm_balance_build(&map));
    for (uint64_t i = 0; i < 20; i++) {
        static watcher w;
        pm_neighbour alone[K];
        pm_neighbour watched[K];
        uint32_t found = 0;
        uint32_t found_watched = 0;
        uint64_t visited = 0;
        w = (watcher){.limit2 = (double)INFINITY};
        pm_search search = {.at = pm_cloud_query(i), .k = K, .radius2 = radius2};
        CHECK_OK(pm_balance_nearest(&map, &search, alone, &found, NULL));
        search.visit = watch;
        search.witness = &w;
        CHECK_OK(pm_balance_nearest(&map, &search, watched, &found_watched, &visited));
        CHECK_THAT(w.count == visited, "%s: told of %llu photons, looked at %llu",
                   pm_cloud_name(kind), (unsigned long long)w.count,
                   (unsigned long long)visited);
        CHECK(found == found_watched);
        for (uint32_t j = 0; j < found; j++) {
            CHECK(watched[j].index == alone[j].index && w.seen[watched[j].index]);
        }
        CHECK(found < K || w.limit2 == watched[0].distance2);
    }
    pm_photon_map_free(&map);
}

static void all_visits_are_told(void)
{
    check_cloud(PM_CLOUD_RANDOM, (double)INFINITY);
    check_cloud(PM_CLOUD_RANDOM, 0.01);
    check_cloud(PM_CLOUD_WALLS, (double)INFINITY);
    check_cloud(PM_CLOUD_LATTICE, (double)INFINITY);
}

PM_TESTS({"balance_visit.1",
          "a search tells of each photon it looks at, once, parents first, and finds the same",
          all_visits_are_told})
