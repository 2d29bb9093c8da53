// The picture that others are judged by: unbiased path tracing with next-event estimation and
// multiple importance sampling. It shares the scene, materials and roulette with the photon
// mapper, and no map, so it cannot share its mistakes of density estimation. In media its paths
// collide by chance, as light does; glass that disperses makes them take one wavelength each.
//
// Paths are sorted into the layers of layer.h by the same rule. What an eye path cannot find
// (light of a point, spot or directional light that went through glass or mirror first) is
// named, and with `light_paths` traced from the lights to the camera instead.
// @source Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997
#ifndef PM_REFERENCE_H
#define PM_REFERENCE_H

#include "image.h"
#include "intersect.h"
#include "trace.h"

#include <stdbool.h>

/// From pm_reference_defaults(), then changed.
typedef struct {
    uint32_t seed;
    uint32_t spp;         // samples of a pixel, even: half of them make each half
    uint32_t max_bounces; // 0: the rule of pm_caps_of()
    pm_roulette_rule roulette;
    uint64_t light_paths; // traced from lights without extent to the camera; 0: none
} pm_reference_settings;

pm_reference_settings pm_reference_defaults(void); // 256 samples, no light paths

typedef struct {
    double seconds;
    double rel_error; // estimated rel_rmse of the whole picture, masked, from its two halves;
                      // NaN when a pixel is not finite
    uint64_t cut;     // paths ended by a cap
    uint64_t light_paths; // traced: 0 when eye paths find everything
    uint64_t too_bright;  // pixels that a float cannot hold
    bool black;
    char blind[256]; // one sentence: what the picture cannot show; "" when it shows everything
} pm_reference_report;

/// The channels of pm_render_image() without gather.*, and half1.*, half2.*: the picture from
/// each half of the samples alone, with every layer again (half1.R, half1.direct.R ...).
///
/// @param image   [out] untouched unless PM_OK; free with pm_image_free()
/// @param report  [out]
/// @return PM_EINPUT when spp is odd or 0, or with fewer than two light paths for each light
///         that needs them; PM_ENOMEM; PM_ESTOPPED on SIGINT
pm_status pm_reference_image(const pm_intersector *world, const pm_reference_settings *settings,
                             pm_image *image, pm_reference_report *report);

#endif
