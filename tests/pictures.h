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

/// Radiance by layer, meant over the film, and the variance of these means.
typedef struct {
    pm_spectrum mean[PM_LAYER_COUNT];
    pm_spectrum variance[PM_LAYER_COUNT];
} pm_pictures_means;

/// Means over pictures with the seeds 1 .. `runs`, whose scatter tells the variance.
pm_pictures_means pm_pictures_repeat(const pm_scenes *s, pm_render_settings settings,
                                     uint32_t runs);

/// Adds one set of layers to sums; turns sums of `count` sets into means and variances.
void pm_pictures_add(pm_pictures_means *sums, const pm_spectrum layer[PM_LAYER_COUNT]);
void pm_pictures_finish(pm_pictures_means *sums, double count);

/// Ends the test unless |got - want| is within 5 standard deviations plus `slack` times want.
void pm_pictures_close(const char *file, int line, const char *what, double got, double want,
                       double variance, double slack);

#define CHECK_CLOSE(what, got, want, variance, slack)                                          \
    pm_pictures_close(__FILE__, __LINE__, (what), (got), (want), (variance), (slack))

/// Ends the test unless every channel of `got` but those named in `but` (or NULL) is that of
/// `want` times `factor`, bit for bit.
void pm_pictures_same(const char *file, int line, const pm_image *got, const pm_image *want,
                      double factor, const char *const *but);

#define CHECK_PICTURE(got, want, factor, but)                                                  \
    pm_pictures_same(__FILE__, __LINE__, (got), (want), (factor), (but))

#endif
