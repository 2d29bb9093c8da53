// Pictures in memory and as PNG.
#include "image.h"
#include "png.h"
#include "test.h"

#include <libpng16/png.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const rgb[3] = {"R", "G", "B"};

static void planes_are_black_and_named(void)
{
    pm_image image;
    CHECK_OK(pm_image_make(3, 2, rgb, 3, &image));
    CHECK(image.width == 3 && image.height == 2 && image.channel_count == 3);
    for (int c = 0; c < 3; c++) {
        CHECK(pm_image_plane(&image, rgb[c]) == image.plane[c]);
        for (int i = 0; i < 6; i++) {
            CHECK(image.plane[c][i] == 0.0F);
        }
    }
    CHECK(pm_image_plane(&image, "r") == NULL && pm_image_plane(&image, "") == NULL);
    pm_image_free(&image);
    CHECK(image.channel_count == 0 && image.width == 0);
    pm_image_free(&image);
}

static void bad_sizes_and_names_are_refused(void)
{
    pm_image image = {.width = 7};
    CHECK_FAILS(pm_image_make(0, 1, rgb, 3, &image), PM_EINPUT, "got 0x1");
    CHECK_FAILS(pm_image_make(1, -1, rgb, 3, &image), PM_EINPUT, "got 1x-1");
    CHECK_FAILS(pm_image_make(65537, 1, rgb, 3, &image), PM_EINPUT, "1 to 65536");
    CHECK_FAILS(pm_image_make(1, 1, rgb, PM_IMAGE_CHANNELS_MAX + 1, &image), PM_EINPUT,
                "0 to 96 channels, got 97");
    const char *const twice[2] = {"R", "R"};
    CHECK_FAILS(pm_image_make(1, 1, twice, 2, &image), PM_EINPUT, "\"R\" is there twice");
    const char *const empty[1] = {""};
    CHECK_FAILS(pm_image_make(1, 1, empty, 1, &image), PM_EINPUT, "1 to 31 letters");
    const char *const longer[1] = {"12345678901234567890123456789012"};
    CHECK_FAILS(pm_image_make(1, 1, longer, 1, &image), PM_EINPUT, "1 to 31 letters");
    CHECK(image.width == 7);
}

// Reads back what was written: 8-bit RGB.
static void read_png(const char *path, uint8_t *pixels, int width, int height)
{
    png_image png = {.version = PNG_IMAGE_VERSION};
    CHECK(png_image_begin_read_from_file(&png, path));
    CHECK((int)png.width == width && (int)png.height == height);
    png.format = PNG_FORMAT_RGB;
    CHECK(png_image_finish_read(&png, NULL, pixels, 0, NULL));
}

static const char *path_of(const char *name)
{
    static char path[4096];
    snprintf(path, sizeof path, "%s/%s", pm_test_folder(), name);
    return path;
}

static void png_has_the_srgb_curve(void)
{
    // Linear values and their codes by IEC 61966-2-1: 0.18 is 118, 0.5 is 188.
    static const float linear[6] = {0.0F, 0.001F, 0.18F, 0.5F, 1.0F, 7.0F};
    static const uint8_t codes[6] = {0, 3, 118, 188, 255, 255};
    pm_image image;
    uint8_t pixels[18];
    CHECK_OK(pm_image_make(3, 2, rgb, 3, &image));
    for (int i = 0; i < 6; i++) {
        image.plane[0][i] = linear[i];
        image.plane[1][i] = -linear[i];
        image.plane[2][i] = linear[5 - i];
    }
    CHECK_OK(pm_png_write(path_of("a.png"), &image, 0.0));
    read_png(path_of("a.png"), pixels, 3, 2);
    for (int i = 0; i < 6; i++) {
        CHECK(pixels[3 * i] == codes[i]);
        CHECK(pixels[3 * i + 1] == 0);
        CHECK(pixels[3 * i + 2] == codes[5 - i]);
    }
    // A stop of exposure doubles: 0.25 looks as 0.5 did.
    image.plane[0][0] = 0.25F;
    CHECK_OK(pm_png_write(path_of("a.png"), &image, 1.0));
    read_png(path_of("a.png"), pixels, 3, 2);
    CHECK(pixels[0] == 188);
    pm_image_free(&image);
}

static void png_refuses_nan_and_missing_channels(void)
{
    pm_image image;
    CHECK_OK(pm_image_make(3, 2, rgb, 3, &image));
    image.plane[1][4] = NAN;
    CHECK_FAILS(pm_png_write(path_of("a.png"), &image, 0.0), PM_EINPUT,
                "pixel 1,1 of channel G is NaN");
    pm_image_free(&image);
    CHECK_OK(pm_image_make(3, 2, rgb, 2, &image));
    CHECK_FAILS(pm_png_write(path_of("a.png"), &image, 0.0), PM_EINPUT, "B is missing");
    pm_image_free(&image);
    CHECK(fopen(path_of("a.png"), "r") == NULL);
    CHECK_FAILS(pm_png_write_bytes(path_of("a.png"), NULL, 0, 5), PM_EINPUT, "got 0x5");
}

PM_TESTS({"image.1", "a new image is black and its channels are found by name",
          planes_are_black_and_named},
         {"image.2", "impossible sizes and channel names are refused",
          bad_sizes_and_names_are_refused},
         {"png.1", "a PNG holds the sRGB codes of the linear values", png_has_the_srgb_curve},
         {"png.2", "a PNG of NaN or without a channel is refused and not written",
          png_refuses_nan_and_missing_channels})
