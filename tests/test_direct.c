// Light straight from the lamps: closed forms for each kind, and what may stand in its way.
#include "direct.h"

#include "chance.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"

#include <string.h>

static const pm_rng_source source = {.seed = 8, .stream = PM_STREAM_TEST};

/// Where a ray from `above` downward meets the scene, and what it meets.
static void look_down(const pm_scenes *s, pm_vec3 above, pm_hit *hit, pm_lobes *lobes)
{
    pm_ray ray = {above, pm_vec(0.0, 0.0, -1.0), HUGE_VAL, 0.0, PM_NONE};
    CHECK(pm_closest(&s->world, &ray, hit));
    pm_material_lobes(&s->scene, hit, &ray, lobes);
}

/// Irradiance [W/m^2], from the radiance that a surface of albedo 1/2 sends up.
static pm_spectrum irradiance(const pm_scenes *s, pm_vec3 above, uint32_t samples,
                              const double shift[2])
{
    pm_hit hit;
    pm_lobes lobes;
    look_down(s, above, &hit, &lobes);
    pm_direct_query query = {.world = &s->world, .samples = samples, .step = 1};
    memcpy(query.shift, shift, sizeof query.shift);
    pm_spectrum radiance = pm_direct(&query, &hit, &lobes);
    return pm_spectrum_scale(radiance, PM_PI / 0.5);
}

static const double no_shift[2] = {0.0, 0.0};

/// A floor at z = 0 of albedo 1/2, material 0.
static void begin_floor(pm_scenes *s)
{
    pm_scenes_begin(s);
    pm_scenes_add(s, pm_scenes_square(20.0, 0.0, false), pm_scenes_diffuse(s, pm_gray(0.5)),
                  PM_NONE);
}

/// A square lamp of side `width` and radiance 17, `height` over the floor, facing it.
static int add_lamp(pm_scenes *s, double width, double height)
{
    int lamp = pm_scenes_add(s, pm_scenes_square(width, height, true), 0, PM_NONE);
    pm_scenes_lamp(s, lamp, pm_gray(17.0));
    return lamp;
}

/// E / (pi L) below the centre of a square of side `width` at `height`.
static double square_factor(double width, double height)
{
    double a = 0.5 * width / height;
    double q = a / sqrt(1.0 + a * a);
    return 4.0 / PM_PI * q * atan(q);
}

/// Mean and the variance of that mean, of `runs` lattices of `samples` with random shifts.
static double sampled(const pm_scenes *s, pm_vec3 above, uint32_t samples, int runs,
                      double *variance)
{
    double sum = 0.0;
    double squares = 0.0;
    for (int i = 0; i < runs; i++) {
        pm_rng rng = pm_rng_at(&source, (uint64_t)i, 0);
        double shift[2];
        shift[0] = pm_rng_draw(&rng);
        shift[1] = pm_rng_draw(&rng);
        double e = irradiance(s, above, samples, shift).c[1];
        sum += e;
        squares += e * e;
    }
    double mean = sum / runs;
    *variance = (squares / runs - mean * mean) / (runs - 1);
    return mean;
}

static void square_over_a_floor(void)
{
    // From far off to nearly touching, where E nears pi L; w = h gives 0.239456.
    static const double heights[5] = {10.0, 3.0, 1.0, 0.2, 0.04};
    CHECK_NEAR(square_factor(1.0, 1.0), 0.239456, 5e-7);
    for (int i = 0; i < 5; i++) {
        pm_scenes s;
        begin_floor(&s);
        add_lamp(&s, 1.0, heights[i]);
        pm_scenes_ready(&s);
        double variance;
        pm_vec3 above = pm_vec(0.0, 0.0, 0.5 * heights[i]);
        double mean = sampled(&s, above, 256, 300, &variance);
        double want = 17.0 * PM_PI * square_factor(1.0, heights[i]);
        CHECK_NEAR(mean, want, 5.0 * sqrt(variance) + 1e-4 * want);
        CHECK(heights[i] < 0.1 || sqrt(variance) < 1e-3 * want); // the bound has teeth
        pm_scenes_free(&s);
    }
}

static void lamp_of_the_cornell_box(void)
{
    // A lamp of .3 at height 1 gives 1.4855; touching, it gives pi L = 53.40708.
    pm_scenes s;
    begin_floor(&s);
    add_lamp(&s, 0.3, 1.0);
    pm_scenes_ready(&s);
    CHECK_NEAR(irradiance(&s, pm_vec(0.0, 0.0, 0.5), 100000, no_shift).c[0], 1.485500, 2e-6);
    pm_scenes_free(&s);
    CHECK_NEAR(17.0 * PM_PI * square_factor(1.0, 1e-6), 53.40708, 1e-5);
    begin_floor(&s);
    add_lamp(&s, 0.3, 0.003);
    pm_scenes_ready(&s);
    double want = 17.0 * PM_PI * square_factor(0.3, 0.003);
    CHECK_NEAR(want, 53.40708, 0.02);
    CHECK_NEAR(irradiance(&s, pm_vec(0.0, 0.0, 0.001), 1000000, no_shift).c[0], want, 0.02);
    pm_scenes_free(&s);
}

static void lattice_parts_make_one(void)
{
    // Four calls of 25 samples are one of 100.
    pm_scenes s;
    begin_floor(&s);
    add_lamp(&s, 1.0, 1.0);
    pm_scenes_ready(&s);
    pm_hit hit;
    pm_lobes lobes;
    look_down(&s, pm_vec(0.3, 0.1, 0.5), &hit, &lobes);
    pm_direct_query all = {.world = &s.world, .samples = 100, .step = 1, .shift = {0.3, 0.7}};
    double whole = pm_direct(&all, &hit, &lobes).c[0];
    double parts = 0.0;
    for (uint32_t first = 0; first < 4; first++) {
        pm_direct_query part = all;
        part.samples = 25;
        part.first = first;
        part.step = 4;
        parts += pm_direct(&part, &hit, &lobes).c[0] / 4.0;
    }
    CHECK(whole > 0.1);
    CHECK_NEAR(parts, whole, 1e-13 * whole);
    pm_scenes_free(&s);
}

static void size_cancels(void)
{
    // Lengths times 2^m: areas and squared distances cancel, to the last bit.
    double first = 0.0;
    for (int m = -20; m <= 20; m += 10) {
        double unit = ldexp(1.0, m);
        pm_scenes s;
        pm_scenes_begin(&s);
        pm_shape floor = pm_scenes_square(20.0 * unit, 0.0, false);
        pm_scenes_add(&s, floor, pm_scenes_diffuse(&s, pm_gray(0.5)), PM_NONE);
        add_lamp(&s, unit, unit);
        pm_scenes_ready(&s);
        double e = irradiance(&s, pm_vec(0.0, 0.0, 0.5 * unit), 64, no_shift).c[2];
        first = m == -20 ? e : first;
        CHECK_NEAR(e, first, 0.0);
        pm_scenes_free(&s);
    }
}

static void point_over_a_floor(void)
{
    // Phi cos / (4 pi d^2), in colour.
    for (double x = 0.0; x < 4.0; x += 0.37) {
        pm_scenes s;
        begin_floor(&s);
        pm_scenes_point(&s, pm_vec(0.0, 0.0, 2.0), pm_rgb(10.0, 1.0, 0.0));
        pm_scenes_ready(&s);
        double d2 = x * x + 4.0;
        double want = 2.0 / sqrt(d2) / (4.0 * PM_PI * d2);
        pm_spectrum e = irradiance(&s, pm_vec(x, 0.0, 1.0), 1, no_shift);
        CHECK_NEAR(e.c[0], 10.0 * want, 1e-13);
        CHECK_NEAR(e.c[1], want, 1e-13);
        CHECK_NEAR(e.c[2], 0.0, 0.0);
        pm_scenes_free(&s);
    }
}

static void sun_over_a_floor(void)
{
    for (double degrees = 0.0; degrees < 90.0; degrees += 15.0) {
        double angle = degrees * PM_PI / 180.0;
        pm_scenes s;
        begin_floor(&s);
        pm_scenes_sun(&s, pm_vec(sin(angle), 0.0, -cos(angle)), pm_rgb(3.0, 2.0, 1.0));
        pm_scenes_ready(&s);
        pm_spectrum e = irradiance(&s, pm_vec(1.0, 2.0, 1.0), 1, no_shift);
        CHECK_NEAR(e.c[0], 3.0 * cos(angle), 1e-13);
        CHECK_NEAR(e.c[2], cos(angle), 1e-13);
        pm_scenes_free(&s);
    }
}

/// Irradiance from a point light, a sun and a lamp, or some of them.
static double with_lights(bool point, bool sun, bool lamp)
{
    pm_scenes s;
    begin_floor(&s);
    if (point) {
        pm_scenes_point(&s, pm_vec(1.0, 0.0, 3.0), pm_gray(5.0));
    }
    if (sun) {
        pm_scenes_sun(&s, pm_vec(0.1, 0.2, -1.0), pm_gray(2.0));
    }
    if (lamp) {
        add_lamp(&s, 1.0, 1.0);
    }
    pm_scenes_ready(&s);
    double e = irradiance(&s, pm_vec(2.0, 0.0, 0.5), 64, no_shift).c[0];
    pm_scenes_free(&s);
    return e;
}

static void lights_add_up(void)
{
    double each = with_lights(true, false, false) + with_lights(false, true, false) +
                  with_lights(false, false, true);
    CHECK(each > 2.0);
    CHECK_NEAR(with_lights(true, true, true), each, 1e-14 * each);
    CHECK_NEAR(with_lights(false, false, false), 0.0, 0.0);

    // Four quarters of a lamp in one place.
    pm_scenes s;
    begin_floor(&s);
    for (int i = 0; i < 4; i++) {
        pm_scenes_point(&s, pm_vec(0.0, 0.0, 2.0), pm_gray(2.5));
    }
    pm_scenes_ready(&s);
    CHECK_NEAR(irradiance(&s, pm_vec(0.0, 0.0, 1.0), 1, no_shift).c[0], 10.0 / (16.0 * PM_PI),
               1e-14);
    pm_scenes_free(&s);
}

// --- what stands in the way

/// Irradiance below a light of kind 0 point, 1 lamp, 2 sun, with `thing` in the scene.
static double with_thing(int kind, pm_shape thing, bool null, double from)
{
    pm_scenes s;
    begin_floor(&s);
    int wear = null ? pm_scenes_null(&s) : pm_scenes_glass(&s, 1.5);
    pm_scenes_wear(&s, thing, wear);
    if (kind == 0) {
        pm_scenes_point(&s, pm_vec(0.0, 0.0, 2.0), pm_gray(1.0));
    } else if (kind == 1) {
        add_lamp(&s, 0.5, 2.0);
    } else {
        pm_scenes_sun(&s, pm_vec(0.0, 0.0, -1.0), pm_gray(1.0));
    }
    pm_scenes_ready(&s);
    double e = irradiance(&s, pm_vec(0.0, 0.0, from), 16, no_shift).c[0];
    pm_scenes_free(&s);
    return e;
}

static void things_between_block(void)
{
    for (int kind = 0; kind < 3; kind++) {
        pm_shape between = pm_scenes_square(3.0, 1.0, false);
        pm_shape aside = pm_shapes_sphere(pm_vec(5.0, 0.0, 1.0), 0.5);
        CHECK(with_thing(kind, aside, false, 0.5) > 0.0);
        CHECK_NEAR(with_thing(kind, between, false, 0.5), 0.0, 0.0); // glass, too
        CHECK_NEAR(with_thing(kind, between, true, 0.5), with_thing(kind, aside, true, 0.5),
                   0.0);
    }
}

static void things_behind_do_not(void)
{
    // Behind the lamp, however near, and under the floor, however near.
    for (int kind = 0; kind < 2; kind++) {
        pm_shape aside = pm_shapes_sphere(pm_vec(5.0, 0.0, 1.0), 0.5);
        double clear = with_thing(kind, aside, false, 0.5);
        static const double heights[4] = {3.0, 2.0 + 1e-9, -1e-9, -1.0};
        for (int i = 0; i < 4; i++) {
            pm_shape behind = pm_scenes_square(3.0, heights[i], false);
            CHECK_NEAR(with_thing(kind, behind, false, 0.5), clear, 0.0);
        }
    }
}

static void lamp_in_the_ceiling_plane(void)
{
    // The ceiling does not shade the lamp that lies in it, nor the lamp itself.
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_room(&s, 1.0, pm_scenes_diffuse(&s, pm_gray(0.5)));
    add_lamp(&s, 0.5, 1.0);
    pm_scenes_ready(&s);
    double variance;
    double mean = sampled(&s, pm_vec(0.0, 0.0, 0.0), 64, 100, &variance);
    double want = 17.0 * PM_PI * square_factor(0.5, 2.0);
    CHECK_NEAR(mean, want, 5.0 * sqrt(variance) + 1e-12);
    CHECK(sqrt(variance) < 1e-3 * want);
    pm_scenes_free(&s);
}

static void back_of_a_lamp_is_dark(void)
{
    pm_scenes s;
    begin_floor(&s);
    pm_scenes_lamp(&s, pm_scenes_add(&s, pm_scenes_square(1.0, 1.0, false), 0, 0),
                   pm_gray(1.0));
    pm_scenes_ready(&s);
    CHECK_NEAR(irradiance(&s, pm_vec(0.0, 0.0, 0.5), 64, no_shift).c[0], 0.0, 0.0);
    pm_scenes_free(&s);
}

static void lit_from_behind_is_dark(void)
{
    // A floor seen from above, lit from below; and a mirror, which has no diffuse lobe.
    pm_scenes s;
    pm_scenes_begin(&s);
    int white = pm_scenes_diffuse(&s, pm_gray(0.5));
    pm_scenes_wear(&s, pm_scenes_square(20.0, 0.0, false), white);
    pm_scenes_point(&s, pm_vec(0.0, 0.0, -2.0), pm_gray(1.0));
    pm_scenes_sun(&s, pm_vec(0.0, 0.0, 1.0), pm_gray(1.0));
    pm_scenes_ready(&s);
    CHECK_NEAR(irradiance(&s, pm_vec(0.0, 0.0, 0.5), 1, no_shift).c[0], 0.0, 0.0);
    pm_scenes_free(&s);

    pm_scenes_begin(&s);
    int mirror = pm_scenes_mirror(&s, pm_gray(1.0));
    pm_scenes_wear(&s, pm_scenes_square(20.0, 0.0, false), mirror);
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 2.0), pm_gray(1.0));
    pm_scenes_ready(&s);
    CHECK_NEAR(irradiance(&s, pm_vec(0.0, 0.0, 0.5), 1, no_shift).c[0], 0.0, 0.0);
    pm_scenes_free(&s);
}

static void sphere_lamp(void)
{
    // E = pi L (R / d)^2 at normal incidence, from half the lamp's samples.
    pm_scenes s;
    begin_floor(&s);
    int ball = pm_scenes_add(&s, pm_shapes_sphere(pm_vec(0.0, 0.0, 2.0), 0.5), 0, PM_NONE);
    pm_scenes_lamp(&s, ball, pm_gray(4.0));
    pm_scenes_ready(&s);
    double variance;
    double mean = sampled(&s, pm_vec(0.0, 0.0, 1.0), 256, 200, &variance);
    CHECK_NEAR(mean, PM_PI * 4.0 / 16.0, 5.0 * sqrt(variance));
    CHECK(sqrt(variance) < 2e-3 * mean);
    pm_scenes_free(&s);
}

/// Points drawn on a lamp that nearly touches the floor outshine each other; shared with
/// directions drawn by the floor they do not.
static void near_lamp_is_shared(void)
{
    pm_scenes s;
    begin_floor(&s);
    add_lamp(&s, 1.0, 0.02);
    pm_scenes_ready(&s);
    pm_light *lamp = &s.lights[0];
    double want = PM_PI * 17.0 * square_factor(1.0, 0.02);
    double alone;
    double shared;
    CHECK(lamp->extent == 0.0); // scenes made by hand do not know it
    sampled(&s, pm_vec(0.0, 0.0, 0.01), 16, 400, &alone);
    lamp->position = pm_vec(0.0, 0.0, 0.02);
    lamp->extent = sqrt(0.5);
    double mean = sampled(&s, pm_vec(0.0, 0.0, 0.01), 16, 400, &shared);
    CHECK_NEAR(mean, want, 5.0 * sqrt(shared));
    CHECK(25.0 * shared < alone);
    // Beside it, where the lamp is near, but few directions meet it.
    double e;
    mean = sampled(&s, pm_vec(0.8, 0.0, 0.01), 16, 2000, &e);
    lamp->extent = 0.0;
    CHECK_NEAR(mean, irradiance(&s, pm_vec(0.8, 0.0, 0.01), 1000000, no_shift).c[1],
               5.0 * sqrt(e));
    pm_scenes_free(&s);
}

PM_TESTS({"direct.1", "a square lamp lights the floor below as its closed form says",
          square_over_a_floor},
         {"direct.2", "a lamp about to touch the floor gives pi L", lamp_of_the_cornell_box},
         {"direct.3", "parts of a lattice add up to the whole", lattice_parts_make_one},
         {"direct.4", "the size of the scene changes no bit", size_cancels},
         {"direct.5", "a point light falls off by the square and the cosine",
          point_over_a_floor},
         {"direct.6", "a sun lights by the cosine", sun_over_a_floor},
         {"direct.7", "lights add up, and four quarters are one", lights_add_up},
         {"direct.8", "everything but null between floor and light blocks it, glass included",
          things_between_block},
         {"direct.9", "things behind the lamp or under the floor shade nothing",
          things_behind_do_not},
         {"direct.10", "a lamp in the plane of the ceiling is not shaded by it",
          lamp_in_the_ceiling_plane},
         {"direct.11", "a lamp is dark from behind", back_of_a_lamp_is_dark},
         {"direct.12", "a surface lit from behind, or without a diffuse lobe, is dark",
          lit_from_behind_is_dark},
         {"direct.13", "a sphere lamp gives pi L (R / d)^2", sphere_lamp},
         {"direct.14", "a lamp that nearly touches is shared with drawn directions",
          near_lamp_is_shared})
