// Pictures and films as WebP, read back by libwebp.
#include "command.h"
#include "test.h"
#include "webp.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <webp/decode.h>
#include <webp/demux.h>

enum { WIDTH = 64, HEIGHT = 48 };

/// One half of a picture of its own colour, the other grey.
static const uint8_t *paint(uint8_t red, uint8_t green, uint8_t blue)
{
    static uint8_t pixels[3 * WIDTH * HEIGHT];
    memset(pixels, 90, sizeof pixels);
    for (int i = 0; i < WIDTH * HEIGHT / 2; i++) {
        pixels[3 * i] = red;
        pixels[3 * i + 1] = green;
        pixels[3 * i + 2] = blue;
    }
    return pixels;
}

static void check_near(const uint8_t *got, uint8_t red, uint8_t green, uint8_t blue)
{
    CHECK_NEAR((double)got[0], (double)red, 6.0);
    CHECK_NEAR((double)got[1], (double)green, 6.0);
    CHECK_NEAR((double)got[2], (double)blue, 6.0);
}

static void still_is_read_back(void)
{
    const char *path = pm_command_path("a.webp");
    CHECK_OK(pm_webp_write_bytes(path, paint(230, 159, 0), WIDTH, HEIGHT));
    uint8_t file[8192];
    FILE *stream = fopen(path, "rb");
    CHECK(stream != NULL);
    size_t size = fread(file, 1, sizeof file, stream);
    fclose(stream);
    int width = 0;
    int height = 0;
    uint8_t *pixels = WebPDecodeRGB(file, size, &width, &height);
    CHECK(pixels != NULL && width == WIDTH && height == HEIGHT);
    check_near(pixels + 3 * (10 * WIDTH + 10), 230, 159, 0);
    check_near(pixels + 3 * (40 * WIDTH + 10), 90, 90, 90);
    WebPFree(pixels);
    CHECK(pm_command_count_files() == 1);
}

static void film_is_read_back(void)
{
    pm_webp_film *film = NULL;
    uint8_t *bytes = NULL;
    size_t size = 0;
    CHECK_OK(pm_webp_film_open(WIDTH, HEIGHT, &film));
    CHECK_OK(pm_webp_film_add(film, paint(230, 159, 0), 100));
    CHECK_OK(pm_webp_film_add(film, paint(0, 158, 115), 100));
    CHECK_OK(pm_webp_film_add(film, paint(86, 180, 233), 3000));
    CHECK_OK(pm_webp_film_bytes(film, &bytes, &size));
    pm_webp_film_close(film);
    const WebPData data = {bytes, size};
    WebPAnimDecoder *decoder = WebPAnimDecoderNew(&data, NULL);
    WebPAnimInfo info;
    CHECK(decoder != NULL && WebPAnimDecoderGetInfo(decoder, &info) != 0);
    CHECK(info.frame_count == 3 && info.loop_count == 0);
    CHECK(info.canvas_width == WIDTH && info.canvas_height == HEIGHT);
    static const uint8_t colours[3][3] = {{230, 159, 0}, {0, 158, 115}, {86, 180, 233}};
    static const int ends[3] = {100, 200, 3200};
    for (int i = 0; i < 3; i++) {
        uint8_t *frame = NULL;
        int end = 0;
        CHECK(WebPAnimDecoderGetNext(decoder, &frame, &end) != 0);
        check_near(frame + 4 * (10 * WIDTH + 10), colours[i][0], colours[i][1], colours[i][2]);
        check_near(frame + 4 * (40 * WIDTH + 10), 90, 90, 90);
        CHECK(end == ends[i]);
    }
    WebPAnimDecoderDelete(decoder);
    free(bytes);
}

static void sizes_are_refused(void)
{
    pm_webp_film *film = NULL;
    const char *path = pm_command_path("a.webp");
    CHECK_FAILS(pm_webp_write_bytes(path, paint(0, 0, 0), 16384, 1), PM_EINPUT,
                "a WebP is 1 to 16383 pixels a side, got 16384x1");
    CHECK_FAILS(pm_webp_film_open(0, 5, &film), PM_EINPUT, "got 0x5");
    CHECK(film == NULL && pm_command_count_files() == 0);
    CHECK_OK(pm_webp_film_open(WIDTH, HEIGHT, &film));
    CHECK_FAILS(pm_webp_film_add(film, paint(0, 0, 0), 0), PM_EINPUT, "at least a millisecond");
    pm_webp_film_close(film);
    CHECK_FAILS(pm_webp_write_bytes("no/such/a.webp", paint(0, 0, 0), WIDTH, HEIGHT), PM_EIO,
                "no/such/a.webp: cannot be written");
}

PM_TESTS({"webp.1", "a picture is read back, about as it was", still_is_read_back},
         {"webp.2", "a film has its frames, their times, and no end", film_is_read_back},
         {"webp.3", "sizes, times and folders that cannot be are refused", sizes_are_refused})
