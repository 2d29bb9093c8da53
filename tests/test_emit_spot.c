// Spots against the intensity that their law gives, by quadrature; the constant light against
// the irradiance that it must give everywhere in the scene.
#include "emit.h"

#include "chance.h"
#include "light.h"
#include "scenes.h"
#include "spot.h"
#include "test.h"

#include <stdlib.h>

enum { COUNT = 100000, RINGS = 32, AROUND = 16 };
static const pm_rng_source source = {.seed = 3, .stream = PM_STREAM_TEST};

/// Half angles of beam and cutoff [rad].
static const double cones[][2] = {{0.3, 0.5}, {0.0, 1.0}, {0.7, 0.7},   {1.2, 3.0},
                                  {0.0, 3.1}, {2.0, 2.5}, {1e-4, 3e-4}, {0.999e-6, 1e-6}};
enum { CONES = sizeof cones / sizeof cones[0] };

static pm_light spot_of(const double cone[2])
{
    return (pm_light){.type = PM_LIGHT_SPOT,
                      .shape = PM_NONE,
                      .medium = PM_NONE,
                      .direction = pm_vec(0.6, 0.0, -0.8),
                      .beam = cone[0],
                      .cutoff = cone[1]};
}

/// Intensity times the sine, in terms of the angle alone.
static double density(const pm_light *light, double angle)
{
    double fading = light->cutoff - light->beam;
    double share = angle <= light->beam ? 1.0 : (light->cutoff - angle) / fading;
    return share * sin(angle);
}

/// Its integral from `a` to `b`, by Simpson's rule; beam and fading apart.
static double power_between(const pm_light *light, double a, double b)
{
    if (a < light->beam && b > light->beam) {
        return power_between(light, a, light->beam) + power_between(light, light->beam, b);
    }
    enum { STEPS = 200 };
    double step = (b - a) / STEPS;
    double sum = 0.0;
    for (int i = 0; i < STEPS; i++) {
        double from = a + i * step;
        sum += density(light, from) + 4.0 * density(light, from + 0.5 * step) +
               density(light, from + step);
    }
    return sum * step / 6.0;
}

static void angles_invert_the_power(void)
{
    for (int k = 0; k < CONES; k++) {
        pm_light light = spot_of(cones[k]);
        double all = power_between(&light, 0.0, light.cutoff);
        double before = 0.0;
        for (int i = 1; i <= 512; i++) {
            double angle = pm_spot_angle(&light, i / 512.0);
            CHECK_THAT(angle > before, "cone %d: the angle falls at %d/512", k, i);
            CHECK_NEAR(power_between(&light, before, angle) / all, 1.0 / 512.0, 2e-12);
            before = angle;
        }
        CHECK(pm_spot_angle(&light, 0.0) == 0.0);
        CHECK_NEAR(before, light.cutoff, 1e-7 * light.cutoff); // a double root: half the digits
        CHECK(before <= light.cutoff);
    }
}

static void the_law_is_that_of_shadow_rays(void)
{
    // What emission draws is the falloff that light.h gives for the same cosine.
    for (int k = 0; k < 6; k++) {
        pm_light light = spot_of(cones[k]);
        for (int i = 1; i < 300; i++) {
            double angle = light.cutoff * i / 300.0;
            CHECK_NEAR(pm_light_falloff(&light, cos(angle)) * sin(angle),
                       density(&light, angle), 1e-12);
        }
        double all = 2.0 * PM_PI * power_between(&light, 0.0, light.cutoff);
        CHECK_NEAR(pm_light_cone(&light), all, 1e-10 * all);
    }
}

/// Cells of equal angle times equal azimuth, against the power that goes there.
static void check_spot(const pm_light *light)
{
    static uint64_t cells[RINGS * AROUND];
    static double expected[RINGS * AROUND];
    pm_scene scene = {.path = "test.xml", .radius = 1.0};
    pm_frame frame = pm_frame_around(light->direction);
    for (int i = 0; i < RINGS * AROUND; i++) {
        double step = light->cutoff / RINGS;
        double from = i / AROUND * step;
        double all = power_between(light, 0.0, light->cutoff);
        cells[i] = 0;
        expected[i] = COUNT * power_between(light, from, from + step) / (all * AROUND);
    }
    for (uint64_t i = 0; i < COUNT; i++) {
        pm_rng rng = pm_rng_at(&source, i, 0);
        pm_ray ray;
        CHECK_OK(pm_emit_ray(&scene, light, NULL, &rng, &ray));
        CHECK_NEAR(pm_vec_length(ray.direction), 1.0, 1e-14);
        double x = pm_vec_dot(ray.direction, frame.s);
        double y = pm_vec_dot(ray.direction, frame.t);
        double angle = atan2(hypot(x, y), pm_vec_dot(ray.direction, frame.n));
        double turn = atan2(y, x) / (2.0 * PM_PI) + 0.5;
        int ring = (int)pm_least(angle / light->cutoff * RINGS, RINGS - 1.0);
        CHECK(angle <= light->cutoff * (1.0 + 1e-9));
        cells[ring * AROUND + (int)pm_least(turn * AROUND, AROUND - 1.0)]++;
    }
    CHECK_FIT(cells, expected, RINGS * AROUND);
}

static void spots_follow_their_intensity(void)
{
    for (int k = 0; k < 7; k += 3) {
        pm_light light = spot_of(cones[k]);
        check_spot(&light);
    }
}

static void a_beam_is_uniform(void)
{
    // Within the beam the share of directions up to an angle is that of the solid angle.
    pm_light light = spot_of((const double[2]){0.8, 0.8});
    pm_scene scene = {.path = "test.xml", .radius = 1.0};
    double within = 0.0;
    for (uint64_t i = 0; i < COUNT; i++) {
        pm_rng rng = pm_rng_at(&source, i, 0);
        pm_ray ray;
        CHECK_OK(pm_emit_ray(&scene, &light, NULL, &rng, &ray));
        within += pm_vec_dot(ray.direction, light.direction) > cos(0.4);
    }
    double want = (1.0 - cos(0.4)) / (1.0 - cos(0.8));
    CHECK_NEAR(within / COUNT, want, pm_chance_bound(want * (1.0 - want), COUNT));
}

// --- the constant light

/// A box of walls from -1 to 1 under a sky of radiance 0.5.
static pm_ray *sky_rays(pm_scenes *s)
{
    pm_scenes_begin(s);
    pm_scenes_room(s, 1.0, pm_scenes_diffuse(s, pm_gray(0.5)));
    pm_scenes_sky(s, pm_gray(0.5));
    pm_scenes_ready(s);
    pm_ray *rays = calloc(COUNT, sizeof *rays);
    CHECK(rays != NULL);
    for (uint64_t i = 0; i < COUNT; i++) {
        pm_rng rng = pm_rng_at(&source, i, 0);
        CHECK_OK(pm_emit_ray(&s->scene, &s->lights[0], NULL, &rng, &rays[i]));
    }
    return rays;
}

static void the_sky_starts_before_everything(void)
{
    pm_scenes s;
    pm_ray *rays = sky_rays(&s);
    static uint64_t cells[AROUND * AROUND];
    double radius = s.scene.radius;
    for (int i = 0; i < COUNT; i++) {
        double before = pm_vec_dot(rays[i].origin, rays[i].direction);
        CHECK(before <= -radius);
        pm_vec3 off = pm_vec_along(rays[i].origin, rays[i].direction, -before);
        CHECK(pm_vec_length(off) < radius * (1.0 + 1e-12));
        CHECK_NEAR(pm_vec_length(rays[i].direction), 1.0, 1e-14);
        pm_vec3 d = rays[i].direction;
        int row = (int)pm_least(0.5 * (1.0 - d.z) * AROUND, AROUND - 1.0);
        double turn = atan2(d.y, d.x) / (2.0 * PM_PI) + 0.5;
        cells[row * AROUND + (int)pm_least(turn * AROUND, AROUND - 1.0)]++;
    }
    CHECK_EVEN(cells, AROUND * AROUND);
    free(rays);
    pm_scenes_free(&s);
}

static void check_share(const pm_scenes *s, double met, double flux)
{
    double all = s->lights[0].flux.c[0];
    double share = flux / all;
    CHECK_NEAR(met / COUNT * all, flux, all * pm_chance_bound(share * (1.0 - share), COUNT));
}

static void the_sky_gives_pi_times_its_radiance(void)
{
    // Onto squares of side 0.5 inside, from above only: E = pi L, whatever way they face.
    static const pm_vec3 places[3] = {{0.0, 0.0, 0.0}, {0.7, 0.7, 0.7}, {-0.9, 0.2, 0.5}};
    pm_scenes s;
    pm_ray *rays = sky_rays(&s);
    CHECK_NEAR(s.lights[0].flux.c[0], 0.5 * 4.0 * PM_PI * PM_PI * 3.0, 1e-12);
    for (int k = 0; k < 3; k++) {
        pm_frame frame = pm_frame_around(pm_vec_normalize(pm_vec(0.3 + k, 1.0 - k, 0.5)));
        double met = 0.0;
        for (int i = 0; i < COUNT; i++) {
            pm_vec3 to = pm_vec_sub(places[k], rays[i].origin);
            double cosine = pm_vec_dot(rays[i].direction, frame.n);
            double t = pm_vec_dot(to, frame.n) / cosine;
            pm_vec3 off = pm_vec_sub(pm_vec_scale(rays[i].direction, t), to);
            met += cosine < 0.0 && fabs(pm_vec_dot(off, frame.s)) < 0.25 &&
                   fabs(pm_vec_dot(off, frame.t)) < 0.25;
        }
        check_share(&s, met, PM_PI * 0.5 * 0.25);
    }
    free(rays);
    pm_scenes_free(&s);
}

static void the_sky_fills_every_sphere(void)
{
    // Into a sphere of radius r: pi L 4 pi r^2, also where it touches the bounding sphere.
    static const double spheres[3][2] = {{0.0, 0.5}, {1.2, 0.3}, {1.63, 0.1}};
    pm_scenes s;
    pm_ray *rays = sky_rays(&s);
    for (int k = 0; k < 3; k++) {
        pm_vec3 center = pm_vec(0.0, -0.6 * spheres[k][0], 0.8 * spheres[k][0]);
        double radius = spheres[k][1];
        double met = 0.0;
        for (int i = 0; i < COUNT; i++) {
            pm_vec3 across =
                pm_vec_cross(pm_vec_sub(center, rays[i].origin), rays[i].direction);
            met += pm_vec_length(across) < radius;
        }
        check_share(&s, met, PM_PI * 0.5 * 4.0 * PM_PI * radius * radius);
    }
    free(rays);
    pm_scenes_free(&s);
}

PM_TESTS({"emit.40", "a spot's angle inverts the power within it, for narrow and wide cones",
          angles_invert_the_power},
         {"emit.41", "emission and shadow rays go by the same law of a spot",
          the_law_is_that_of_shadow_rays},
         {"emit.42", "a spot's photons follow its intensity", spots_follow_their_intensity},
         {"emit.43", "a spot's beam is uniform over the solid angle", a_beam_is_uniform},
         {"emit.44", "the sky comes from all around and starts before everything",
          the_sky_starts_before_everything},
         {"emit.45", "the sky gives pi times its radiance to any plane in the scene",
          the_sky_gives_pi_times_its_radiance},
         {"emit.46", "the sky sends as much into any sphere as its surface asks",
          the_sky_fills_every_sphere})
