// Reading, by OpenEXR's C library. Files are not trusted: what a header claims is held against
// the size of the file before anything is allocated.
#include "exr.h"

#include "file.h"

#include <openexr.h>
#include <stdbool.h>
#include <string.h>

#define SIDE_MAX 65536

// No compression of OpenEXR packs an image of one value tighter than this.
#define MOST_PACKED 4096

typedef struct {
    const char *path;
    exr_context_t context;
    exr_attr_box2i_t window;
    const exr_attr_chlist_t *channels;
    pm_image image;
} reading;

static void ignore_message(exr_const_context_t context, exr_result_t code, const char *message)
{
    (void)context;
    (void)code;
    (void)message;
}

static pm_status refuse(const reading *r, const char *why)
{
    return pm_status_fail(PM_EINPUT, "%s: cannot be read as a picture: %s", r->path, why);
}

static pm_status check_result(const reading *r, exr_result_t result)
{
    return result == EXR_ERR_SUCCESS ? PM_OK : refuse(r, exr_get_default_error_message(result));
}

static pm_status check_layout(const reading *r)
{
    int parts;
    exr_storage_t storage;
    PM_TRY(check_result(r, exr_get_count(r->context, &parts)));
    PM_TRY(check_result(r, exr_get_storage(r->context, 0, &storage)));
    if (parts != 1) {
        return refuse(r, "it has several parts; one is read");
    }
    if (storage != EXR_STORAGE_SCANLINE) {
        return refuse(r, "it is tiled or deep; flat scanlines are read");
    }
    return PM_OK;
}

static pm_status check_channels(const reading *r)
{
    if (r->channels->num_channels < 1 || r->channels->num_channels > PM_IMAGE_CHANNELS_MAX) {
        return refuse(r, "it has no channels, or more than 64");
    }
    for (int i = 0; i < r->channels->num_channels; i++) {
        const exr_attr_chlist_entry_t *channel = &r->channels->entries[i];
        if (channel->x_sampling != 1 || channel->y_sampling != 1) {
            return refuse(r, "it has a subsampled channel");
        }
        if (channel->name.length < 1 || channel->name.length >= PM_IMAGE_NAME_ROOM) {
            return refuse(r, "it has a channel whose name is not 1 to 31 letters long");
        }
    }
    return PM_OK;
}

static pm_status make_image(reading *r, uint64_t file_bytes)
{
    int64_t width = (int64_t)r->window.max.x - r->window.min.x + 1;
    int64_t height = (int64_t)r->window.max.y - r->window.min.y + 1;
    if (width < 1 || height < 1 || width > SIDE_MAX || height > SIDE_MAX) {
        return refuse(r, "its size is not 1 to 65536 pixels a side");
    }
    uint64_t bytes = (uint64_t)(width * height) * (uint64_t)r->channels->num_channels * 2;
    if (bytes / MOST_PACKED > file_bytes) {
        return refuse(r, "it is too short for the size it claims");
    }
    const char *names[PM_IMAGE_CHANNELS_MAX];
    for (int i = 0; i < r->channels->num_channels; i++) {
        names[i] = r->channels->entries[i].name.str;
    }
    return pm_image_make((int)width, (int)height, names, r->channels->num_channels, &r->image);
}

static void aim(exr_decode_pipeline_t *pipe, const pm_image *image, int row)
{
    for (int i = 0; i < pipe->channel_count; i++) {
        exr_coding_channel_info_t *channel = &pipe->channels[i];
        float *plane = pm_image_plane(image, channel->channel_name);
        float *line = plane + (size_t)row * (size_t)image->width;
        channel->decode_to_ptr = (uint8_t *)line;
        channel->user_data_type = EXR_PIXEL_FLOAT;
        channel->user_bytes_per_element = sizeof(float);
        channel->user_pixel_stride = sizeof(float);
        channel->user_line_stride = image->width * (int32_t)sizeof(float);
    }
}

static exr_result_t read_chunk(const reading *r, exr_decode_pipeline_t *pipe, int row)
{
    exr_chunk_info_t info;
    exr_result_t result =
        exr_read_scanline_chunk_info(r->context, 0, r->window.min.y + row, &info);
    if (result != EXR_ERR_SUCCESS) {
        return result;
    }
    bool first = pipe->context == NULL;
    result = first ? exr_decoding_initialize(r->context, 0, &info, pipe)
                   : exr_decoding_update(r->context, 0, &info, pipe);
    if (result != EXR_ERR_SUCCESS) {
        return result;
    }
    aim(pipe, &r->image, row);
    if (first) {
        result = exr_decoding_choose_default_routines(r->context, 0, pipe);
    }
    return result == EXR_ERR_SUCCESS ? exr_decoding_run(r->context, 0, pipe) : result;
}

static pm_status read_chunks(const reading *r)
{
    int lines;
    PM_TRY(check_result(r, exr_get_scanlines_per_chunk(r->context, 0, &lines)));
    exr_decode_pipeline_t pipe = EXR_DECODE_PIPELINE_INITIALIZER;
    exr_result_t result = EXR_ERR_SUCCESS;
    for (int row = 0; row < r->image.height && result == EXR_ERR_SUCCESS; row += lines) {
        result = read_chunk(r, &pipe, row);
    }
    exr_decoding_destroy(r->context, &pipe);
    return check_result(r, result);
}

static pm_status read_image(reading *r, uint64_t file_bytes)
{
    PM_TRY(check_layout(r));
    PM_TRY(check_result(r, exr_get_data_window(r->context, 0, &r->window)));
    PM_TRY(check_result(r, exr_get_channels(r->context, 0, &r->channels)));
    PM_TRY(check_channels(r));
    PM_TRY(make_image(r, file_bytes));
    return read_chunks(r);
}

pm_status pm_exr_read(const char *path, pm_image *image)
{
    uint64_t file_bytes;
    PM_TRY(pm_file_size(path, &file_bytes));
    // Without reconstruction: a file that was cut must not come back with black lines.
    exr_context_initializer_t setup = {.size = sizeof setup,
                                       .error_handler_fn = ignore_message,
                                       .max_image_width = SIDE_MAX,
                                       .max_image_height = SIDE_MAX,
                                       .zip_level = -2,
                                       .dwa_quality = -1.0F,
                                       .flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION};
    reading r = {.path = path};
    PM_TRY(check_result(&r, exr_start_read(&r.context, path, &setup)));
    pm_status status = read_image(&r, file_bytes);
    exr_finish(&r.context);
    if (status != PM_OK) {
        pm_image_free(&r.image);
        return status;
    }
    *image = r.image;
    return PM_OK;
}
