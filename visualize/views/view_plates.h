// What the kinds that show whole pictures share: reading one, and laying plates on the page.
#ifndef PM_VIEW_PLATES_H
#define PM_VIEW_PLATES_H

#include "plate.h"
#include "view.h"

/// Reads a picture file.
/// @param image  [out] untouched unless PM_OK; free with pm_image_free()
/// @return PM_EIO or PM_EINPUT with a line: no such file, no picture, a pixel of any channel
///         that is not finite
pm_status pm_view_read_picture(const char *path, pm_image *image);

/// Zooms a plate, lays it on the page, tells --json where ("pictures": [{what at size zoom}]),
/// and frees it, whatever is returned.
/// @param x, y  of its top left corner, pixels from the figure's top left
pm_status pm_view_lay_plate(pm_view *view, const char *what, pm_plate *plate, int zoom, int x,
                            int y);

#endif
