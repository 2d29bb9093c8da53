// The whole picture: plan, photon maps, trees, eye pass, image.
#ifndef PM_RENDER_H
#define PM_RENDER_H

#include "gather.h"
#include "image.h"
#include "photon_pass.h"
#include "plan.h"
#include "projection.h"

/// How a picture is made. From pm_render_defaults(), then changed.
typedef struct {
    uint32_t seed;
    uint64_t photons[PM_MAP_COUNT]; // to emit; 0: the map is off by choice
    uint64_t total;                 // to emit in all, split by the plan instead; 0: off
    uint64_t stored;                // emit until each map holds this many instead; 0: off
    pm_roulette_rule roulette;
    uint32_t max_bounces; // 0: the rule of pm_caps_of()
    bool unpacked;
    pm_gather_settings light;
    int only;            // one pm_layer, or PM_NONE for all
    bool view_photons;   // photons as dots in place of the picture
    bool everywhere;     // no projection maps
    bool direct_photons; // shadow photons decide where shadow rays are needless
    bool precompute;     // irradiance at photon positions for the gather (irradiance.h)
    uint32_t pass; // number of a progressive pass, from 0: other random numbers throughout
    double reach[PM_MAP_COUNT]; // [m] > 0: all photons of this map nearer than that count, in
                                // place of k (progressive.h); 0: the estimate's own rule
} pm_render_settings;

pm_render_settings pm_render_defaults(void);

/// The maps of a picture and how they came to be.
typedef struct {
    bool planned; // pm_render_trace_maps() takes the plan as it is
    pm_plan plan;
    uint64_t photons[PM_MAP_COUNT]; // to emit for each map; 0: not traced
    uint64_t shadow_photons;        // besides; 0: none
    bool has[PM_MAP_COUNT];
    pm_photon_map map[PM_MAP_COUNT];
    pm_pass_report pass[PM_MAP_COUNT];    // zeroed where a stored map was given
    double balance_seconds[PM_MAP_COUNT]; // CPU and wall: one thread
    pm_projections aim[PM_MAP_COUNT];     // how each map's photons were aimed
    pm_photon_map irradiance;             // with `precompute`; empty otherwise
    double irradiance_seconds;
    pm_beams beams; // over the volume map, where it is asked by beams
    double beams_seconds;
    pm_shadow_maps shadows; // with `direct_photons`
    double shadow_seconds;
} pm_render_maps;

/// What the eye pass did.
typedef struct {
    double seconds;   // on the wall
    double cpu;       // [s] of all threads
    uint64_t lookups; // in the global map
    uint64_t cut;     // eye paths and gather rays ended after too many S events in a row
    uint64_t near;    // gather rays that went on one bounce
    uint64_t shadow_rays, shadow_spared;
    uint64_t too_bright; // pixels beyond the range of a float: infinite in the picture
    bool black;          // no pixel has any light
} pm_eye_report;

/// Decides what is to be done, and does nothing of it yet: the plan, with what is missing for a
/// map that is off; how many photons go to each map that the scene and the wanted layers need
/// and that is not there already; how they are aimed.
///
/// @param maps  [in, out] zeroed, or with maps given; free with pm_render_maps_free() in any
/// case
/// @return PM_EINPUT when settings->total is too small to be split
pm_status pm_render_plan(const pm_scene *scene, const pm_render_settings *settings,
                         pm_render_maps *maps);

/// Whether the picture shows `layer`, by itself or in mirrors.
bool pm_render_shows(const pm_render_settings *settings, pm_layer layer);

/// Whether `precompute` finds something to do: a global map, and gather rays to look it up.
bool pm_render_precomputes(const pm_render_settings *settings, const pm_render_maps *maps);

/// Plans (pm_render_plan()), unless that is done, then traces and balances what was planned.
/// A map that is there already (`has` set, from a file) is balanced if it is not and kept.
///
/// @param maps  [in, out] zeroed, or with maps given; free with pm_render_maps_free() in any
/// case
pm_status pm_render_trace_maps(const pm_intersector *world, const pm_render_settings *settings,
                               pm_render_maps *maps);

/// Makes what is looked up in place of these maps, or besides: shadow photons, irradiance,
/// beams. Here settings->reach counts for the first time.
pm_status pm_render_ready_maps(const pm_intersector *world, const pm_render_settings *settings,
                               pm_render_maps *maps);

/// Both, one after the other.
pm_status pm_render_make_maps(const pm_intersector *world, const pm_render_settings *settings,
                              pm_render_maps *maps);
void pm_render_maps_free(pm_render_maps *maps);

/// Forgets what was traced and keeps the plan, for another pass.
void pm_render_maps_renew(pm_render_maps *maps);

/// The picture with all its layers, as seen by the scene's camera from these maps.
///
/// Channels: R G B, LAYER.R .G .B for each layer, depth.Z [m] from the eye (0 where nothing
/// is), normal.X .Y .Z, gather.radius [m] and gather.count (means over the estimates in the
/// global map), mask.emitter. The layers add up to R G B.
///
/// @param image   [out] untouched unless PM_OK; free with pm_image_free()
/// @param report  [out]
/// @return PM_ESTOPPED on SIGINT
pm_status pm_render_image(const pm_intersector *world, const pm_render_settings *settings,
                          const pm_render_maps *maps, pm_image *image, pm_eye_report *report);

/// Says of a rendered picture which pixels are beyond a float and whether all are black.
/// @param report  [out] too_bright and black only
void pm_render_look_over(const pm_image *image, pm_eye_report *report);

#endif
