// The oracle: a loop over all primitives of all shapes, in double.
//
// Invariant: shapes and primitives are asked in ascending order and only a smaller t replaces a
// hit, so of hits at the same t the lowest shape and primitive is reported.
#include "intersect_plain.h"

#include "shape.h"
#include "shape_hit.h"

#include <stdlib.h>

typedef struct {
    const pm_scene *scene;
} world;

/// The nearest hit up to `limit`, of surfaces other than null ones if `past_null`.
static bool answer(const pm_scene *scene, const pm_ray *ray, double limit, bool past_null,
                   pm_hit *hit)
{
    pm_hit best = {.shape = PM_NONE};
    for (int i = 0; i < scene->shape_count; i++) {
        const pm_shape *shape = &scene->shapes[i];
        uint32_t count =
            past_null && pm_shape_is_null(scene, shape) ? 0 : pm_shape_primitives(shape);
        for (uint32_t j = 0; j < count; j++) {
            double t;
            if (pm_shape_hit(shape, j, ray, limit, &t) &&
                (best.shape == PM_NONE || t < best.t)) {
                best = (pm_hit){.t = t, .shape = i, .primitive = j};
                limit = t;
            }
        }
    }
    if (best.shape == PM_NONE) {
        return false;
    }
    *hit = best;
    pm_shape_complete(&scene->shapes[best.shape], ray, hit);
    return true;
}

static bool closest(const void *state, const pm_ray *ray, pm_hit *hit)
{
    const pm_scene *scene = ((const world *)state)->scene;
    if (!answer(scene, ray, ray->t_max, false, hit)) {
        return false;
    }
    if (pm_shape_is_null(scene, &scene->shapes[hit->shape])) {
        double end = hit->t + pm_hit_passed(hit, ray->direction);
        (void)answer(scene, ray, pm_least(end, ray->t_max), true, hit);
    }
    return true;
}

static bool shape_blocks(const pm_shape *shape, const pm_ray *ray)
{
    uint32_t count = pm_shape_primitives(shape);
    for (uint32_t j = 0; j < count; j++) {
        double t;
        if (pm_shape_hit(shape, j, ray, ray->t_max, &t)) {
            return true;
        }
    }
    return false;
}

static bool blocked(const void *state, const pm_ray *ray)
{
    const pm_scene *scene = ((const world *)state)->scene;
    for (int i = 0; i < scene->shape_count; i++) {
        const pm_shape *shape = &scene->shapes[i];
        if (!pm_shape_is_null(scene, shape) && shape_blocks(shape, ray)) {
            return true;
        }
    }
    return false;
}

pm_status pm_intersect_plain(const pm_scene *scene, pm_intersector *out)
{
    world *state = malloc(sizeof *state);
    if (!state) {
        return PM_FAIL(PM_ENOMEM, "no memory for ray queries (%zu bytes)", sizeof *state);
    }
    state->scene = scene;
    *out = (pm_intersector){scene, state, closest, blocked, free};
    return PM_OK;
}
