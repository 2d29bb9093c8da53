// A point's place in the file is its own coordinates plus an origin; both are small or both
// near, so `own + (origin - center)` loses nothing that `own + origin` would not have lost
// before.
#include "scene_center.h"

#include "light.h"

#include <math.h>

typedef struct {
    pm_vec3 low, high;
} bounds;

static bounds nowhere(void)
{
    return (bounds){pm_vec(HUGE_VAL, HUGE_VAL, HUGE_VAL),
                    pm_vec(-HUGE_VAL, -HUGE_VAL, -HUGE_VAL)};
}

static void cover(bounds *b, pm_vec3 point)
{
    b->low = pm_vec_min(b->low, point);
    b->high = pm_vec_max(b->high, point);
}

/// A disc about `center` across the unit `axis`, or a sphere when `axis` is zero.
static void cover_round(bounds *b, pm_vec3 center, pm_vec3 axis, double radius)
{
    pm_vec3 half = {radius * sqrt(fmax(0.0, 1.0 - axis.x * axis.x)),
                    radius * sqrt(fmax(0.0, 1.0 - axis.y * axis.y)),
                    radius * sqrt(fmax(0.0, 1.0 - axis.z * axis.z))};
    cover(b, pm_vec_add(center, half));
    cover(b, pm_vec_sub(center, half));
}

static bounds bounds_of(const pm_shape *shape)
{
    bounds b = nowhere();
    switch (shape->type) {
    case PM_SHAPE_RECTANGLE:
        for (int i = 0; i < 4; i++) {
            pm_vec3 across = pm_vec_along(shape->corner, shape->edge[0], (double)(i & 1));
            cover(&b, pm_vec_along(across, shape->edge[1], (double)(i >> 1)));
        }
        break;
    case PM_SHAPE_SPHERE:
        cover_round(&b, shape->center, pm_vec(0.0, 0.0, 0.0), shape->radius);
        break;
    case PM_SHAPE_DISK:
        cover_round(&b, shape->center, shape->axis, shape->radius);
        break;
    case PM_SHAPE_CYLINDER:
        cover_round(&b, shape->center, shape->axis, shape->radius);
        cover_round(&b, pm_vec_along(shape->center, shape->axis, shape->length), shape->axis,
                    shape->radius);
        break;
    case PM_SHAPE_MESH:
        for (uint32_t i = 0; i < shape->vertex_count; i++) {
            cover(&b, shape->vertices[i]);
        }
        break;
    }
    return b;
}

static void move(pm_shape *shape, pm_vec3 by)
{
    if (shape->type == PM_SHAPE_RECTANGLE) {
        shape->corner = pm_vec_add(shape->corner, by);
    } else if (shape->type != PM_SHAPE_MESH) {
        shape->center = pm_vec_add(shape->center, by);
    }
    for (uint32_t i = 0; i < shape->vertex_count; i++) {
        shape->vertices[i] = pm_vec_add(shape->vertices[i], by);
    }
    bounds b = bounds_of(shape);
    shape->reach = fmax(pm_vec_reach(b.low), pm_vec_reach(b.high));
}

/// Points and spots, which stand somewhere without being a shape.
static bool has_place(const pm_light *light)
{
    return light->type == PM_LIGHT_POINT || light->type == PM_LIGHT_SPOT;
}

static void cover_point_lights(const pm_scene *scene, const pm_vec3 *origin, bounds *all)
{
    for (int i = 0; i < scene->light_count; i++) {
        if (has_place(&scene->lights[i])) {
            pm_vec3 by = origin != NULL ? origin[i] : pm_vec(0.0, 0.0, 0.0);
            cover(all, pm_vec_add(scene->lights[i].position, by));
        }
    }
}

/// The middle of all shapes, in the file's coordinates. Point lights do not move it: photons
/// are floats and offsets grow with coordinates, so a sun far away would make the scene coarse.
static pm_vec3 middle_of(const pm_scene_file *source)
{
    const pm_scene *scene = &source->scene;
    bounds all = nowhere();
    for (int i = 0; i < scene->shape_count; i++) {
        bounds b = bounds_of(&scene->shapes[i]);
        cover(&all, pm_vec_add(b.low, source->shape_origin[i]));
        cover(&all, pm_vec_add(b.high, source->shape_origin[i]));
    }
    if (scene->shape_count == 0) {
        cover_point_lights(scene, source->light_origin, &all);
    }
    return all.low.x <= all.high.x ? pm_vec_scale(pm_vec_add(all.low, all.high), 0.5)
                                   : pm_vec(0.0, 0.0, 0.0);
}

/// Bounds in centred coordinates, and the radius about the origin.
static void measure(pm_scene *scene)
{
    bounds all = nowhere();
    for (int i = 0; i < scene->shape_count; i++) {
        bounds b = bounds_of(&scene->shapes[i]);
        cover(&all, b.low);
        cover(&all, b.high);
    }
    cover_point_lights(scene, NULL, &all);
    all = all.low.x <= all.high.x ? all : (bounds){0};
    scene->low = all.low;
    scene->high = all.high;
    pm_vec3 farthest = pm_vec_max(all.high, pm_vec_negate(all.low));
    scene->radius = pm_vec_length(farthest) > 0.0 ? pm_vec_length(farthest) : 1.0;
}

static pm_spectrum flux_of(const pm_scene *scene, const pm_light *light)
{
    double disc = PM_PI * scene->radius * scene->radius;
    switch (light->type) {
    case PM_LIGHT_POINT:
        return pm_spectrum_scale(light->emitted, 4.0 * PM_PI);
    case PM_LIGHT_SPOT:
        return pm_spectrum_scale(light->emitted, pm_light_cone(light));
    case PM_LIGHT_AREA:
        return pm_spectrum_scale(light->emitted, PM_PI * scene->shapes[light->shape].area);
    case PM_LIGHT_DIRECTIONAL:
        return pm_spectrum_scale(light->emitted, disc);
    case PM_LIGHT_CONSTANT: // pi L through each of the 4 pi R^2 of the sphere
        return pm_spectrum_scale(light->emitted, 4.0 * PM_PI * disc);
    }
    return pm_gray(0.0);
}

/// The middle of an area light and how far it reaches from there.
static void find_extent(const pm_scene *scene, pm_light *light)
{
    if (light->type == PM_LIGHT_AREA) {
        bounds b = bounds_of(&scene->shapes[light->shape]);
        light->position = pm_vec_scale(pm_vec_add(b.low, b.high), 0.5);
        light->extent = 0.5 * pm_vec_length(pm_vec_sub(b.high, b.low));
    }
}

static void find_flux(pm_scene_file *source)
{
    pm_scene *scene = &source->scene;
    for (int i = 0; i < scene->light_count; i++) {
        pm_light *light = &scene->lights[i];
        light->flux = flux_of(scene, light);
        // The books of power hold squares.
        if (!pm_spectrum_is_finite(pm_spectrum_mul(light->flux, light->flux))) {
            pm_faults_add(&source->faults, scene->path, 0,
                          "the power of light \"%.60s\" squared is too large for a double",
                          light->id);
        }
    }
}

void pm_scene_center(pm_scene_file *source)
{
    pm_scene *scene = &source->scene;
    scene->center = middle_of(source);
    for (int i = 0; i < scene->shape_count; i++) {
        move(&scene->shapes[i], pm_vec_sub(source->shape_origin[i], scene->center));
    }
    for (int i = 0; i < scene->light_count; i++) {
        pm_light *light = &scene->lights[i];
        if (has_place(light)) {
            pm_vec3 by = pm_vec_sub(source->light_origin[i], scene->center);
            light->position = pm_vec_add(light->position, by);
        }
        find_extent(scene, light);
    }
    scene->camera.position = pm_vec_sub(source->camera_origin, scene->center);
    measure(scene);
    if (!isfinite(scene->radius * scene->radius)) {
        pm_faults_add(&source->faults, scene->path, 0, "the scene is too large for a double");
        return;
    }
    find_flux(source);
}
