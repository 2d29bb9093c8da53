// Searches against brute force: few photons and many, ties, every k, every scale.
#include "balance.h"
#include "clouds.h"
#include "photon_map.h"
#include "test.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NO_REACH ((double)INFINITY)

static pm_photon_map tree_of(pm_cloud_kind kind, uint32_t count, double scale)
{
    pm_photon_map map = pm_cloud_make(kind, count, scale, false);
    CHECK_OK(pm_balance_build(&map));
    CHECK(map.balanced && map.count == count);
    return map;
}

// --- searches -------------------------------------------------------------------------------

static double distance2_of(const pm_photon *photon, pm_vec3 at)
{
    double dx = (double)photon->position[0] - at.x;
    double dy = (double)photon->position[1] - at.y;
    double dz = (double)photon->position[2] - at.z;
    return dx * dx + dy * dy + dz * dz;
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a;
    double y = *(const double *)b;
    return (x > y) - (x < y);
}

/// All accepted distances in the reach, ascending. Returns how many.
static uint32_t brute_force(const pm_photon_map *map, const pm_search *search, double *all)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < map->count; i++) {
        double distance2 = distance2_of(&map->photons[i], search->at);
        bool taken = search->accept == NULL ||
                     search->accept(search->context, &map->photons[i], &distance2);
        if (taken && distance2 <= search->radius2) {
            all[count++] = distance2;
        }
    }
    qsort(all, count, sizeof *all, by_value);
    return count;
}

static void check_search(const pm_photon_map *map, const pm_search *search)
{
    uint32_t found = 0;
    pm_neighbour *nearest = malloc(search->k * sizeof *nearest);
    double *want = malloc((map->count + 1) * sizeof *want);
    double *got = malloc(search->k * sizeof *got);
    bool *seen = calloc(map->count + 1, sizeof *seen);
    CHECK(nearest != NULL && want != NULL && got != NULL && seen != NULL);
    CHECK_OK(pm_balance_nearest(map, search, nearest, &found, NULL));
    uint32_t there = brute_force(map, search, want);
    CHECK(found == (there < search->k ? there : search->k));
    double farthest = 0.0;
    for (uint32_t i = 0; i < found; i++) {
        CHECK(nearest[i].index < map->count && !seen[nearest[i].index]);
        seen[nearest[i].index] = true;
        got[i] = nearest[i].distance2;
        farthest = fmax(farthest, got[i]);
        double own = distance2_of(&map->photons[nearest[i].index], search->at);
        CHECK(search->accept != NULL || own == got[i]);
    }
    CHECK(found < search->k || nearest[0].distance2 == farthest);
    qsort(got, found, sizeof *got, by_value);
    CHECK(memcmp(got, want, found * sizeof *got) == 0);
    free(nearest);
    free(want);
    free(got);
    free(seen);
}

/// The reach that holds the nearest `rank` photons exactly, the last at its rim.
static double reach2_of(const pm_photon_map *map, pm_vec3 at, uint32_t rank)
{
    pm_search all = {.at = at, .k = 1, .radius2 = NO_REACH};
    double *distances = malloc((map->count + 1) * sizeof *distances);
    CHECK(distances != NULL);
    uint32_t count = brute_force(map, &all, distances);
    double reach2 = count == 0 ? 1.0 : distances[rank < count ? rank : count - 1];
    free(distances);
    return reach2 > 0.0 ? reach2 : 0x1p-40;
}

static void few_photons_match_brute_force(void)
{
    for (pm_cloud_kind kind = 0; kind < PM_CLOUD_COUNT; kind++) {
        for (uint32_t count = 0; count <= 64; count++) {
            pm_photon_map map = tree_of(kind, count, 1.0);
            for (uint32_t k = 1; k <= count + 2; k++) {
                pm_vec3 at = pm_cloud_query(100 * count + k);
                check_search(&map, &(pm_search){.at = at, .k = k, .radius2 = NO_REACH});
                double reach2 = reach2_of(&map, at, count / 3);
                check_search(&map, &(pm_search){.at = at, .k = k, .radius2 = reach2});
            }
            pm_photon_map_free(&map);
        }
    }
}

static void many_photons_match_brute_force(void)
{
    static const uint32_t ks[] = {1, 2, 7, 100, 500, 6000, 6001};
    for (pm_cloud_kind kind = 0; kind < PM_CLOUD_COUNT; kind++) {
        pm_photon_map map = tree_of(kind, 6000, 1.0);
        for (uint32_t i = 0; i < 7 * 3; i++) {
            uint32_t k = ks[i % 7];
            // On a photon as well as beside them: ties with planes.
            pm_vec3 at = pm_cloud_query(i);
            const float *own = map.photons[i * 280].position;
            if (i % 2 == 1) {
                at = pm_vec((double)own[0], (double)own[1], (double)own[2]);
            }
            check_search(&map, &(pm_search){.at = at, .k = k, .radius2 = NO_REACH});
            double reach2 = reach2_of(&map, at, 200);
            check_search(&map, &(pm_search){.at = at, .k = k, .radius2 = reach2});
        }
        pm_photon_map_free(&map);
    }
}

/// Takes photons left of 0.6 and measures heights five times.
static bool accept_half(const void *context, const pm_photon *photon, double *distance2)
{
    pm_vec3 at = *(const pm_vec3 *)context;
    double height = (double)photon->position[2] - at.z;
    *distance2 = distance2_of(photon, at) + 24.0 * height * height;
    return photon->position[0] < 0.6f;
}

static void judged_photons_match_brute_force(void)
{
    pm_photon_map map = tree_of(PM_CLOUD_WALLS, 10000, 1.0);
    for (uint32_t i = 0; i < 40; i++) {
        pm_vec3 at = pm_cloud_query(i);
        pm_search search = {.at = at,
                            .k = 1 + i * i,
                            .radius2 = i % 2 ? 0.04 : NO_REACH,
                            .accept = accept_half,
                            .context = &at};
        check_search(&map, &search);
        search.widen[2] = 25.0; // the planes across z are as far as the measure says
        check_search(&map, &search);
    }
    pm_photon_map_free(&map);
}

static void scale_changes_nothing(void)
{
    for (int power = -20; power <= 20; power += 20) {
        double scale = exp2(power);
        pm_photon_map map = tree_of(PM_CLOUD_WALLS, 3000, scale);
        pm_photon_map unit = tree_of(PM_CLOUD_WALLS, 3000, 1.0);
        for (uint32_t i = 0; i < 20; i++) {
            pm_neighbour got[50];
            pm_neighbour want[50];
            uint32_t found;
            pm_vec3 at = pm_cloud_query(i);
            pm_search search = {.at = at, .k = 50, .radius2 = 0.01};
            CHECK_OK(pm_balance_nearest(&unit, &search, want, &found, NULL));
            uint32_t wanted = found;
            search.at = pm_vec_scale(at, scale);
            search.radius2 = 0.01 * scale * scale;
            CHECK_OK(pm_balance_nearest(&map, &search, got, &found, NULL));
            CHECK(found == wanted);
            for (uint32_t j = 0; j < found; j++) {
                CHECK(got[j].index == want[j].index);
                CHECK(got[j].distance2 == want[j].distance2 * scale * scale);
            }
        }
        pm_photon_map_free(&map);
        pm_photon_map_free(&unit);
    }
}

// --- cost -----------------------------------------------------------------------------------

static double visited_mean(pm_cloud_kind kind, uint32_t count, uint32_t k)
{
    pm_photon_map map = tree_of(kind, count, 1.0);
    uint64_t visited = 0;
    for (uint32_t i = 0; i < 500; i++) {
        pm_neighbour nearest[100];
        uint32_t found;
        const float *own = map.photons[(uint64_t)i * count / 500].position;
        pm_search search = {.at = pm_vec((double)own[0], (double)own[1], (double)own[2]),
                            .k = k,
                            .radius2 = NO_REACH};
        CHECK_OK(pm_balance_nearest(&map, &search, nearest, &found, &visited));
    }
    pm_photon_map_free(&map);
    return (double)visited / 500.0;
}

static void searches_look_at_few_photons(void)
{
    // O(log n + k): 16 times the photons cost four levels more, not 16 times the looks.
    for (uint32_t k = 1; k <= 100; k *= 10) {
        double few = visited_mean(PM_CLOUD_WALLS, 4000, k);
        double many = visited_mean(PM_CLOUD_WALLS, 64000, k);
        CHECK_THAT(many < few + 80.0, "k %u: %g looks at 4000 photons, %g at 64000", k, few,
                   many);
        CHECK_THAT(many < 6.0 * k + 80.0, "k %u: %g looks", k, many);
    }
    // All equal: with k held at distance 0 nothing beyond a plane at distance 0 can be nearer.
    double equal = visited_mean(PM_CLOUD_COINCIDENT, 100000, 50);
    CHECK_THAT(equal < 200.0, "%g looks at coincident photons", equal);
}

static void threads_do_not_meet(void)
{
    enum { QUERIES = 2000, K = 20 };
    static pm_neighbour alone[QUERIES][K];
    static pm_neighbour together[QUERIES][K];
    pm_photon_map map = tree_of(PM_CLOUD_RANDOM, 20000, 1.0);
    int failed = 0;
    for (int i = 0; i < QUERIES; i++) {
        uint32_t found;
        pm_search search = {.at = pm_cloud_query((uint64_t)i), .k = K, .radius2 = NO_REACH};
        CHECK_OK(pm_balance_nearest(&map, &search, alone[i], &found, NULL));
    }
#pragma omp parallel for num_threads(16) reduction(+ : failed)
    for (int i = 0; i < QUERIES; i++) {
        uint32_t found;
        pm_search search = {.at = pm_cloud_query((uint64_t)i), .k = K, .radius2 = NO_REACH};
        failed += pm_balance_nearest(&map, &search, together[i], &found, NULL) != PM_OK;
        for (int j = 0; j < K; j++) {
            failed += together[i][j].index != alone[i][j].index;
        }
    }
    CHECK(failed == 0);
    pm_photon_map_free(&map);
}

// --- refusals -------------------------------------------------------------------------------

static void wrong_searches_are_refused(void)
{
    pm_neighbour nearest[4];
    uint32_t found = 99;
    pm_photon_map map = pm_cloud_make(PM_CLOUD_RANDOM, 100, 1.0, false);
    pm_search search = {.k = 4, .radius2 = NO_REACH};
    CHECK_FAILS(pm_balance_nearest(&map, &search, nearest, &found, NULL), PM_EINPUT,
                "must be balanced");
    CHECK_OK(pm_balance_build(&map));
    search.k = 0;
    CHECK_FAILS(pm_balance_nearest(&map, &search, nearest, &found, NULL), PM_EINPUT,
                "at least 1");
    search.k = 4;
    static const double reaches[] = {0.0, -1.0, (double)NAN};
    for (int i = 0; i < 3; i++) {
        search.radius2 = reaches[i];
        CHECK_FAILS(pm_balance_nearest(&map, &search, nearest, &found, NULL), PM_EINPUT,
                    "must be > 0");
    }
    search.radius2 = 1.0;
    search.at.x = (double)NAN;
    CHECK_FAILS(pm_balance_nearest(&map, &search, nearest, &found, NULL), PM_EINPUT,
                "finite position");
    CHECK(found == 99);
    pm_photon_map_free(&map);
}

static void an_empty_map_is_legal(void)
{
    pm_photon_map map = {.kind = PM_MAP_GLOBAL};
    pm_neighbour nearest;
    uint32_t found = 99;
    pm_search search = {.k = 1, .radius2 = NO_REACH};
    CHECK_OK(pm_balance_nearest(&map, &search, &nearest, &found, NULL));
    CHECK(found == 0);
    CHECK_OK(pm_balance_build(&map));
    CHECK_OK(pm_balance_nearest(&map, &search, &nearest, &found, NULL));
    CHECK(map.balanced && found == 0);
}

PM_TESTS(
    {"balance_search.1", "searches among few photons match brute force for every k",
     few_photons_match_brute_force},
    {"balance_search.2", "searches among many photons match brute force",
     many_photons_match_brute_force},
    {"balance_search.3", "searches that judge photons match brute force",
     judged_photons_match_brute_force},
    {"balance_search.4", "the same photons are found at every scale", scale_changes_nothing},
    {"balance_search.5", "a search looks at O(log n + k) photons",
     searches_look_at_few_photons},
    {"balance_search.6", "searches in threads do not disturb each other", threads_do_not_meet},
    {"balance_search.7", "searches without a meaning are refused", wrong_searches_are_refused},
    {"balance_search.8", "an empty map can be built and searched", an_empty_map_is_legal})
