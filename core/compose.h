// Lab 7. The picture is put together: which light is asked where, so that each path counts
// once.
//
// Reading a path from the eye, the first rule that fits names its layer: no event: emission;
// first event S: specular; V: volume; else, from a diffuse first event, LD is direct, LS+D
// caustic, any other indirect. The sources below know how to answer; composing decides whom to
// ask, and lets media take their share of what lies behind them.
#ifndef PM_COMPOSE_H
#define PM_COMPOSE_H

#include "eye_path.h"
#include "layer.h"

/// Whom to ask for radiance [W/(m^2 sr)] leaving a vertex towards lobes.wi. Each writes its
/// last argument. Those that are NULL do not exist in this picture and count as black.
///
/// A lamp that shows in a rough mirror is found in two ways: by `glint`, which draws points on
/// lamps, and by `emitted`, where the mirrored path meets one. They share it out between them,
/// by at->pdf, so that both may be added.
typedef struct {
    void *context;
    pm_status (*emitted)(void *context, const pm_vertex *at, pm_spectrum *radiance);
    pm_status (*sky)(void *context, const pm_ray *ray, pm_spectrum *radiance); // beyond all
    pm_status (*glint)(void *context, const pm_vertex *at, pm_spectrum *radiance);
    pm_status (*direct)(void *context, const pm_vertex *at, pm_spectrum *radiance);  // LD
    pm_status (*caustic)(void *context, const pm_vertex *at, pm_spectrum *radiance); // LS+D
    pm_status (*indirect)(void *context, const pm_vertex *at,
                          pm_spectrum *radiance); // the rest
    /// All of it by D lobes, at the end of a gather ray; may draw on from that ray's `rng`.
    pm_status (*global)(void *context, const pm_vertex *at, pm_rng *rng, pm_spectrum *radiance);
    /// What a medium scatters into a stretch of an eye path, arriving at its start.
    pm_status (*volume)(void *context, const pm_stretch *along, pm_spectrum *radiance);
    /// The same into a gather ray.
    pm_status (*haze)(void *context, const pm_stretch *along, pm_rng *rng,
                      pm_spectrum *radiance);
} pm_compose_sources;

typedef struct {
    const pm_intersector *world;
    pm_rng_source source;
    pm_roulette_rule rule;
    uint32_t max_specular; // S events in a row
    uint32_t splits;       // S events at which every lobe is followed; later ones play roulette
    uint32_t colours;      // wavelengths that an eye path is split into at the first surface
                           // that disperses; 0 counts as 1
    uint32_t samples;      // of a pixel, that share its range of wavelengths; 0 counts as 1
    bool wanted[PM_LAYER_COUNT];
    pm_compose_sources ask;
} pm_compose;

/// What one eye ray brings.
typedef struct {
    pm_spectrum layer[PM_LAYER_COUNT];
    bool hit;           // the ray met a surface at all
    bool emitter;       // an emitter was met, through any number of S events
    double depth;       // [m] from the eye to the first surface
    pm_vec3 normal;     // of the first surface, on the eye's side
    uint32_t vertices;  // met so far
    uint32_t stretches; // been through so far
    uint64_t cut; // paths ended by max_specular, where they had another S event before them
} pm_eye;

/// Follows an eye ray through mirrors and glass and asks the sources for light, layer by layer.
///
/// @param index  of the eye sample: places its random numbers
/// @param eye    [in, out] zeroed, but for pixel and sample given here
pm_status pm_compose_eye(const pm_compose *compose, const pm_ray *ray, uint64_t pixel,
                         uint32_t sample, uint64_t index, pm_eye *eye);

/// What a gather ray adds: at a diffuse surface everything that leaves it, by the global map,
/// and what media scatter into it on the way.
///
/// 0 from emitters and the sky, met directly (direct light has them) or through S events (the
/// caustic map has them); S events are followed to a diffuse surface.
///
/// @param at        pixel, sample and vertex that the ray belongs to
/// @param rng       drawn from at S events, and by the global map's source
/// @param radiance  [out] arriving along the ray
/// @param cut       [in, out] counts rays ended by max_specular
pm_status pm_compose_gather(const pm_compose *compose, const pm_ray *ray, const pm_vertex *at,
                            pm_rng *rng, pm_spectrum *radiance, uint64_t *cut);

#endif
