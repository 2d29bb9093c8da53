// Lab 2. Photons travel: what they meet takes part of them, and Russian roulette decides which
// part of the rest goes on, so that one photon stays one photon. In a medium it may collide on
// the way; glass that disperses makes it take one wavelength.
//
// Invariant: the expected power carried on by each lobe is the power arriving times its albedo,
// channel by channel; over all wavelengths taken, the expected power is the one before.
#ifndef PM_TRACE_H
#define PM_TRACE_H

#include "emit.h"
#include "material.h"
#include "photon.h"

/// How likely a lobe is chosen. Both are unbiased; they differ in noise.
typedef enum {
    PM_ROULETTE_MAX,     // largest channel of the power carried on over largest arriving
    PM_ROULETTE_AVERAGE, // mean albedo over the channels
} pm_roulette_rule;

/// How it went.
typedef struct {
    int lobe;          // chosen, or PM_NONE: absorbed
    pm_spectrum power; // carried on: arriving power * albedo / probability; 0 when absorbed
} pm_roulette;

typedef enum {
    PM_EVENT_SURFACE,
    PM_EVENT_MEDIUM,
    PM_EVENT_ESCAPED, // met nothing
    PM_EVENT_CUT,     // a bounce cap ended it; its power is lost
    PM_EVENT_DONE, // the map needs nothing further of this photon; the surface takes the rest
} pm_event_kind;

/// One thing that happened to a photon, in the order it happened. Pointers last for the call.
/// Power goes `arriving`, `entering`, `chosen`, `carried`.
typedef struct {
    pm_event_kind kind;
    char scatter;           // 'S', 'D' or 'V' by what was chosen; 0 when the photon ended
    uint32_t bounce;        // events before this one
    const pm_hit *hit;      // NULL when escaped or in a medium
    const pm_lobes *lobes;  // NULL without a surface
    int medium;             // index of the medium that it collided in, or PM_NONE
    pm_vec3 from, position; // the photon flew from .. to .. (escaped: position is `from`)
    pm_vec3 direction;      // that it travelled in, unit
    pm_spectrum arriving;   // power before
    pm_spectrum entering;   // power before roulette: another one where a wavelength was taken
    pm_spectrum chosen;     // power after roulette, before the sampled direction's own weight
    pm_spectrum carried;    // power that goes on; 0 when the photon ended here
} pm_event;

/// Where tracing hands over what it finds. `event` may be NULL.
typedef struct {
    void *context;
    pm_status (*deposit)(void *context, const pm_deposit *deposit);
    void (*event)(void *context, const pm_start *start, const pm_event *event);
} pm_trace_sink;

typedef struct {
    const pm_intersector *world;
    pm_rng_source source;
    pm_roulette_rule rule;
    uint32_t max_bounces;  // events of one photon
    uint32_t max_specular; // S events in a row
    pm_map_kind map;       // which deposits are handed over; those of a caustic map end with
                           // the first event that is not S
    pm_trace_sink sink;
} pm_tracing;

/// Plays Russian roulette over `count` lobes for a photon of `power`.
///
/// PM_ROULETTE_MAX: P_l = max_c(albedo_lc power_c) / max_c(power_c); PM_ROULETTE_AVERAGE: P_l =
/// mean_c(albedo_lc). When the P_l add up to more than 1 they are all scaled down to sum 1.
/// A photon without power is absorbed.
///
/// @param outcome  [out]
pm_status pm_trace_roulette(pm_spectrum power, const pm_lobe *lobes, int count,
                            pm_roulette_rule rule, pm_rng *rng, pm_roulette *outcome);

/// Follows `count` photons to their ends, one after the other.
///
/// Every meeting with a surface that has a D lobe (for a volume map: every collision in a
/// medium) is handed to the sink with the arriving power, before roulette, the first one
/// included. Null surfaces are passed. The back of a one-sided surface absorbs and deposits
/// nothing.
///
/// Numbers are drawn at bounce n + 1 after n events: the depth of the next collision, if the
/// way leads into a medium; a wavelength, at the second and later times that one is needed; the
/// roulette; the direction.
///
/// @return what the sink returned, if it was not PM_OK
pm_status pm_trace_photons(const pm_tracing *tracing, const pm_start *starts, uint32_t count);

#endif
