// Scenes by hand. Invariant: what the reader would compute (flux, bounds, radius) is set as its
// contract says; nothing else of a scene is.
#include "scenes.h"

#include "intersect_plain.h"
#include "light.h"
#include "shape.h"
#include "shapes.h"
#include "test.h"

void pm_scenes_begin(pm_scenes *s)
{
    *s = (pm_scenes){0};
    s->scene = (pm_scene){
        .path = "test.xml",
        .materials = s->materials,
        .shapes = s->shapes,
        .lights = s->lights,
        .media = s->media,
        .camera = {.medium = PM_NONE},
    };
}

static int add_material(pm_scenes *s, pm_material material)
{
    CHECK(s->scene.material_count < PM_SCENES_MATERIALS);
    s->materials[s->scene.material_count] = material;
    return s->scene.material_count++;
}

int pm_scenes_diffuse(pm_scenes *s, pm_spectrum albedo)
{
    return add_material(
        s, (pm_material){.type = PM_BSDF_DIFFUSE, .id = "diffuse", .reflectance = albedo});
}

int pm_scenes_mirror(pm_scenes *s, pm_spectrum reflectance)
{
    return add_material(s, (pm_material){.type = PM_BSDF_CONDUCTOR,
                                         .id = "mirror",
                                         .specular_reflectance = reflectance,
                                         .perfect_mirror = true});
}

int pm_scenes_glass(pm_scenes *s, double ior)
{
    return add_material(s, (pm_material){.type = PM_BSDF_DIELECTRIC,
                                         .id = "glass",
                                         .specular_reflectance = pm_gray(1.0),
                                         .specular_transmittance = pm_gray(1.0),
                                         .int_ior = ior,
                                         .ext_ior = 1.0});
}

int pm_scenes_metal(pm_scenes *s, pm_spectrum eta, pm_spectrum k)
{
    return add_material(s, (pm_material){.type = PM_BSDF_CONDUCTOR,
                                         .id = "metal",
                                         .specular_reflectance = pm_gray(1.0),
                                         .eta = eta,
                                         .k = k});
}

int pm_scenes_null(pm_scenes *s)
{
    return add_material(s, (pm_material){.type = PM_BSDF_NULL, .id = "null"});
}

int pm_scenes_pane(pm_scenes *s, double ior)
{
    int pane = pm_scenes_glass(s, ior);
    s->materials[pane].type = PM_BSDF_THIN_DIELECTRIC;
    s->materials[pane].id = "pane";
    return pane;
}

int pm_scenes_plastic(pm_scenes *s, pm_spectrum reflectance, double ior)
{
    pm_material plastic = {.type = PM_BSDF_PLASTIC,
                           .id = "plastic",
                           .reflectance = reflectance,
                           .specular_reflectance = pm_gray(1.0),
                           .int_ior = ior,
                           .ext_ior = 1.0};
    pm_material_prepare(&plastic);
    return add_material(s, plastic);
}

int pm_scenes_rough_mirror(pm_scenes *s, pm_microfacet_kind kind, double alpha)
{
    int mirror = pm_scenes_mirror(s, pm_gray(1.0));
    pm_material *material = &s->materials[mirror];
    material->type = PM_BSDF_ROUGH_CONDUCTOR;
    material->id = "rough mirror";
    material->microfacet = kind;
    material->alpha = alpha;
    return mirror;
}

int pm_scenes_rough_metal(pm_scenes *s, pm_spectrum eta, pm_spectrum k, double alpha)
{
    int metal = pm_scenes_rough_mirror(s, PM_MICROFACET_GGX, alpha);
    pm_material *material = &s->materials[metal];
    material->id = "rough metal";
    material->perfect_mirror = false;
    material->eta = eta;
    material->k = k;
    return metal;
}

int pm_scenes_rough_plastic(pm_scenes *s, pm_spectrum reflectance, double ior,
                            pm_microfacet_kind kind, double alpha)
{
    pm_material plastic = {.type = PM_BSDF_ROUGH_PLASTIC,
                           .id = "rough plastic",
                           .reflectance = reflectance,
                           .specular_reflectance = pm_gray(1.0),
                           .int_ior = ior,
                           .ext_ior = 1.0,
                           .microfacet = kind,
                           .alpha = alpha};
    pm_material_prepare(&plastic);
    return add_material(s, plastic);
}

int pm_scenes_add(pm_scenes *s, pm_shape shape, int front, int back)
{
    CHECK(s->scene.shape_count < PM_SCENES_SHAPES);
    shape.material[0] = front;
    shape.material[1] = back;
    s->shapes[s->scene.shape_count] = shape;
    return s->scene.shape_count++;
}

int pm_scenes_wear(pm_scenes *s, pm_shape shape, int material)
{
    return pm_scenes_add(s, shape, material, material);
}

int pm_scenes_room(pm_scenes *s, double half, int material)
{
    const pm_frame upright = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    pm_shape walls[6];
    pm_shapes_room(&upright, pm_vec(0.0, 0.0, 0.0), half, walls);
    int first = s->scene.shape_count;
    for (int i = 0; i < 6; i++) {
        pm_scenes_add(s, walls[i], material, PM_NONE);
    }
    return first;
}

int pm_scenes_globe(pm_scenes *s, double radius, int material)
{
    pm_shape globe = pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), radius);
    globe.flipped = true;
    return pm_scenes_add(s, globe, material, PM_NONE);
}

pm_shape pm_scenes_square(double width, double z, bool down)
{
    double half = 0.5 * width;
    pm_vec3 along_x = pm_vec(width, 0.0, 0.0);
    pm_vec3 along_y = pm_vec(0.0, width, 0.0);
    pm_vec3 corner = pm_vec(-half, -half, z);
    return down ? pm_shapes_rectangle(corner, along_y, along_x)
                : pm_shapes_rectangle(corner, along_x, along_y);
}

static int add_light(pm_scenes *s, pm_light light)
{
    CHECK(s->scene.light_count < PM_SCENES_LIGHTS);
    light.medium = PM_NONE;
    s->lights[s->scene.light_count] = light;
    return s->scene.light_count++;
}

int pm_scenes_point(pm_scenes *s, pm_vec3 position, pm_spectrum flux)
{
    return add_light(s, (pm_light){.type = PM_LIGHT_POINT,
                                   .id = "point",
                                   .shape = PM_NONE,
                                   .position = position,
                                   .emitted = pm_spectrum_scale(flux, 0.25 / PM_PI),
                                   .flux = flux});
}

int pm_scenes_lamp(pm_scenes *s, int shape, pm_spectrum radiance)
{
    double through = PM_PI * s->shapes[shape].area;
    s->shapes[shape].light = s->scene.light_count;
    return add_light(s, (pm_light){.type = PM_LIGHT_AREA,
                                   .id = "lamp",
                                   .shape = shape,
                                   .emitted = radiance,
                                   .flux = pm_spectrum_scale(radiance, through)});
}

int pm_scenes_sun(pm_scenes *s, pm_vec3 direction, pm_spectrum irradiance)
{
    return add_light(s, (pm_light){.type = PM_LIGHT_DIRECTIONAL,
                                   .id = "sun",
                                   .shape = PM_NONE,
                                   .direction = pm_vec_normalize(direction),
                                   .emitted = irradiance});
}

int pm_scenes_spot(pm_scenes *s, pm_vec3 position, pm_vec3 direction, const double cone[2],
                   pm_spectrum intensity)
{
    pm_light spot = {.type = PM_LIGHT_SPOT,
                     .id = "spot",
                     .shape = PM_NONE,
                     .position = position,
                     .direction = pm_vec_normalize(direction),
                     .beam = cone[0],
                     .cutoff = cone[1],
                     .emitted = intensity};
    spot.flux = pm_spectrum_scale(intensity, pm_light_cone(&spot));
    return add_light(s, spot);
}

int pm_scenes_sky(pm_scenes *s, pm_spectrum radiance)
{
    return add_light(
        s, (pm_light){
               .type = PM_LIGHT_CONSTANT, .id = "sky", .shape = PM_NONE, .emitted = radiance});
}

int pm_scenes_medium(pm_scenes *s, double sigma_t, pm_spectrum albedo, double g)
{
    static const char *const ids[PM_SCENES_MEDIA] = {"fog", "smoke", "water", "milk"};
    int index = s->scene.medium_count++;
    CHECK(index < PM_SCENES_MEDIA);
    s->media[index] =
        (pm_medium){.id = ids[index], .sigma_t = sigma_t, .albedo = albedo, .g = g};
    return index;
}

int pm_scenes_bound(pm_scenes *s, pm_shape shape, int interior, int exterior)
{
    shape.boundary = true;
    shape.interior = interior;
    shape.exterior = exterior;
    int null = pm_scenes_null(s);
    return pm_scenes_add(s, shape, null, null);
}

static void measure(pm_scene *scene)
{
    scene->low = pm_vec(HUGE_VAL, HUGE_VAL, HUGE_VAL);
    scene->high = pm_vec_negate(scene->low);
    for (int i = 0; i < scene->shape_count; i++) {
        uint32_t count = pm_shape_primitives(&scene->shapes[i]);
        for (uint32_t j = 0; j < count; j++) {
            pm_box box = pm_shape_box(&scene->shapes[i], j);
            scene->low = pm_vec_min(scene->low, box.low);
            scene->high = pm_vec_max(scene->high, box.high);
        }
    }
    for (int i = 0; i < scene->light_count; i++) {
        if (scene->lights[i].type == PM_LIGHT_POINT || scene->lights[i].type == PM_LIGHT_SPOT) {
            scene->low = pm_vec_min(scene->low, scene->lights[i].position);
            scene->high = pm_vec_max(scene->high, scene->lights[i].position);
        }
    }
    pm_vec3 far_corner = pm_vec_max(scene->high, pm_vec_negate(scene->low));
    scene->radius = pm_vec_length(far_corner);
}

void pm_scenes_ready(pm_scenes *s)
{
    measure(&s->scene);
    double disc = PM_PI * s->scene.radius * s->scene.radius;
    for (int i = 0; i < s->scene.light_count; i++) {
        pm_light *light = &s->lights[i];
        if (light->type == PM_LIGHT_DIRECTIONAL) {
            light->flux = pm_spectrum_scale(light->emitted, disc);
        } else if (light->type == PM_LIGHT_CONSTANT) {
            light->flux = pm_spectrum_scale(light->emitted, 4.0 * PM_PI * disc);
        }
    }
    CHECK_OK(pm_intersect_plain(&s->scene, &s->world));
}

void pm_scenes_free(pm_scenes *s)
{
    pm_intersector_free(&s->world);
    pm_shapes_free(s->shapes, (size_t)s->scene.shape_count);
}

void pm_scenes_sheet(pm_scenes *s, int front, int back)
{
    pm_shape shape = pm_scenes_square(2.0, 0.0, false);
    shape.exterior = 0;
    shape.boundary = true;
    shape.interior = 1;
    pm_scenes_add(s, shape, front, back);
    pm_scenes_ready(s);
}

pm_lobes pm_scenes_lobes(const pm_scenes *s, pm_vec3 wi)
{
    pm_hit hit = {.normal = pm_vec(0.0, 0.0, 1.0), .offset = PM_OFFSET};
    pm_lobes lobes;
    pm_ray along = {.direction = pm_vec_negate(wi), .medium = PM_NONE};
    pm_material_lobes(&s->scene, &hit, &along, &lobes);
    return lobes;
}

pm_vec3 pm_scenes_slant(double cosine)
{
    double sine = sqrt((1.0 - cosine) * (1.0 + cosine));
    return pm_vec(sine * 0.6, sine * 0.8, cosine);
}

void pm_scenes_balls(pm_scenes *s)
{
    pm_scenes_begin(s);
    pm_scenes_room(s, 1.0, pm_scenes_diffuse(s, pm_rgb(0.7, 0.5, 0.3)));
    pm_shape mirror = pm_shapes_sphere(pm_vec(-0.4, 0.2, -0.6), 0.4);
    pm_shape glass = pm_shapes_sphere(pm_vec(0.45, -0.2, -0.55), 0.4);
    pm_scenes_wear(s, mirror, pm_scenes_mirror(s, pm_gray(0.9)));
    pm_scenes_wear(s, glass, pm_scenes_glass(s, 1.5));
    int lamp = pm_scenes_add(s, pm_scenes_square(0.5, 1.0, true), 0, PM_NONE);
    pm_scenes_lamp(s, lamp, pm_gray(2.0));
    pm_scenes_point(s, pm_vec(0.1, 0.0, 0.8), pm_rgb(1.0, 2.0, 1.0));
    pm_scenes_ready(s);
}

void pm_scenes_lit_room(pm_scenes *s, double albedo)
{
    pm_scenes_begin(s);
    pm_scenes_room(s, 1.0, pm_scenes_diffuse(s, pm_gray(albedo)));
    pm_scenes_point(s, pm_vec(0.1, 0.0, 0.2), pm_gray(3.0));
    pm_scenes_ready(s);
}

void pm_scenes_glass_sheet(pm_scenes *s, double ior)
{
    pm_scenes_begin(s);
    int glass = pm_scenes_glass(s, ior);
    pm_scenes_sheet(s, glass, glass);
}

const pm_lobe *pm_scenes_lobe(const pm_lobes *lobes, pm_lobe_type type)
{
    for (int i = 0; i < lobes->count; i++) {
        if (lobes->lobe[i].type == type) {
            return &lobes->lobe[i];
        }
    }
    return NULL;
}

double pm_scenes_reflected(const pm_lobes *lobes)
{
    const pm_lobe *lobe = pm_scenes_lobe(lobes, PM_LOBE_REFLECT);
    return lobe == NULL ? 0.0 : lobe->albedo.c[0];
}
