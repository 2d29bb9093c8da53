// Lights as a surface sees them: draws of points on them against closed forms and quadrature,
// and densities against the draws.
#include "light.h"

#include "chance.h"
#include "lattice.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"

#include <string.h>

#define DEGREE (PM_PI / 180.0)

static const double corner[2] = {0.0, 0.0};

// --- points, spots, suns, skies -------------------------------------------------------------

/// The one light of a scene, drawn once from `from`.
static bool draw_one(const pm_scenes *s, pm_vec3 from, pm_light_sample *sample)
{
    return pm_light_sample_from(&s->scene, &s->lights[0], from, corner, sample);
}

static void points_fall_off_by_the_square(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_point(&s, pm_vec(1.0, 2.0, 3.0), pm_rgb(4.0 * PM_PI, 0.0, 8.0 * PM_PI));
    pm_light_sample sample;
    CHECK(draw_one(&s, pm_vec(1.0, 2.0, -4.0), &sample));
    CHECK_NEAR(sample.radiance.c[0], 1.0 / 49.0, 1e-17);
    CHECK_NEAR(sample.radiance.c[1], 0.0, 0.0);
    CHECK_NEAR(sample.radiance.c[2], 2.0 / 49.0, 1e-16);
    CHECK_NEAR(sample.direction.z, 1.0, 0.0);
    CHECK(sample.pdf == 0.0 && !sample.endless && sample.target.z == 3.0);
    CHECK(!draw_one(&s, pm_vec(1.0, 2.0, 3.0), &sample));
    pm_scenes_free(&s);
}

static void falloff_is_mitsubas(void)
{
    // What Mitsuba 3.9's spot gives at a distance of 1.
    static const struct {
        double beam, cutoff, angle, share;
    } rows[] = {
        {15.0, 20.0, 14.9, 1.0},       {15.0, 20.0, 15.1, 0.98}, {15.0, 20.0, 18.0, 0.4},
        {15.0, 20.0, 19.9, 0.02},      {15.0, 20.0, 20.1, 0.0},  {0.0, 20.0, 5.0, 0.75},
        {20.0, 20.0, 19.9, 1.0},       {20.0, 20.0, 20.1, 0.0},  {1.0, 60.0, 50.0, 0.1695},
        {90.0, 120.0, 100.0, 2. / 3.}, {90.0, 120.0, 170.0, 0.0}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const double cone[2] = {rows[i].beam * DEGREE, rows[i].cutoff * DEGREE};
        double angle = rows[i].angle * DEGREE;
        pm_scenes s;
        pm_scenes_begin(&s);
        pm_scenes_spot(&s, pm_vec(1.0, 0.0, 0.0), pm_vec(0.0, 0.0, 2.0), cone, pm_gray(3.0));
        pm_light_sample sample;
        pm_vec3 from = pm_vec(1.0 + 2.0 * sin(angle), 0.0, 2.0 * cos(angle));
        bool lit = draw_one(&s, from, &sample);
        CHECK(lit == (rows[i].share > 0.0));
        CHECK_NEAR(lit ? sample.radiance.c[1] : 0.0, rows[i].share * 3.0 / 4.0, 5e-5);
        pm_scenes_free(&s);
    }
}

static void spots_power_is_the_integral(void)
{
    static const double cones[6][2] = {{15.0, 20.0}, {0.0, 20.0},  {90.0, 120.0},
                                       {0.0, 179.0}, {30.0, 30.0}, {29.99, 30.0}};
    for (int i = 0; i < 6; i++) {
        pm_light spot = {.type = PM_LIGHT_SPOT,
                         .beam = cones[i][0] * DEGREE,
                         .cutoff = cones[i][1] * DEGREE};
        enum { STEPS = 200000 };
        double sum = 0.0;
        for (int step = 0; step < STEPS; step++) {
            double angle = PM_PI * (step + 0.5) / STEPS;
            sum += pm_light_falloff(&spot, cos(angle)) * sin(angle);
        }
        CHECK_NEAR(pm_light_cone(&spot), 2.0 * PM_PI * sum * PM_PI / STEPS, 1e-4);
        CHECK_NEAR(pm_light_cone(&spot), 2.0 * PM_PI * sum * PM_PI / STEPS,
                   2e-5 * pm_light_cone(&spot) + 1e-5);
    }
}

static void narrow_spots_lose_no_digits(void)
{
    // pi/3 (b^2 + b c + c^2), whose relative error is of the order of c^2.
    for (double c = 1e-3; c > 1e-150; c *= 1e-3) {
        pm_light spot = {.type = PM_LIGHT_SPOT, .beam = 0.75 * c, .cutoff = c};
        double want = PM_PI / 3.0 * (0.5625 + 0.75 + 1.0) * c * c;
        CHECK_NEAR(pm_light_cone(&spot), want, (c * c + 1e-14) * want);
        for (double share = 0.0; share <= 2.0; share += 0.125) {
            double falloff = pm_light_falloff(&spot, cos(share * c));
            CHECK(falloff >= 0.0 && falloff <= 1.0);
        }
    }
}

static void suns_and_skies(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_sun(&s, pm_vec(0.0, 3.0, -4.0), pm_rgb(1.0, 2.0, 3.0));
    pm_scenes_sky(&s, pm_rgb(0.5, 0.0, 0.25));
    pm_light_sample sample;
    CHECK(draw_one(&s, pm_vec(7.0, 0.0, 0.0), &sample));
    CHECK(sample.endless && sample.pdf == 0.0 && sample.radiance.c[2] == 3.0);
    CHECK_NEAR(sample.direction.y, -0.6, 1e-15);
    CHECK_NEAR(sample.direction.z, 0.8, 1e-15);
    CHECK(
        !pm_light_sample_from(&s.scene, &s.lights[1], pm_vec(7.0, 0.0, 0.0), corner, &sample));
    CHECK_NEAR(pm_light_sky(&s.scene).c[0], 0.5, 0.0);
    CHECK_NEAR(pm_light_sky(&s.scene).c[2], 0.25, 0.0);
    s.scene.light_count = 1;
    CHECK(pm_spectrum_is_black(pm_light_sky(&s.scene)));
    pm_scenes_free(&s);
}

static void names(void)
{
    static const char *const want[5] = {"point", "area", "directional", "spot", "constant"};
    for (int i = 0; i < 5; i++) {
        CHECK(strcmp(pm_light_name((pm_light_type)i), want[i]) == 0);
    }
}

// --- lamps ----------------------------------------------------------------------------------

/// A lamp of radiance (2, 1, 0) over the receiver in the origin, which faces up.
typedef struct {
    const char *name;
    pm_shape shape;
    double irradiance; // over L; 0: by quadrature
    double facing;     // share of its area that faces the origin
} lamp_case;

enum { LAMPS = 6 };

/// Lambert's formula for a triangle above the horizon: half the sum over its edges of the angle
/// that an edge spans times the cosine of the edge's plane to the receiver's normal.
static double triangle_irradiance(pm_vec3 a, pm_vec3 b, pm_vec3 c)
{
    const pm_vec3 v[3] = {a, b, c};
    double sum = 0.0;
    for (int i = 0; i < 3; i++) {
        pm_vec3 across = pm_vec_cross(v[i], v[(i + 1) % 3]);
        double sine = pm_vec_length(across);
        sum += across.z / sine * atan2(sine, pm_vec_dot(v[i], v[(i + 1) % 3]));
    }
    return fabs(0.5 * sum);
}

static pm_vec3 triangle_normal(const pm_shape *mesh, uint32_t i, pm_vec3 v[3])
{
    for (int c = 0; c < 3; c++) {
        v[c] = mesh->vertices[mesh->triangles[i][c]];
    }
    return pm_vec_cross(pm_vec_sub(v[1], v[0]), pm_vec_sub(v[2], v[0]));
}

/// Sums Lambert's formula, and the areas, of the triangles that face the origin.
static void measure_mesh(lamp_case *lamp)
{
    lamp->irradiance = lamp->facing = 0.0;
    for (uint32_t i = 0; i < lamp->shape.triangle_count; i++) {
        pm_vec3 v[3];
        pm_vec3 normal = triangle_normal(&lamp->shape, i, v);
        if (pm_vec_dot(normal, v[0]) < 0.0) {
            lamp->irradiance += triangle_irradiance(v[0], v[1], v[2]);
            lamp->facing += 0.5 * pm_vec_length(normal) / lamp->shape.area;
        }
    }
}

/// By the midpoint rule over its side: cos cos / d^2 dA of what faces the origin.
static double cylinder_irradiance(const pm_shape *shape)
{
    enum { AROUND = 2000, ALONG = 400 };
    pm_frame frame = pm_frame_around(shape->axis);
    double sum = 0.0;
    for (int i = 0; i < AROUND * ALONG; i++) {
        double phi = 2.0 * PM_PI * (i % AROUND + 0.5) / AROUND;
        double height = shape->length * (i / AROUND + 0.5) / ALONG;
        pm_vec3 normal = pm_frame_to_world(&frame, pm_vec(cos(phi), sin(phi), 0.0));
        pm_vec3 at = pm_vec_along(pm_vec_along(shape->center, shape->axis, height), normal,
                                  shape->radius);
        double d2 = pm_vec_dot(at, at);
        sum += pm_most(0.0, -pm_vec_dot(normal, at)) * at.z / (d2 * d2);
    }
    return sum * shape->area / (AROUND * ALONG);
}

static void make_lamps(lamp_case lamps[LAMPS])
{
    double a = 0.5 / 1.5;
    double q = a / sqrt(1.0 + a * a);
    lamps[0] = (lamp_case){"square", pm_scenes_square(1.0, 1.5, true), 4.0 * q * atan(q), 1.0};
    lamps[1] =
        (lamp_case){"disk", pm_shapes_disk(pm_vec(0.0, 0.0, 1.5), pm_vec(0.0, 0.0, -1.0), 0.5),
                    PM_PI * 0.25 / (0.25 + 2.25), 1.0};
    pm_vec3 aside = pm_vec(0.9, 0.0, 1.2); // at a distance of 1.5
    lamps[2] = (lamp_case){"sphere", pm_shapes_sphere(aside, 0.6), PM_PI * 0.16 * 0.8, 0.3};
    pm_shape side = pm_shapes_cylinder(pm_vec(-0.5, 0.0, 1.5), pm_vec(1.0, 0.0, 0.0), 1.0, 0.6);
    lamps[3] =
        (lamp_case){"cylinder", side, cylinder_irradiance(&side), acos(0.6 / 1.5) / PM_PI};
    pm_frame askew = pm_shapes_askew();
    lamps[4] = (lamp_case){"cube", pm_shapes_cube(&askew, pm_vec(0.3, -0.2, 1.5), 0.4), 0, 0};
    lamps[5] = (lamp_case){"ball", pm_shapes_ball(aside, 0.6, 9, 14), 0, 0};
    measure_mesh(&lamps[4]);
    measure_mesh(&lamps[5]);
}

/// The shape as the only lamp of a scene.
static void light_up(const lamp_case *lamp, pm_scenes *s)
{
    pm_scenes_begin(s);
    int shape = pm_scenes_add(s, lamp->shape, PM_NONE, PM_NONE);
    pm_scenes_lamp(s, shape, pm_rgb(2.0, 1.0, 0.0));
    pm_scenes_ready(s);
}

static void draws_give_the_irradiance(void)
{
    lamp_case lamps[LAMPS];
    make_lamps(lamps);
    for (int l = 0; l < LAMPS; l++) {
        enum { DRAWS = 100000 };
        pm_scenes s;
        light_up(&lamps[l], &s);
        double sum = 0.0;
        double squares = 0.0;
        int facing = 0;
        for (uint64_t i = 0; i < DRAWS; i++) {
            pm_rng rng = pm_shapes_rng(i, (uint32_t)l);
            double u[2];
            u[0] = pm_rng_draw(&rng);
            u[1] = pm_rng_draw(&rng);
            pm_light_sample sample;
            if (pm_light_sample_from(&s.scene, &s.lights[0], pm_vec(0, 0, 0), u, &sample)) {
                double e = sample.radiance.c[0] * sample.direction.z;
                CHECK(sample.radiance.c[1] == 0.5 * sample.radiance.c[0]);
                sum += e;
                squares += e * e;
                facing++;
            }
        }
        double mean = sum / DRAWS;
        double variance = squares / DRAWS - mean * mean;
        double want = 2.0 * lamps[l].irradiance;
        CHECK_THAT(fabs(mean - want) <= pm_chance_bound(variance, DRAWS), "%s: %g, not %g",
                   lamps[l].name, mean, want);
        CHECK(pm_chance_bound(variance, DRAWS) < 0.05 * want); // the bound has teeth
        double share = lamps[l].facing;
        CHECK_NEAR((double)facing / DRAWS, share,
                   pm_chance_bound(share * (1.0 - share), DRAWS) + 1e-15);
        pm_scenes_free(&s);
    }
}

/// Draws one direction to the lamp and looks there: the density must be that of the draw.
static void check_density(const pm_scenes *s, pm_rng *rng, const char *name)
{
    double u[2];
    u[0] = pm_rng_draw(rng);
    u[1] = pm_rng_draw(rng);
    pm_vec3 from = pm_vec(0.0, 0.0, 0.0);
    pm_light_sample sample;
    pm_hit hit;
    if (!pm_light_sample_from(&s->scene, &s->lights[0], from, u, &sample)) {
        return;
    }
    pm_ray ray = {from, sample.direction, HUGE_VAL, 0.0, PM_NONE};
    if (!pm_closest(&s->world, &ray, &hit)) {
        return; // a draw on the very edge
    }
    double cosine = -pm_vec_dot(hit.normal, sample.direction);
    double pdf = pm_light_pdf(&s->scene, &hit, from, sample.direction);
    CHECK_THAT(fabs(pdf / sample.pdf - 1.0) < 1e-12 / (cosine * cosine * cosine),
               "%s: density %.17g, drawn with %.17g at cosine %g", name, pdf, sample.pdf,
               cosine);
    CHECK_NEAR(pm_light_emitted(&s->scene, &hit, pm_vec_negate(sample.direction)).c[0], 2.0,
               0.0);
    CHECK(pm_light_emitted(&s->scene, &hit, sample.direction).c[0] == 0.0);
    CHECK(pm_light_pdf(&s->scene, &hit, from, pm_vec_negate(sample.direction)) == 0.0);
}

static void density_is_that_of_the_draws(void)
{
    lamp_case lamps[LAMPS];
    make_lamps(lamps);
    for (int l = 0; l < LAMPS; l++) {
        pm_scenes s;
        light_up(&lamps[l], &s);
        for (uint64_t i = 0; i < 2000; i++) {
            pm_rng rng = pm_shapes_rng(i, 100);
            check_density(&s, &rng, lamps[l].name);
        }
        pm_scenes_free(&s);
    }
}

static void density_adds_up_to_what_faces(void)
{
    // By even directions over the upper half, 2 pi sr. Coarse: it has a pole at outlines.
    enum { DIRECTIONS = 20000 };
    lamp_case lamps[LAMPS];
    make_lamps(lamps);
    for (int l = 0; l < LAMPS; l++) {
        pm_scenes s;
        light_up(&lamps[l], &s);
        double sum = 0.0;
        for (uint32_t i = 0; i < DIRECTIONS; i++) {
            double u[2];
            pm_lattice_point(corner, i, DIRECTIONS, u);
            double radius = sqrt(1.0 - u[0] * u[0]);
            double phi = 2.0 * PM_PI * u[1];
            pm_vec3 way = pm_vec(radius * cos(phi), radius * sin(phi), u[0]);
            pm_ray ray = {pm_vec(0.0, 0.0, 0.0), way, HUGE_VAL, 0.0, PM_NONE};
            pm_hit hit;
            if (pm_closest(&s.world, &ray, &hit)) {
                sum += pm_light_pdf(&s.scene, &hit, ray.origin, way);
            }
        }
        double got = sum * 2.0 * PM_PI / DIRECTIONS;
        CHECK_THAT(fabs(got - lamps[l].facing) < 0.04 * lamps[l].facing, "%s: %g, not %g",
                   lamps[l].name, got, lamps[l].facing);
        pm_scenes_free(&s);
    }
}

static void what_is_no_lamp_has_no_density(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_wear(&s, pm_scenes_square(1.0, 1.0, true), pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 5.0), pm_gray(1.0));
    pm_scenes_ready(&s);
    pm_ray up = {pm_vec(0.0, 0.0, 0.0), pm_vec(0.0, 0.0, 1.0), HUGE_VAL, 0.0, PM_NONE};
    pm_hit hit;
    CHECK(pm_closest(&s.world, &up, &hit));
    CHECK(pm_light_pdf(&s.scene, &hit, up.origin, up.direction) == 0.0);
    CHECK(pm_spectrum_is_black(pm_light_emitted(&s.scene, &hit, pm_vec(0.0, 0.0, -1.0))));
    pm_scenes_free(&s);
}

static void places_are_those_of_the_draws(void)
{
    lamp_case lamps[LAMPS];
    make_lamps(lamps);
    for (int l = 0; l < LAMPS; l++) {
        pm_scenes s;
        light_up(&lamps[l], &s);
        for (uint64_t i = 0; i < 100; i++) {
            pm_rng rng = pm_shapes_rng(i, 9);
            double u[2];
            u[0] = pm_rng_draw(&rng);
            u[1] = pm_rng_draw(&rng);
            pm_vec3 from = pm_vec(0.0, 0.0, 0.0);
            pm_vec3 place;
            pm_light_sample sample;
            CHECK(pm_light_place(&s.scene, &s.lights[0], u, &place));
            if (pm_light_sample_from(&s.scene, &s.lights[0], from, u, &sample)) {
                pm_vec3 way = pm_vec_normalize(pm_vec_sub(place, from));
                CHECK_NEAR(pm_vec_dot(way, sample.direction), 1.0, 1e-14);
            }
        }
        pm_scenes_free(&s);
    }
    pm_vec3 place;
    pm_light sun = {.type = PM_LIGHT_DIRECTIONAL};
    pm_light sky = {.type = PM_LIGHT_CONSTANT};
    CHECK(!pm_light_place(NULL, &sun, corner, &place));
    CHECK(!pm_light_place(NULL, &sky, corner, &place));
}

PM_TESTS({"light.1", "a point light falls off by the square of the distance",
          points_fall_off_by_the_square},
         {"light.2", "a spot falls off with the angle as Mitsuba's does", falloff_is_mitsubas},
         {"light.3", "a spot's power is its intensity over all directions",
          spots_power_is_the_integral},
         {"light.4", "however narrow a spot, its power keeps its digits",
          narrow_spots_lose_no_digits},
         {"light.5", "suns come from outside, the constant light is not drawn", suns_and_skies},
         {"light.6", "lights are called what scene files call them", names},
         {"light.7", "draws on a lamp of any shape give its closed form",
          draws_give_the_irradiance},
         {"light.8", "the density at a point of a lamp is that of the draws",
          density_is_that_of_the_draws},
         {"light.9", "the density over all directions is the share of the lamp that is seen",
          density_adds_up_to_what_faces},
         {"light.10", "what is no lamp shines not and is never drawn",
          what_is_no_lamp_has_no_density},
         {"light.11", "the place of a draw lies where the draw points to",
          places_are_those_of_the_draws})
