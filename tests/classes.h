// Classes of paths: is a picture lit in one layer alone, and by as much as it should be?
#ifndef PM_CLASSES_H
#define PM_CLASSES_H

#include "pictures.h"
#include "scenes.h"

#define PM_CLASSES_MIRRORED 0.8 // by every mirror of these scenes
#define PM_CLASSES_MAP 0.015    // what maps may be off by
#define PM_CLASSES_FLOAT 1e-6   // and what is lost in a float

/// Settings for these small pictures, with so many gather rays a pixel.
pm_render_settings pm_classes_settings(uint32_t rays);

/// Ends the test unless `render`, with and without a gather, and `reference` light the layer
/// `only` by this much, and no other layer at all. Frees the scene.
///
/// The bound is 5 sigma plus `slack`, which is render's: the reference has none.
/// @param want  radiance per channel, of closed form; NULL: what the reference says
void pm_classes_check(pm_scenes *s, pm_layer only, const double *want, double slack);

/// Adds a lamp of radiance 2, 1, 0.5 that is black but for that.
void pm_classes_lamp(pm_scenes *s, pm_shape shape);

/// Adds a square floor about the origin that faces up, black from below.
void pm_classes_floor(pm_scenes *s, double width, double albedo);

/// A rectangle at height z that faces down: x from -0.6 to 0.6, y from `low` to `high`.
pm_shape pm_classes_lid(double low, double high, double z);

/// Makes the scene ready; the eye sees a square of this half width about the origin, from
/// straight above.
void pm_classes_look_down(pm_scenes *s, double half);

/// Begins a scene with a mirror upright in y = 2 that faces the origin: light that rises goes
/// on rising, so what leaves a floor never comes back to it.
void pm_classes_upright_mirror(pm_scenes *s);

/// Makes the scene ready; the eye sees in that mirror what lies about the origin.
void pm_classes_look_at_the_image(pm_scenes *s);

#endif
