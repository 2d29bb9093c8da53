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

#include "render.h"

#define PM_PROGRESSIVE_ALPHA (2.0 / 3.0)

/// Radius of pass `pass` (from 1) over that of the first one, where the kernel spreads over
/// `dimensions` (2: discs and beams, 3: balls).
double pm_progressive_radius(uint64_t pass, int dimensions);

/// The sums of all passes so far. Zero-initialised: none.
typedef struct {
    uint32_t passes;            // done
    double first[PM_MAP_COUNT]; // [m] radius of pass 1 for each map; 0: not asked
    int width, height;
    int channels;                   // of a rendered picture (pixel.h)
    double *sum;                    // channels * height * width, by channel
    pm_eye_report eye;              // summed over the passes
    uint64_t photons[PM_MAP_COUNT]; // emitted, over all passes
    uint64_t stored[PM_MAP_COUNT];
} pm_progressive;

/// Does the next pass and adds it. An interrupted or failed pass leaves the sums as they were.
///
/// @param settings  of the whole picture; seed and pass place the random numbers. With a finite
///                  estimate.radius that is the first radius of every map; else each map's is
///                  the mean distance of its k-th photon, from pass 1
/// @param maps      [out] of this pass; free with pm_render_maps_free() in any case
/// @return PM_ESTOPPED on SIGINT
pm_status pm_progressive_pass(const pm_intersector *world, const pm_render_settings *settings,
                              pm_progressive *progressive, pm_render_maps *maps);

/// The mean of all passes so far.
/// @param image  [out] with the channels of pm_render_image(); free with pm_image_free()
/// @return PM_EINPUT before the first pass
pm_status pm_progressive_image(const pm_progressive *progressive, pm_image *image);

void pm_progressive_free(pm_progressive *progressive);

#endif
