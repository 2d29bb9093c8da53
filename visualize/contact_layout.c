// Where everything stands on a contact sheet. A block is a heading over a row of pictures, each
// with its setting and its note beneath; blocks fill the sheet row by row. All of a kind are
// equally large, so a column of the sheet is a column of settings.
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

static int longest_heading(const pm_contact *sheet)
{
    double most = 0.0;
    for (int i = 0; i < sheet->block_count; i++) {
        double letters = (double)strlen(sheet->block[i].scene) + PM_CONTACT_EXPOSURE_LETTERS;
        most = fmax(most, bold_letter * PM_CONTACT_HEADING * letters);
    }
    return (int)ceil(most);
}

static int most_pictures(const pm_contact *sheet)
{
    int most = 0;
    for (int i = 0; i < sheet->block_count; i++) {
        most = sheet->block[i].count > most ? sheet->block[i].count : most;
    }
    return most;
}

/// Sizes of the parts, in pixels.
typedef struct {
    int pitch; // from one picture of a block to the next
    int block_width, block_height;
} measures;

static measures measure(const pm_contact *sheet)
{
    int line = longest_line(sheet);
    int cell = line > sheet->picture_width ? line : sheet->picture_width;
    int row = most_pictures(sheet) * (cell + PM_CONTACT_GAP) - PM_CONTACT_GAP;
    int heading = longest_heading(sheet);
    return (measures){
        .pitch = cell + PM_CONTACT_GAP,
        .block_width = heading > row ? heading : row,
        .block_height = PM_CONTACT_ABOVE + sheet->picture_height + PM_CONTACT_BELOW,
    };
}

static void size_sheet(pm_contact *sheet, const measures *m, int columns)
{
    int rows = (sheet->block_count + columns - 1) / columns;
    int width = 2 * PM_CONTACT_MARGIN + columns * (m->block_width + PM_CONTACT_AISLE) -
                PM_CONTACT_AISLE;
    sheet->width = width > PM_CONTACT_WIDTH_MIN ? width : PM_CONTACT_WIDTH_MIN;
    sheet->height = PM_CONTACT_TOP + rows * (m->block_height + PM_CONTACT_AISLE);
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
        size_sheet(sheet, m, columns);
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
    int columns = choose_columns(sheet, &m);
    size_sheet(sheet, &m, columns);
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
        block->x = PM_CONTACT_MARGIN + b % columns * (m.block_width + PM_CONTACT_AISLE);
        block->y = PM_CONTACT_TOP + b / columns * (m.block_height + PM_CONTACT_AISLE);
        for (int i = 0; i < block->count; i++) {
            sheet->picture[block->first + i].x = block->x + i * m.pitch;
            sheet->picture[block->first + i].y = block->y + PM_CONTACT_ABOVE;
        }
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
