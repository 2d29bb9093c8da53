// What the reference promises of every picture: two independent halves of which it is the mean,
// layers that add up, the mask, the same bits for any number of threads, and plain words about
// what it cannot show.
#include "compare.h"
#include "exr.h"
#include "reference_blind.h"
#include "references.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"

#include <jansson.h>
#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <string.h>

static void room_begin(pm_scenes *s, int size)
{
    pm_references_room(s, true);
    pm_scenes_point(s, pm_vec(0.1, -0.2, 0.3), pm_rgb(1.0, 0.5, 1.0));
    pm_scenes_ready(s);
    pm_pictures_look(s, pm_vec(0.0, -0.95, 0.1), pm_vec(0.0, 1.0, 0.0), 0.9, size);
}

static const float *plane_of(const pm_image *image, const char *prefix, int layer, int c)
{
    char name[PM_IMAGE_NAME_ROOM];
    const char *dot = layer < PM_LAYER_COUNT ? "." : "";
    const char *word = layer < PM_LAYER_COUNT ? pm_layer_name((pm_layer)layer) : "";
    snprintf(name, sizeof name, "%s%s%s%c", prefix, word, dot, "RGB"[c]);
    const float *plane = pm_image_plane(image, name);
    CHECK_THAT(plane != NULL, "no channel %s", name);
    return plane;
}

static void check_sum(const pm_image *image, const char *prefix, int i, int c)
{
    double sum = 0.0;
    for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
        sum += (double)plane_of(image, prefix, layer, c)[i];
    }
    float got = plane_of(image, prefix, PM_LAYER_COUNT, c)[i];
    CHECK_THAT(got == (float)sum, "%s%c at %d: %.9g, layers %.9g", prefix, "RGB"[c], i,
               (double)got, sum);
}

static void layers_and_halves_add_up(void)
{
    pm_scenes s;
    room_begin(&s, 12);
    pm_reference_settings settings = pm_references_settings(8);
    settings.light_paths = 2000;
    pm_image image = pm_references_take(&s, &settings, NULL);
    for (int i = 0; i < 144 * 3; i++) {
        check_sum(&image, "", i / 3, i % 3);
        check_sum(&image, "half1.", i / 3, i % 3);
        check_sum(&image, "half2.", i / 3, i % 3);
        for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
            double one = (double)plane_of(&image, "half1.", layer, i % 3)[i / 3];
            double two = (double)plane_of(&image, "half2.", layer, i % 3)[i / 3];
            float whole = plane_of(&image, "", layer, i % 3)[i / 3];
            CHECK(whole == (float)(0.5 * (one + two)));
        }
    }
    CHECK(pm_image_plane(&image, "gather.radius") == NULL);
    CHECK(pm_image_plane(&image, "depth.Z") != NULL);
    pm_image_free(&image);
    pm_scenes_free(&s);
}

static double luminance_at(const pm_image *image, const char *prefix, int i)
{
    return pm_spectrum_luminance(pm_rgb((double)plane_of(image, prefix, PM_LAYER_COUNT, 0)[i],
                                        (double)plane_of(image, prefix, PM_LAYER_COUNT, 1)[i],
                                        (double)plane_of(image, prefix, PM_LAYER_COUNT, 2)[i]));
}

// (h1 - h2)^2 / 4 and (A - B)^2 / 2 of two seeds both estimate the variance of a pixel; their
// difference has mean 0, which halves that know of each other would miss.
static void halves_tell_the_noise(void)
{
    pm_scenes s;
    pm_references_room(&s, true);
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, -0.95, 0.5), pm_vec(0.0, 1.0, 0.3), 0.3, 40);
    pm_reference_settings settings = pm_references_settings(8);
    pm_reference_report report;
    omp_set_num_threads(1);
    pm_image a = pm_references_take(&s, &settings, &report);
    settings.seed = 2;
    pm_image b = pm_references_take(&s, &settings, NULL);
    double sum = 0.0;
    double squares = 0.0;
    double noise = 0.0;
    for (int i = 0; i < 1600; i++) {
        double half = luminance_at(&a, "half1.", i) - luminance_at(&a, "half2.", i);
        double whole = luminance_at(&a, "", i) - luminance_at(&b, "", i);
        double difference = 0.25 * half * half - 0.5 * whole * whole;
        sum += difference;
        squares += difference * difference;
        noise += 0.5 * whole * whole;
    }
    CHECK_THAT(5.0 * sqrt(squares) < 0.5 * noise, "too few pixels to tell");
    CHECK_CLOSE("noise by halves less noise by seeds", sum, 0.0, squares, 0.0);
    pm_image_free(&a);
    pm_image_free(&b);
    pm_scenes_free(&s);
}

// By hand from the halves, over the pixels that compare counts.
static void rel_error_is_that_of_the_mean(void)
{
    pm_scenes s;
    room_begin(&s, 24);
    pm_reference_settings settings = pm_references_settings(4);
    pm_reference_report report;
    pm_image image = pm_references_take(&s, &settings, &report);
    const char *const names[2] = {"a", "b"};
    pm_compare_pair pair;
    CHECK_OK(pm_compare_pair_make(&image, &image, names, true, &pair));
    CHECK(pair.count < 16 * 16);
    double squares = 0.0;
    double sum = 0.0;
    for (int i = 0; i < 24 * 24; i++) {
        if (pair.counted[i]) {
            double half = luminance_at(&image, "half1.", i) - luminance_at(&image, "half2.", i);
            squares += 0.25 * half * half;
            sum += luminance_at(&image, "", i);
        }
    }
    double count = (double)pair.count;
    CHECK_NEAR(report.rel_error, sqrt(squares / count) / (sum / count), 1e-12);
    pm_compare_pair_free(&pair);
    pm_image_free(&image);
    pm_scenes_free(&s);
}

/// The lamp must be marked in the pixels 2 to 5 of 8, each way, and nothing else.
static void check_mask(const pm_scenes *s)
{
    pm_reference_settings settings = pm_references_settings(4);
    pm_image image = pm_references_take(s, &settings, NULL);
    const float *mask = pm_image_plane(&image, "mask.emitter");
    for (int i = 0; i < 64; i++) {
        bool lamp = i % 8 >= 2 && i % 8 <= 5 && i / 8 >= 2 && i / 8 <= 5;
        CHECK_THAT(mask[i] == (lamp ? 1.0f : 0.0f), "pixel %d,%d", i % 8, i / 8);
    }
    pm_image_free(&image);
}

/// A square of this half width across y, that faces forward (+y) or back.
static pm_shape upright(double half, double y, bool forward)
{
    pm_vec3 corner = pm_vec(-half, y, -half);
    pm_vec3 across = pm_vec(2.0 * half, 0.0, 0.0);
    pm_vec3 up = pm_vec(0.0, 0.0, 2.0 * half);
    return forward ? pm_shapes_rectangle(corner, up, across)
                   : pm_shapes_rectangle(corner, across, up);
}

static void lamp_upright(pm_scenes *s, double half, double y, bool forward)
{
    int lamp = pm_scenes_wear(s, upright(half, y, forward), PM_NONE);
    pm_scenes_lamp(s, lamp, pm_gray(1.0));
}

static void look_ahead(pm_scenes *s)
{
    pm_scenes_ready(s);
    pm_pictures_look(s, pm_vec(0.0, 0.0, 0.0), pm_vec(0.0, 1.0, 0.0), 1.0, 8);
}

// Around the lamp is a wall whose paths meet the lamp behind the camera, after a D event.
static void emitters_are_marked(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    lamp_upright(&s, 0.5, 1.0, false);
    lamp_upright(&s, 4.0, -0.5, true);
    pm_scenes_wear(&s, upright(9.0, 3.0, false), pm_scenes_diffuse(&s, pm_gray(0.9)));
    look_ahead(&s);
    check_mask(&s);
    pm_scenes_free(&s);
}

static void emitters_are_marked_in_mirrors(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    lamp_upright(&s, 1.5, -1.0, true);
    pm_scenes_wear(&s, upright(2.0, 1.0, false), pm_scenes_mirror(&s, pm_gray(0.9)));
    look_ahead(&s);
    check_mask(&s);
    pm_scenes_free(&s);
}

// A mirror shows the sky; the wall around it meets the sky after a D event only.
static void sky_is_marked(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_sky(&s, pm_gray(1.0));
    pm_scenes_wear(&s, upright(0.5, 1.0, false), pm_scenes_mirror(&s, pm_gray(0.9)));
    pm_scenes_wear(&s, upright(9.0, 3.0, false), pm_scenes_diffuse(&s, pm_gray(0.9)));
    look_ahead(&s);
    check_mask(&s);
    pm_scenes_free(&s);
}

static void threads_do_not_matter(void)
{
    const int threads[3] = {1, 2, 7};
    pm_scenes s;
    room_begin(&s, 20);
    pm_reference_settings settings = pm_references_settings(4);
    settings.light_paths = 3000;
    pm_image first = {0};
    for (int i = 0; i < 3; i++) {
        omp_set_num_threads(threads[i]);
        pm_image image = pm_references_take(&s, &settings, NULL);
        if (i == 0) {
            first = image;
            continue;
        }
        CHECK_PICTURE(&image, &first, 1.0, NULL);
        pm_image_free(&image);
    }
    pm_image_free(&first);
    pm_scenes_free(&s);
}

static void wrong_numbers_are_refused(void)
{
    pm_scenes s;
    room_begin(&s, 4);
    pm_image image = {.width = 77};
    pm_reference_report report = {.cut = 77};
    pm_reference_settings settings = pm_references_settings(3);
    CHECK_FAILS(pm_reference_image(&s.world, &settings, &image, &report), PM_EINPUT,
                "samples of a pixel must be even and above 0, half of them for each half of"
                " the picture, got 3");
    settings.spp = 0;
    CHECK_FAILS(pm_reference_image(&s.world, &settings, &image, &report), PM_EINPUT, "got 0");
    settings.spp = 2;
    settings.light_paths = 1;
    CHECK_FAILS(pm_reference_image(&s.world, &settings, &image, &report), PM_EINPUT,
                "light paths must be 0 or lie between 2 (two a light) and 8589934589, got 1");
    CHECK(image.width == 77 && report.cut == 77);
    pm_scenes_free(&s);
}

static void light_paths_are_traced_where_they_find_something(void)
{
    pm_scenes s;
    pm_references_room(&s, true);
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, -0.95, 0.1), pm_vec(0.0, 1.0, 0.0), 0.9, 4);
    pm_reference_settings settings = pm_references_settings(2);
    settings.light_paths = 1000;
    pm_reference_report report;
    pm_image image = pm_references_take(&s, &settings, &report);
    CHECK(report.light_paths == 0 && report.blind[0] == '\0');
    pm_image_free(&image);
    pm_scenes_free(&s);
}

static void dark_pictures_are_called_black(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_wear(&s, pm_scenes_square(4.0, 0.0, false), pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 1.0), pm_gray(0.0));
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, 0.0, 2.0), pm_vec(0.0, 0.0, 0.0), 0.5, 4);
    pm_reference_settings settings = pm_references_settings(2);
    pm_reference_report report = {0};
    pm_image image = pm_references_take(&s, &settings, &report);
    CHECK(report.black && report.rel_error == 0.0 && report.too_bright == 0);
    pm_image_free(&image);
    s.lights[0].emitted = pm_gray(1e60); // above every float
    s.lights[0].flux = pm_gray(4.0 * PM_PI * 1e60);
    image = pm_references_take(&s, &settings, &report);
    CHECK(!report.black && report.too_bright == 16 && isnan(report.rel_error));
    pm_image_free(&image);
    pm_scenes_free(&s);
}

/// Runs reference with this number of samples and gives its exit code; output in `ran`.
static int run_reference(const char *path, const char *spp, const char *light_paths,
                         pm_test_ran *ran)
{
    const char *argv[] = {pm_test_program("reference"),
                          "scenes/cornell-spheres.xml",
                          "-o",
                          path,
                          "--spp",
                          spp,
                          "--size",
                          "24x24",
                          "--threads",
                          "1",
                          "--json",
                          light_paths != NULL ? "--light-paths" : NULL,
                          light_paths,
                          NULL};
    *ran = pm_test_run(argv, 60.0);
    return ran->exit_code;
}

static void program_writes_picture_and_report(void)
{
    char path[4096];
    pm_test_ran ran;
    snprintf(path, sizeof path, "%s/r.exr", pm_test_folder());
    CHECK(run_reference(path, "5", NULL, &ran) == 2);
    CHECK_CONTAINS(ran.err, "samples of a pixel must be even and above 0");
    CHECK(ran.out[0] == '\0' && fopen(path, "rb") == NULL);
    pm_test_ran_free(&ran);

    CHECK(run_reference(path, "4", "100", &ran) == 0);
    json_t *object = json_loads(ran.out, 0, NULL);
    CHECK(json_integer_value(json_object_get(object, "spp")) == 4);
    CHECK(json_real_value(json_object_get(object, "seconds")) > 0.0);
    CHECK(json_real_value(json_object_get(object, "rel_error")) > 0.0);
    CHECK(json_is_string(json_object_get(object, "blind")));
    CHECK(json_is_integer(json_object_get(object, "cut")));
    json_t *settings = json_object_get(object, "settings");
    CHECK(json_integer_value(json_object_get(settings, "light_paths")) == 100);
    CHECK(json_integer_value(json_object_get(settings, "width")) == 24);
    json_decref(object);
    pm_test_ran_free(&ran);

    pm_image image;
    CHECK_OK(pm_exr_read(path, &image));
    CHECK(image.width == 24 && pm_image_plane(&image, "half2.caustic.G") != NULL);
    pm_image_free(&image);
}

PM_TESTS({"reference_picture.1", "layers add up to R G B, and halves to twice the picture",
          layers_and_halves_add_up},
         {"reference_picture.2", "the halves tell the noise that pictures of two seeds show",
          halves_tell_the_noise},
         {"reference_picture.3", "rel_error is the masked error of the mean of both halves",
          rel_error_is_that_of_the_mean},
         {"reference_picture.4", "emitters are marked, and not what they light",
          emitters_are_marked},
         {"reference_picture.5", "emitters are marked where a mirror shows them",
          emitters_are_marked_in_mirrors},
         {"reference_picture.6", "any number of threads makes the same bits",
          threads_do_not_matter},
         {"reference_picture.7", "odd samples, none, and too few light paths are refused",
          wrong_numbers_are_refused},
         {"reference_picture.9", "light paths are traced only where they find something",
          light_paths_are_traced_where_they_find_something},
         {"reference_picture.10", "a picture is called black, or too bright for a float",
          dark_pictures_are_called_black},
         {"reference_picture.11", "the program writes the picture and says what it did",
          program_writes_picture_and_report},
         {"reference_picture.12", "the constant light is an emitter and marked as one",
          sky_is_marked})
