// Cameras for scenes made by hand, and the pictures that they take. Calls that fail end the
// running test.
#ifndef PM_PICTURES_H
#define PM_PICTURES_H

#include "render.h"
#include "scenes.h"

/// A square camera of `size` pixels a side. Up is z, or y for a camera that looks along z;
/// `tangent` is that of half the field of view.
void pm_pictures_look(pm_scenes *s, pm_vec3 from, pm_vec3 to, double tangent, int size);

/// The first surface from a point along a unit direction, as the first vertex of an eye path.
pm_vertex pm_pictures_meet(const pm_scenes *s, pm_vec3 from, pm_vec3 direction);

/// Settings for small pictures: 20,000 photons a map, 4 samples a pixel, gather off.
pm_render_settings pm_pictures_settings(void);

/// Maps and picture by the whole renderer; free with pm_image_free().
pm_image pm_pictures_take(const pm_scenes *s, const pm_render_settings *settings);

/// One pixel of a channel; the channel must be there.
double pm_pictures_at(const pm_image *image, const char *channel, int x, int y);

/// Mean over all pixels of a channel, and of the three channels of a layer.
double pm_pictures_mean(const pm_image *image, const char *channel);
pm_spectrum pm_pictures_layer(const pm_image *image, pm_layer layer);

/// Ends the test unless every channel of `got` but those named in `but` (or NULL) is that of
/// `want` times `factor`, bit for bit.
void pm_pictures_same(const char *file, int line, const pm_image *got, const pm_image *want,
                      double factor, const char *const *but);

#define CHECK_PICTURE(got, want, factor, but)                                                  \
    pm_pictures_same(__FILE__, __LINE__, (got), (want), (factor), (but))

#endif
