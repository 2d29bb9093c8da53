// Every material is a list of lobes, and every lobe knows its own value, density and sampling.
// Plastics are a mirror, or microfacets, over a ground that light leaves through the coat.
#include "material.h"

#include "coat.h"
#include "fresnel.h"
#include "microfacet.h"

#include <stddef.h>

static double square(double x)
{
    return x * x;
}

static double cosine_of(const pm_lobes *lobes, pm_vec3 w)
{
    return pm_vec_dot(w, lobes->normal);
}

/// D lobes stay when they are black, so that photons are stored on black walls too.
static void add_lobe(pm_lobes *lobes, pm_lobe_type type, bool specular, pm_spectrum albedo)
{
    if (specular && pm_spectrum_is_black(albedo)) {
        return;
    }
    lobes->lobe[lobes->count++] = (pm_lobe){type, specular, albedo};
    lobes->diffuse = lobes->diffuse || !specular;
}

/// Index inside glass, for light of this wavelength.
static double index_of(const pm_material *material, double wavelength)
{
    if (material->glass == NULL) {
        return material->int_ior;
    }
    return pm_glass_index(material->glass, wavelength > 0.0 ? wavelength : PM_GLASS_D_LINE);
}

static void add_dielectric(pm_lobes *lobes, const pm_material *material, bool inside,
                           double wavelength)
{
    double within = index_of(material, wavelength);
    lobes->eta = inside ? within / material->ext_ior : material->ext_ior / within;
    lobes->disperses = material->glass != NULL && wavelength == 0.0;
    double reflected =
        pm_fresnel_dielectric(cosine_of(lobes, lobes->wi), lobes->eta, &lobes->cos_beyond);
    add_lobe(lobes, PM_LOBE_REFLECT, true,
             pm_spectrum_scale(material->specular_reflectance, reflected));
    add_lobe(lobes, PM_LOBE_TRANSMIT, true,
             pm_spectrum_scale(material->specular_transmittance, 1.0 - reflected));
}

/// The same from both sides: the pane's own two faces are one surface here.
static void add_pane(pm_lobes *lobes, const pm_material *material)
{
    double reflected =
        pm_fresnel_pane(cosine_of(lobes, lobes->wi), material->ext_ior / material->int_ior);
    add_lobe(lobes, PM_LOBE_REFLECT, true,
             pm_spectrum_scale(material->specular_reflectance, reflected));
    add_lobe(lobes, PM_LOBE_STRAIGHT, true,
             pm_spectrum_scale(material->specular_transmittance, 1.0 - reflected));
}

/// What a mirror of this material reflects at this cosine, its own or a microfacet's.
static pm_spectrum mirror_reflectance(const pm_material *material, double cosine)
{
    pm_spectrum fresnel = pm_gray(1.0);
    if (material->type == PM_BSDF_ROUGH_PLASTIC) {
        double cos_t;
        double eta = material->ext_ior / material->int_ior;
        fresnel = pm_gray(pm_fresnel_dielectric(cosine, eta, &cos_t));
    } else if (!material->perfect_mirror) {
        for (int c = 0; c < 3; c++) {
            fresnel.c[c] = pm_fresnel_conductor(cosine, material->eta.c[c], material->k.c[c]);
        }
    }
    return pm_spectrum_mul(material->specular_reflectance, fresnel);
}

static void add_metal(pm_lobes *lobes, const pm_material *material)
{
    pm_spectrum albedo = mirror_reflectance(material, cosine_of(lobes, lobes->wi));
    if (material->type == PM_BSDF_CONDUCTOR) {
        add_lobe(lobes, PM_LOBE_REFLECT, true, albedo);
    } else {
        add_lobe(lobes, PM_LOBE_GLOSSY, material->alpha <= PM_GLOSSY_ALPHA, albedo);
    }
}

static void add_plastic(pm_lobes *lobes, const pm_material *material)
{
    bool rough = material->type == PM_BSDF_ROUGH_PLASTIC;
    double through = pm_coat_through(material, cosine_of(lobes, lobes->wi));
    add_lobe(lobes, rough ? PM_LOBE_GLOSSY : PM_LOBE_REFLECT,
             !rough || material->alpha <= PM_GLOSSY_ALPHA,
             pm_spectrum_scale(material->specular_reflectance, 1.0 - through));
    add_lobe(lobes, PM_LOBE_COATED, false,
             pm_spectrum_scale(material->reflectance, through * pm_coat_gain(material)));
}

static void add_lobes(pm_lobes *lobes, const pm_material *material, bool behind,
                      double wavelength)
{
    switch (material->type) {
    case PM_BSDF_DIFFUSE:
        add_lobe(lobes, PM_LOBE_DIFFUSE, false, material->reflectance);
        break;
    case PM_BSDF_DIELECTRIC:
        add_dielectric(lobes, material, behind, wavelength);
        break;
    case PM_BSDF_THIN_DIELECTRIC:
        add_pane(lobes, material);
        break;
    case PM_BSDF_CONDUCTOR:
    case PM_BSDF_ROUGH_CONDUCTOR:
        add_metal(lobes, material);
        break;
    case PM_BSDF_PLASTIC:
    case PM_BSDF_ROUGH_PLASTIC:
        add_plastic(lobes, material);
        break;
    case PM_BSDF_NULL:
        lobes->passes = true;
        break;
    }
}

void pm_material_lobes(const pm_scene *scene, const pm_hit *hit, const pm_ray *along,
                       pm_lobes *lobes)
{
    const pm_shape *shape = &scene->shapes[hit->shape];
    pm_vec3 wi = pm_vec_negate(along->direction);
    bool behind = pm_vec_dot(wi, hit->normal) < 0.0;
    *lobes = (pm_lobes){
        .wi = wi,
        .normal = behind ? pm_vec_negate(hit->normal) : hit->normal,
        .eta = 1.0,
        .medium_here = along->medium,
        .medium_beyond = along->medium,
    };
    if (shape->boundary) {
        lobes->medium_here = behind ? shape->interior : shape->exterior;
        lobes->medium_beyond = behind ? shape->exterior : shape->interior;
    }
    int index = shape->material[behind];
    if (index == PM_NONE) {
        return;
    }
    lobes->material = &scene->materials[index];
    add_lobes(lobes, lobes->material, behind, along->wavelength);
}

static pm_vec3 cosine_direction(pm_vec3 normal, pm_rng *rng)
{
    double u[2];
    u[0] = pm_rng_draw(rng);
    u[1] = pm_rng_draw(rng);
    pm_frame frame = pm_frame_around(normal);
    return pm_frame_cosine(&frame, u);
}

static pm_vec3 refracted(const pm_lobes *lobes)
{
    double along = lobes->eta * pm_vec_dot(lobes->wi, lobes->normal) - lobes->cos_beyond;
    pm_vec3 flat = pm_vec_scale(lobes->wi, -lobes->eta);
    return pm_vec_normalize(pm_vec_along(flat, lobes->normal, along));
}

static pm_microfacet facets_of(const pm_lobes *lobes)
{
    return (pm_microfacet){lobes->material->microfacet, lobes->material->alpha};
}

static pm_vec3 drawn_facet(const pm_lobes *lobes, pm_rng *rng)
{
    pm_frame frame = pm_frame_around(lobes->normal);
    pm_vec3 wi = pm_vec(pm_vec_dot(lobes->wi, frame.s), pm_vec_dot(lobes->wi, frame.t),
                        pm_vec_dot(lobes->wi, frame.n));
    return pm_frame_to_world(&frame, pm_microfacet_normal(facets_of(lobes), wi, rng));
}

/// f cos / pdf = F G1(wo), of which the lobe's albedo has a part already. What a facet sends
/// below the surface is lost in the roughness: weight 0, on a harmless way out.
static void sample_glossy(const pm_lobes *lobes, pm_spectrum albedo, pm_rng *rng,
                          pm_scatter *scatter)
{
    pm_vec3 facet = drawn_facet(lobes, rng);
    double cos_i = pm_vec_dot(lobes->wi, facet);
    scatter->wo = pm_vec_normalize(pm_vec_reflect(lobes->wi, facet));
    double cos_o = cosine_of(lobes, scatter->wo);
    scatter->weight = pm_gray(0.0);
    if (cos_i <= 0.0 || cos_o <= 0.0) {
        scatter->wo = pm_vec_normalize(pm_vec_reflect(lobes->wi, lobes->normal));
        return;
    }
    double unmasked = cos_o / pm_microfacet_seen(facets_of(lobes), cos_o);
    pm_spectrum fresnel = mirror_reflectance(lobes->material, pm_least(1.0, cos_i));
    for (int c = 0; c < 3; c++) {
        scatter->weight.c[c] = albedo.c[c] > 0.0 ? fresnel.c[c] * unmasked / albedo.c[c] : 0.0;
    }
}

/// f cos / pdf over the albedo: how much easier than on average the coat lets light out.
static pm_spectrum coated_weight(const pm_lobes *lobes, pm_vec3 wo)
{
    double mean = lobes->material->coat_mean;
    double through = pm_coat_through(lobes->material, cosine_of(lobes, wo));
    return pm_gray(mean > 0.0 ? through / mean : 0.0);
}

void pm_material_sample(const pm_lobes *lobes, int which, pm_rng *rng, pm_scatter *scatter)
{
    *scatter = (pm_scatter){
        .weight = pm_gray(1.0),
        .radiance = 1.0,
        .medium = lobes->medium_here,
    };
    switch (lobes->lobe[which].type) {
    case PM_LOBE_DIFFUSE:
        scatter->wo = cosine_direction(lobes->normal, rng);
        break;
    case PM_LOBE_COATED:
        scatter->wo = cosine_direction(lobes->normal, rng);
        scatter->weight = coated_weight(lobes, scatter->wo);
        break;
    case PM_LOBE_GLOSSY:
        sample_glossy(lobes, lobes->lobe[which].albedo, rng, scatter);
        break;
    case PM_LOBE_REFLECT:
        scatter->wo = pm_vec_normalize(pm_vec_reflect(lobes->wi, lobes->normal));
        break;
    case PM_LOBE_TRANSMIT:
        scatter->wo = refracted(lobes);
        scatter->radiance = square(lobes->eta);
        scatter->medium = lobes->medium_beyond;
        break;
    case PM_LOBE_STRAIGHT:
        scatter->wo = pm_vec_negate(lobes->wi);
        scatter->medium = lobes->medium_beyond;
        break;
    }
    scatter->pdf = pm_material_pdf(lobes, which, scatter->wo);
}

/// D(h) / (4 s(wi)), with h half way between wi and wo: the density of wo.
static double glossy_pdf(const pm_lobes *lobes, pm_vec3 wo)
{
    pm_vec3 half = pm_vec_add(lobes->wi, wo);
    pm_vec3 flat = pm_vec_cross(half, lobes->normal);
    double length2 = pm_vec_dot(half, half);
    double cos2 = square(cosine_of(lobes, half)) / length2;
    double sin2 = pm_vec_dot(flat, flat) / length2;
    double cosine = cosine_of(lobes, lobes->wi);
    pm_microfacet facets = facets_of(lobes);
    return 0.25 * pm_microfacet_density(facets, cos2, sin2) /
           pm_microfacet_seen(facets, cosine);
}

/// F D(h) / (4 s(wi) s(wo)).
static pm_spectrum glossy_value(const pm_lobes *lobes, pm_vec3 wo)
{
    double length = pm_vec_length(pm_vec_add(lobes->wi, wo)); // 2 cos(wi, h)
    pm_spectrum fresnel = mirror_reflectance(lobes->material, pm_least(1.0, 0.5 * length));
    double seen = pm_microfacet_seen(facets_of(lobes), cosine_of(lobes, wo));
    return pm_spectrum_scale(fresnel, glossy_pdf(lobes, wo) / seen);
}

pm_spectrum pm_material_value(const pm_lobes *lobes, int which, pm_vec3 wo)
{
    if (!(cosine_of(lobes, wo) > 0.0)) {
        return pm_gray(0.0);
    }
    pm_spectrum flat = pm_spectrum_scale(lobes->lobe[which].albedo, 1.0 / PM_PI);
    switch (lobes->lobe[which].type) {
    case PM_LOBE_DIFFUSE:
        return flat;
    case PM_LOBE_COATED:
        return pm_spectrum_mul(flat, coated_weight(lobes, wo));
    case PM_LOBE_GLOSSY:
        return glossy_value(lobes, wo);
    default:
        return pm_gray(0.0);
    }
}

pm_spectrum pm_material_evaluate(const pm_lobes *lobes, pm_vec3 wo)
{
    pm_spectrum value = pm_gray(0.0);
    for (int i = 0; i < lobes->count; i++) {
        if (!lobes->lobe[i].specular) {
            value = pm_spectrum_add(value, pm_material_value(lobes, i, wo));
        }
    }
    return value;
}

double pm_material_pdf(const pm_lobes *lobes, int which, pm_vec3 wo)
{
    double cosine = cosine_of(lobes, wo);
    if (!(cosine > 0.0)) {
        return 0.0;
    }
    switch (lobes->lobe[which].type) {
    case PM_LOBE_DIFFUSE:
    case PM_LOBE_COATED:
        return cosine / PM_PI;
    case PM_LOBE_GLOSSY:
        return glossy_pdf(lobes, wo);
    default:
        return 0.0;
    }
}

bool pm_material_is_lambertian(const pm_lobes *lobes)
{
    for (int i = 0; i < lobes->count; i++) {
        if (!lobes->lobe[i].specular && lobes->lobe[i].type != PM_LOBE_DIFFUSE) {
            return false;
        }
    }
    return true;
}

void pm_material_prepare(pm_material *material)
{
    if (material->type == PM_BSDF_PLASTIC || material->type == PM_BSDF_ROUGH_PLASTIC) {
        pm_coat_prepare(material);
    }
}
