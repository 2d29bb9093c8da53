// alike A B: whether two pictures (PNG or WebP) look the same. Exit code 0 when they do, 1 when
// not, 2 when one cannot be read.
//
// Pictures of the same data differ a little from machine to machine: where a line's edge falls,
// what a later library does to a rounded corner. So they are compared by blocks: nowhere may a
// block's mean colour move far, and over the whole picture it must hardly move at all.
#include <libpng16/png.h>
#include <webp/demux.h>

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BLOCK 16
#define BLOCK_MOST 24.0 // of 255, in the mean of a block's channels
#define WHOLE_MOST 1.5  // mean of all blocks

typedef struct {
    int width, height;
    uint8_t *pixels; // RGB, rows from the top
} picture;

static uint8_t *read_file(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    uint8_t *bytes = NULL;
    if (file == NULL) {
        return NULL;
    }
    if (fseek(file, 0, SEEK_END) == 0 && ftell(file) > 0) {
        *size = (size_t)ftell(file);
        rewind(file);
        bytes = malloc(*size);
        if (bytes != NULL && fread(bytes, 1, *size, file) != *size) {
            free(bytes);
            bytes = NULL;
        }
    }
    fclose(file);
    return bytes;
}

static int decode_png(const uint8_t *bytes, size_t size, picture *p)
{
    png_image png = {.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_memory(&png, bytes, size)) {
        return 0;
    }
    png.format = PNG_FORMAT_RGB;
    p->width = (int)png.width;
    p->height = (int)png.height;
    p->pixels = malloc(PNG_IMAGE_SIZE(png));
    return p->pixels != NULL && png_image_finish_read(&png, NULL, p->pixels, 0, NULL);
}

/// The last frame of a film is the one that shows it all; a still picture is a film of one.
static int decode_webp(const uint8_t *bytes, size_t size, picture *p)
{
    WebPData data = {bytes, size};
    WebPAnimDecoderOptions options;
    WebPAnimDecoder *decoder =
        WebPAnimDecoderOptionsInit(&options) ? WebPAnimDecoderNew(&data, &options) : NULL;
    WebPAnimInfo info;
    uint8_t *frame = NULL; // RGBA, the decoder's
    int when = 0;
    if (decoder == NULL || !WebPAnimDecoderGetInfo(decoder, &info)) {
        WebPAnimDecoderDelete(decoder);
        return 0;
    }
    while (WebPAnimDecoderHasMoreFrames(decoder) &&
           WebPAnimDecoderGetNext(decoder, &frame, &when)) {
    }
    p->width = (int)info.canvas_width;
    p->height = (int)info.canvas_height;
    size_t count = (size_t)p->width * (size_t)p->height;
    p->pixels = frame != NULL ? malloc(3 * count) : NULL;
    for (size_t i = 0; i < count && p->pixels != NULL; i++) {
        memcpy(p->pixels + 3 * i, frame + 4 * i, 3);
    }
    WebPAnimDecoderDelete(decoder);
    return p->pixels != NULL;
}

static int read_picture(const char *path, picture *p)
{
    size_t size = 0;
    uint8_t *bytes = read_file(path, &size);
    *p = (picture){0};
    if (bytes != NULL && !decode_png(bytes, size, p)) {
        decode_webp(bytes, size, p);
    }
    free(bytes);
    if (p->pixels == NULL) {
        fprintf(stderr, "%s: cannot be read as PNG or WebP\n", path);
    }
    return p->pixels != NULL;
}

/// Mean over channels of how far the mean colour of a block moves.
static double block_difference(const picture *a, const picture *b, int x0, int y0)
{
    double sum[3] = {0.0, 0.0, 0.0};
    int count = 0;
    for (int y = y0; y < a->height && y < y0 + BLOCK; y++) {
        for (int x = x0; x < a->width && x < x0 + BLOCK; x++) {
            size_t at = 3 * ((size_t)y * (size_t)a->width + (size_t)x);
            for (size_t c = 0; c < 3; c++) {
                sum[c] += (double)a->pixels[at + c] - (double)b->pixels[at + c];
            }
            count++;
        }
    }
    double all = 0.0;
    for (int c = 0; c < 3; c++) {
        all += sum[c] < 0.0 ? -sum[c] : sum[c];
    }
    return all / (3.0 * count);
}

static int look_alike(const picture *a, const picture *b)
{
    if (a->width != b->width || a->height != b->height) {
        return 0;
    }
    double worst = 0.0;
    double sum = 0.0;
    int count = 0;
    for (int y = 0; y < a->height; y += BLOCK) {
        for (int x = 0; x < a->width; x += BLOCK) {
            double difference = block_difference(a, b, x, y);
            worst = difference > worst ? difference : worst;
            sum += difference;
            count++;
        }
    }
    return worst <= BLOCK_MOST && sum / count <= WHOLE_MOST;
}

int main(int argc, char **argv)
{
    picture a = {0};
    picture b = {0};
    if (argc != 3) {
        fprintf(stderr, "usage: alike A B\n");
        return 2;
    }
    int code = 2;
    if (read_picture(argv[1], &a) && read_picture(argv[2], &b)) {
        code = look_alike(&a, &b) ? 0 : 1;
    }
    free(a.pixels);
    free(b.pixels);
    return code;
}
