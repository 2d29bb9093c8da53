// A picture on a page, in a thin frame, so that a dark one does not melt into the background.
#ifndef PM_DRAW_PLATE_H
#define PM_DRAW_PLATE_H

#include "figure.h"
#include "plate.h"

#ifdef __cplusplus
extern "C" {
#endif

/// @param x, y  of its top left corner, pixels from the figure's top left; the frame lies
/// outside
pm_status pm_draw_plate(pm_figure *figure, const pm_plate *plate, int x, int y);

#ifdef __cplusplus
}
#endif
#endif
