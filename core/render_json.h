// The JSON object of a finished picture.
#ifndef PM_RENDER_JSON_H
#define PM_RENDER_JSON_H

#include "render.h"

#include <jansson.h>

/// {scene, plan, settings, maps, flux, direct, gather, precompute, choices, .., seconds,
/// peak_bytes}. The caller's reference; NULL without memory.
json_t *pm_render_json(const pm_scene *scene, const pm_render_settings *settings,
                       const pm_render_maps *maps, const pm_eye_report *eye);

#endif
