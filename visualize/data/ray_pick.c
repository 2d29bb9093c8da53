// Light from outside starts two scene radii away; it is shown from where it crosses a box a
// little larger than the scene, so that floors and walls at the bounds do not hide it.
#include "ray_pick.h"

#include <stdlib.h>

#define BEYOND 0.02 // scene radii between the scene's bounds and that box

static bool comes_from_outside(const pm_scene *scene, uint32_t light)
{
    pm_light_type type = scene->lights[light].type;
    return type == PM_LIGHT_DIRECTIONAL || type == PM_LIGHT_CONSTANT;
}

/// The stretch of a ray between two planes across an axis; false when it is empty.
static bool cut_slab(double from, double step, double low, double high, double *enter,
                     double *leave)
{
    if (step == 0.0) {
        return from >= low && from <= high;
    }
    double a = (low - from) / step;
    double b = (high - from) / step;
    *enter = pm_most(*enter, pm_least(a, b));
    *leave = pm_least(*leave, pm_most(a, b));
    return *enter <= *leave;
}

/// Where the ray comes into the scene; false when it passes by.
static bool enter_scene(const pm_scene *scene, const pm_ray_start *ray, pm_vec3 *start)
{
    double enter = 0.0;
    double leave = HUGE_VAL;
    double more = BEYOND * scene->radius;
    for (int axis = 0; axis < 3; axis++) {
        if (!cut_slab(pm_vec_axis(ray->origin, axis), pm_vec_axis(ray->direction, axis),
                      pm_vec_axis(scene->low, axis) - more,
                      pm_vec_axis(scene->high, axis) + more, &enter, &leave)) {
            return false;
        }
    }
    *start = pm_vec_along(ray->origin, ray->direction, enter);
    return true;
}

static bool is_seen(const pm_scene *scene, const pm_ray_start *ray, pm_vec3 *start)
{
    *start = ray->origin;
    return !comes_from_outside(scene, ray->light) || enter_scene(scene, ray, start);
}

/// Adds up what each light sends; returns how many rays of `light` can be seen.
static uint64_t sum_up(const pm_ray_set *rays, const pm_scene *scene, int light,
                       pm_ray_sum *sums)
{
    uint64_t seen = 0;
    for (uint64_t i = 0; i < rays->count; i++) {
        const pm_ray_start *ray = &rays->rays[i];
        pm_ray_sum *sum = &sums[ray->light];
        pm_vec3 start;
        bool past = !is_seen(scene, ray, &start);
        sum->count++;
        sum->past += past;
        sum->power = pm_spectrum_add(sum->power, ray->power);
        seen += !past && (light == PM_NONE || ray->light == (uint32_t)light);
    }
    return seen;
}

/// Whether the `index`-th of many is among about `most` of `all`, evenly; the first one is.
static bool is_among(uint64_t index, uint64_t most, uint64_t all)
{
    double rate = all > most ? (double)most / (double)all : 1.0;
    return index == 0 || floor((double)index * rate) > floor((double)(index - 1) * rate);
}

static void choose(const pm_ray_set *rays, const pm_scene *scene, int light, uint64_t dots,
                   uint64_t arrows, uint64_t seen, uint64_t *met, pm_ray_choice *out)
{
    for (uint64_t i = 0; i < rays->count; i++) {
        const pm_ray_start *ray = &rays->rays[i];
        pm_vec3 start;
        if ((light != PM_NONE && ray->light != (uint32_t)light) ||
            !is_seen(scene, ray, &start)) {
            continue;
        }
        uint64_t index = met[ray->light]++;
        bool arrow = is_among(index, arrows, seen);
        if (arrow || is_among(index, dots, seen)) {
            out->shown[out->count++] = (pm_ray_shown){ray, start, arrow};
            out->arrows += arrow;
        }
    }
}

pm_status pm_ray_pick(const pm_ray_set *rays, const pm_scene *scene, int light, uint64_t dots,
                      uint64_t arrows, pm_ray_choice *choice)
{
    size_t lights = (size_t)scene->light_count;
    pm_ray_choice made = {.light = calloc(lights + 1, sizeof *made.light)};
    uint64_t *met = calloc(lights + 1, sizeof *met);
    uint64_t seen = made.light != NULL ? sum_up(rays, scene, light, made.light) : 0;
    made.shown = calloc((size_t)seen + 1, sizeof *made.shown);
    if (made.light == NULL || met == NULL || made.shown == NULL) {
        free(met);
        pm_ray_pick_free(&made);
        return PM_FAIL(PM_ENOMEM, "no memory for %llu rays", (unsigned long long)rays->count);
    }
    choose(rays, scene, light, dots, arrows, seen, met, &made);
    free(met);
    *choice = made;
    return PM_OK;
}

void pm_ray_pick_free(pm_ray_choice *choice)
{
    free(choice->shown);
    free(choice->light);
    *choice = (pm_ray_choice){0};
}
