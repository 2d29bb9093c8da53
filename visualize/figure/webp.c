// Lossy with sharp colours: WebP keeps colour at half the size, and thin coloured lines would
// smear. A film's encoder keeps of each frame only what changed; it wants to know when a frame
// begins, so the last one's time is given by the end.
#include "webp.h"

#include "file.h"

#include <limits.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <webp/encode.h>
#include <webp/mux.h>

#define STILL_QUALITY 75.0f
#define FILM_QUALITY 70.0f

struct pm_webp_film {
    WebPAnimEncoder *encoder;
    int width, height;
    int milliseconds; // so far
    uint64_t frames;
};

static pm_status check_size(int width, int height)
{
    if (width < 1 || height < 1 || width > WEBP_MAX_DIMENSION || height > WEBP_MAX_DIMENSION) {
        return pm_status_fail(PM_EINPUT, "a WebP is 1 to %d pixels a side, got %dx%d",
                              WEBP_MAX_DIMENSION, width, height);
    }
    return PM_OK;
}

static bool configure(float quality, WebPConfig *config)
{
    if (WebPConfigInit(config) == 0) {
        return false;
    }
    config->quality = quality;
    config->use_sharp_yuv = 1;
    return WebPValidateConfig(config) != 0;
}

/// The pixels as libwebp wants them. WebPPictureFree() afterwards, whatever is returned.
static bool import_pixels(const uint8_t *pixels, int width, int height, WebPPicture *picture)
{
    if (WebPPictureInit(picture) == 0) {
        return false;
    }
    picture->use_argb = 1;
    picture->width = width;
    picture->height = height;
    return WebPPictureImportRGB(picture, pixels, 3 * width) != 0;
}

static pm_status no_memory(void)
{
    return PM_FAIL(PM_ENOMEM, "%s", "no memory for a WebP");
}

// --- a still picture ------------------------------------------------------------------------

static pm_status encode(const uint8_t *pixels, int width, int height, WebPMemoryWriter *to)
{
    WebPConfig config;
    WebPPicture picture = {0};
    bool ready =
        configure(STILL_QUALITY, &config) && import_pixels(pixels, width, height, &picture);
    picture.writer = WebPMemoryWrite;
    picture.custom_ptr = to;
    bool done = ready && WebPEncode(&config, &picture) != 0;
    WebPPictureFree(&picture);
    return done ? PM_OK : no_memory();
}

pm_status pm_webp_write_bytes(const char *path, const uint8_t *pixels, int width, int height)
{
    PM_TRY(check_size(width, height));
    pm_file file;
    PM_TRY(pm_file_begin(path, &file));
    WebPMemoryWriter to;
    WebPMemoryWriterInit(&to);
    pm_status status = encode(pixels, width, height, &to);
    if (status == PM_OK) {
        fwrite(to.mem, 1, to.size, file.stream); // a failure shows at the commit
        status = pm_file_commit(&file);
    } else {
        pm_file_abandon(&file);
    }
    WebPMemoryWriterClear(&to);
    return status;
}

// --- a film ---------------------------------------------------------------------------------

pm_status pm_webp_film_open(int width, int height, pm_webp_film **film)
{
    PM_TRY(check_size(width, height));
    WebPAnimEncoderOptions options;
    pm_webp_film *begun = calloc(1, sizeof *begun);
    if (begun != NULL && WebPAnimEncoderOptionsInit(&options) != 0) {
        options.anim_params.loop_count = 0; // for ever
        begun->encoder = WebPAnimEncoderNew(width, height, &options);
    }
    if (begun == NULL || begun->encoder == NULL) {
        free(begun);
        return no_memory();
    }
    begun->width = width;
    begun->height = height;
    *film = begun;
    return PM_OK;
}

pm_status pm_webp_film_add(pm_webp_film *film, const uint8_t *pixels, int milliseconds)
{
    if (milliseconds < 1 || milliseconds > INT_MAX - film->milliseconds) {
        return PM_FAIL(PM_EINPUT, "a frame must be seen for at least a millisecond, got %d",
                       milliseconds);
    }
    WebPConfig config;
    WebPPicture picture = {0};
    bool done = configure(FILM_QUALITY, &config) &&
                import_pixels(pixels, film->width, film->height, &picture) &&
                WebPAnimEncoderAdd(film->encoder, &picture, film->milliseconds, &config) != 0;
    WebPPictureFree(&picture);
    film->milliseconds += milliseconds;
    film->frames++;
    return done ? PM_OK
                : PM_FAIL(PM_ELIMIT, "frame %llu of a film: %s",
                          (unsigned long long)film->frames,
                          WebPAnimEncoderGetError(film->encoder));
}

pm_status pm_webp_film_bytes(pm_webp_film *film, uint8_t **bytes, size_t *size)
{
    WebPData data = {0};
    if (WebPAnimEncoderAdd(film->encoder, NULL, film->milliseconds, NULL) == 0 ||
        WebPAnimEncoderAssemble(film->encoder, &data) == 0) {
        return PM_FAIL(PM_ELIMIT, "a film: %s", WebPAnimEncoderGetError(film->encoder));
    }
    uint8_t *copy = malloc(data.size);
    if (copy != NULL) {
        memcpy(copy, data.bytes, data.size);
        *bytes = copy;
        *size = data.size;
    }
    WebPDataClear(&data);
    return copy != NULL ? PM_OK : no_memory();
}

void pm_webp_film_close(pm_webp_film *film)
{
    if (film != NULL) {
        WebPAnimEncoderDelete(film->encoder);
        free(film);
    }
}
