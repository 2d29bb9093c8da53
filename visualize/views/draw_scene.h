// The scene, faintly, for orientation.
#ifndef PM_DRAW_SCENE_H
#define PM_DRAW_SCENE_H

#include "figure.h"
#include "scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Shapes faintly, for orientation: edges, a breath of colour on the faces, and words on
/// lights, mirrors and glass.
pm_status pm_draw_scene(pm_figure *figure, const pm_scene *scene);

/// The same without words: for small panels, and where other words stand.
pm_status pm_draw_scene_wordless(pm_figure *figure, const pm_scene *scene);

#ifdef __cplusplus
}
#endif
#endif
