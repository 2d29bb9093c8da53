// Composing in isolation: a scene whose sources of light are made up. Each answers with its own
// power of ten, so a sum can be read off its digits.
#ifndef PM_DESK_H
#define PM_DESK_H

#include "compose.h"
#include "scenes.h"

enum {
    PM_DESK_EMITTED = 1, // of shapes that carry a light
    PM_DESK_DIRECT = 10,
    PM_DESK_CAUSTIC = 100,
    PM_DESK_INDIRECT = 1000,
    PM_DESK_GLOBAL = 10000,
    PM_DESK_ALL = 1111, // a diffuse lamp, seen by the eye
    PM_DESK_GLINT = 100000,
};

/// Zero-initialise; then pm_scenes_begin(&desk.s) and the scene.
typedef struct {
    pm_scenes s;
    pm_compose compose;
    double sky;                                   // what it answers
    int direct, caustic, indirect, global, glint; // calls
    pm_vertex last;                               // that was asked about
    pm_vertex lamp;                               // the last that was asked what it emits
    uint64_t cut;                                 // gather rays
} pm_desk;

/// To be called when materials, shapes and lights are there: all layers wanted, two splits.
void pm_desk_ready(pm_desk *desk);

/// An eye ray of pixel 3, sample 2, and a gather ray from that sample's first vertex.
pm_eye pm_desk_look(const pm_desk *desk, pm_vec3 from, pm_vec3 to, uint64_t index);
double pm_desk_gather(pm_desk *desk, pm_vec3 from, pm_vec3 to, uint64_t index);

#endif
