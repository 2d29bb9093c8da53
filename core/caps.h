// Where paths are cut: only as far as a scene could keep light for ever.
#ifndef PM_CAPS_H
#define PM_CAPS_H

#include "scene.h"

typedef struct {
    uint32_t bounces;  // events of one path; UINT32_MAX: no cap
    uint32_t specular; // S events in a row
} pm_caps;

/// The caps in force: `asked` for both if it is not 0; else no cap on events unless a material
/// with a D lobe could carry on more than 0.9999 of diffuse light, or a medium scatters more
/// than that (then 10,000), and 1,000 specular events in a row.
pm_caps pm_caps_of(const pm_scene *scene, uint32_t asked);

#endif
