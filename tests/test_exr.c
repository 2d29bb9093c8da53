// Pictures as EXR: every bit comes back, whatever the threads; what is cut or garbage is
// refused; a full disk leaves nothing.
#include "bytes.h"
#include "exr.h"
#include "test.h"

#include <math.h>
#include <omp.h>
#include <openexr.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

static const char *const names[5] = {"R", "G", "B", "caustic.R", "depth.Z"};

static const char *path_of(const char *name)
{
    static char path[4096];
    snprintf(path, sizeof path, "%s/%s", pm_test_folder(), name);
    return path;
}

// Values of every kind, from a small generator of its own.
static pm_image make_picture(int width, int height)
{
    pm_image image;
    CHECK_OK(pm_image_make(width, height, names, 5, &image));
    uint32_t state = 1;
    for (int c = 0; c < 5; c++) {
        for (int i = 0; i < width * height; i++) {
            state = state * 1664525u + 1013904223u;
            image.plane[c][i] = ldexpf((float)(state >> 8), (int)(state & 63) - 50);
        }
    }
    image.plane[0][0] = NAN;
    image.plane[0][1] = -INFINITY;
    image.plane[0][2] = -0.0F;
    image.plane[0][3] = 1e-45F;
    return image;
}

static void every_bit_comes_back(void)
{
    static const int sizes[4][2] = {{1, 1}, {7, 33}, {64, 16}, {33, 50}};
    for (int s = 0; s < 4; s++) {
        pm_image image = make_picture(sizes[s][0] < 4 ? 4 : sizes[s][0], sizes[s][1]);
        pm_image back = {0};
        CHECK_OK(pm_exr_write(path_of("a.exr"), &image));
        CHECK_OK(pm_exr_read(path_of("a.exr"), &back));
        CHECK(back.width == image.width && back.height == image.height);
        CHECK(back.channel_count == 5);
        for (int c = 0; c < 5; c++) {
            size_t bytes = (size_t)image.width * (size_t)image.height * sizeof(float);
            CHECK_THAT(memcmp(pm_image_plane(&back, names[c]), image.plane[c], bytes) == 0,
                       "channel %s differs", names[c]);
        }
        pm_image_free(&image);
        pm_image_free(&back);
    }
}

static void threads_do_not_change_bytes(void)
{
    pm_image image = make_picture(100, 300);
    uint8_t *first = NULL;
    size_t first_size = 0;
    static const int threads[3] = {1, 2, 7};
    for (int i = 0; i < 3; i++) {
        size_t size;
        omp_set_num_threads(threads[i]);
        CHECK_OK(pm_exr_write(path_of("a.exr"), &image));
        uint8_t *bytes = pm_bytes_read(path_of("a.exr"), &size);
        if (i == 0) {
            first = bytes;
            first_size = size;
            continue;
        }
        CHECK(size == first_size && memcmp(bytes, first, size) == 0);
        free(bytes);
    }
    free(first);
    pm_image_free(&image);
}

static void ignore_message(exr_const_context_t context, exr_result_t code, const char *message)
{
    (void)context;
    (void)code;
    (void)message;
}

static void header_is_as_promised(void)
{
    pm_image image = make_picture(20, 40);
    CHECK_OK(pm_exr_write(path_of("a.exr"), &image));
    pm_image_free(&image);
    exr_context_initializer_t setup = {.size = sizeof setup,
                                       .error_handler_fn = ignore_message,
                                       .zip_level = -2,
                                       .dwa_quality = -1.0F};
    exr_context_t context;
    exr_attr_box2i_t data;
    exr_attr_box2i_t display;
    exr_compression_t compression;
    int32_t attributes = 0;
    CHECK(exr_start_read(&context, path_of("a.exr"), &setup) == EXR_ERR_SUCCESS);
    CHECK(exr_get_data_window(context, 0, &data) == EXR_ERR_SUCCESS);
    CHECK(exr_get_display_window(context, 0, &display) == EXR_ERR_SUCCESS);
    CHECK(memcmp(&data, &display, sizeof data) == 0 && data.max.x == 19 && data.max.y == 39);
    CHECK(exr_get_compression(context, 0, &compression) == EXR_ERR_SUCCESS);
    CHECK(compression == EXR_COMPRESSION_ZIP);
    CHECK(exr_get_attribute_count(context, 0, &attributes) == EXR_ERR_SUCCESS);
    CHECK_THAT(attributes == 9, "the 8 required attributes and `type`, no time stamp: got %d",
               attributes);
    exr_finish(&context);
}

// A one-channel file of another pixel type, made by the library alone.
static void write_other(const char *path, exr_pixel_type_t type, const void *pixels, int size)
{
    exr_context_initializer_t setup = {.size = sizeof setup,
                                       .error_handler_fn = ignore_message,
                                       .zip_level = -2,
                                       .dwa_quality = -1.0F};
    exr_context_t context;
    exr_chunk_info_t info;
    exr_encode_pipeline_t pipe = EXR_ENCODE_PIPELINE_INITIALIZER;
    int part;
    CHECK(exr_start_write(&context, path, EXR_WRITE_FILE_DIRECTLY, &setup) == EXR_ERR_SUCCESS);
    CHECK(exr_add_part(context, NULL, EXR_STORAGE_SCANLINE, &part) == EXR_ERR_SUCCESS);
    exr_initialize_required_attr_simple(context, 0, 4, 1, EXR_COMPRESSION_NONE);
    CHECK(exr_add_channel(context, 0, "R", type, EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1) ==
          EXR_ERR_SUCCESS);
    CHECK(exr_write_header(context) == EXR_ERR_SUCCESS);
    CHECK(exr_write_scanline_chunk_info(context, 0, 0, &info) == EXR_ERR_SUCCESS);
    CHECK(exr_encoding_initialize(context, 0, &info, &pipe) == EXR_ERR_SUCCESS);
    pipe.channels[0].encode_from_ptr = pixels;
    pipe.channels[0].user_data_type = (uint16_t)type;
    pipe.channels[0].user_bytes_per_element = (int16_t)size;
    pipe.channels[0].user_pixel_stride = size;
    pipe.channels[0].user_line_stride = 4 * size;
    exr_encoding_choose_default_routines(context, 0, &pipe);
    CHECK(exr_encoding_run(context, 0, &pipe) == EXR_ERR_SUCCESS);
    exr_encoding_destroy(context, &pipe);
    CHECK(exr_finish(&context) == EXR_ERR_SUCCESS);
}

static void half_and_uint_become_float(void)
{
    static const uint16_t half[4] = {0x3c00, 0xc000, 0x3555, 0x0001}; // 1, -2, ~1/3, 2^-24
    static const uint32_t whole[4] = {0, 1, 1000, 16777216};
    pm_image image = {0};
    write_other(path_of("h.exr"), EXR_PIXEL_HALF, half, 2);
    CHECK_OK(pm_exr_read(path_of("h.exr"), &image));
    const float *r = pm_image_plane(&image, "R");
    CHECK(r[0] == 1.0F && r[1] == -2.0F && r[2] == 0.333251953125F);
    CHECK(r[3] == 5.9604644775390625e-8F);
    pm_image_free(&image);
    write_other(path_of("u.exr"), EXR_PIXEL_UINT, whole, 4);
    CHECK_OK(pm_exr_read(path_of("u.exr"), &image));
    r = pm_image_plane(&image, "R");
    CHECK(r[0] == 0.0F && r[1] == 1.0F && r[2] == 1000.0F && r[3] == 16777216.0F);
    pm_image_free(&image);
}

static void every_cut_is_refused(void)
{
    pm_image image = make_picture(8, 40);
    size_t size;
    CHECK_OK(pm_exr_write(path_of("a.exr"), &image));
    pm_image_free(&image);
    uint8_t *bytes = pm_bytes_read(path_of("a.exr"), &size);
    for (size_t cut = 0; cut < size; cut += cut < 500 ? 1 : 97) {
        pm_image back = {.width = 7};
        pm_bytes_write(path_of("cut.exr"), bytes, cut);
        CHECK_FAILS(pm_exr_read(path_of("cut.exr"), &back), PM_EINPUT,
                    "cut.exr: cannot be read as a picture: ");
        CHECK(back.width == 7);
    }
    free(bytes);
}

// A changed bit may still be a picture (of other values); it must never be worse than that.
static void garbage_is_survived(void)
{
    pm_image image = make_picture(8, 40);
    size_t size;
    CHECK_OK(pm_exr_write(path_of("a.exr"), &image));
    pm_image_free(&image);
    uint8_t *bytes = pm_bytes_read(path_of("a.exr"), &size);
    int refused = 0;
    for (size_t at = 0; at < size; at += at < 500 ? 1 : 41) {
        pm_image back = {0};
        bytes[at] ^= (uint8_t)(1 << at % 8);
        pm_bytes_write(path_of("bad.exr"), bytes, size);
        bytes[at] ^= (uint8_t)(1 << at % 8);
        refused += pm_exr_read(path_of("bad.exr"), &back) != PM_OK;
        pm_status_clear();
        pm_image_free(&back);
    }
    CHECK(refused > 100);
    memset(bytes, 0x5a, size);
    pm_bytes_write(path_of("bad.exr"), bytes, size);
    pm_image back;
    CHECK_FAILS(pm_exr_read(path_of("bad.exr"), &back), PM_EINPUT, "cannot be read");
    free(bytes);
}

static void claims_beyond_the_file_are_refused(void)
{
    pm_image image = make_picture(8, 40);
    size_t size;
    CHECK_OK(pm_exr_write(path_of("a.exr"), &image));
    pm_image_free(&image);
    uint8_t *bytes = pm_bytes_read(path_of("a.exr"), &size);
    for (size_t at = 0; at + 30 < size; at++) {
        if (memcmp(bytes + at, "dataWindow", 11) == 0) {
            static const uint8_t wide[4] = {0xff, 0xff, 0, 0}; // x to 65535
            memcpy(bytes + at + 11 + 6 + 4 + 8, wide, 4);
            memcpy(bytes + at + 11 + 6 + 4 + 12, wide, 4);
        }
    }
    pm_bytes_write(path_of("wide.exr"), bytes, size);
    pm_image back;
    CHECK_FAILS(pm_exr_read(path_of("wide.exr"), &back), PM_EINPUT,
                "it is too short for the size it claims");
    free(bytes);
}

// An EXR writer that died leaves its table of chunks empty; what came before is not a picture.
static void unfinished_files_are_refused(void)
{
    pm_image image = make_picture(8, 40);
    size_t size;
    CHECK_OK(pm_exr_write(path_of("a.exr"), &image));
    pm_image_free(&image);
    uint8_t *bytes = pm_bytes_read(path_of("a.exr"), &size);
    enum { TABLE = 3 * 8 }; // 40 lines are three chunks of 16
    int emptied = 0;
    for (size_t at = 0; at + TABLE < size; at++) {
        uint64_t first;
        memcpy(&first, bytes + at, sizeof first);
        if (first == at + TABLE) { // the first chunk follows the table
            memset(bytes + at, 0, TABLE);
            emptied++;
        }
    }
    CHECK(emptied == 1);
    pm_bytes_write(path_of("dead.exr"), bytes, size);
    pm_image back;
    CHECK_FAILS(pm_exr_read(path_of("dead.exr"), &back), PM_EINPUT, "dead.exr: cannot be read");
    free(bytes);
}

static void what_is_no_picture_is_refused(void)
{
    pm_image image;
    CHECK_FAILS(pm_exr_read(path_of("none.exr"), &image), PM_EIO,
                "none.exr: cannot be read: No such file");
    CHECK_FAILS(pm_exr_read(pm_test_folder(), &image), PM_EIO, "it is a directory");
    pm_bytes_write(path_of("empty.exr"), (const uint8_t *)"", 0);
    CHECK_FAILS(pm_exr_read(path_of("empty.exr"), &image), PM_EINPUT, "empty.exr: cannot");
    pm_image bare = {.width = 1, .height = 1};
    CHECK_FAILS(pm_exr_write(path_of("b.exr"), &bare), PM_EINPUT, "needs a channel");
}

static void no_room_leaves_no_picture(void)
{
    pm_image image = make_picture(100, 100);
    signal(SIGXFSZ, SIG_IGN);
    struct rlimit limit = {50000, 50000};
    CHECK(setrlimit(RLIMIT_FSIZE, &limit) == 0);
    CHECK_FAILS(pm_exr_write(path_of("a.exr"), &image), PM_EIO,
                "a.exr: cannot be written: File too large");
    CHECK(access(path_of("a.exr"), F_OK) != 0);
    CHECK_THAT(rmdir(pm_test_folder()) == 0, "a temporary file was left behind");
    pm_image_free(&image);
}

PM_TESTS(
    {"exr.1", "every bit of a picture comes back, NaN and infinity too", every_bit_comes_back},
    {"exr.2", "1, 2 and 7 threads write the same bytes", threads_do_not_change_bytes},
    {"exr.3", "the file is ZIP, its windows are equal, it has no time stamp",
     header_is_as_promised},
    {"exr.4", "half and whole numbers are read as float", half_and_uint_become_float},
    {"exr.5", "a picture that was cut is refused wherever the cut is", every_cut_is_refused},
    {"exr.6", "altered and garbage files do no harm", garbage_is_survived},
    {"exr.7", "a size that the file cannot hold is refused",
     claims_beyond_the_file_are_refused},
    {"exr.8", "a missing, empty or wrong file is refused by name",
     what_is_no_picture_is_refused},
    {"exr.9", "no room leaves no picture and no temporary file", no_room_leaves_no_picture},
    {"exr.10", "a file whose writer died is refused", unfinished_files_are_refused})
