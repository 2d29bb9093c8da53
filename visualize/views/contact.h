// A contact sheet: many pictures at their own size, side by side, each under its name. Files
// are named SCENE.SETTINGS.exr; neighbours of one scene form a block and share an exposure, so
// that what differs between them is their settings and not how they are shown.
#ifndef PM_CONTACT_H
#define PM_CONTACT_H

#include "figure.h"
#include "image.h"
#include "status.h"

#include <jansson.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define PM_CONTACT_MOST 256 // pictures
#define PM_CONTACT_NAME 64  // bytes, with the final zero

typedef struct {
    const char *path;
    char setting[PM_CONTACT_NAME]; // what stands between SCENE. and .exr; "" without
    char note[96];                 // from the report beside the picture (contact_note.h); or ""
    double seconds;                // from there, too; 0 when not known
    int block;
    int x, y;        // of its top left corner on the sheet, pixels from the top left
    uint8_t *pixels; // as on the sheet: 8-bit sRGB, rows from the top
} pm_contact_picture;

/// The pictures of one scene.
typedef struct {
    char scene[PM_CONTACT_NAME];
    int first, count; // of the pictures
    double exposure;  // [stops] of all of them
    int x, y;         // top left corner of its heading
    int right;        // end of its line: of its pictures, or beyond where the heading is longer
} pm_contact_block;

/// Free with pm_contact_free().
typedef struct {
    pm_contact_picture picture[PM_CONTACT_MOST];
    pm_contact_block block[PM_CONTACT_MOST];
    int picture_count, block_count;
    int picture_width, picture_height; // of every picture
    int width, height;                 // of the sheet
} pm_contact;

/// Reads the pictures and shows them as pm_png_write() would: linear light times 2^exposure in
/// sRGB. The exposure of a block is the one, in half stops, at which 95 % of its pixels are not
/// too bright to show, plus `exposure`.
///
/// @param files   1 to PM_CONTACT_MOST paths, which must outlive the sheet
/// @param sheet   [out] without places yet; untouched unless PM_OK
/// @return PM_EIO or PM_EINPUT with a line a fault: no such file, no picture, no channels R G
///         B, a NaN, another size than the first one's; PM_ENOMEM
pm_status pm_contact_read(const char *const *files, int count, double exposure,
                          pm_contact *sheet);
void pm_contact_free(pm_contact *sheet);

/// Finds a place for everything and the size of the sheet, near 4:3.
/// @return PM_EINPUT when a side would be longer than a figure may be
pm_status pm_contact_lay(pm_contact *sheet);

/// What stands where, for programs that read the sheet; NULL without memory. The caller's
/// reference.
/// @param path  of the sheet
json_t *pm_contact_json(const pm_contact *sheet, const char *path);

/// Draws the sheet, which has its places, on a page of its own.
/// @param figure  [out] close with pm_figure_close(), also when drawing fails
pm_status pm_contact_draw(const pm_contact *sheet, const char *title, pm_figure **figure);

#ifdef __cplusplus
}
#endif
#endif
