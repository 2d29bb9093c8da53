// The reference and glass that disperses: wavelengths leave energy as it is, channel by
// channel, and paths from the eye and from the lights see the same spectra.
#include "films.h"
#include "references.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"
#include "tiny_path_tracer.h"

#include <omp.h>
#include <stdlib.h>

/// Makes the scene's clear glass one that disperses.
static void disperse(pm_scenes *s, const pm_glass *glass)
{
    for (int i = 0; i < s->scene.material_count; i++) {
        if (s->materials[i].type == PM_BSDF_DIELECTRIC) {
            s->materials[i].glass = glass;
        }
    }
}

static void room_look(pm_scenes *s)
{
    pm_scenes_ready(s);
    pm_pictures_look(s, pm_vec(0.0, -0.95, 0.1), pm_vec(0.0, 1.0, 0.0), 0.9, 16);
}

static void agree(const pm_pictures_means *got, const pm_pictures_means *want)
{
    for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
        pm_references_agree((pm_layer)layer, got, want);
    }
}

// n^2 = 1 + 1.25 at every wavelength.
static void glass_of_one_index_is_clear_glass(void)
{
    static const pm_glass flat = {.name = "flat", .terms = 1, .b = {1.25}};
    pm_scenes s;
    pm_references_room(&s, true);
    room_look(&s);
    pm_pictures_means want = pm_references_trace(&s, 40);
    disperse(&s, &flat);
    pm_pictures_means got = pm_references_trace(&s, 40);
    agree(&got, &want);
    CHECK(got.mean[PM_LAYER_SPECULAR].c[0] != want.mean[PM_LAYER_SPECULAR].c[0]);
    pm_scenes_free(&s);
}

/// Ends the test unless a channel of pictures with several seeds is 1 on average.
static void check_white(const pm_scenes *s, const char *channel)
{
    const double runs = 16.0;
    double sum = 0.0;
    double squares = 0.0;
    omp_set_num_threads(1); // the runner keeps the other cores busy
    pm_reference_settings settings = pm_references_settings(32);
    for (settings.seed = 1; settings.seed <= 16; settings.seed++) {
        pm_image image = pm_references_take(s, &settings, NULL);
        double mean = pm_pictures_mean(&image, channel);
        sum += mean;
        squares += mean * mean;
        pm_image_free(&image);
    }
    double mean = sum / runs;
    double variance = (squares / runs - mean * mean) / (runs - 1.0);
    CHECK_THAT(variance < 1e-4, "too noisy: %g", variance);
    CHECK_CLOSE(channel, mean, 1.0, variance, 0.0);
}

// Whatever happens to a path in a sky of 1, among things that absorb nothing, it brings 1; its
// wavelengths, a new one past each diffuse event and each in fog, must do so on average. (Fog
// within the glass would do, too, but the noise of all its wavelengths' weights has no bound.)
static void a_white_furnace_stays_white(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    int glass = pm_scenes_glass(&s, 1.5);
    int fog = pm_scenes_medium(&s, 1.0, pm_gray(1.0), 0.3);
    pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(0.0, 0.6, 0.0), 0.6),
                   pm_scenes_diffuse(&s, pm_gray(1.0)));
    pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(-0.6, -0.4, 0.0), 0.5), glass);
    pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(0.6, -0.4, 0.0), 0.5), glass);
    pm_scenes_bound(&s, pm_shapes_sphere(pm_vec(0.0, -0.4, 0.6), 0.5), fog, PM_NONE);
    pm_scenes_sky(&s, pm_gray(1.0));
    disperse(&s, pm_glass_named("sf11"));
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, -4.0, 0.0), pm_vec(0.0, 0.0, 0.0), 0.3, 16);
    check_white(&s, "R");
    check_white(&s, "B");
    pm_scenes_free(&s);
}

static void rooms_agree_with_chance_and_with_light_paths(void)
{
    pm_scenes s;
    pm_references_room(&s, true);
    disperse(&s, pm_glass_named("diamond"));
    room_look(&s);
    pm_pictures_means want = pm_tiny_trace(&s.world, 40000);
    pm_pictures_means got = pm_references_trace(&s, 64);
    agree(&got, &want);
    want = pm_films_repeat(&s, 1500, 12);
    CHECK(want.mean[PM_LAYER_CAUSTIC].c[0] > 0.0);
    pm_references_agree(PM_LAYER_CAUSTIC, &got, &want);
    pm_references_agree(PM_LAYER_INDIRECT, &got, &want);
    pm_scenes_free(&s);
}

static void light_paths_bring_the_spectra_of_points(void)
{
    pm_scenes s;
    pm_references_room(&s, false);
    pm_scenes_point(&s, pm_vec(0.1, -0.2, 0.3), pm_rgb(6.0, 5.0, 4.0));
    disperse(&s, pm_glass_named("sf11"));
    room_look(&s);
    pm_pictures_means want = pm_films_repeat(&s, 1500, 12);
    pm_reference_settings settings = pm_references_settings(4);
    settings.light_paths = 1500;
    pm_pictures_means got = pm_references_repeat(&s, settings, 12);
    pm_references_agree(PM_LAYER_CAUSTIC, &got, &want);
    pm_references_agree(PM_LAYER_INDIRECT, &got, &want);
    pm_scenes_free(&s);
}

// --- a prism --------------------------------------------------------------------------------

enum { PRISM_SIDE = 12 };

/// A rectangle about `middle`, `across` wide in the plane of y = 0 and `deep` along y, that
/// faces along `normal` in that plane.
static pm_shape upright(pm_vec3 middle, pm_vec3 normal, double across, double deep)
{
    pm_vec3 along_y = pm_vec(0.0, deep, 0.0);
    pm_vec3 up = pm_vec_scale(pm_vec_cross(normal, pm_vec(0.0, 1.0, 0.0)), across);
    pm_vec3 corner = pm_vec_along(pm_vec_along(middle, along_y, -0.5), up, -0.5);
    return pm_shapes_rectangle(corner, along_y, up);
}

/// A lamp, two faces of SF11 that meet at 60 degrees, and a screen, placed for the least
/// deviation of the d line: light rises by half of it and falls as much.
static void prism_begin(pm_scenes *s)
{
    const double half = 0.5 * 66.343 * PM_PI / 180.0;
    const double far = 2.0;
    pm_vec3 rising = pm_vec(cos(half), 0.0, sin(half));
    pm_vec3 falling = pm_vec(cos(half), 0.0, -sin(half));
    pm_vec3 enters = pm_vec(-0.25, 0.0, 0.0);
    pm_vec3 leaves = pm_vec(0.25, 0.0, 0.0);
    pm_scenes_begin(s);
    int glass = pm_scenes_glass(s, 1.78472);
    disperse(s, pm_glass_named("sf11"));
    double root = sqrt(0.75);
    pm_scenes_wear(s, upright(enters, pm_vec(-root, 0.0, 0.5), 1.0, 2.0), glass);
    pm_scenes_wear(s, upright(leaves, pm_vec(root, 0.0, 0.5), 1.0, 2.0), glass);
    pm_vec3 from = pm_vec_along(enters, rising, -far);
    int lamp = pm_scenes_add(s, upright(from, rising, 0.2, 1.0), PM_NONE, PM_NONE);
    pm_scenes_lamp(s, lamp, pm_gray(10.0));
    pm_vec3 to = pm_vec_along(leaves, falling, far);
    pm_scenes_wear(s, upright(to, pm_vec_negate(falling), 1.6, 1.6),
                   pm_scenes_diffuse(s, pm_gray(0.8)));
    pm_scenes_ready(s);
    pm_vec3 eye = pm_vec_along(pm_vec_along(to, falling, -1.2), pm_vec(0.0, -1.0, 0.0), 1.0);
    pm_pictures_look(s, eye, to, 0.25, PRISM_SIDE);
}

/// The picture's caustic in the rows with this mark, as pm_films_means() has it.
static pm_pictures_means rows_of(const pm_image *image, const int *marks, int mark)
{
    pm_film_pair films = {.pixels = image->width * image->height};
    size_t size = (size_t)films.pixels * PM_LAYER_COUNT * sizeof(pm_spectrum);
    static const char *const names[2][3] = {
        {"half1.caustic.R", "half1.caustic.G", "half1.caustic.B"},
        {"half2.caustic.R", "half2.caustic.G", "half2.caustic.B"}};
    for (int h = 0; h < 2; h++) {
        films.half[h] = calloc(1, size);
        CHECK(films.half[h] != NULL);
        for (int c = 0; c < 3; c++) {
            const float *plane = pm_image_plane(image, names[h][c]);
            for (int i = 0; i < films.pixels; i++) {
                films.half[h][i * PM_LAYER_COUNT + PM_LAYER_CAUSTIC].c[c] = (double)plane[i];
            }
        }
    }
    pm_pictures_means means = pm_films_means(&films, marks, mark);
    pm_films_free(&films);
    return means;
}

// Red is bent least and falls on the upper part of the screen.
static void a_prism_has_the_same_spectrum_either_way(void)
{
    pm_scenes s;
    prism_begin(&s);
    int third[PRISM_SIDE * PRISM_SIDE];
    for (int i = 0; i < PRISM_SIDE * PRISM_SIDE; i++) {
        third[i] = 3 * (i / PRISM_SIDE) / PRISM_SIDE;
    }
    pm_film_pair films = pm_films_of(&s, 40000, true);
    pm_reference_settings settings = pm_references_settings(800);
    pm_image image = pm_references_take(&s, &settings, NULL);
    double red_over_blue[3];
    for (int t = 0; t < 3; t++) {
        pm_pictures_means want = pm_films_means(&films, third, t);
        pm_pictures_means got = rows_of(&image, third, t);
        pm_references_agree(PM_LAYER_CAUSTIC, &got, &want);
        const pm_spectrum *caustic = &want.mean[PM_LAYER_CAUSTIC];
        red_over_blue[t] = caustic->c[0] / caustic->c[2];
    }
    CHECK(red_over_blue[0] > 2.0 * red_over_blue[1]);
    CHECK(red_over_blue[1] > 1.3 * red_over_blue[2]);
    pm_image_free(&image);
    pm_films_free(&films);
    pm_scenes_free(&s);
}

static void threads_do_not_matter(void)
{
    const int threads[3] = {1, 2, 7};
    pm_image image[3];
    pm_scenes s;
    pm_references_room(&s, false);
    int fog = pm_scenes_medium(&s, 0.5, pm_gray(0.8), 0.3);
    pm_scenes_point(&s, pm_vec(0.1, -0.2, 0.3), pm_gray(5.0));
    s.lights[0].medium = fog;
    disperse(&s, pm_glass_named("sf11"));
    room_look(&s);
    s.scene.camera.medium = fog;
    pm_reference_settings settings = pm_references_settings(4);
    settings.light_paths = 5000;
    for (int i = 0; i < 3; i++) {
        omp_set_num_threads(threads[i]);
        image[i] = pm_references_take(&s, &settings, NULL);
        CHECK_PICTURE(&image[i], &image[0], 1.0, NULL);
    }
    for (int i = 0; i < 3; i++) {
        pm_image_free(&image[i]);
    }
    pm_scenes_free(&s);
}

PM_TESTS({"reference_dispersion.1", "glass of one index for all wavelengths is clear glass",
          glass_of_one_index_is_clear_glass},
         {"reference_dispersion.2", "a white furnace stays white in glass that disperses",
          a_white_furnace_stays_white},
         {"reference_dispersion.3",
          "a room with a diamond is what paths by chance and paths from its lamp find",
          rooms_agree_with_chance_and_with_light_paths},
         {"reference_dispersion.4", "light paths bring all spectra of a point light, and once",
          light_paths_bring_the_spectra_of_points},
         {"reference_dispersion.5",
          "a prism's spectrum is the same from the eye and from the lamp",
          a_prism_has_the_same_spectrum_either_way},
         {"reference_dispersion.6",
          "fog and spectra are the same bits for any number of threads", threads_do_not_matter})
