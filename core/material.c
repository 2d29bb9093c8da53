// Smooth dielectrics and conductors after Fresnel, Lambertian reflection, null.
#include "material.h"

static double square(double x)
{
    return x * x;
}

/// Reflectance of a dielectric interface for unpolarised light; eta = n_i / n_t. Writes the
/// cosine of the refracted direction, 0 on total reflection.
static double dielectric_reflectance(double cos_i, double eta, double *cos_t)
{
    if (eta == 1.0) { // both sides alike, at grazing angles too
        *cos_t = cos_i;
        return 0.0;
    }
    // 1 - eta^2 sin^2, in a form that loses no digits where eta is near 1 or light grazes.
    double cos2_t = (1.0 - eta) * (1.0 + eta) + square(eta * cos_i);
    if (cos2_t <= 0.0) {
        *cos_t = 0.0;
        return 1.0;
    }
    *cos_t = sqrt(cos2_t);
    double across = eta * cos_i + *cos_t;
    double along = cos_i + eta * *cos_t;
    double r_s = (eta * cos_i - *cos_t) / across;
    double r_p = (cos_i - eta * *cos_t) / along;
    return 0.5 * (square(r_s) + square(r_p));
}

/// Reflectance of a conductor seen from vacuum, one channel.
static double conductor_reflectance(double cos_i, double eta, double k)
{
    double cos2 = square(cos_i);
    double sin2 = 1.0 - cos2;
    double t0 = (eta - 1.0) * (eta + 1.0) - square(k) + cos2; // eta^2 - k^2 - sin^2
    double a2_plus_b2 = sqrt(square(t0) + 4.0 * square(eta) * square(k));
    double t1 = a2_plus_b2 + cos2;
    double t2 = 2.0 * cos_i * sqrt(pm_most(0.0, 0.5 * (a2_plus_b2 + t0)));
    if (t1 + t2 == 0.0) { // index 1, exactly grazing
        return 0.0;
    }
    double r_s = (t1 - t2) / (t1 + t2);
    double t3 = cos2 * a2_plus_b2 + square(sin2);
    double t4 = t2 * sin2;
    return 0.5 * r_s * (1.0 + (t3 - t4) / (t3 + t4));
}

static void add_lobe(pm_lobes *lobes, pm_lobe_type type, pm_spectrum albedo)
{
    bool specular = type != PM_LOBE_DIFFUSE;
    if (specular && pm_spectrum_is_black(albedo)) {
        return;
    }
    lobes->lobe[lobes->count++] = (pm_lobe){type, specular, albedo};
    lobes->diffuse = lobes->diffuse || !specular;
}

static void add_dielectric(pm_lobes *lobes, const pm_material *material, bool inside)
{
    lobes->eta =
        inside ? material->int_ior / material->ext_ior : material->ext_ior / material->int_ior;
    double cos_i = pm_vec_dot(lobes->wi, lobes->normal);
    double reflected = dielectric_reflectance(cos_i, lobes->eta, &lobes->cos_beyond);
    add_lobe(lobes, PM_LOBE_REFLECT,
             pm_spectrum_scale(material->specular_reflectance, reflected));
    add_lobe(lobes, PM_LOBE_TRANSMIT,
             pm_spectrum_scale(material->specular_transmittance, 1.0 - reflected));
}

static void add_conductor(pm_lobes *lobes, const pm_material *material)
{
    pm_spectrum fresnel = pm_gray(1.0);
    double cos_i = pm_vec_dot(lobes->wi, lobes->normal);
    for (int c = 0; c < 3 && !material->perfect_mirror; c++) {
        fresnel.c[c] = conductor_reflectance(cos_i, material->eta.c[c], material->k.c[c]);
    }
    add_lobe(lobes, PM_LOBE_REFLECT, pm_spectrum_mul(material->specular_reflectance, fresnel));
}

void pm_material_lobes(const pm_scene *scene, const pm_hit *hit, pm_vec3 wi, double wavelength,
                       pm_lobes *lobes)
{
    (void)wavelength; // glasses that disperse will ask for it
    const pm_shape *shape = &scene->shapes[hit->shape];
    bool behind = pm_vec_dot(wi, hit->normal) < 0.0;
    *lobes = (pm_lobes){
        .wi = wi,
        .normal = behind ? pm_vec_negate(hit->normal) : hit->normal,
        .eta = 1.0,
        .medium_here = behind ? shape->interior : shape->exterior,
        .medium_beyond = behind ? shape->exterior : shape->interior,
    };
    int index = shape->material[behind];
    if (index == PM_NONE) {
        return;
    }
    const pm_material *material = &scene->materials[index];
    lobes->material = material;
    switch (material->type) {
    case PM_BSDF_DIFFUSE:
        add_lobe(lobes, PM_LOBE_DIFFUSE, material->reflectance);
        break;
    case PM_BSDF_DIELECTRIC:
        add_dielectric(lobes, material, behind);
        break;
    case PM_BSDF_CONDUCTOR:
        add_conductor(lobes, material);
        break;
    case PM_BSDF_NULL:
        lobes->passes = true;
        break;
    default:
        break;
    }
}

static pm_vec3 cosine_direction(pm_vec3 normal, pm_rng *rng)
{
    double u = pm_rng_draw(rng);
    double phi = 2.0 * PM_PI * pm_rng_draw(rng);
    pm_frame frame = pm_frame_around(normal);
    double radius = sqrt(u);
    return pm_frame_to_world(&frame,
                             pm_vec(radius * cos(phi), radius * sin(phi), sqrt(1.0 - u)));
}

static pm_vec3 refracted(const pm_lobes *lobes)
{
    double along = lobes->eta * pm_vec_dot(lobes->wi, lobes->normal) - lobes->cos_beyond;
    pm_vec3 flat = pm_vec_scale(lobes->wi, -lobes->eta);
    return pm_vec_normalize(pm_vec_along(flat, lobes->normal, along));
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
        scatter->pdf = pm_material_pdf(lobes, which, scatter->wo);
        break;
    case PM_LOBE_REFLECT:
        scatter->wo = pm_vec_normalize(pm_vec_reflect(lobes->wi, lobes->normal));
        break;
    case PM_LOBE_TRANSMIT:
        scatter->wo = refracted(lobes);
        scatter->radiance = square(lobes->eta);
        scatter->medium = lobes->medium_beyond;
        break;
    default:
        break;
    }
}

pm_spectrum pm_material_value(const pm_lobes *lobes, int which, pm_vec3 wo)
{
    bool reflects = lobes->lobe[which].type == PM_LOBE_DIFFUSE;
    bool above = pm_vec_dot(wo, lobes->normal) > 0.0;
    return reflects && above ? pm_spectrum_scale(lobes->lobe[which].albedo, 1.0 / PM_PI)
                             : pm_gray(0.0);
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
    double cosine = pm_vec_dot(wo, lobes->normal);
    bool samples = lobes->lobe[which].type == PM_LOBE_DIFFUSE && cosine > 0.0;
    return samples ? cosine / PM_PI : 0.0;
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

pm_material_traits pm_material_traits_of(const pm_material *material)
{
    pm_material_traits traits = {0};
    if (material->type == PM_BSDF_DIFFUSE) {
        traits.diffuse = true;
        traits.albedo = pm_spectrum_max(material->reflectance);
        traits.reflecting = traits.albedo > 0.0;
    }
    traits.specular = traits.delta =
        material->type == PM_BSDF_DIELECTRIC || material->type == PM_BSDF_CONDUCTOR;
    traits.transmits = material->type == PM_BSDF_DIELECTRIC || material->type == PM_BSDF_NULL;
    return traits;
}

void pm_material_prepare(pm_material *material)
{
    (void)material;
}
