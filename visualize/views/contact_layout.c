// Where everything stands on a contact sheet. A block is a heading over a row of pictures, each
// with its setting and its note beneath; blocks fill the sheet row by row. All pictures are
// equally far apart, so where blocks have as many, a column of the sheet is one of settings.
#include "contact_layout.h"

#include "figure.h"

#include <math.h>
#include <string.h>

static const double best_aspect = 4.0 / 3.0;
// Width of a letter over its size, on average and rather too much; of bold ones, too.
static const double letter = 0.5;
static const double bold_letter = 0.58;

/// Width of the longest line beneath a picture.
static int longest_line(const pm_contact *sheet)
{
    double most = 0.0;
    for (int i = 0; i < sheet->picture_count; i++) {
        const pm_contact_picture *picture = &sheet->picture[i];
        double letters = (double)strlen(picture->setting) + PM_CONTACT_SECONDS_LETTERS;
        double note = PM_CONTACT_NOTE * (double)strlen(picture->note);
        most = fmax(most, letter * fmax(PM_CONTACT_SETTING * letters, note));
    }
    return (int)ceil(most);
}

/// Room for a block's heading and for what stands at its right.
static int heading_width(const pm_contact_block *block)
{
    double letters = (double)strlen(block->scene) + PM_CONTACT_EXPOSURE_LETTERS;
    return (int)ceil(bold_letter * PM_CONTACT_HEADING * letters);
}

/// Sizes of the parts, in pixels.
typedef struct {
    int pitch; // from one picture of a block to the next
    int widest_block, block_height;
} measures;

static int block_width(const pm_contact_block *block, int pitch)
{
    int row = block->count * pitch - PM_CONTACT_GAP;
    int heading = heading_width(block);
    return heading > row ? heading : row;
}

static measures measure(const pm_contact *sheet)
{
    int line = longest_line(sheet);
    int cell = line > sheet->picture_width ? line : sheet->picture_width;
    measures m = {
        .pitch = cell + PM_CONTACT_GAP,
        .block_height = PM_CONTACT_ABOVE + sheet->picture_height + PM_CONTACT_BELOW,
    };
    for (int i = 0; i < sheet->block_count; i++) {
        int width = block_width(&sheet->block[i], m.pitch);
        m.widest_block = width > m.widest_block ? width : m.widest_block;
    }
    return m;
}

/// Puts blocks in rows that have room for `columns` of the widest, and sizes the sheet to it.
static void place_blocks(pm_contact *sheet, const measures *m, int columns)
{
    int room = columns * (m->widest_block + PM_CONTACT_AISLE) - PM_CONTACT_AISLE;
    int x = 0;
    int row = 0;
    for (int i = 0; i < sheet->block_count; i++) {
        int width = block_width(&sheet->block[i], m->pitch);
        if (x > 0 && x + width > room) {
            x = 0;
            row++;
        }
        sheet->block[i].x = PM_CONTACT_MARGIN + x;
        sheet->block[i].y = PM_CONTACT_TOP + row * (m->block_height + PM_CONTACT_AISLE);
        x += width + PM_CONTACT_AISLE;
    }
    int width = 2 * PM_CONTACT_MARGIN + room;
    sheet->width = width > PM_CONTACT_WIDTH_MIN ? width : PM_CONTACT_WIDTH_MIN;
    sheet->height = PM_CONTACT_TOP + (row + 1) * (m->block_height + PM_CONTACT_AISLE);
}

/// How far the sheet is from the shape that screens like, as a ratio above 1; a sheet that is
/// too large is far off.
static double distance(const pm_contact *sheet)
{
    double aspect = (double)sheet->width / sheet->height / best_aspect;
    bool fits = sheet->width <= PM_FIGURE_SIZE_MAX && sheet->height <= PM_FIGURE_SIZE_MAX;
    return fits ? fmax(aspect, 1.0 / aspect) : HUGE_VAL;
}

static int choose_columns(pm_contact *sheet, const measures *m)
{
    int best = 1;
    double least = HUGE_VAL;
    for (int columns = 1; columns <= sheet->block_count; columns++) {
        place_blocks(sheet, m, columns);
        double off = distance(sheet);
        if (off < least) {
            least = off;
            best = columns;
        }
    }
    return best;
}

pm_status pm_contact_lay(pm_contact *sheet)
{
    measures m = measure(sheet);
    place_blocks(sheet, &m, choose_columns(sheet, &m));
    if (!(distance(sheet) < HUGE_VAL)) {
        return pm_status_fail(
            PM_EINPUT,
            "view: %d pictures of %dx%d make a sheet of %dx%d, and a side has "
            "at most %d pixels; take fewer or smaller ones",
            sheet->picture_count, sheet->picture_width, sheet->picture_height, sheet->width,
            sheet->height, PM_FIGURE_SIZE_MAX);
    }
    for (int b = 0; b < sheet->block_count; b++) {
        pm_contact_block *block = &sheet->block[b];
        for (int i = 0; i < block->count; i++) {
            sheet->picture[block->first + i].x = block->x + i * m.pitch;
            sheet->picture[block->first + i].y = block->y + PM_CONTACT_ABOVE;
        }
        int row = (block->count - 1) * m.pitch + sheet->picture_width;
        int heading = heading_width(block);
        block->right = block->x + (heading > row ? heading : row);
    }
    return PM_OK;
}

json_t *pm_contact_json(const pm_contact *sheet, const char *path)
{
    json_t *pictures = json_array();
    for (int i = 0; i < sheet->picture_count; i++) {
        const pm_contact_picture *at = &sheet->picture[i];
        const pm_contact_block *block = &sheet->block[at->block];
        json_t *one = json_pack("{s:s,s:s,s:s,s:s,s:f,s:[i,i],s:[i,i]}", "file", at->path,
                                "scene", block->scene, "setting", at->setting, "note", at->note,
                                "exposure", block->exposure, "at", at->x, at->y, "size",
                                sheet->picture_width, sheet->picture_height);
        json_array_append_new(pictures, one);
    }
    return json_pack("{s:s,s:[i,i],s:o}", "picture", path, "size", sheet->width, sheet->height,
                     "pictures", pictures);
}
