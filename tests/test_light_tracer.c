// Paths from the lights to the camera against paths from the eye, which share no estimator, and
// against closed forms of what refraction and the pinhole do.
#include "films.h"
#include "light.h"
#include "references.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

/// A floor under each kind of light, seen from the side by a wide camera.
static void floor_begin(pm_scenes *s, pm_light_type type)
{
    const double cone[2] = {0.3, 0.9};
    pm_scenes_begin(s);
    pm_scenes_add(s, pm_scenes_square(4.0, 0.0, false),
                  pm_scenes_diffuse(s, pm_rgb(0.8, 0.4, 0.2)), PM_NONE);
    if (type == PM_LIGHT_POINT) {
        pm_scenes_point(s, pm_vec(0.5, 0.2, 1.0), pm_gray(10.0));
    } else if (type == PM_LIGHT_SPOT) {
        pm_scenes_spot(s, pm_vec(0.5, 0.2, 2.0), pm_vec(0.1, 0.0, -1.0), cone, pm_gray(2.0));
    } else if (type == PM_LIGHT_DIRECTIONAL) {
        pm_scenes_sun(s, pm_vec(0.5, 0.2, -1.0), pm_gray(1.0));
    } else if (type == PM_LIGHT_AREA) {
        int lamp = pm_scenes_wear(s, pm_scenes_square(0.5, 1.5, true), PM_NONE);
        pm_scenes_lamp(s, lamp, pm_gray(5.0));
    } else {
        pm_scenes_sky(s, pm_gray(1.0));
    }
    pm_scenes_ready(s);
    pm_pictures_look(s, pm_vec(0.2, -1.0, 1.2), pm_vec(0.0, 0.0, 0.0), 1.2, 16);
}

static void direct_light_is_what_eyes_find(void)
{
    for (pm_light_type type = PM_LIGHT_POINT; type <= PM_LIGHT_CONSTANT; type++) {
        pm_scenes s;
        floor_begin(&s, type);
        pm_film_pair films = pm_films_of(&s, 15000, true);
        pm_pictures_means got = pm_films_means(&films, NULL, 0);
        pm_pictures_means want = pm_references_trace(&s, 64);
        CHECK_THAT(want.mean[PM_LAYER_DIRECT].c[0] > 0.0, "%s", pm_light_name(type));
        pm_references_agree(PM_LAYER_DIRECT, &got, &want);
        pm_films_free(&films);
        pm_scenes_free(&s);
    }
}

// A floor in the sun shines alike everywhere; what falls off towards the corners of a wide
// film, by the fourth power of the cosine, is the pinhole's alone.
static void every_part_of_the_film_is_weighed_right(void)
{
    enum { SIDE = 16, RINGS = 4 };
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_wear(&s, pm_scenes_square(8.0, 0.0, false), pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_sun(&s, pm_vec(0.0, 1.0, -1.0), pm_gray(1.0));
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, 0.0, 1.0), pm_vec(0.0, 0.0, 0.0), 3.0, SIDE);
    pm_film_pair films = pm_films_of(&s, 50000, true);
    int ring[SIDE * SIDE];
    for (int i = 0; i < SIDE * SIDE; i++) {
        double x = i % SIDE - 7.5;
        double y = i / SIDE - 7.5;
        ring[i] = (int)(sqrt(x * x + y * y) / 10.7 * RINGS);
    }
    double want = 0.5 / PM_PI * sqrt(0.5);
    for (int r = 0; r < RINGS; r++) {
        pm_pictures_means got = pm_films_means(&films, ring, r);
        double variance = got.variance[PM_LAYER_DIRECT].c[0];
        CHECK_THAT(25.0 * variance < 0.01 * want * want, "ring %d is too noisy", r);
        CHECK_CLOSE("direct", got.mean[PM_LAYER_DIRECT].c[0], want, variance, 0.0);
    }
    pm_films_free(&films);
    pm_scenes_free(&s);
}

// A lamp has extent, so both ways find all of its light: caustics of glass and mirror too.
static void caustics_are_what_eyes_find(void)
{
    pm_scenes s;
    pm_references_room(&s, true);
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, -0.95, 0.1), pm_vec(0.0, 1.0, 0.0), 0.9, 16);
    pm_film_pair films = pm_films_of(&s, 30000, true);
    pm_pictures_means got = pm_films_means(&films, NULL, 0);
    pm_pictures_means want = pm_references_trace(&s, 128);
    CHECK(got.mean[PM_LAYER_CAUSTIC].c[0] > 0.0);
    pm_references_agree(PM_LAYER_DIRECT, &got, &want);
    pm_references_agree(PM_LAYER_CAUSTIC, &got, &want);
    pm_references_agree(PM_LAYER_INDIRECT, &got, &want);
    pm_films_free(&films);
    pm_scenes_free(&s);
}

/// A room with a point light among a glass ball, a smooth mirror and a rough one.
static void point_room_begin(pm_scenes *s)
{
    pm_references_room(s, false);
    pm_scenes_wear(s, pm_shapes_sphere(pm_vec(0.1, 0.5, 0.4), 0.25),
                   pm_scenes_rough_mirror(s, PM_MICROFACET_GGX, 0.1));
    pm_scenes_point(s, pm_vec(0.1, -0.2, 0.3), pm_rgb(6.0, 5.0, 4.0));
    pm_scenes_ready(s);
    pm_pictures_look(s, pm_vec(0.0, -0.95, 0.1), pm_vec(0.0, 1.0, 0.0), 0.9, 16);
}

// Eye paths find a part, and light paths the rest: no more, no less.
static void the_two_passes_share_the_light(void)
{
    pm_scenes s;
    point_room_begin(&s);
    pm_film_pair films = pm_films_of(&s, 30000, true);
    pm_pictures_means want = pm_films_means(&films, NULL, 0);
    pm_reference_settings settings = pm_references_settings(96);
    pm_reference_report report;
    pm_image image = pm_references_take(&s, &settings, &report);
    pm_pictures_means eye = pm_references_means(&image);
    CHECK(report.light_paths == 0 && eye.mean[PM_LAYER_CAUSTIC].c[0] > 0.0);
    CHECK(eye.mean[PM_LAYER_CAUSTIC].c[0] < 0.7 * want.mean[PM_LAYER_CAUSTIC].c[0]);
    pm_image_free(&image);

    settings.light_paths = 60000;
    image = pm_references_take(&s, &settings, &report);
    pm_pictures_means got = pm_references_means(&image);
    CHECK(report.light_paths == 60000);
    pm_references_agree(PM_LAYER_DIRECT, &got, &want);
    pm_references_agree(PM_LAYER_CAUSTIC, &got, &want);
    pm_references_agree(PM_LAYER_INDIRECT, &got, &want);
    CHECK(got.mean[PM_LAYER_DIRECT].c[0] == eye.mean[PM_LAYER_DIRECT].c[0]);
    pm_image_free(&image);
    pm_films_free(&films);
    pm_scenes_free(&s);
}

// Under a flat sea the sun's light arrives less what Fresnel's equations mirror, and nothing
// else is light at the floor but what floor and sea exchange.
static void the_sun_under_water_has_a_closed_form(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_wear(&s, pm_scenes_square(3.0, 0.0, false),
                   pm_scenes_diffuse(&s, pm_rgb(0.8, 0.4, 0.2)));
    pm_scenes_wear(&s, pm_scenes_square(3.0, 1.0, false), pm_scenes_glass(&s, 1.5));
    pm_scenes_sun(&s, pm_vec(0.0, 0.0, -1.0), pm_gray(2.0));
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, -0.3, 0.8), pm_vec(0.0, 0.0, 0.0), 0.4, 8);
    pm_reference_settings settings = pm_references_settings(2);
    settings.light_paths = 160000;
    pm_reference_report report;
    pm_image image = pm_references_take(&s, &settings, &report);
    pm_pictures_means got = pm_references_means(&image);
    const double albedo[3] = {0.8, 0.4, 0.2};
    for (int c = 0; c < 3; c++) {
        double want = albedo[c] / PM_PI * 2.0 * 0.96;
        double variance = got.variance[PM_LAYER_CAUSTIC].c[c];
        CHECK_THAT(25.0 * variance < 0.01 * want * want, "too noisy");
        CHECK_CLOSE("caustic", got.mean[PM_LAYER_CAUSTIC].c[c], want, variance, 0.0);
    }
    CHECK(pm_spectrum_is_black(got.mean[PM_LAYER_DIRECT]));
    CHECK_CONTAINS(report.blind, "what smooth glass and mirrors show of the caustics of"
                                 " directional lights");
    pm_image_free(&image);
    pm_scenes_free(&s);
}

// A lossless glass ball around a point light in a globe: all light is a caustic of even
// irradiance E, which the globe makes E / (1 - rho).
static void a_light_in_glass_fills_a_globe(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    const double rho[3] = {0.5, 0.25, 0.75};
    pm_scenes_globe(&s, 1.0, pm_scenes_diffuse(&s, pm_rgb(rho[0], rho[1], rho[2])));
    pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 0.2), pm_scenes_glass(&s, 1.5));
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 0.0), pm_gray(4.0 * PM_PI));
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, 0.3, 0.0), pm_vec(0.0, 1.0, 0.0), 1.0, 8);
    pm_reference_settings settings = pm_references_settings(2);
    settings.light_paths = 60000;
    pm_image image = pm_references_take(&s, &settings, NULL);
    pm_pictures_means got = pm_references_means(&image);
    CHECK(pm_spectrum_is_black(got.mean[PM_LAYER_DIRECT]));
    for (int c = 0; c < 3; c++) {
        double caustic = rho[c] / PM_PI;
        CHECK_CLOSE("caustic", got.mean[PM_LAYER_CAUSTIC].c[c], caustic,
                    got.variance[PM_LAYER_CAUSTIC].c[c], 0.0);
        double indirect = caustic * rho[c] / (1.0 - rho[c]);
        double variance = got.variance[PM_LAYER_INDIRECT].c[c];
        CHECK_THAT(25.0 * variance < 0.01 * indirect * indirect, "too noisy");
        CHECK_CLOSE("indirect", got.mean[PM_LAYER_INDIRECT].c[c], indirect, variance, 0.0);
    }
    pm_image_free(&image);
    pm_scenes_free(&s);
}

// Lamps are met by chance, and rough metal takes light from anywhere: nothing here is left for
// light paths.
static void what_eyes_find_is_left_to_them(void)
{
    const double cone[2] = {0.1, 0.2}; // on the rough square
    pm_scenes s;
    pm_scenes_begin(&s);
    int rough = pm_scenes_rough_mirror(&s, PM_MICROFACET_GGX, 0.1);
    int mirror = pm_scenes_mirror(&s, pm_gray(1.0));
    pm_scenes_globe(&s, 2.0, pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_wear(&s, pm_scenes_square(1.0, 0.0, false), rough);
    pm_scenes_spot(&s, pm_vec(0.0, 0.0, 1.0), pm_vec(0.0, 0.0, -1.0), cone, pm_gray(1.0));
    int lamp = pm_scenes_wear(&s, pm_scenes_square(1.0, -0.5, true), PM_NONE);
    pm_scenes_lamp(&s, lamp, pm_gray(1.0));
    pm_scenes_wear(&s, pm_scenes_square(4.0, -1.0, false), mirror);
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, 1.0, 0.5), pm_vec(0.0, 1.5, 0.5), 1.0, 8);
    pm_film_pair all = pm_films_of(&s, 2000, true);
    CHECK(pm_films_means(&all, NULL, 0).mean[PM_LAYER_CAUSTIC].c[0] > 0.0);
    pm_films_free(&all);

    pm_film_pair left = pm_films_of(&s, 2000, false);
    for (int i = 0; i < left.pixels * PM_LAYER_COUNT; i++) {
        CHECK(pm_spectrum_is_black(left.half[0][i]));
    }
    pm_films_free(&left);
    pm_scenes_free(&s);
}

static void threads_do_not_matter(void)
{
    const int threads[3] = {1, 2, 7};
    pm_scenes s;
    point_room_begin(&s);
    pm_light_tracing tracing = pm_films_tracing(&s, 5000, true);
    size_t bytes = 16 * 16 * PM_LAYER_COUNT * sizeof(pm_spectrum);
    pm_spectrum *film[3];
    for (int i = 0; i < 3; i++) {
        uint64_t cut = 0;
        film[i] = calloc(1, bytes);
        CHECK(film[i] != NULL);
        omp_set_num_threads(threads[i]);
        CHECK_OK(pm_light_tracer_run(&tracing, film[i], &cut));
        CHECK(memcmp(film[0], film[i], bytes) == 0);
    }
    for (int i = 0; i < 3; i++) {
        free(film[i]);
    }
    pm_scenes_free(&s);
}

PM_TESTS({"light_tracer.1",
          "light traced to the camera from every kind of light is what eye"
          " paths find",
          direct_light_is_what_eyes_find},
         {"light_tracer.2", "a floor in the sun is as bright in the corners of a wide film",
          every_part_of_the_film_is_weighed_right},
         {"light_tracer.3", "caustics and indirect light of a lamp are what eye paths find",
          caustics_are_what_eyes_find},
         {"light_tracer.4", "with light paths the reference has all light of a point, and once",
          the_two_passes_share_the_light},
         {"light_tracer.5", "the floor of a calm sea has the sun's light less Fresnel's share",
          the_sun_under_water_has_a_closed_form},
         {"light_tracer.6", "a point light in glass fills a globe by E / (1 - rho)",
          a_light_in_glass_fills_a_globe},
         {"light_tracer.7", "what eye paths find is left to them",
          what_eyes_find_is_left_to_them},
         {"light_tracer.8", "any number of threads makes the same film", threads_do_not_matter})
