// Frames wait in memory, as PNGs, until the film is whole: an interrupted run leaves nothing,
// and no earlier film is touched before the new one is there.
#include "film.h"

#include "file.h"
#include "webp.h"

#include <libpng16/png.h>
#include <limits.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define FRAME_MILLISECONDS 100
#define LAST_MILLISECONDS 3000
#define ENDING ".webp"

typedef struct {
    uint8_t *bytes;
    size_t size;
} content;

struct pm_film {
    char *path;
    int width, height;
    uint32_t frames, added;
    pm_webp_film *webp;
    content *png; // of each frame
};

/// The path of frame `index`, or of the film itself behind the last.
static void name_file(const pm_film *film, uint32_t index, char path[PATH_MAX])
{
    if (index == film->frames) {
        snprintf(path, PATH_MAX, "%s", film->path);
        return;
    }
    size_t stem = strlen(film->path) - strlen(ENDING);
    snprintf(path, PATH_MAX, "%.*s.%03u.png", (int)stem, film->path, index + 1);
}

static pm_status check_path(const char *path)
{
    size_t length = strlen(path);
    size_t tail = strlen(ENDING);
    if (length <= tail || strcmp(path + length - tail, ENDING) != 0) {
        return pm_status_fail(PM_EINPUT, "view: -o of a film must end in %s, got %s", ENDING,
                              path);
    }
    if (length + 8 > PATH_MAX) {
        return pm_status_fail(PM_EIO, "%s: cannot be written: the name is too long", path);
    }
    return PM_OK;
}

/// What would be refused at the end is refused now.
static pm_status check_files(const pm_film *film)
{
    for (uint32_t i = 0; i <= film->frames; i++) {
        char path[PATH_MAX];
        pm_file file;
        name_file(film, i, path);
        PM_TRY(pm_file_begin(path, &file));
        pm_file_abandon(&file);
    }
    return PM_OK;
}

pm_status pm_film_open(const char *path, int width, int height, uint32_t frames, pm_film **film)
{
    PM_TRY(check_path(path));
    pm_film *begun = calloc(1, sizeof *begun);
    if (begun == NULL) {
        return PM_FAIL(PM_ENOMEM, "%s", "no memory for a film");
    }
    *begun = (pm_film){.width = width, .height = height, .frames = frames};
    begun->path = strdup(path);
    begun->png = calloc(frames, sizeof *begun->png);
    pm_status status = begun->path != NULL && begun->png != NULL
                           ? check_files(begun)
                           : PM_FAIL(PM_ENOMEM, "%s", "no memory for a film");
    if (status == PM_OK) {
        status = pm_webp_film_open(width, height, &begun->webp);
    }
    if (status != PM_OK) {
        pm_film_close(begun);
        return status;
    }
    *film = begun;
    return PM_OK;
}

static pm_status compress(const pm_film *film, const uint8_t *pixels, content *png)
{
    png_image image;
    memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    image.width = (png_uint_32)film->width;
    image.height = (png_uint_32)film->height;
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    uint8_t *room = malloc(size);
    if (room == NULL ||
        png_image_write_to_memory(&image, room, &size, 0, pixels, 0, NULL) == 0) {
        free(room);
        return PM_FAIL(PM_ENOMEM, "no memory for frame %u of a film", film->added + 1);
    }
    uint8_t *fitted = realloc(room, size);
    *png = (content){fitted != NULL ? fitted : room, size};
    return PM_OK;
}

pm_status pm_film_add(pm_film *film, const uint8_t *pixels)
{
    if (film->added == film->frames) {
        return PM_FAIL(PM_EINPUT, "a film of %u frames is full", film->frames);
    }
    bool last = film->added + 1 == film->frames;
    PM_TRY(pm_webp_film_add(film->webp, pixels, last ? LAST_MILLISECONDS : FRAME_MILLISECONDS));
    PM_TRY(compress(film, pixels, &film->png[film->added]));
    film->added++;
    return PM_OK;
}

static pm_status write_file(const pm_film *film, uint32_t index, const content *what)
{
    char path[PATH_MAX];
    pm_file file;
    name_file(film, index, path);
    PM_TRY(pm_file_begin(path, &file));
    fwrite(what->bytes, 1, what->size, file.stream); // a failure shows at the commit
    return pm_file_commit(&file);
}

static void remove_first(const pm_film *film, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        char path[PATH_MAX];
        name_file(film, i, path);
        unlink(path);
    }
}

static pm_status write_all(const pm_film *film, const content *webp)
{
    for (uint32_t i = 0; i <= film->frames; i++) {
        pm_status status = write_file(film, i, i < film->frames ? &film->png[i] : webp);
        if (status != PM_OK) {
            remove_first(film, i);
            return status;
        }
    }
    return PM_OK;
}

pm_status pm_film_write(pm_film *film)
{
    if (film->added < film->frames) {
        return PM_FAIL(PM_EINPUT, "a film of %u frames has %u", film->frames, film->added);
    }
    content webp;
    PM_TRY(pm_webp_film_bytes(film->webp, &webp.bytes, &webp.size));
    pm_status status = write_all(film, &webp);
    free(webp.bytes);
    return status;
}

void pm_film_close(pm_film *film)
{
    if (film == NULL) {
        return;
    }
    for (uint32_t i = 0; i < film->added; i++) {
        free(film->png[i].bytes);
    }
    pm_webp_film_close(film->webp);
    free(film->png);
    free(film->path);
    free(film);
}
