// Random numbers without a sequence: each number is a pure function of where it is used.
//
// Philox4x32-10 (Random123) maps (key, counter) to 128 random bits. The key holds seed, stream
// and pass; the counter holds the 64-bit photon (or pixel sample) index, the bounce and the
// draw. So photons are the same for any number of threads, any photon can be replayed alone,
// and the n-th draw at a place is always the same number, however many draws others make.
//
// One draw per statement: C leaves the order of calls inside one expression open.
// @source Salmon et al., "Parallel Random Numbers: As Easy as 1, 2, 3", SC 2011
#ifndef PM_RNG_H
#define PM_RNG_H

#include <stdint.h>

/// What the numbers are for; decisions of different streams are independent. The first three
/// equal the map kinds.
typedef enum {
    PM_STREAM_GLOBAL,
    PM_STREAM_CAUSTIC,
    PM_STREAM_VOLUME,
    PM_STREAM_CAMERA, // index = pixel * samples per pixel + sample
    PM_STREAM_REFERENCE,
    PM_STREAM_TEST,
    PM_STREAM_SHADOW,
    PM_STREAM_LIGHT_PATHS, // of the reference
} pm_rng_stream;

/// Everything about a run that its random numbers depend on, one index and one bounce apart.
typedef struct {
    uint32_t seed;
    pm_rng_stream stream;
    uint32_t pass; // below 2^28
} pm_rng_source;

/// A place to draw from. Plain data, cheap to copy; a copy repeats the same draws.
typedef struct {
    uint32_t key[2];
    uint32_t counter[4]; // index low, index high, bounce, next block of draws
    uint32_t words[4];   // the current block
    uint32_t used;       // words of it already handed out, 0..4
} pm_rng;

/// The handle for one index (a photon, a pixel sample) at one bounce, before its first draw.
/// Emission draws at bounce 0, the n-th event of a path at bounce n.
pm_rng pm_rng_at(const pm_rng_source *source, uint64_t index, uint32_t bounce);

/// The next uniform number in [0, 1): a multiple of 2^-53, never 1.
double pm_rng_draw(pm_rng *rng);

#endif
