// The frame is an overlay, and overlays count rows from the bottom.
#include "figure.hh"

#include "draw_plate.h"
#include "drawing.hh"

pm_status pm_draw_plate(pm_figure *figure, const pm_plate *plate, int x, int y)
{
    PM_TRY(pm_figure_picture(figure, plate->pixels, plate->width, plate->height, x, y));
    return pm_figure_guard("a frame", [&] {
        double left = x - 1.0;
        double right = x + plate->width + 1.0;
        double top = figure->height - y + 1.0;
        double bottom = figure->height - y - plate->height - 1.0;
        pm_drawing frame;
        frame.outline({pm_vec(left, bottom, 0), pm_vec(right, bottom, 0), pm_vec(right, top, 0),
                       pm_vec(left, top, 0)},
                      {92, 98, 112}, 1.0);
        pm_figure_overlay(figure, frame.data(), 1.0);
        return PM_OK;
    });
}
