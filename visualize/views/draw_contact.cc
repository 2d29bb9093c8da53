// A contact sheet on a figure.
#include "core.hh"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#include "contact_layout.h"
#pragma GCC diagnostic pop
#include "figure.h"

#include <cstdio>
#include <string>

namespace {

const char lead[] = "Linear light shown in sRGB, clipped to 0..1. Pictures of one scene "
                    "share its exposure [stops].";

/// The scene's name, and at the right end of that line the exposure.
pm_status draw_heading(pm_figure *figure, const pm_contact_block *block)
{
    char exposure[32];
    double down = PM_CONTACT_HEADING - PM_CONTACT_NOTE; // both stand on one line
    std::snprintf(exposure, sizeof exposure, "%+.1f stops", block->exposure);
    PM_TRY(pm_figure_text(figure, block->scene, block->x, block->y, PM_CONTACT_HEADING,
                          PM_TEXT_STRONG));
    return pm_figure_text(figure, exposure, block->right, block->y + down, PM_CONTACT_NOTE,
                          PM_TEXT_DIM_RIGHT);
}

pm_status draw_picture(pm_figure *figure, const pm_contact *sheet,
                       const pm_contact_picture *picture)
{
    double below = picture->y + sheet->picture_height + 5.0;
    std::string setting = picture->setting;
    if (picture->seconds > 0.0) {
        char took[32];
        std::snprintf(took, sizeof took, "%.1f s", picture->seconds);
        setting += (setting.empty() ? "" : ", ") + std::string(took);
    }
    PM_TRY(pm_figure_picture(figure, picture->pixels, sheet->picture_width,
                             sheet->picture_height, picture->x, picture->y));
    PM_TRY(pm_figure_text(figure, setting.c_str(), picture->x, below, PM_CONTACT_SETTING,
                          PM_TEXT_PLAIN));
    return pm_figure_text(figure, picture->note, picture->x, below + 20.0, PM_CONTACT_NOTE,
                          PM_TEXT_DIM);
}

pm_status draw(pm_figure *figure, const pm_contact *sheet, const char *title)
{
    PM_TRY(pm_figure_text(figure, title, PM_CONTACT_MARGIN, 24.0, PM_CONTACT_TITLE,
                          PM_TEXT_STRONG));
    PM_TRY(pm_figure_text(figure, lead, PM_CONTACT_MARGIN, 62.0, PM_CONTACT_LEAD, PM_TEXT_DIM));
    for (int i = 0; i < sheet->block_count; i++) {
        PM_TRY(draw_heading(figure, &sheet->block[i]));
    }
    for (int i = 0; i < sheet->picture_count; i++) {
        PM_TRY(draw_picture(figure, sheet, &sheet->picture[i]));
    }
    return PM_OK;
}

} // namespace

pm_status pm_contact_draw(const pm_contact *sheet, const char *title, pm_figure **figure)
{
    PM_TRY(pm_figure_open_flat(sheet->width, sheet->height, figure));
    return draw(*figure, sheet, title);
}
