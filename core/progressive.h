// Pictures that get better while you wait: memoryless stochastic progressive photon mapping.
// Each pass is a whole picture of its own, from new photons, with a radius that shrinks from
// pass to pass; the result is the mean of all passes so far.
//
// Invariant: after pass i (from 1) the radii follow r_{i+1}^2 / r_i^2 = (i + a) / (i + 1), so
// that the variance falls with the number of passes as N^-a and the squared bias as N^(2a-2);
// of balls in a medium r^3 takes the place of r^2. Passes know nothing of each other, memory is
// that of one pass, and the sums are kept in double: the same bytes however often the work was
// interrupted.
// @source Knaus and Zwicker, "Progressive Photon Mapping: A Probabilistic Approach", TOG 30(3),
// 2011
#ifndef PM_PROGRESSIVE_H
#define PM_PROGRESSIVE_H

#include "map_power.h"
#include "render.h"

#define PM_PROGRESSIVE_ALPHA (2.0 / 3.0)
#define PM_PROGRESSIVE_MOST 268435455u // passes: what random numbers tell apart (rng.h)

/// Planes of sums: the layers' channels, then these.
enum {
    PM_SUM_DEPTH = 3 * PM_LAYER_COUNT,
    PM_SUM_NORMAL, // x, y, z
    PM_SUM_RADIUS = PM_SUM_NORMAL + 3,
    PM_SUM_COUNT,
    PM_SUM_EMITTER, // passes that met an emitter
    PM_SUM_HITS,    // passes that met a surface
    PM_SUM_PLANES,
};

/// Radius of pass `pass` (from 1) over that of the first one, where the kernel spreads over
/// `dimensions` (2: discs and beams, 3: balls).
double pm_progressive_radius(uint64_t pass, int dimensions);

/// Dimensions of the kernel that the map of `kind` is asked with.
int pm_progressive_dimensions(const pm_render_settings *settings, pm_map_kind kind);

/// One map, over all passes. Powers are summed as each pass has them [W]: over the number of
/// passes they are means.
typedef struct {
    double first; // [m] radius of pass 1; 0: not known yet, or not asked
    pm_map_sum sum;
    pm_pass_report pass; // without shares
    double balance_seconds;
} pm_progressive_map;

/// The sums of all passes so far. Zero-initialised: none.
typedef struct {
    uint32_t passes; // done
    pm_progressive_map map[PM_MAP_COUNT];
    pm_eye_report eye;       // summed, but for what is said of a whole picture
    uint64_t shadow_photons; // traced
    uint64_t places;         // of known irradiance
    double shadow_seconds, irradiance_seconds, beams_seconds;
    int width, height;
    double *sum; // PM_SUM_PLANES * height * width; NULL before the first pass
} pm_progressive;

/// Makes zeroed sums ready for passes of this scene, which must outlive them.
/// @param progressive  [in, out] zero-initialised; free with pm_progressive_free() in any case
/// @return PM_ENOMEM
pm_status pm_progressive_begin(const pm_scene *scene, pm_progressive *progressive);

/// Does the next pass and adds it; the first one begins the sums, too. An interrupted or failed
/// pass leaves the sums as they were.
///
/// @param settings  of the whole picture; seed and pass place the random numbers. With a finite
///                  estimate.radius that is the first radius of every map; else each map's is
///                  the mean distance of its k-th photon (first_radius.h) in the first pass
///                  where two of them lie apart; before that its photons are asked as ever
/// @param maps      [in, out] zeroed, or those of another pass with these settings, whose plan
///                  is kept; then those of this pass; free with pm_render_maps_free() in any
///                  case
/// @return PM_EINPUT for settings that make no passes (a stored number of photons, photons as
///         dots) and after PM_PROGRESSIVE_MOST passes; PM_ESTOPPED on SIGINT
pm_status pm_progressive_pass(const pm_intersector *world, const pm_render_settings *settings,
                              pm_progressive *progressive, pm_render_maps *maps);

/// The mean of all passes so far. Depth and normal are means over the passes that met a surface
/// there, mask.emitter is 1 where any pass met an emitter.
///
/// @param image   [out] with the channels of pm_render_image(); free with pm_image_free()
/// @param report  [out] of all passes together; black and too_bright are said of `image`
/// @return PM_EINPUT before the first pass
pm_status pm_progressive_image(const pm_progressive *progressive, pm_image *image,
                               pm_eye_report *report);

/// What all passes together have to report, in the form that one pass has: the plan, photons
/// of a pass, aims, books in means [W] and sums of photons and seconds. The maps hold no
/// photons; their counts are in progressive->map.
///
/// @param maps  [out] free with pm_render_maps_free() in any case
pm_status pm_progressive_books(const pm_scene *scene, const pm_render_settings *settings,
                               const pm_progressive *progressive, pm_render_maps *maps);

void pm_progressive_free(pm_progressive *progressive);

#endif
