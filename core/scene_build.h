// The parts of a scene made from their elements. To be called in this order; each part refers
// to those before it by index.
#ifndef PM_SCENE_BUILD_H
#define PM_SCENE_BUILD_H

#include "scene_file.h"

/// scene.materials; an element's `index` becomes that of its material (twosided has none).
void pm_scene_build_materials(pm_scene_file *source);

/// The materials of a shape's two sides: of the bsdf or ref inside it, or Mitsuba's default.
void pm_scene_build_sides(pm_scene_file *source, const pm_xml *shape, int material[2]);

/// scene.media; an element's `index` becomes that of its medium.
void pm_scene_build_media(pm_scene_file *source);

/// Whether a child of a shape is named as the medium on one of its sides.
bool pm_scene_build_names_side(const pm_xml *child);

/// boundary, interior and exterior of a shape.
void pm_scene_build_boundary(pm_scene_file *source, const pm_xml *element, pm_shape *shape);

/// The medium that a sensor or an emitter names, or PM_NONE.
int pm_scene_build_stand(pm_scene_file *source, const pm_xml *object);

/// scene.shapes and shape_origin; an element's `index` becomes that of its shape.
void pm_scene_build_shapes(pm_scene_file *source);

/// scene.lights and light_origin; shapes learn their light. Flux is left to pm_scene_center().
void pm_scene_build_lights(pm_scene_file *source);

/// scene.camera, has_camera and camera_origin.
void pm_scene_build_camera(pm_scene_file *source);

/// Drops the media that no shape, light or camera refers to, with a note for each: they cost
/// nothing then, and the scene is the one without them.
void pm_scene_drop_media(pm_scene_file *source);

#endif
