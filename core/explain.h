// `render --explain`: what the scene requires and why, what that costs, what is left out.
#ifndef PM_EXPLAIN_H
#define PM_EXPLAIN_H

#include "render.h"

#include <jansson.h>

/// Prints it for people. `maps` is planned (pm_render_plan()).
void pm_explain_print(const pm_render_settings *settings, const pm_render_maps *maps,
                      FILE *stream);

/// The same as JSON: {plan, photons, choices[{option, effect, missing, idle}],
/// not_offered[{what, why}]}. The caller's reference; NULL without memory.
json_t *pm_explain_json(const pm_render_settings *settings, const pm_render_maps *maps);

/// [{option, effect, missing, idle}, ..]
json_t *pm_explain_choices(const pm_render_settings *settings, const pm_render_maps *maps);

#endif
