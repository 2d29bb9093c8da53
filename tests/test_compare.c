// Errors of pictures: closed forms on constant pictures, the mask pixel by pixel, and halves
// that take the reference's noise out. What is noise and what a fault: test_coherence.c.
#include "chance.h"
#include "compare.h"
#include "exr.h"
#include "rng.h"
#include "test.h"

#include <jansson.h>
#include <libpng16/png.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 64 };

static const char *const files[2] = {"a.exr", "b.exr"};

static pm_image make(int width, int height)
{
    static const char *const names[7] = {"R",         "G",         "B",           "caustic.R",
                                         "caustic.G", "caustic.B", "mask.emitter"};
    pm_image image;
    CHECK_OK(pm_image_make(width, height, names, 7, &image));
    return image;
}

static void fill(pm_image *image, int first, double r, double g, double b)
{
    const double value[3] = {r, g, b};
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < image->width * image->height; i++) {
            image->plane[first + c][i] = (float)value[c];
        }
    }
}

static void set_gray(pm_image *image, int x, int y, float value)
{
    for (int c = 0; c < 3; c++) {
        image->plane[c][y * image->width + x] = value;
    }
}

static pm_compare_part measure(const pm_image *a, const pm_image *b, const char *layer,
                               bool masked)
{
    pm_compare_pair pair;
    pm_compare_part part;
    CHECK_OK(pm_compare_pair_make(a, b, files, masked, &pair));
    CHECK_OK(pm_compare_measure(&pair, layer, &part));
    pm_compare_pair_free(&pair);
    return part;
}

static void errors_have_their_closed_form(void)
{
    pm_image a = make(SIDE, SIDE);
    pm_image b = make(SIDE, SIDE);
    fill(&a, 0, 2.0, 6.0, 0.5);
    fill(&b, 0, 1.0, 2.0, 2.0);
    pm_compare_part part = measure(&a, &b, "", true);
    double y_a = 0.2126 * 2.0 + 0.7152 * 6.0 + 0.0722 * 0.5;
    double y_b = 0.2126 * 1.0 + 0.7152 * 2.0 + 0.0722 * 2.0;
    CHECK_NEAR(part.rel_mse, (y_a - y_b) * (y_a - y_b) / (y_b * y_b), 1e-12);
    CHECK_NEAR(part.rel_rmse, (y_a - y_b) / y_b, 1e-12);
    CHECK_NEAR(part.mean_b, y_b, 1e-12);
    CHECK_NEAR(part.max, y_a - y_b, 1e-12);
    CHECK_NEAR(part.mean_ratio[0], 2.0, 0.0);
    CHECK_NEAR(part.mean_ratio[1], 3.0, 0.0);
    CHECK_NEAR(part.mean_ratio[2], 0.25, 0.0);
    CHECK(!part.halves && !part.noise_known);
    pm_image_free(&a);
    pm_image_free(&b);
}

static void errors_are_relative_to_the_mean_not_the_pixel(void)
{
    pm_image a = make(2, 1);
    pm_image b = make(2, 1);
    set_gray(&a, 0, 0, 2.0F); // A 2 3, B 1 3: (1 + 0) / 2 over 2^2
    set_gray(&a, 1, 0, 3.0F);
    set_gray(&b, 0, 0, 1.0F);
    set_gray(&b, 1, 0, 3.0F);
    pm_compare_part part = measure(&a, &b, "", false);
    CHECK_NEAR(part.rel_mse, 0.125, 1e-12);
    CHECK_NEAR(part.mean_ratio[1], 1.25, 1e-12);
    CHECK(part.max_x == 0 && part.max_y == 0);
    pm_image_free(&a);
    pm_image_free(&b);
}

// Which pixels are left out, asked one by one.
static void mask_is_emitters_grown_and_a_frame(void)
{
    pm_image a = make(20, 16);
    pm_image b = make(20, 16);
    a.plane[6][8 * 20 + 7] = 1.0F;   // an emitter in A at 7,8
    b.plane[6][6 * 20 + 12] = 0.25F; // a part of one in B at 12,6
    pm_compare_pair pair;
    CHECK_OK(pm_compare_pair_make(&a, &b, files, true, &pair));
    for (int y = 0; y < 16; y++) {
        for (int x = 0; x < 20; x++) {
            bool frame = x < 4 || y < 4 || x >= 16 || y >= 12;
            bool near_a = abs(x - 7) <= 1 && abs(y - 8) <= 1;
            bool near_b = abs(x - 12) <= 1 && abs(y - 6) <= 1;
            CHECK_THAT(pair.counted[y * 20 + x] == !(frame || near_a || near_b), "pixel %d,%d",
                       x, y);
        }
    }
    CHECK(pair.count == 12 * 8 - 18);
    pm_compare_pair_free(&pair);
    CHECK_OK(pm_compare_pair_make(&a, &b, files, false, &pair));
    CHECK(pair.count == 20 * 16);
    pm_compare_pair_free(&pair);

    // A difference there does not count, and one beside it does.
    fill(&a, 0, 1.0, 1.0, 1.0);
    fill(&b, 0, 1.0, 1.0, 1.0);
    set_gray(&a, 8, 9, 100.0F);
    CHECK(measure(&a, &b, "", true).rel_mse == 0.0);
    set_gray(&a, 9, 9, 100.0F);
    CHECK_NEAR(measure(&a, &b, "", true).rel_mse, 99.0 * 99.0 / 78.0, 1e-9);
    pm_image_free(&a);
    pm_image_free(&b);
}

static void layers_are_measured_alone(void)
{
    pm_image a = make(SIDE, SIDE);
    pm_image b = make(SIDE, SIDE);
    fill(&a, 0, 1.0, 1.0, 1.0);
    fill(&b, 0, 1.0, 1.0, 1.0);
    fill(&a, 3, 0.5, 0.5, 0.5);
    fill(&b, 3, 0.25, 0.25, 0.25);
    pm_compare_pair pair;
    CHECK_OK(pm_compare_pair_make(&a, &b, files, true, &pair));
    CHECK(pm_compare_has(&pair, "caustic") && !pm_compare_has(&pair, "direct"));
    pm_compare_pair_free(&pair);
    CHECK(measure(&a, &b, "", true).rel_mse == 0.0);
    pm_compare_part part = measure(&a, &b, "caustic", true);
    CHECK_NEAR(part.rel_mse, 1.0, 1e-12);
    CHECK_NEAR(part.mean_ratio[0], 2.0, 1e-12);
    CHECK(strcmp(part.name, "caustic") == 0);
    pm_image_free(&a);
    pm_image_free(&b);
}

static void black_has_no_relative_error(void)
{
    pm_image a = make(SIDE, SIDE);
    pm_image b = make(SIDE, SIDE);
    pm_compare_part part = measure(&a, &b, "", true);
    CHECK(part.rel_mse == 0.0 && part.mean_ratio[0] == 1.0);
    fill(&a, 0, 1.0, 0.0, 0.0);
    part = measure(&a, &b, "", true);
    CHECK(isnan(part.rel_mse) && isnan(part.rel_rmse) && isnan(part.mean_ratio[0]));
    CHECK(part.mean_ratio[1] == 1.0 && part.max > 0.2);
    pm_image_free(&a);
    pm_image_free(&b);
}

static void bad_pairs_are_refused(void)
{
    static const char *const two[2] = {"R", "G"};
    pm_compare_pair pair = {.count = 77};
    pm_image a = make(SIDE, SIDE);
    pm_image b = make(SIDE, SIDE + 1);
    pm_image c;
    CHECK_OK(pm_image_make(SIDE, SIDE, two, 2, &c));
    CHECK_FAILS(pm_compare_pair_make(&a, &b, files, true, &pair), PM_EINPUT,
                "a.exr is 64x64, b.exr is 64x65: sizes must be equal");
    CHECK_FAILS(pm_compare_pair_make(&a, &c, files, true, &pair), PM_EINPUT,
                "b.exr: has no channel B");
    a.plane[4][5 * SIDE + 3] = NAN;
    CHECK_FAILS(pm_compare_pair_make(&a, &a, files, true, &pair), PM_EINPUT,
                "a.exr: pixel 3,5 of channel caustic.G is nan");
    a.plane[4][5 * SIDE + 3] = -INFINITY;
    CHECK_FAILS(pm_compare_pair_make(&a, &a, files, true, &pair), PM_EINPUT, "is -inf");
    a.plane[4][5 * SIDE + 3] = 0.0F;
    for (int i = 0; i < SIDE * SIDE; i++) {
        a.plane[6][i] = 1.0F; // nothing but emitter
    }
    CHECK_FAILS(pm_compare_pair_make(&a, &a, files, true, &pair), PM_EINPUT,
                "leaves no pixel; --no-mask compares all");
    CHECK(pair.count == 77);
    pm_image_free(&a);
    pm_image_free(&b);
    pm_image_free(&c);
    a = make(8, 100);
    CHECK_FAILS(pm_compare_pair_make(&a, &a, files, true, &pair), PM_EINPUT, "--no-mask");
    pm_image_free(&a);
}

static double draw_noise(uint64_t index)
{
    const pm_rng_source source = {.seed = 7, .stream = PM_STREAM_TEST};
    pm_rng rng = pm_rng_at(&source, index, 0);
    double u = pm_rng_draw(&rng);
    return u - 0.5; // variance 1/12
}

/// A picture of 1 with noise in two halves, channels in the order whole, first, second half; it
/// is all in the layer named, or in none that is stored ("").
static pm_image make_halved(const char *layer)
{
    char names[9][PM_IMAGE_NAME_ROOM];
    const char *name[9];
    const char *dot = layer[0] != '\0' ? "." : "";
    for (int i = 0; i < 9; i++) {
        static const char *const prefix[3] = {"", "half1.", "half2."};
        snprintf(names[i], sizeof names[i], "%s%s%s%c", prefix[i / 3], layer, dot,
                 "RGB"[i % 3]);
        name[i] = names[i];
    }
    pm_image image;
    CHECK_OK(pm_image_make(SIDE, SIDE, name, 9, &image));
    for (int i = 0; i < SIDE * SIDE; i++) {
        double one = 1.0 + draw_noise(2 * (uint64_t)i);
        double two = 1.0 + draw_noise(2 * (uint64_t)i + 1);
        for (int c = 0; c < 3; c++) {
            image.plane[c][i] = (float)(0.5 * (one + two));
            image.plane[3 + c][i] = (float)one;
            image.plane[6 + c][i] = (float)two;
        }
    }
    return image;
}

// A is 10 % too bright; B is the mean of two halves with noise. The product of the halves has
// mean 0.01 and, per pixel, variance 2 d^2 s^2 + s^4 with d = 0.1, s^2 = 1/12.
static void check_halved(const pm_compare_part *part)
{
    double pixels = (SIDE - 8) * (SIDE - 8);
    double variance = 2.0 * 0.01 / 12.0 + 1.0 / 144.0;
    double bound = pm_chance_bound(variance, pixels);
    CHECK_NEAR(part->rel_mse * part->mean_b * part->mean_b, 0.01, bound);
    CHECK(part->halves && !part->noise_known);
    CHECK_THAT(bound < 0.5 / 24.0, "a formula without halves, 0.01 + 1/24, would be found out");
}

static void halves_take_the_noise_out(void)
{
    pm_image a = make(SIDE, SIDE);
    pm_image b = make_halved("");
    fill(&a, 0, 1.1, 1.1, 1.1);
    pm_compare_part part = measure(&a, &b, "", true);
    check_halved(&part);
    pm_image_free(&a);
    pm_image_free(&b);
}

/// The image with R G B of 1 before its channels.
static pm_image with_total(pm_image *layer)
{
    const char *name[12] = {"R", "G", "B"};
    pm_image image;
    for (int i = 0; i < 9; i++) {
        name[3 + i] = layer->name[i];
    }
    CHECK_OK(pm_image_make(SIDE, SIDE, name, 12, &image));
    fill(&image, 0, 1.0, 1.0, 1.0);
    for (int i = 0; i < 9; i++) {
        memcpy(image.plane[3 + i], layer->plane[i], SIDE * SIDE * sizeof(float));
    }
    pm_image_free(layer);
    return image;
}

// The halves of a layer serve that layer, and neither another nor the whole picture.
static void halves_of_a_layer_are_its_own(void)
{
    pm_image a = make(SIDE, SIDE);
    pm_image layer = make_halved("caustic");
    pm_image b = with_total(&layer);
    fill(&a, 0, 1.5, 1.5, 1.5);
    fill(&a, 3, 1.1, 1.1, 1.1);
    pm_compare_part part = measure(&a, &b, "caustic", true);
    check_halved(&part);
    part = measure(&a, &b, "", true);
    CHECK(!part.halves && fabs(part.rel_mse - 0.25) < 1e-6);
    pm_image_free(&b);

    b = make_halved(""); // halves of the whole alone
    strcpy(b.name[3], "caustic.R");
    strcpy(b.name[4], "caustic.G");
    strcpy(b.name[5], "caustic.B");
    CHECK(!measure(&a, &b, "caustic", true).halves);
    pm_image_free(&a);
    pm_image_free(&b);
}

static void difference_is_painted_by_sign(void)
{
    pm_image a = make(20, 20);
    pm_image b = make(20, 20);
    fill(&a, 0, 1.0, 1.0, 1.0);
    fill(&b, 0, 1.0, 1.0, 1.0);
    for (int y = 0; y < 20; y++) {
        set_gray(&a, 6, y, 3.0F);
        set_gray(&a, 8, y, 0.0F);
    }
    char path[4096];
    double full = 0.0;
    pm_compare_pair pair;
    snprintf(path, sizeof path, "%s/d.png", pm_test_folder());
    CHECK_OK(pm_compare_pair_make(&a, &b, files, true, &pair));
    CHECK_OK(pm_compare_picture(&pair, path, &full));
    CHECK_NEAR(full, 2.0, 1e-12);
    pm_compare_pair_free(&pair);

    uint8_t pixels[20 * 20 * 3];
    png_image png = {.version = PNG_IMAGE_VERSION};
    CHECK(png_image_begin_read_from_file(&png, path));
    png.format = PNG_FORMAT_RGB;
    CHECK(png_image_finish_read(&png, NULL, pixels, 0, NULL));
    const uint8_t *row = pixels + (size_t)(10 * 20 * 3);
    CHECK(row[0] == 96 && row[1] == 96 && row[2] == 96);   // left out
    CHECK(row[15] == 0 && row[16] == 0 && row[17] == 0);   // equal
    CHECK(row[18] == 255 && row[20] == 0);                 // A brighter: red
    CHECK(row[24] == 0 && row[26] > 150 && row[26] < 255); // A darker, by half: blue
    pm_image_free(&a);
    pm_image_free(&b);
}

// Runs compare on two files of this test and gives its exit code; its output in `ran`.
static int run_compare(const char *a, const char *b, const char *option, const char *value,
                       pm_test_ran *ran)
{
    const char *argv[] = {pm_test_program("compare"), a, b, "--json", option, value, NULL};
    *ran = pm_test_run(argv, 60.0);
    return ran->exit_code;
}

static void program_tells_by_exit_code_and_json(void)
{
    char path[2][4096];
    pm_test_ran ran;
    for (int i = 0; i < 2; i++) {
        pm_image image = make(SIDE, SIDE);
        fill(&image, 0, 1.0 + 0.5 * i, 1.0 + 0.5 * i, 1.0 + 0.5 * i);
        snprintf(path[i], sizeof path[i], "%s/%s", pm_test_folder(), files[i]);
        CHECK_OK(pm_exr_write(path[i], &image));
        pm_image_free(&image);
    }
    CHECK(run_compare(path[0], path[1], NULL, NULL, &ran) == 0);
    json_t *object = json_loads(ran.out, 0, NULL);
    CHECK_NEAR(json_real_value(json_object_get(object, "rel_mse")), 1.0 / 9.0, 1e-12);
    CHECK_NEAR(json_real_value(json_object_get(object, "rel_rmse")), 1.0 / 3.0, 1e-12);
    CHECK_NEAR(json_real_value(json_object_get(object, "max")), 0.5, 1e-12);
    json_t *ratio = json_object_get(object, "mean_ratio");
    CHECK(json_array_size(ratio) == 3);
    CHECK_NEAR(json_real_value(json_array_get(ratio, 2)), 2.0 / 3.0, 1e-12);
    json_t *layers = json_object_get(object, "layers");
    CHECK(json_object_get(layers, "caustic") != NULL);
    CHECK(json_object_get(layers, "direct") == NULL);
    json_decref(object);
    pm_test_ran_free(&ran);

    CHECK(run_compare(path[0], path[1], "--max-rel-mse", "0.112", &ran) == 0);
    pm_test_ran_free(&ran);
    CHECK(run_compare(path[0], path[1], "--max-rel-mse", "0.111", &ran) == 1);
    pm_test_ran_free(&ran);
    CHECK(run_compare(path[0], path[1], "--same", NULL, &ran) == 1);
    CHECK_CONTAINS(ran.out, "\"verdict\": \"fault\"");
    pm_test_ran_free(&ran);
    CHECK(run_compare(path[0], path[0], "--same", NULL, &ran) == 0);
    CHECK_CONTAINS(ran.out, "\"verdict\": \"equal\"");
    pm_test_ran_free(&ran);
    CHECK(run_compare(path[0], "none.exr", NULL, NULL, &ran) == 2);
    CHECK_CONTAINS(ran.err, "none.exr: cannot be read");
    CHECK(ran.out[0] == '\0');
    pm_test_ran_free(&ran);
}

PM_TESTS({"compare.1", "errors of constant pictures have their closed form",
          errors_have_their_closed_form},
         {"compare.2", "an error is relative to the mean of B, not to the pixel",
          errors_are_relative_to_the_mean_not_the_pixel},
         {"compare.3", "emitters grown by a pixel and a frame of four are left out",
          mask_is_emitters_grown_and_a_frame},
         {"compare.4", "a layer is measured against its own mean", layers_are_measured_alone},
         {"compare.5", "a black reference has no relative error", black_has_no_relative_error},
         {"compare.6", "unequal sizes, missing channels, NaN and an empty mask are refused",
          bad_pairs_are_refused},
         {"compare.7", "halves take the reference's own noise out of the error",
          halves_take_the_noise_out},
         {"compare.8", "halves of a layer take the noise out of that layer",
          halves_of_a_layer_are_its_own},
         {"compare.9", "the difference is red where A is brighter and blue where darker",
          difference_is_painted_by_sign},
         {"compare.10", "the program says by exit code and JSON what it found",
          program_tells_by_exit_code_and_json})
