// Sums and shares of a picture mean nothing once a pixel is infinite, so such a one is refused.
#include "view_plates.h"

#include "draw_plate.h"
#include "exr.h"

#include <math.h>

static pm_status check_plane(const char *path, const pm_image *image, int channel)
{
    size_t width = (size_t)image->width;
    size_t count = width * (size_t)image->height;
    for (size_t i = 0; i < count; i++) {
        double value = (double)image->plane[channel][i];
        if (!isfinite(value)) {
            return pm_status_fail(
                PM_EINPUT, "%s: pixel %zu,%zu of channel %s is %g, and must be a finite number",
                path, i % width, i / width, image->name[channel], value);
        }
    }
    return PM_OK;
}

static pm_status check_image(const char *path, const pm_image *image)
{
    static const char *const colours[3] = {"R", "G", "B"};
    for (int c = 0; c < 3; c++) {
        if (pm_image_plane(image, colours[c]) == NULL) {
            return pm_status_fail(PM_EINPUT, "%s: has no channel %s, so it is no picture", path,
                                  colours[c]);
        }
    }
    for (int c = 0; c < image->channel_count; c++) {
        PM_TRY(check_plane(path, image, c));
    }
    return PM_OK;
}

pm_status pm_view_read_picture(const char *path, pm_image *image)
{
    pm_image read;
    PM_TRY(pm_exr_read(path, &read));
    pm_status status = check_image(path, &read);
    if (status != PM_OK) {
        pm_image_free(&read);
        return status;
    }
    *image = read;
    return PM_OK;
}

static void tell(pm_view *view, const char *what, const pm_plate *plate, int zoom, int x, int y)
{
    json_t *pictures = json_object_get(view->facts, "pictures");
    if (pictures == NULL) {
        pictures = json_array();
        pm_view_fact(view, "pictures", pictures);
    }
    json_array_append_new(pictures,
                          json_pack("{s:s,s:[i,i],s:[i,i],s:i}", "what", what, "at", x, y,
                                    "size", plate->width, plate->height, "zoom", zoom));
}

pm_status pm_view_lay_plate(pm_view *view, const char *what, pm_plate *plate, int zoom, int x,
                            int y)
{
    pm_status status = pm_plate_zoom(plate, zoom);
    if (status == PM_OK) {
        tell(view, what, plate, zoom, x, y);
        status = pm_draw_plate(view->figure, plate, x, y);
    }
    pm_plate_free(plate);
    return status;
}
