// What a surface does to light: its lobes, and for each lobe how to sample a direction, with
// what density, and the value of the bsdf, kept together so that they cannot disagree. `wi` and
// `wo` are unit and point away from the surface.
#ifndef PM_MATERIAL_H
#define PM_MATERIAL_H

#include "intersect.h"
#include "rng.h"
#include "scene.h"

#define PM_LOBES_MAX 3

/// Up to this roughness a GLOSSY lobe is narrow enough to be followed like a mirror: S.
#define PM_GLOSSY_ALPHA 0.1

typedef enum {
    PM_LOBE_DIFFUSE,  // cosine about the normal
    PM_LOBE_REFLECT,  // one mirrored direction
    PM_LOBE_TRANSMIT, // one refracted direction
    PM_LOBE_STRAIGHT, // on through a pane, undeviated
    PM_LOBE_COATED,   // diffuse under a plastic's coat
    PM_LOBE_GLOSSY,   // mirrored at microfacets; S or D by their roughness
} pm_lobe_type;

/// A share of the light that a surface scatters.
typedef struct {
    pm_lobe_type type;
    bool specular;      // sampling it is an S event; otherwise D
    pm_spectrum albedo; // ratio of power carried on to power arriving, per channel, in [0, 1];
                        // GLOSSY: near it, the direction's own weight has the rest
} pm_lobe;

/// The lobes of one hit, seen from the side of `wi`. No lobe: the surface absorbs.
typedef struct {
    pm_lobe lobe[PM_LOBES_MAX];
    int count;
    bool diffuse; // one of them is a D lobe: photons are stored here
    bool passes;  // a null surface: the ray goes on, nothing happens
    bool
        disperses; // what it does hangs on the wavelength, and the ray that met it has none yet
    const pm_material *material; // on this side, or NULL
    pm_vec3 wi;
    pm_vec3 normal;    // unit geometric normal on the side of wi
    double eta;        // index where wi runs over index on the other side
    double cos_beyond; // cosine of the refracted direction, 0 on total reflection
    int medium_here;   // medium on the side of wi, and on the other one
    int medium_beyond;
} pm_lobes;

/// A sampled continuation of a path.
typedef struct {
    pm_vec3 wo;
    pm_spectrum weight; // bsdf * |cos| / pdf over the lobe's albedo: the direction's own weight
    double pdf;         // [1/sr] of wo within its lobe; 0 for a delta lobe
    double
        radiance; // factor on radiance travelling back along wo: (n_i / n_t)^2, 1 if reflected
    int medium;   // that the ray along wo runs in
} pm_scatter;

/// The lobes at `hit` for light arriving along the ray `along`, or leaving back along it.
///
/// Its wavelength chooses the index of a glass that disperses; without one it is that of the
/// yellow d line. Its medium is on both sides of a surface that parts no media. Albedos are the
/// same for power and for radiance; the n^2 factor of radiance is in pm_scatter.
void pm_material_lobes(const pm_scene *scene, const pm_hit *hit, const pm_ray *along,
                       pm_lobes *lobes);

/// A direction from lobe number `which`.
void pm_material_sample(const pm_lobes *lobes, int which, pm_rng *rng, pm_scatter *scatter);

/// Value of lobe `which` towards `wo` [1/sr], without a cosine; 0 on the other side, and for a
/// delta lobe. Alike when wi and wo change places.
pm_spectrum pm_material_value(const pm_lobes *lobes, int which, pm_vec3 wo);

/// Sum of the values of all D lobes.
pm_spectrum pm_material_evaluate(const pm_lobes *lobes, pm_vec3 wo);

/// Density [1/sr] with which lobe `which` samples `wo`; 0 for a delta lobe.
double pm_material_pdf(const pm_lobes *lobes, int which, pm_vec3 wo);

/// Whether every D lobe reflects alike whatever the directions.
bool pm_material_is_lambertian(const pm_lobes *lobes);

/// What a material can do, whatever light meets it.
typedef struct {
    bool diffuse;    // has a D lobe, a black one too: photons are stored on it
    bool reflecting; // some channel of a D lobe is above 0
    bool specular;   // has an S lobe that is not black
    bool delta;      // one of these is a smooth one: only by chance would a light be met there
    double albedo;   // with a D lobe: of diffuse light, all its lobes together carry on no more
                     // than this in any channel
} pm_material_traits;

pm_material_traits pm_material_traits_of(const pm_material *material);

/// Fills in the tables of a plastic's coat; nothing for other materials. To be called once,
/// when everything else in it stands.
void pm_material_prepare(pm_material *material);

#endif
