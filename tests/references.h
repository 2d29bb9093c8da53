// Reference pictures of scenes made by hand, and what they show on average. Calls that fail end
// the running test.
#ifndef PM_REFERENCES_H
#define PM_REFERENCES_H

#include "pictures.h"
#include "reference.h"

/// Settings with this many samples a pixel.
pm_reference_settings pm_references_settings(uint32_t spp);

/// The picture; free with pm_image_free(). `report` may be NULL.
pm_image pm_references_take(const pm_scenes *s, const pm_reference_settings *settings,
                            pm_reference_report *report);

/// Means over the film, and their variances from the halves of all pixels: pixels are drawn
/// independently of each other, and their halves too.
pm_pictures_means pm_references_means(const pm_image *image);

/// The same of a picture that is taken and given back.
pm_pictures_means pm_references_trace(const pm_scenes *s, uint32_t spp);

/// Means over pictures with the seeds 1 .. `runs`, whose scatter tells the variance: for
/// pictures with light paths, whose pixels are not independent of each other.
pm_pictures_means pm_references_repeat(const pm_scenes *s, pm_reference_settings settings,
                                       uint32_t runs);

/// Ends the test unless the channels of a layer agree within 5 sigma of both variances.
void pm_references_agree(pm_layer layer, const pm_pictures_means *got,
                         const pm_pictures_means *want);

/// A room with coloured walls, a mirror ball, a glass ball and a lamp that reflects, without a
/// camera; not ready yet. Returns the lamp's shape, which shines when `shines`.
int pm_references_room(pm_scenes *s, bool shines);

#endif
