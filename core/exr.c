// Writing, by OpenEXR's C library. Chunks of lines are compressed on all threads, each for
// itself, and written in order by one: the bytes do not depend on the number of threads.
// Reading is in exr_read.c.
#include "exr.h"

#include "file.h"

#include <errno.h>
#include <openexr.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define ZIP_LEVEL 4 // fixed, because the library's default has changed between versions

typedef struct {
    void *bytes;
    uint64_t size;
} chunk;

typedef struct {
    const pm_image *image;
    exr_context_t context;
    int lines; // of a chunk
    int count;
    chunk *chunks;
} writing;

static void ignore_message(exr_const_context_t context, exr_result_t code, const char *message)
{
    (void)context;
    (void)code;
    (void)message;
}

static int64_t write_bytes(exr_const_context_t context, void *stream, const void *bytes,
                           uint64_t size, uint64_t offset, exr_stream_error_func_ptr_t report)
{
    const char *from = bytes;
    uint64_t done = 0;
    while (done < size) {
        ssize_t step =
            pwrite(fileno(stream), from + done, (size_t)(size - done), (off_t)(offset + done));
        if (step < 0 && errno != EINTR) {
            report(context, EXR_ERR_WRITE_IO, "%s", strerror(errno));
            return -1;
        }
        done += step > 0 ? (uint64_t)step : 0;
    }
    return (int64_t)done;
}

// Points the channels of a pipeline at the image's lines from `y` on.
static void aim(exr_encode_pipeline_t *pipe, const pm_image *image, int y)
{
    for (int i = 0; i < pipe->channel_count; i++) {
        exr_coding_channel_info_t *channel = &pipe->channels[i];
        // The library sorts channels by name, so that indices differ.
        const float *plane = pm_image_plane(image, channel->channel_name);
        const float *line = plane + (size_t)y * (size_t)image->width;
        channel->encode_from_ptr = (const uint8_t *)line;
        channel->user_data_type = EXR_PIXEL_FLOAT;
        channel->user_bytes_per_element = sizeof(float);
        channel->user_pixel_stride = sizeof(float);
        channel->user_line_stride = image->width * (int32_t)sizeof(float);
    }
}

static bool prepare(writing *w, exr_encode_pipeline_t *pipe, int y, bool first)
{
    exr_chunk_info_t info;
    if (exr_write_scanline_chunk_info(w->context, 0, y, &info) != EXR_ERR_SUCCESS) {
        return false;
    }
    if (!first) {
        bool updated = exr_encoding_update(w->context, 0, &info, pipe) == EXR_ERR_SUCCESS;
        aim(pipe, w->image, y);
        return updated;
    }
    if (exr_encoding_initialize(w->context, 0, &info, pipe) != EXR_ERR_SUCCESS) {
        return false;
    }
    aim(pipe, w->image, y);
    if (exr_encoding_choose_default_routines(w->context, 0, pipe) != EXR_ERR_SUCCESS) {
        return false;
    }
    pipe->yield_until_ready_fn = NULL; // compress only: writing comes later, in order
    pipe->write_fn = NULL;
    return true;
}

static bool compress_chunk(writing *w, exr_encode_pipeline_t *pipe, int index, bool first)
{
    if (!prepare(w, pipe, index * w->lines, first) ||
        exr_encoding_run(w->context, 0, pipe) != EXR_ERR_SUCCESS) {
        return false;
    }
    chunk *made = &w->chunks[index];
    made->size = pipe->compressed_bytes;
    made->bytes = malloc(pipe->compressed_bytes);
    if (made->bytes == NULL) {
        return false;
    }
    memcpy(made->bytes, pipe->compressed_buffer, pipe->compressed_bytes);
    return true;
}

static bool compress_all(writing *w)
{
    int failures = 0;
#pragma omp parallel reduction(+ : failures)
    {
        exr_encode_pipeline_t pipe = EXR_ENCODE_PIPELINE_INITIALIZER;
        bool first = true;
#pragma omp for schedule(dynamic, 1)
        for (int i = 0; i < w->count; i++) {
            failures += !compress_chunk(w, &pipe, i, first);
            first = false;
        }
        if (!first) {
            exr_encoding_destroy(w->context, &pipe);
        }
    }
    return failures == 0;
}

static bool write_chunks(const writing *w)
{
    for (int i = 0; i < w->count; i++) {
        const chunk *made = &w->chunks[i];
        if (exr_write_scanline_chunk(w->context, 0, i * w->lines, made->bytes, made->size) !=
            EXR_ERR_SUCCESS) {
            return false;
        }
    }
    return true;
}

static bool write_header(writing *w)
{
    int part;
    if (exr_add_part(w->context, NULL, EXR_STORAGE_SCANLINE, &part) != EXR_ERR_SUCCESS ||
        exr_initialize_required_attr_simple(w->context, part, w->image->width, w->image->height,
                                            EXR_COMPRESSION_ZIP) != EXR_ERR_SUCCESS) {
        return false;
    }
    for (int i = 0; i < w->image->channel_count; i++) {
        if (exr_add_channel(w->context, part, w->image->name[i], EXR_PIXEL_FLOAT,
                            EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1) != EXR_ERR_SUCCESS) {
            return false;
        }
    }
    return exr_write_header(w->context) == EXR_ERR_SUCCESS &&
           exr_get_scanlines_per_chunk(w->context, part, &w->lines) == EXR_ERR_SUCCESS;
}

static bool write_image(writing *w)
{
    if (!write_header(w)) {
        return false;
    }
    w->count = (w->image->height + w->lines - 1) / w->lines;
    w->chunks = calloc((size_t)w->count, sizeof *w->chunks);
    bool written = w->chunks != NULL && compress_all(w) && write_chunks(w);
    for (int i = 0; w->chunks != NULL && i < w->count; i++) {
        free(w->chunks[i].bytes);
    }
    free(w->chunks);
    return written;
}

static pm_status write_to(const pm_image *image, pm_file *file)
{
    exr_context_initializer_t setup = {.size = sizeof setup,
                                       .error_handler_fn = ignore_message,
                                       .user_data = file->stream,
                                       .write_fn = write_bytes,
                                       .zip_level = ZIP_LEVEL,
                                       .dwa_quality = -1.0F};
    writing w = {.image = image};
    errno = 0;
    bool written = exr_start_write(&w.context, file->path, EXR_WRITE_FILE_DIRECTLY, &setup) ==
                   EXR_ERR_SUCCESS;
    if (written) {
        written = write_image(&w);
        written = exr_finish(&w.context) == EXR_ERR_SUCCESS && written;
    }
    if (!written) {
        return pm_status_fail(PM_EIO, "%s: cannot be written: %s", file->path,
                              errno != 0 ? strerror(errno) : "OpenEXR failed");
    }
    return PM_OK;
}

pm_status pm_exr_write(const char *path, const pm_image *image)
{
    if (image->channel_count == 0) {
        return PM_FAIL(PM_EINPUT, "an EXR file needs a channel");
    }
    pm_file file;
    PM_TRY(pm_file_begin(path, &file));
    pm_status status = write_to(image, &file);
    if (status != PM_OK) {
        pm_file_abandon(&file);
        return status;
    }
    return pm_file_commit(&file);
}
