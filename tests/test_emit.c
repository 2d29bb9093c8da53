// Photons shared out among lights, the power they are given, and the turns that lights take.
// Directions and starts: test_emit_rays.c and test_emit_spot.c; cells: test_emit_cells.c.
#include "emit.h"

#include "scenes.h"
#include "test.h"

#include <stdlib.h>
#include <string.h>

enum { MANY = 1000, LIGHTS = 10 };
static const pm_rng_source source = {.seed = 1, .stream = PM_STREAM_GLOBAL};

/// Point lights of these powers; a coloured one has its channels 1 : 2 : 3.
static void lights_of(pm_scenes *s, const double *powers, size_t count, bool coloured)
{
    pm_scenes_begin(s);
    for (size_t i = 0; i < count; i++) {
        double p = powers[i];
        pm_spectrum flux = coloured ? pm_rgb(0.5 * p, p, 1.5 * p) : pm_gray(p);
        pm_scenes_point(s, pm_vec((double)i, 0.0, 0.0), flux);
    }
    pm_scenes_ready(s);
}

typedef struct {
    size_t count, powered;
    double powers[LIGHTS];
} light_set;

static const light_set sets[] = {
    {1, 1, {7.0}},
    {2, 2, {1.0, 1.0}},
    {2, 2, {9.0, 1.0}},
    {2, 2, {1.0, 9.0}},
    {2, 2, {1e-6, 1.0}},
    {2, 2, {1e38, 1e-38}},
    {3, 1, {0.0, 4.0, 0.0}},
    {4, 2, {0.0, 5.0, 0.0, 2.0}},
    {3, 3, {1.0, PM_PI, 100.0}},
    {10, 10, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10}},
    {10, 9, {1e-9, 1e-9, 1e-9, 1, 1e-9, 0, 1e-9, 1e-9, 1e-9, 1e-9}},
};
enum { SETS = sizeof sets / sizeof sets[0] };

static void check_shares(const light_set *set, const uint64_t *share, uint64_t count)
{
    uint64_t sum = 0;
    for (size_t i = 0; i < set->count; i++) {
        sum += share[i];
        CHECK_THAT((share[i] == 0) == (set->powers[i] == 0.0),
                   "light %zu of %g W gets %llu of %llu photons", i, set->powers[i],
                   (unsigned long long)share[i], (unsigned long long)count);
    }
    CHECK_THAT(sum == count, "shares add up to %llu of %llu", (unsigned long long)sum,
               (unsigned long long)count);
}

static void shares_add_up(void)
{
    for (size_t i = 0; i < SETS; i++) {
        pm_scenes s;
        lights_of(&s, sets[i].powers, sets[i].count, i % 2 == 1);
        uint64_t share[LIGHTS];
        for (uint64_t n = sets[i].powered; n <= MANY; n++) {
            CHECK_OK(pm_emit_share(&s.scene, NULL, n, share));
            check_shares(&sets[i], share, n);
        }
        pm_scenes_free(&s);
    }
}

static void shares_follow_power(void)
{
    // Rounded either way, never further; every light here is due at least one photon.
    static const double powers[4] = {1.0, 2.5, 3.25, 10.0};
    pm_scenes s;
    lights_of(&s, powers, 4, true);
    for (uint64_t n = 17; n <= MANY; n++) {
        uint64_t share[4];
        CHECK_OK(pm_emit_share(&s.scene, NULL, n, share));
        for (int i = 0; i < 4; i++) {
            CHECK_NEAR((double)share[i], (double)n * powers[i] / 16.75, 1.0);
        }
    }
    pm_scenes_free(&s);
}

static void weak_light_takes_from_strong(void)
{
    static const double powers[3] = {1e-9, 1.0, 1e-9};
    pm_scenes s;
    lights_of(&s, powers, 3, false);
    uint64_t share[3];
    CHECK_OK(pm_emit_share(&s.scene, NULL, 100, share));
    CHECK(share[0] == 1 && share[1] == 98 && share[2] == 1);
    pm_scenes_free(&s);
}

static void darkness_sends_nothing(void)
{
    static const double dark[2] = {0.0, 0.0};
    uint64_t share[2] = {77, 77};
    pm_scenes s;
    lights_of(&s, dark, 2, false);
    CHECK_OK(pm_emit_share(&s.scene, NULL, 100, share));
    CHECK(share[0] == 0 && share[1] == 0);
    pm_scenes_free(&s);
}

static void sharing_refuses(void)
{
    static const double three[4] = {1.0, 0.0, 1.0, 1.0};
    uint64_t share[4] = {77, 77, 77, 77};
    pm_scenes s;
    lights_of(&s, three, 4, false);
    CHECK_FAILS(pm_emit_share(&s.scene, NULL, 0, share), PM_EINPUT, "got 0");
    CHECK_FAILS(pm_emit_share(&s.scene, NULL, 2, share), PM_EINPUT, "between 3");
    CHECK_FAILS(pm_emit_share(&s.scene, NULL, PM_EMIT_MAX + 1ull, share), PM_EINPUT,
                "got 4294967296");
    CHECK(share[0] == 77 && share[3] == 77);
    CHECK_OK(pm_emit_share(&s.scene, NULL, PM_EMIT_MAX, share));
    CHECK(share[0] + share[2] + share[3] == PM_EMIT_MAX && share[1] == 0);
    pm_scenes_free(&s);
}

/// All photons of a pass of `count`; free() them.
static pm_start *emit_all(const pm_scenes *s, uint32_t count)
{
    uint64_t share[LIGHTS];
    CHECK_OK(pm_emit_share(&s->scene, NULL, count, share));
    pm_emission emission = {&s->scene, source, count, share, NULL};
    pm_start *starts = calloc(count, sizeof *starts);
    CHECK(starts != NULL);
    CHECK_OK(pm_emit_photons(&emission, 0, count, starts));
    return starts;
}

static void check_power(const pm_scenes *s, uint32_t count)
{
    pm_start *starts = emit_all(s, count);
    pm_spectrum sum[LIGHTS] = {0};
    for (uint32_t i = 0; i < count; i++) {
        sum[starts[i].light] = pm_spectrum_add(sum[starts[i].light], starts[i].power);
    }
    for (int i = 0; i < s->scene.light_count; i++) {
        for (int c = 0; c < 3; c++) {
            double want = s->lights[i].flux.c[c] * count;
            CHECK_NEAR(sum[i].c[c], want, 1e-12 * want);
        }
    }
    free(starts);
}

static void power_is_exact(void)
{
    static const uint32_t counts[4] = {1, 2, 3, 1000};
    for (size_t i = 0; i < SETS; i++) {
        pm_scenes s;
        lights_of(&s, sets[i].powers, sets[i].count, i % 2 == 0);
        for (int j = 0; j < 4; j++) {
            if (counts[j] >= sets[i].powered) {
                check_power(&s, counts[j]);
            }
        }
        pm_scenes_free(&s);
    }
}

static void every_kind_of_light_is_exact(void)
{
    static const double cone[2] = {0.2, 0.7};
    pm_scenes s;
    pm_scenes_begin(&s);
    int black = pm_scenes_diffuse(&s, pm_gray(0.0));
    int lamp = pm_scenes_wear(&s, pm_scenes_square(0.5, 1.0, true), black);
    pm_scenes_wear(&s, pm_scenes_square(3.0, -1.0, false), black);
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 0.0), pm_rgb(0.0, 3.0, 1e-3));
    pm_scenes_lamp(&s, lamp, pm_rgb(2.0, 0.0, 5.0));
    pm_scenes_sun(&s, pm_vec(0.0, 0.6, -0.8), pm_rgb(1.0, 0.9, 0.0));
    pm_scenes_spot(&s, pm_vec(0.0, 0.0, 0.5), pm_vec(0.0, 0.0, -1.0), cone,
                   pm_rgb(1e3, 1.0, 1e-3));
    pm_scenes_sky(&s, pm_rgb(0.1, 0.2, 0.4));
    pm_scenes_ready(&s);
    check_power(&s, 5);
    check_power(&s, 1000);
    pm_scenes_free(&s);
}

static void lights_take_turns(void)
{
    // With up to three lights no prefix is two photons away from proportion.
    for (size_t i = 0; i < SETS; i++) {
        if (sets[i].count > 3) {
            continue;
        }
        pm_scenes s;
        lights_of(&s, sets[i].powers, sets[i].count, false);
        uint64_t share[LIGHTS];
        CHECK_OK(pm_emit_share(&s.scene, NULL, MANY, share));
        pm_start *starts = emit_all(&s, MANY);
        double sent[LIGHTS] = {0};
        for (uint32_t p = 0; p < MANY; p++) {
            CHECK(starts[p].photon == p);
            sent[starts[p].light]++;
            for (size_t j = 0; j < sets[i].count; j++) {
                CHECK_NEAR(sent[j], (p + 1.0) * (double)share[j] / MANY, 2.0);
            }
        }
        free(starts);
        pm_scenes_free(&s);
    }
}

static void many_lights_take_turns(void)
{
    // Of ten lights the strong one may run ahead by one photon for each of the others.
    for (size_t i = 0; i < SETS; i++) {
        pm_scenes s;
        lights_of(&s, sets[i].powers, sets[i].count, false);
        uint64_t share[LIGHTS];
        CHECK_OK(pm_emit_share(&s.scene, NULL, MANY, share));
        pm_start *starts = emit_all(&s, MANY);
        double sent[LIGHTS] = {0};
        for (uint32_t p = 0; p < MANY; p++) {
            sent[starts[p].light]++;
            for (size_t j = 0; j < sets[i].count; j++) {
                double ahead = (double)sets[i].count;
                CHECK_NEAR(sent[j], (p + 1.0) * (double)share[j] / MANY, ahead);
            }
        }
        for (size_t j = 0; j < sets[i].count; j++) {
            CHECK_NEAR(sent[j], (double)share[j], 0.0);
        }
        free(starts);
        pm_scenes_free(&s);
    }
}

static bool same_start(const pm_start *a, const pm_start *b)
{
    return memcmp(&a->ray.origin, &b->ray.origin, sizeof a->ray.origin) == 0 &&
           memcmp(&a->ray.direction, &b->ray.direction, sizeof a->ray.direction) == 0 &&
           memcmp(&a->power, &b->power, sizeof a->power) == 0 && a->photon == b->photon &&
           a->light == b->light;
}

static void chunks_do_not_matter(void)
{
    static const uint32_t sizes[3] = {1, 7, 64};
    static const double powers[3] = {1.0, 5.0, 2.0};
    pm_scenes s;
    lights_of(&s, powers, 3, true);
    pm_start *whole = emit_all(&s, MANY);
    uint64_t share[3];
    CHECK_OK(pm_emit_share(&s.scene, NULL, MANY, share));
    pm_emission emission = {&s.scene, source, MANY, share, NULL};
    for (int i = 0; i < 3; i++) {
        for (uint32_t first = 0; first < MANY; first += sizes[i]) {
            pm_start part[64];
            uint32_t count = first + sizes[i] <= MANY ? sizes[i] : MANY - first;
            CHECK_OK(pm_emit_photons(&emission, first, count, part));
            for (uint32_t j = 0; j < count; j++) {
                CHECK(same_start(&part[j], &whole[first + j]));
            }
        }
    }
    free(whole);
    pm_scenes_free(&s);
}

static pm_vec3 first_direction(const pm_scenes *s, pm_rng_source from, uint64_t photon)
{
    uint64_t share = MANY;
    pm_emission emission = {&s->scene, from, MANY, &share, NULL};
    pm_start start;
    CHECK_OK(pm_emit_photons(&emission, photon, 1, &start));
    return start.ray.direction;
}

static void every_source_sends_others(void)
{
    pm_scenes s;
    lights_of(&s, (const double[1]){1.0}, 1, false);
    const pm_rng_source sources[5] = {{1, PM_STREAM_GLOBAL, 0},
                                      {2, PM_STREAM_GLOBAL, 0},
                                      {1, PM_STREAM_CAUSTIC, 0},
                                      {1, PM_STREAM_GLOBAL, 1},
                                      {1, PM_STREAM_GLOBAL, 2}};
    for (int i = 0; i < 5; i++) {
        for (int j = 0; j < i; j++) {
            CHECK(first_direction(&s, sources[i], 0).z != first_direction(&s, sources[j], 0).z);
        }
        CHECK(first_direction(&s, sources[i], 0).z != first_direction(&s, sources[i], 1).z);
    }
    pm_scenes_free(&s);
}

PM_TESTS(
    {"emit.1", "the shares of unlike lights add up to every count, none left out",
     shares_add_up},
    {"emit.2", "a share is the light's part of the power, rounded", shares_follow_power},
    {"emit.3", "a weak light takes its one photon from the strongest",
     weak_light_takes_from_strong},
    {"emit.8b", "lights of 0 W send no photon, and that is no fault", darkness_sends_nothing},
    {"emit.4", "no power, too few and too many photons are refused", sharing_refuses},
    {"emit.5", "the power handed out is flux times count, by light and channel",
     power_is_exact},
    {"emit.5b", "coloured lights of every kind hand out exactly their power by channel",
     every_kind_of_light_is_exact},
    {"emit.6", "every prefix of a pass holds three lights in proportion", lights_take_turns},
    {"emit.7", "ten lights get exactly their shares and take turns as well",
     many_lights_take_turns},
    {"emit.8", "a photon is the same in any chunk", chunks_do_not_matter},
    {"emit.9", "seed, map, pass and photon each change the draws", every_source_sends_others})
