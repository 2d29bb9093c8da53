// The sources of light that the picture is composed from: lamps, shadow rays, the maps
// (lookup.h), the final gather. One pm_gather a thread; the maps behind it are shared and only
// read.
//
// Where the disc at the end of a gather ray hangs over an edge or is wider than the surface,
// its estimate is too dark: so photons tell that do not fill it (fill.h), and so it is likely
// on a surface nearer than the disc's radius. Such a ray goes on one bounce instead: direct
// light by shadow rays, caustics by the global map, the rest from where one more ray ends.
#ifndef PM_GATHER_H
#define PM_GATHER_H

#include "beams.h"
#include "compose.h"
#include "direct.h"
#include "estimate.h"

/// How the volume map is asked.
typedef enum {
    PM_MEDIA_BEAMS, // one query a stretch (beams.h)
    PM_MEDIA_MARCH, // an estimate a step (media.h)
} pm_media_query;

/// How a picture's light is looked up.
typedef struct {
    pm_estimate_settings estimate;
    uint32_t rays;          // of the final gather, a pixel; 0: the global map is seen directly
    uint32_t light_samples; // shadow rays to each area light, a pixel
    uint32_t spp;           // eye samples a pixel that these are dealt out to
    bool caustics_global;   // the caustic-marked photons of the global map feed that layer
    pm_media_query media;
    double step; // [m] of a march; 0: pm_media_step()
} pm_gather_settings;

typedef struct {
    const pm_compose *compose;              // that asks; set by pm_gather_sources()
    const pm_photon_map *map[PM_MAP_COUNT]; // balanced; NULL: not in this picture
    pm_gather_settings settings;
    const pm_photon_map *irradiance; // at places of the global map (irradiance.h), or NULL
    const pm_shadow_maps *shadows;   // or NULL
    const pm_beams *beams;           // over the volume map, where it is asked by beams; or NULL
    double reach[PM_MAP_COUNT];      // [m] > 0: all photons this near count, in place of k
    pm_neighbour *scratch; // as many as any lookup's k (lookup.h), at least PM_SHADOW_K
    // set by pm_gather_sources():
    double irradiance_reach; // of these places
    bool marked;             // the global map has caustic-marked photons
    pm_vec3 low, high;       // box around the volume map's photons
    // what the estimates in the global map used, summed since the user set them to 0; and what
    // was cut
    double radius_sum;
    uint64_t found_sum;
    uint64_t lookups;
    uint64_t cut;                        // gather rays ended after too many S events in a row
    uint64_t near;                       // gather rays that went on one bounce
    uint64_t shadow_rays, shadow_spared; // as in pm_direct_query
} pm_gather;

/// Points compose->ask at `gather` and the maps that it has. To be called when these are there.
/// Indirect light exists when there is a global map, caustics when there is a caustic map, or,
/// with `caustics_global`, a global map that holds some. What media scatter exists where the
/// scene has media: once scattered without a map, more often with a volume map.
void pm_gather_sources(pm_gather *gather, pm_compose *compose);

/// What an eye sample asks its pixel's lights for. Shifts of lattices hang on it, and random
/// numbers.
typedef enum {
    PM_GATHER_LIGHTS, // at a vertex
    PM_GATHER_RAYS,
    PM_GATHER_GLINT,
    PM_GATHER_FOG, // along a stretch
} pm_gather_purpose;

/// The query of one eye sample at its vertex or stretch `number`, its light points shared out
/// among all samples of the pixel.
pm_direct_query pm_gather_share(const pm_gather *gather, uint64_t pixel, uint32_t sample,
                                uint32_t number, pm_gather_purpose purpose);

/// The query of one sample of each light, for a gather ray; draws from `rng`, and all later
/// numbers are to be drawn from the query's.
pm_direct_query pm_gather_single(const pm_gather *gather, pm_rng *rng);

/// Takes over what a query counted.
void pm_gather_count(pm_gather *gather, const pm_direct_query *query);

#endif
