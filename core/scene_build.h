// The parts of a scene made from their elements. To be called in this order; each part refers
// to those before it by index.
#ifndef PM_SCENE_BUILD_H
#define PM_SCENE_BUILD_H

#include "scene_file.h"

/// scene.materials; an element's `index` becomes that of its material (twosided has none).
void pm_scene_build_materials(pm_scene_file *source);

/// The materials of a shape's two sides: of the bsdf or ref inside it, or Mitsuba's default.
void pm_scene_build_sides(pm_scene_file *source, const pm_xml *shape, int material[2]);

/// scene.shapes and shape_origin; an element's `index` becomes that of its shape.
void pm_scene_build_shapes(pm_scene_file *source);

/// scene.lights and light_origin; shapes learn their light. Flux is left to pm_scene_center().
void pm_scene_build_lights(pm_scene_file *source);

/// scene.camera, has_camera and camera_origin.
void pm_scene_build_camera(pm_scene_file *source);

#endif
