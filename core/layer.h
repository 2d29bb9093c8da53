// The layers of a picture, in the order of the rule that sorts a light path into one of them
// (first that fits, read from the eye). Together they are the picture: each path is in one.
#ifndef PM_LAYER_H
#define PM_LAYER_H

#include <stdbool.h>
#include <stdint.h>

typedef enum {
    PM_LAYER_EMISSION, // no event
    PM_LAYER_SPECULAR, // first eye event specular
    PM_LAYER_VOLUME,   // first eye event in a medium
    PM_LAYER_DIRECT,   // LD
    PM_LAYER_CAUSTIC,  // LS+D
    PM_LAYER_INDIRECT, // any other
    PM_LAYER_COUNT,
} pm_layer;

/// The events of a path, read from the eye. Zero-initialised: none.
typedef struct {
    uint32_t count;
    uint32_t specular; // S events in a row at its far end
    char first;        // 'S', 'D' or 'V': the event next to the eye
    bool later_spread; // one beyond it is D or V
} pm_layer_events;

/// The same path with one more event at its far end, 'S', 'D' or 'V'.
static inline pm_layer_events pm_layer_event(pm_layer_events events, char scatter)
{
    if (events.count == 0) {
        events.first = scatter;
    } else if (scatter != 'S') {
        events.later_spread = true;
    }
    events.count++;
    events.specular = scatter == 'S' ? events.specular + 1 : 0;
    return events;
}

/// Where light belongs that comes along a path with these events.
static inline pm_layer pm_layer_of(pm_layer_events events)
{
    if (events.count == 0) {
        return PM_LAYER_EMISSION;
    }
    if (events.first == 'S') {
        return PM_LAYER_SPECULAR;
    }
    if (events.first == 'V') {
        return PM_LAYER_VOLUME;
    }
    if (events.count == 1) {
        return PM_LAYER_DIRECT;
    }
    return events.later_spread ? PM_LAYER_INDIRECT : PM_LAYER_CAUSTIC;
}

/// The layer's name, as options and channels ("caustic.R") spell it.
static inline const char *pm_layer_name(pm_layer layer)
{
    static const char *const names[PM_LAYER_COUNT] = {"emission", "specular", "volume",
                                                      "direct",   "caustic",  "indirect"};
    return names[layer];
}

#endif
