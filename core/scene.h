// A scene as plain data, after reading: shapes in world space, materials, lights, one camera.
//
// World space is centred: the reader subtracts `center` from every shape, light and camera in
// double before anything becomes float, and output adds it back. Lengths are in metres.
#ifndef PM_SCENE_H
#define PM_SCENE_H

#include "glass.h"
#include "spectrum.h"
#include "vec.h"

#include <stdbool.h>
#include <stdint.h>

#define PM_NONE (-1)

typedef enum {
    PM_BSDF_DIFFUSE,
    PM_BSDF_DIELECTRIC,
    PM_BSDF_CONDUCTOR,
    PM_BSDF_NULL,            // no event: light passes as if nothing were there
    PM_BSDF_THIN_DIELECTRIC, // a pane: both its faces at once, transmits straight on
    PM_BSDF_ROUGH_CONDUCTOR,
    PM_BSDF_PLASTIC, // diffuse under a smooth dielectric coat
    PM_BSDF_ROUGH_PLASTIC,
} pm_bsdf_type;

/// Distribution of microfacet normals.
typedef enum {
    PM_MICROFACET_BECKMANN,
    PM_MICROFACET_GGX,
} pm_microfacet_kind;

/// Entries of a table over the cosine to the normal, at 0, 1/(n-1), .. 1.
#define PM_COSINE_TABLE 129

/// One bsdf. Ratios lie in [0, 1], indices are > 0.
typedef struct {
    pm_bsdf_type type;
    const char *id; // as in the file, or TYPE@LINE
    int line;
    pm_spectrum reflectance;            // diffuse albedo; of plastics, what lies under the coat
    pm_spectrum specular_reflectance;   // factor on what a smooth lobe reflects
    pm_spectrum specular_transmittance; // factor on what a dielectric transmits
    double int_ior, ext_ior;            // dielectric: inside is opposite to the normal
    const pm_glass *glass;         // dielectric that disperses: its index replaces int_ior;
                                   // else NULL
    bool perfect_mirror;           // conductor with material "none": reflects everything
    pm_spectrum eta, k;            // conductor otherwise, relative to vacuum
    pm_microfacet_kind microfacet; // rough ones
    double alpha;                  // roughness, 1e-4 to 10; up to 0.1 its lobe counts as S
    // Of a plastic's coat, filled in by pm_material_prepare():
    double coat[PM_COSINE_TABLE]; // rough: share of light from outside that gets in, over its
                                  // cosine
    double coat_mean;             // its mean over a diffuse field, weighed by the cosine
    double coat_inside;           // share of diffuse light from within that is thrown back
} pm_material;

typedef enum {
    PM_SHAPE_RECTANGLE,
    PM_SHAPE_SPHERE,
    PM_SHAPE_DISK,
    PM_SHAPE_CYLINDER, // open, without caps
    PM_SHAPE_MESH,     // cube, ply, obj
} pm_shape_type;

/// One shape in world space. Its geometric normal is the one of the formula given, negated when
/// `flipped`; materials and emission refer to that final normal.
typedef struct {
    pm_shape_type type;
    const char *id; // as in the file, or TYPE@LINE
    int line;
    bool flipped;
    int material[2]; // index for the side of the normal and the side behind; PM_NONE absorbs
    int light;       // index of the area light on it, or PM_NONE
    bool
        boundary; // parts media: `interior` and `exterior` say what is behind and before it,
                  // PM_NONE for nothing. Else the same medium is on both sides, whichever it is
    int interior, exterior; // index of the medium behind and before, or PM_NONE
    double area;            // [m^2]
    double reach;           // largest |coordinate| of any of its points; hits take their own
                            // triangle's instead

    pm_vec3 corner; // rectangle: corner + u edge[0] + v edge[1]; normal edge[0] x edge[1]
    pm_vec3 edge[2];

    pm_vec3 center; // sphere, disk; centre of a cylinder's first end
    pm_vec3 axis;   // unit: a disk's normal; a cylinder's direction to its second end
    double radius;  // sphere normal outward; cylinder normal away from the axis
    double length;  // cylinder

    pm_vec3 *vertices; // mesh; normal (v1 - v0) x (v2 - v0)
    uint32_t (*triangles)[3];
    uint32_t vertex_count, triangle_count;
    double
        *area_below; // mesh with a light: area of triangles 0..i, summed in double; else NULL
} pm_shape;

typedef enum {
    PM_LIGHT_POINT,
    PM_LIGHT_AREA,        // on a shape, from the side of its normal, Lambertian
    PM_LIGHT_DIRECTIONAL, // parallel, from outside the scene
    PM_LIGHT_SPOT,        // a cone from a point: full inside the beam, to 0 at the cutoff
    PM_LIGHT_CONSTANT,    // the same radiance from all around, from outside the scene
} pm_light_type;

typedef struct {
    pm_light_type type;
    const char *id; // as in the file, or TYPE@LINE
    int line;
    int shape;           // area: index of its shape; else PM_NONE
    int medium;          // that it stands in, or PM_NONE
    pm_vec3 position;    // point, spot; area: the middle of its shape
    double extent;       // [m] area: no point of it is farther from the middle; 0: not known
    pm_vec3 direction;   // directional, spot: unit, the way the light travels (on the axis)
    double beam, cutoff; // spot [rad]: half angles, 0 <= beam < cutoff < pi; between them the
                         // intensity falls to 0 linearly in the angle
    pm_spectrum emitted; // point, spot: intensity [W/sr] (of the beam); area, constant:
                         // radiance [W/(m^2 sr)]; directional: irradiance [W/m^2] on a plane
                         // facing it
    pm_spectrum flux;    // [W] all in all; directional: through the scene's bounding disc;
                         // constant: into its bounding sphere
} pm_light;

/// A pinhole camera. Pixel (0, 0) is the top left one; a film point (u, v) in [0,1]^2, v down,
/// looks along forward + right (2u - 1) tan_x + up (1 - 2v) tan_y.
typedef struct {
    pm_vec3 position;
    pm_vec3 right, up, forward; // unit
    double tan_x, tan_y;        // of half the field of view
    int width, height;          // pixels
    int medium;                 // that it stands in, or PM_NONE
} pm_camera;

/// Homogeneous medium.
typedef struct {
    const char *id; // as in the file, or TYPE@LINE
    int line;
    double sigma_t;     // extinction [1/m], >= 0
    pm_spectrum albedo; // scattering over extinction, in [0, 1]
    double g;           // Henyey-Greenstein mean cosine, in (-1, 1); 0 isotropic
} pm_medium;

typedef struct pm_scene {
    const char *path; // of the file, for messages
    pm_material *materials;
    pm_shape *shapes;
    pm_light *lights;
    pm_medium *media;
    int material_count, shape_count, light_count, medium_count;
    bool has_camera;
    pm_camera camera;
    pm_vec3 center; // of all shapes; added to a centred point gives the file's coordinates
    pm_vec3 low,
        high;      // bounds of all shapes, points and spots, centred; the camera is left out
    double radius; // of the bounding sphere about the centred origin, > 0
    uint64_t hash; // of everything above that light depends on
    char **notes;  // lines about what was accepted but is not used
    int note_count;
    void *storage; // where every pointer above lives; scene_read owns the kind
} pm_scene;

#endif
