// Reading a contact sheet. Of a picture only R G B are kept while a block's exposure is sought.
#include "contact.h"

#include "contact_note.h"
#include "exposure.h"
#include "exr.h"
#include "faults.h"
#include "png.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const channels[3] = {"R", "G", "B"};

/// A sheet on its way: the pictures as they were read.
typedef struct {
    pm_contact sheet;
    pm_image image[PM_CONTACT_MOST]; // R G B alone
} reading;

static void split_name(const char *path, char scene[PM_CONTACT_NAME],
                       char setting[PM_CONTACT_NAME])
{
    const char *slash = strrchr(path, '/');
    const char *name = slash != NULL ? slash + 1 : path;
    size_t length = strlen(name);
    if (length > 4 && strcmp(name + length - 4, ".exr") == 0) {
        length -= 4;
    }
    size_t dot = length; // before the setting
    for (size_t i = 1; i < length; i++) {
        dot = name[i] == '.' ? i : dot;
    }
    snprintf(scene, PM_CONTACT_NAME, "%.*s", (int)dot, name);
    snprintf(setting, PM_CONTACT_NAME, "%.*s", dot < length ? (int)(length - dot - 1) : 0,
             name + dot + (dot < length));
}

/// R G B of a picture file.
static pm_status read_image(const char *path, pm_image *out)
{
    pm_image whole;
    pm_image image;
    PM_TRY(pm_exr_read(path, &whole));
    pm_status status = pm_image_make(whole.width, whole.height, channels, 3, &image);
    for (int c = 0; c < 3 && status == PM_OK; c++) {
        size_t bytes = sizeof(float) * (size_t)whole.width * (size_t)whole.height;
        const float *plane = pm_image_plane(&whole, channels[c]);
        if (plane == NULL) {
            pm_image_free(&image);
            status = pm_status_fail(PM_EINPUT, "%s: has no channel %s, so it is no picture",
                                    path, channels[c]);
        } else {
            memcpy(image.plane[c], plane, bytes);
        }
    }
    pm_image_free(&whole);
    if (status == PM_OK) {
        *out = image;
    }
    return status;
}

static void check_size(const reading *r, int i, pm_faults *faults)
{
    const pm_image *first = &r->image[0];
    const pm_image *image = &r->image[i];
    if (first->width > 0 && (image->width != first->width || image->height != first->height)) {
        pm_faults_add(faults, r->sheet.picture[i].path, 0,
                      "%dx%d pixels, but %s has %dx%d; a sheet takes pictures of one size",
                      image->width, image->height, r->sheet.picture[0].path, first->width,
                      first->height);
    }
}

/// The message at hand as a line among the others.
static void add_fault(pm_faults *faults, pm_status status)
{
    char file[256];
    const char *message = pm_status_message();
    const char *colon = strstr(message, ": ");
    int length = colon != NULL ? (int)(colon - message) : 0;
    snprintf(file, sizeof file, "%.*s", length, message);
    pm_faults_add(faults, file, 0, "%s", message + (colon != NULL ? length + 2 : 0));
    pm_faults_fail(faults, status);
    pm_status_clear();
}

static pm_status read_images(reading *r)
{
    pm_faults faults = {0};
    for (int i = 0; i < r->sheet.picture_count; i++) {
        pm_contact_picture *picture = &r->sheet.picture[i];
        pm_status status = read_image(picture->path, &r->image[i]);
        if (status == PM_OK) {
            check_size(r, i, &faults);
            status = pm_contact_note(picture->path, picture->note, sizeof picture->note,
                                     &picture->seconds);
        }
        if (status != PM_OK) {
            add_fault(&faults, status);
        }
    }
    return pm_faults_report(&faults);
}

static void name_pictures(pm_contact *sheet)
{
    for (int i = 0; i < sheet->picture_count; i++) {
        char scene[PM_CONTACT_NAME];
        pm_contact_picture *picture = &sheet->picture[i];
        split_name(picture->path, scene, picture->setting);
        pm_contact_block *last = &sheet->block[sheet->block_count - (sheet->block_count > 0)];
        if (sheet->block_count == 0 || strcmp(last->scene, scene) != 0) {
            last = &sheet->block[sheet->block_count++];
            memcpy(last->scene, scene, sizeof scene);
            last->first = i;
        }
        last->count++;
        picture->block = sheet->block_count - 1;
    }
}

/// The brightest channel of a block's pixels decides.
static double find_exposure(const reading *r, const pm_contact_block *block, float *sample)
{
    size_t pixels = (size_t)r->image[0].width * (size_t)r->image[0].height;
    size_t count = 0;
    for (int i = block->first; i < block->first + block->count; i++) {
        for (size_t p = 0; p < pixels; p++) {
            const pm_image *image = &r->image[i];
            sample[count++] =
                fmaxf(image->plane[0][p], fmaxf(image->plane[1][p], image->plane[2][p]));
        }
    }
    return pm_exposure_choose(sample, count);
}

static pm_status choose_exposures(reading *r, double more)
{
    size_t pixels = (size_t)r->image[0].width * (size_t)r->image[0].height;
    float *sample = malloc(pixels * (size_t)r->sheet.picture_count * sizeof *sample);
    if (sample == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %d pictures", r->sheet.picture_count);
    }
    for (int b = 0; b < r->sheet.block_count; b++) {
        r->sheet.block[b].exposure = find_exposure(r, &r->sheet.block[b], sample) + more;
    }
    free(sample);
    return PM_OK;
}

static pm_status show(reading *r)
{
    size_t bytes = 3 * (size_t)r->image[0].width * (size_t)r->image[0].height;
    for (int i = 0; i < r->sheet.picture_count; i++) {
        pm_contact_picture *picture = &r->sheet.picture[i];
        picture->pixels = malloc(bytes);
        if (picture->pixels == NULL) {
            return PM_FAIL(PM_ENOMEM, "no memory for %d pictures", r->sheet.picture_count);
        }
        PM_TRY(pm_png_pixels(picture->path, &r->image[i],
                             r->sheet.block[picture->block].exposure, picture->pixels));
    }
    return PM_OK;
}

static pm_status read_all(reading *r, const char *const *files, double exposure)
{
    for (int i = 0; i < r->sheet.picture_count; i++) {
        r->sheet.picture[i].path = files[i];
    }
    name_pictures(&r->sheet);
    PM_TRY(read_images(r));
    PM_TRY(choose_exposures(r, exposure));
    r->sheet.picture_width = r->image[0].width;
    r->sheet.picture_height = r->image[0].height;
    return show(r);
}

pm_status pm_contact_read(const char *const *files, int count, double exposure,
                          pm_contact *sheet)
{
    if (count < 1 || count > PM_CONTACT_MOST) {
        return PM_FAIL(PM_EINPUT, "a contact sheet has 1 to %d pictures, got %d",
                       PM_CONTACT_MOST, count);
    }
    reading *r = calloc(1, sizeof *r);
    if (r == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %d pictures", count);
    }
    r->sheet.picture_count = count;
    pm_status status = read_all(r, files, exposure);
    for (int i = 0; i < count; i++) {
        pm_image_free(&r->image[i]);
    }
    if (status == PM_OK) {
        *sheet = r->sheet;
    } else {
        pm_contact_free(&r->sheet);
    }
    free(r);
    return status;
}

void pm_contact_free(pm_contact *sheet)
{
    for (int i = 0; i < sheet->picture_count; i++) {
        free(sheet->picture[i].pixels);
    }
    *sheet = (pm_contact){0};
}
