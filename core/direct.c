// L = sum over lights of f * (what arrives without the surface) * cos / pdf, where nothing is
// between.
#include "direct.h"

#include "lattice.h"
#include "shape.h"

/// What every light is asked about.
typedef struct {
    const pm_intersector *world;
    const pm_hit *hit;
    const pm_lobes *lobes;
} pm_receiver;

/// f * cos towards `direction`, 0 where the surface does not look.
static pm_spectrum response(const pm_receiver *at, pm_vec3 direction)
{
    double cosine = pm_vec_dot(direction, at->lobes->normal);
    return pm_spectrum_scale(pm_material_evaluate(at->lobes, direction), pm_most(0.0, cosine));
}

/// Whether something stands between the receiver and the point `target` off the light.
static bool shadowed(const pm_receiver *at, pm_vec3 towards, pm_vec3 target)
{
    pm_vec3 origin = pm_hit_leave(at->hit, towards);
    pm_vec3 way = pm_vec_sub(target, origin);
    double length = pm_vec_length(way);
    if (length == 0.0) {
        return false;
    }
    pm_ray ray = {origin, pm_vec_scale(way, 1.0 / length), length, 0.0, at->lobes->medium_here};
    return pm_blocked(at->world, &ray);
}

static pm_spectrum from_point(const pm_receiver *at, const pm_light *light)
{
    pm_vec3 way = pm_vec_sub(light->position, at->hit->position);
    double distance2 = pm_vec_dot(way, way);
    if (distance2 == 0.0) {
        return pm_gray(0.0);
    }
    pm_vec3 direction = pm_vec_scale(way, 1.0 / sqrt(distance2));
    pm_spectrum f = response(at, direction);
    if (pm_spectrum_is_black(f) || shadowed(at, direction, light->position)) {
        return pm_gray(0.0);
    }
    return pm_spectrum_mul(f, pm_spectrum_scale(light->emitted, 1.0 / distance2));
}

static pm_spectrum from_afar(const pm_receiver *at, const pm_light *light)
{
    pm_vec3 direction = pm_vec_negate(light->direction);
    pm_spectrum f = response(at, direction);
    pm_ray ray = pm_hit_ray(at->hit, direction, 0.0, at->lobes->medium_here);
    if (pm_spectrum_is_black(f) || pm_blocked(at->world, &ray)) {
        return pm_gray(0.0);
    }
    return pm_spectrum_mul(f, light->emitted);
}

/// One point of an area light, as if the whole light were there.
static pm_spectrum from_area(const pm_receiver *at, const pm_light *light, const double u[2])
{
    const pm_shape *shape = &at->world->scene->shapes[light->shape];
    pm_hit source = {.shape = light->shape};
    pm_shape_point(shape, u[0], u[1], &source);
    pm_vec3 way = pm_vec_sub(source.position, at->hit->position);
    double distance2 = pm_vec_dot(way, way);
    if (distance2 == 0.0) {
        return pm_gray(0.0);
    }
    pm_vec3 direction = pm_vec_scale(way, 1.0 / sqrt(distance2));
    double leaving = -pm_vec_dot(direction, source.normal);
    pm_spectrum f = response(at, direction);
    if (leaving <= 0.0 || pm_spectrum_is_black(f)) {
        return pm_gray(0.0);
    }
    if (shadowed(at, direction, pm_hit_leave(&source, pm_vec_negate(direction)))) {
        return pm_gray(0.0);
    }
    double geometry = leaving * shape->area / distance2;
    return pm_spectrum_mul(f, pm_spectrum_scale(light->emitted, geometry));
}

pm_spectrum pm_direct(const pm_intersector *world, const pm_hit *hit, const pm_lobes *lobes,
                      uint32_t samples, uint32_t first, uint32_t step, const double shift[2])
{
    pm_receiver at = {world, hit, lobes};
    pm_spectrum sum = pm_gray(0.0);
    for (int i = 0; i < world->scene->light_count; i++) {
        const pm_light *light = &world->scene->lights[i];
        if (light->type == PM_LIGHT_POINT) {
            sum = pm_spectrum_add(sum, from_point(&at, light));
        } else if (light->type == PM_LIGHT_DIRECTIONAL) {
            sum = pm_spectrum_add(sum, from_afar(&at, light));
        }
        for (uint32_t s = 0; s < samples && light->type == PM_LIGHT_AREA; s++) {
            double u[2];
            pm_lattice_point(shift, first + s * step, samples * step, u);
            pm_spectrum one = from_area(&at, light, u);
            sum = pm_spectrum_add(sum, pm_spectrum_scale(one, 1.0 / samples));
        }
    }
    return sum;
}
