// Shadow rays against closed forms, and what stands in their way.
#include "chance.h"
#include "direct.h"
#include "pictures.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"

static const double albedo = 0.8;
static const double half_shift[2] = {0.5, 0.5};

static void add_floor(pm_scenes *s)
{
    int white = pm_scenes_diffuse(s, pm_gray(albedo));
    pm_scenes_wear(s, pm_scenes_square(4.0, 0.0, false), white);
}

/// Radiance that leaves the floor at the origin upwards, by `samples` shadow rays a lamp.
static double direct_up(const pm_scenes *s, uint32_t samples)
{
    pm_vertex at = pm_pictures_meet(s, pm_vec(0.0, 0.0, 0.01), pm_vec(0.0, 0.0, -1.0));
    pm_spectrum radiance = pm_direct(&s->world, &at.hit, &at.lobes, samples, 0, 1, half_shift);
    return radiance.c[1];
}

/// E / (pi L) below the centre of a square of side w, h above.
static double under_square(double w, double h)
{
    double a = 0.5 * w / h;
    double q = a / sqrt(1.0 + a * a);
    return 4.0 / PM_PI * q * atan(q);
}

static void point_lights_follow_the_closed_form(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    add_floor(&s);
    pm_scenes_point(&s, pm_vec(0.6, -0.3, 0.7), pm_gray(5.0));
    pm_scenes_ready(&s);
    double distance2 = 0.36 + 0.09 + 0.49;
    double irradiance = 5.0 / (4.0 * PM_PI * distance2) * 0.7 / sqrt(distance2);
    CHECK_NEAR(direct_up(&s, 1), albedo / PM_PI * irradiance, 1e-14);
    pm_scenes_free(&s);
}

static void suns_follow_the_cosine(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    add_floor(&s);
    pm_scenes_sun(&s, pm_vec(3.0, 0.0, -4.0), pm_gray(2.0));
    pm_scenes_ready(&s);
    CHECK_NEAR(direct_up(&s, 1), albedo / PM_PI * 2.0 * 0.8, 1e-14);
    pm_scenes_free(&s);
}

static void square_lights_follow_the_closed_form(void)
{
    const double heights[] = {0.5, 1.0, 4.0};
    CHECK_NEAR(under_square(1.0, 1.0), 0.239456, 5e-7);
    for (int i = 0; i < 3; i++) {
        pm_scenes s;
        pm_scenes_begin(&s);
        add_floor(&s);
        int lamp = pm_scenes_add(&s, pm_scenes_square(1.0, heights[i], true), PM_NONE, PM_NONE);
        pm_scenes_lamp(&s, lamp, pm_gray(3.0));
        pm_scenes_ready(&s);
        double want = albedo * 3.0 * under_square(1.0, heights[i]);
        CHECK_NEAR(direct_up(&s, 4096), want, 1e-3 * want);
        pm_scenes_free(&s);
    }
}

// Samples of one pixel may stand on different surfaces; so each call's share of the lattice has
// to be fair by itself.
static void each_share_of_the_shadow_rays_is_fair(void)
{
    enum { CALLS = 8000, STEP = 4 };
    pm_scenes s;
    pm_scenes_begin(&s);
    add_floor(&s);
    int lamp = pm_scenes_add(&s, pm_scenes_square(1.0, 0.5, true), PM_NONE, PM_NONE);
    pm_scenes_lamp(&s, lamp, pm_gray(3.0));
    pm_scenes_ready(&s);
    pm_vertex at = pm_pictures_meet(&s, pm_vec(0.0, 0.0, 0.01), pm_vec(0.0, 0.0, -1.0));
    double want = albedo * 3.0 * under_square(1.0, 0.5);
    for (uint32_t first = 0; first < STEP; first++) {
        double sum = 0.0;
        double square = 0.0;
        for (uint64_t i = 0; i < CALLS; i++) {
            pm_rng rng = pm_shapes_rng(i, first);
            double shift[2];
            shift[0] = pm_rng_draw(&rng);
            shift[1] = pm_rng_draw(&rng);
            double x = pm_direct(&s.world, &at.hit, &at.lobes, 1, first, STEP, shift).c[0];
            sum += x;
            square += x * x;
        }
        double mean = sum / CALLS;
        CHECK_NEAR(mean, want, pm_chance_bound(square / CALLS - mean * mean, CALLS));
    }
    pm_scenes_free(&s);
}

/// Direct light on the floor from one of three kinds of light at (0, 0, 2), with a square that
/// is made of `type` at z = `height`.
static double lit_past(double height, pm_bsdf_type type, int kind)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    add_floor(&s);
    int material = type == PM_BSDF_NULL         ? pm_scenes_null(&s)
                   : type == PM_BSDF_DIELECTRIC ? pm_scenes_glass(&s, 1.5)
                                                : pm_scenes_diffuse(&s, pm_gray(0.5));
    pm_scenes_wear(&s, pm_scenes_square(3.0, height, true), material);
    if (kind == 0) {
        pm_scenes_point(&s, pm_vec(0.0, 0.0, 2.0), pm_gray(5.0));
    } else if (kind == 1) {
        int lamp = pm_scenes_add(&s, pm_scenes_square(1.0, 2.0, true), PM_NONE, PM_NONE);
        pm_scenes_lamp(&s, lamp, pm_gray(3.0));
    } else {
        pm_scenes_sun(&s, pm_vec(0.0, 0.0, -1.0), pm_gray(2.0));
    }
    pm_scenes_ready(&s);
    double radiance = direct_up(&s, 16);
    pm_scenes_free(&s);
    return radiance;
}

static void shadow_rays_end_at_the_light(void)
{
    for (int kind = 0; kind < 3; kind++) {
        double open = lit_past(-1.0, PM_BSDF_DIFFUSE, kind); // below the floor
        CHECK(open > 0.0);
        CHECK_NEAR(lit_past(1.0, PM_BSDF_DIFFUSE, kind), 0.0, 0.0);
        CHECK_NEAR(lit_past(1.0, PM_BSDF_DIELECTRIC, kind), 0.0, 0.0);
        CHECK_NEAR(lit_past(1.0, PM_BSDF_NULL, kind), open, 0.0);
        if (kind < 2) { // close behind the lamp
            CHECK_NEAR(lit_past(2.0001, PM_BSDF_DIFFUSE, kind), open, 0.0);
        }
    }
}

static void the_dark_sides_get_nothing(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    add_floor(&s);
    pm_scenes_point(&s, pm_vec(0.0, 0.0, -1.0), pm_gray(5.0)); // below the floor
    pm_scenes_sun(&s, pm_vec(0.0, 0.0, 1.0), pm_gray(5.0));
    int below = pm_scenes_add(&s, pm_scenes_square(1.0, -1.5, false), PM_NONE, PM_NONE);
    pm_scenes_lamp(&s, below, pm_gray(3.0));
    int away = pm_scenes_add(&s, pm_scenes_square(1.0, 1.0, false), PM_NONE, PM_NONE);
    pm_scenes_lamp(&s, away, pm_gray(3.0)); // above the floor, shining up
    pm_scenes_ready(&s);
    CHECK_NEAR(direct_up(&s, 64), 0.0, 0.0);
    pm_scenes_free(&s);
}

PM_TESTS({"direct.1", "a point light's direct light follows Phi cos / (4 pi d^2) to rounding",
          point_lights_follow_the_closed_form},
         {"direct.2", "a directional light's direct light follows the cosine",
          suns_follow_the_cosine},
         {"direct.3", "shadow rays to a square give the closed form at three heights",
          square_lights_follow_the_closed_form},
         {"direct.4", "each share of a pixel's shadow rays has the right mean by itself",
          each_share_of_the_shadow_rays_is_fair},
         {"direct.5",
          "shadow rays are blocked by glass, not by null nor by what is past the lamp",
          shadow_rays_end_at_the_light},
         {"direct.6", "lights behind a surface and backs of lamps give exactly nothing",
          the_dark_sides_get_nothing})
