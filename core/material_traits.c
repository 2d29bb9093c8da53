// What a material can do, read off its numbers alone. A bound may be too high, never too low: a
// map that is needed must not be left out.
#include "coat.h"
#include "material.h"

static bool is_one(pm_spectrum s)
{
    return s.c[0] == 1.0 && s.c[1] == 1.0 && s.c[2] == 1.0;
}

static pm_material_traits traits_of_metal(const pm_material *material)
{
    bool vacuum =
        !material->perfect_mirror && is_one(material->eta) && pm_spectrum_is_black(material->k);
    double reflects = vacuum ? 0.0 : pm_spectrum_max(material->specular_reflectance);
    bool smooth = material->type == PM_BSDF_CONDUCTOR;
    bool specular = smooth || material->alpha <= PM_GLOSSY_ALPHA;
    return (pm_material_traits){
        .diffuse = !specular,
        .reflecting = !specular && reflects > 0.0,
        .specular = specular && reflects > 0.0,
        .delta = smooth && reflects > 0.0,
        .albedo = specular ? 0.0 : reflects,
    };
}

static pm_material_traits traits_of_plastic(const pm_material *material)
{
    bool smooth = material->type == PM_BSDF_PLASTIC;
    bool coated = material->int_ior != material->ext_ior &&
                  !pm_spectrum_is_black(material->specular_reflectance);
    bool specular = coated && (smooth || material->alpha <= PM_GLOSSY_ALPHA);
    double out = material->coat_mean * pm_coat_gain(material);
    pm_spectrum ground = pm_spectrum_scale(material->reflectance, out);
    pm_spectrum coat =
        pm_spectrum_scale(material->specular_reflectance, 1.0 - material->coat_mean);
    return (pm_material_traits){
        .diffuse = true,
        .reflecting = !pm_spectrum_is_black(material->reflectance) || (coated && !specular),
        .specular = specular,
        .delta = specular && smooth,
        .albedo = pm_spectrum_max(pm_spectrum_add(ground, coat)),
    };
}

static pm_material_traits traits_of_glass(const pm_material *material)
{
    bool dark = pm_spectrum_is_black(material->specular_reflectance) &&
                pm_spectrum_is_black(material->specular_transmittance);
    return (pm_material_traits){.specular = !dark, .delta = !dark};
}

pm_material_traits pm_material_traits_of(const pm_material *material)
{
    double albedo = pm_spectrum_max(material->reflectance);
    switch (material->type) {
    case PM_BSDF_DIFFUSE:
        return (pm_material_traits){
            .diffuse = true, .reflecting = albedo > 0.0, .albedo = albedo};
    case PM_BSDF_CONDUCTOR:
    case PM_BSDF_ROUGH_CONDUCTOR:
        return traits_of_metal(material);
    case PM_BSDF_PLASTIC:
    case PM_BSDF_ROUGH_PLASTIC:
        return traits_of_plastic(material);
    case PM_BSDF_DIELECTRIC:
    case PM_BSDF_THIN_DIELECTRIC:
        return traits_of_glass(material);
    case PM_BSDF_NULL:
        break;
    }
    return (pm_material_traits){0};
}
