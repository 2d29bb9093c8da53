// Whole scenes made by hand, in memory: materials, shapes (tests/shapes.h), lights, and ray
// queries by the plain intersector. In coordinates that are already centred.
//
//     pm_scenes s;
//     pm_scenes_begin(&s);
//     pm_scenes_room(&s, 1.0, pm_scenes_diffuse(&s, pm_gray(0.5)));
//     pm_scenes_point(&s, pm_vec(0.0, 0.0, 0.0), pm_gray(1.0));
//     pm_scenes_ready(&s);
//     ...
//     pm_scenes_free(&s);
#ifndef PM_SCENES_H
#define PM_SCENES_H

#include "material.h"

enum {
    PM_SCENES_SHAPES = 24,
    PM_SCENES_MATERIALS = 12,
    PM_SCENES_LIGHTS = 12,
    PM_SCENES_MEDIA = 4,
};

/// Fixed in memory from begin to free: `scene` points into it.
typedef struct {
    pm_scene scene;
    pm_intersector world;
    pm_shape shapes[PM_SCENES_SHAPES];
    pm_material materials[PM_SCENES_MATERIALS];
    pm_light lights[PM_SCENES_LIGHTS];
    pm_medium media[PM_SCENES_MEDIA];
} pm_scenes;

void pm_scenes_begin(pm_scenes *s);

/// Each adds a material and returns its index.
int pm_scenes_diffuse(pm_scenes *s, pm_spectrum albedo);
int pm_scenes_mirror(pm_scenes *s, pm_spectrum reflectance);
int pm_scenes_glass(pm_scenes *s, double ior); // in air of index 1
int pm_scenes_metal(pm_scenes *s, pm_spectrum eta, pm_spectrum k);
int pm_scenes_null(pm_scenes *s);
int pm_scenes_pane(pm_scenes *s, double ior);
int pm_scenes_plastic(pm_scenes *s, pm_spectrum reflectance, double ior);

/// Rough ones: a perfect mirror of microfacets, and a plastic with a rough coat.
int pm_scenes_rough_mirror(pm_scenes *s, pm_microfacet_kind kind, double alpha);
int pm_scenes_rough_metal(pm_scenes *s, pm_spectrum eta, pm_spectrum k, double alpha);
int pm_scenes_rough_plastic(pm_scenes *s, pm_spectrum reflectance, double ior,
                            pm_microfacet_kind kind, double alpha);

/// Adds a shape with materials on the side of its normal and behind; returns its index. The
/// scene owns what a mesh holds.
int pm_scenes_add(pm_scenes *s, pm_shape shape, int front, int back);

/// The same, wearing one material on both sides.
int pm_scenes_wear(pm_scenes *s, pm_shape shape, int material);

/// Six walls from -half to half (x -, +, y -, +, z -, +), normals inward, black from outside.
/// Returns the index of the first.
int pm_scenes_room(pm_scenes *s, double half, int material);

/// A sphere about the origin that faces inward.
int pm_scenes_globe(pm_scenes *s, double radius, int material);

/// A square of side `width` across z at height z; it faces up, or down.
pm_shape pm_scenes_square(double width, double z, bool down);

/// Each adds a light and returns its index. Point: flux [W]. Area: radiance on a shape. Sun:
/// irradiance on a plane facing it; its flux is set by pm_scenes_ready().
int pm_scenes_point(pm_scenes *s, pm_vec3 position, pm_spectrum flux);
int pm_scenes_lamp(pm_scenes *s, int shape, pm_spectrum radiance);
int pm_scenes_sun(pm_scenes *s, pm_vec3 direction, pm_spectrum irradiance);

/// A spot by the intensity of its beam [W/sr] and two half angles [rad]; and the same radiance
/// from all around, whose flux is set by pm_scenes_ready().
int pm_scenes_spot(pm_scenes *s, pm_vec3 position, pm_vec3 direction, const double cone[2],
                   pm_spectrum intensity);
int pm_scenes_sky(pm_scenes *s, pm_spectrum radiance);

/// Adds a medium and returns its index. Lights and the camera stand outside all media; a test
/// sets `medium` of those that do not.
int pm_scenes_medium(pm_scenes *s, double sigma_t, pm_spectrum albedo, double g);

/// Adds a shape that parts media and does nothing else to light; PM_NONE: no medium there.
int pm_scenes_bound(pm_scenes *s, pm_shape shape, int interior, int exterior);

/// Bounds, radius, flux of suns and skies, ray queries.
void pm_scenes_ready(pm_scenes *s);

void pm_scenes_free(pm_scenes *s);

/// Adds a square across z, normal up, medium 0 above and 1 below, and makes the scene ready.
void pm_scenes_sheet(pm_scenes *s, int front, int back);

/// The lobes of shape 0, which lies across z, for light from `wi`.
pm_lobes pm_scenes_lobes(const pm_scenes *s, pm_vec3 wi);

/// A unit direction at this cosine to +z; a negative one points below.
pm_vec3 pm_scenes_slant(double cosine);

/// A room with a mirror ball, a glass ball, a lamp and a coloured point light; ready.
void pm_scenes_balls(pm_scenes *s);

/// A diffuse room of this albedo around a point light of 3 W; ready.
void pm_scenes_lit_room(pm_scenes *s, double albedo);

/// One sheet of glass, as pm_scenes_sheet() lays it; begun and ready.
void pm_scenes_glass_sheet(pm_scenes *s, double ior);

/// The lobe of this type, or NULL; and the albedo of the mirrored one, 0 without.
const pm_lobe *pm_scenes_lobe(const pm_lobes *lobes, pm_lobe_type type);
double pm_scenes_reflected(const pm_lobes *lobes);

#endif
