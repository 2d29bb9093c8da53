// The layers of a picture, in the order of the rule that sorts a light path into one of them
// (first that fits, read from the eye). Together they are the picture: each path is in one.
#ifndef PM_LAYER_H
#define PM_LAYER_H

typedef enum {
    PM_LAYER_EMISSION, // no event
    PM_LAYER_SPECULAR, // first eye event specular
    PM_LAYER_VOLUME,   // first eye event in a medium
    PM_LAYER_DIRECT,   // LD
    PM_LAYER_CAUSTIC,  // LS+D
    PM_LAYER_INDIRECT, // any other
    PM_LAYER_COUNT,
} pm_layer;

/// The layer's name, as options and channels ("caustic.R") spell it.
static inline const char *pm_layer_name(pm_layer layer)
{
    static const char *const names[PM_LAYER_COUNT] = {"emission", "specular", "volume",
                                                      "direct",   "caustic",  "indirect"};
    return names[layer];
}

#endif
