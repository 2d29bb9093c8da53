// Every light's photons carry the light's flux over its share of the pass, so the power handed
// out is exact for any number of photons; the lights are interleaved so that a pass may stop
// anywhere.
#include "emit.h"

#include "shape.h"
#include "spot.h"

#include <stddef.h>
#include <string.h>

static const pm_projection *projection_of(const pm_projection *projections, int light)
{
    return projections == NULL ? NULL : &projections[light];
}

/// Share of a light's power that is sent.
static double lit_fraction(const pm_projection *projection)
{
    if (projection == NULL || projection->rows == 0) {
        return 1.0;
    }
    return projection->lit_count / ((double)projection->rows * projection->columns);
}

/// What each light sends [W], the mean of its channels.
typedef struct {
    const pm_scene *scene;
    const pm_projection *projections;
} sending;

static double sent_power(const sending *all, int light)
{
    double lit = lit_fraction(projection_of(all->projections, light));
    return pm_spectrum_mean(all->scene->lights[light].flux) * lit;
}

/// Rounds every share down, but no light that sends below one photon. Returns the photons
/// given.
static uint64_t share_rounded_down(const sending *all, uint64_t count, double total,
                                   uint64_t *share)
{
    uint64_t given = 0;
    for (int i = 0; i < all->scene->light_count; i++) {
        double power = sent_power(all, i);
        share[i] = (uint64_t)((double)count * (power / total));
        if (share[i] == 0 && power > 0.0) {
            share[i] = 1;
        }
        given += share[i];
    }
    return given;
}

/// The light whose photons carry the most power (`most` true) or the least, among those that
/// can gain or lose one.
static int light_out_of_step(const sending *all, const uint64_t *share, bool most)
{
    int found = PM_NONE;
    double extreme = 0.0;
    for (int i = 0; i < all->scene->light_count; i++) {
        if (share[i] == 0 || (!most && share[i] == 1)) {
            continue;
        }
        double each = sent_power(all, i) / (double)share[i];
        if (found == PM_NONE || (most ? each > extreme : each < extreme)) {
            found = i;
            extreme = each;
        }
    }
    return found;
}

pm_status pm_emit_share(const pm_scene *scene, const pm_projection *projections, uint64_t count,
                        uint64_t *share)
{
    const sending all = {scene, projections};
    double total = 0.0;
    uint64_t senders = 0;
    for (int i = 0; i < scene->light_count; i++) {
        total += sent_power(&all, i);
        senders += sent_power(&all, i) > 0.0;
    }
    if (senders == 0) {
        memset(share, 0, (size_t)scene->light_count * sizeof *share);
        return PM_OK;
    }
    if (count < senders || count > PM_EMIT_MAX) {
        return pm_status_fail(
            PM_EINPUT,
            "%s: a pass emits between %llu (one photon a light) and %u photons,"
            " got %llu",
            scene->path, (unsigned long long)senders, PM_EMIT_MAX, (unsigned long long)count);
    }
    uint64_t given = share_rounded_down(&all, count, total, share);
    for (; given < count; given++) {
        share[light_out_of_step(&all, share, true)]++;
    }
    for (; given > count; given--) {
        share[light_out_of_step(&all, share, false)]--;
    }
    return PM_OK;
}

/// A place in cell `cell` of `count` along one side. Rounding must not reach the next cell.
static double within(double cell, double offset, double count)
{
    return pm_least((cell + offset) / count, nextafter((cell + 1.0) / count, 0.0));
}

pm_status pm_emit_cell(const pm_projection *projection, pm_rng *rng, double u[2])
{
    if (projection == NULL || projection->rows == 0) {
        u[0] = pm_rng_draw(rng);
        u[1] = pm_rng_draw(rng);
        return PM_OK;
    }
    if (projection->lit_count == 0) {
        return PM_FAIL(PM_EINPUT, "a light without a lit cell sends nothing");
    }
    double pick = pm_rng_draw(rng) * projection->lit_count;
    uint32_t cell = projection->lit[(uint32_t)pick];
    double across = pm_rng_draw(rng);
    double along = pm_rng_draw(rng);
    u[0] = within(cell / projection->columns, across, projection->rows);
    u[1] = within(cell % projection->columns, along, projection->columns);
    return PM_OK;
}

static pm_vec3 sphere_direction(const double u[2])
{
    double z = 1.0 - 2.0 * u[0];
    double radius = sqrt(pm_most(0.0, 1.0 - z * z));
    double phi = 2.0 * PM_PI * u[1];
    return pm_vec(radius * cos(phi), radius * sin(phi), z);
}

static pm_status emit_point(const pm_light *light, const pm_projection *projection, pm_rng *rng,
                            pm_ray *ray)
{
    double u[2];
    PM_TRY(pm_emit_cell(projection, rng, u));
    ray->origin = light->position;
    ray->direction = sphere_direction(u);
    return PM_OK;
}

static pm_status emit_spot(const pm_light *light, const pm_projection *projection, pm_rng *rng,
                           pm_ray *ray)
{
    double u[2];
    PM_TRY(pm_emit_cell(projection, rng, u));
    double angle = pm_spot_angle(light, u[0]);
    double phi = 2.0 * PM_PI * u[1];
    pm_frame frame = pm_frame_around(light->direction);
    pm_vec3 local = pm_vec(sin(angle) * cos(phi), sin(angle) * sin(phi), cos(angle));
    ray->origin = light->position;
    ray->direction = pm_frame_to_world(&frame, local);
    return PM_OK;
}

static pm_status emit_area(const pm_shape *shape, const pm_projection *projection, pm_rng *rng,
                           pm_ray *ray)
{
    double u[2];
    PM_TRY(pm_emit_cell(projection, rng, u));
    double across = pm_rng_draw(rng);
    double along = pm_rng_draw(rng);
    pm_hit start = {0};
    pm_shape_point(shape, across, along, &start);

    // Cosine about the normal: the unit disc, lifted onto the hemisphere.
    double radius = sqrt(u[0]);
    double phi = 2.0 * PM_PI * u[1];
    pm_frame frame = pm_frame_around(start.normal);
    pm_vec3 local = pm_vec(radius * cos(phi), radius * sin(phi), sqrt(1.0 - u[0]));
    ray->direction = pm_frame_to_world(&frame, local);
    ray->origin = pm_hit_leave(&start, ray->direction);
    return PM_OK;
}

/// A start on the scene's disc across `direction`. Two radii back: whatever touches the
/// bounding sphere is still ahead.
static pm_vec3 start_before(const pm_scene *scene, pm_vec3 direction, const double u[2])
{
    double radius = scene->radius * sqrt(u[0]);
    double phi = 2.0 * PM_PI * u[1];
    pm_frame frame = pm_frame_around(direction);
    return pm_frame_to_world(
        &frame, pm_vec(radius * cos(phi), radius * sin(phi), -2.0 * scene->radius));
}

static pm_status emit_directional(const pm_scene *scene, const pm_light *light,
                                  const pm_projection *projection, pm_rng *rng, pm_ray *ray)
{
    double u[2];
    PM_TRY(pm_emit_cell(projection, rng, u));
    ray->origin = start_before(scene, light->direction, u);
    ray->direction = light->direction;
    return PM_OK;
}

static pm_status emit_constant(const pm_scene *scene, pm_rng *rng, pm_ray *ray)
{
    double way[2];
    double start[2];
    PM_TRY(pm_emit_cell(NULL, rng, way));
    PM_TRY(pm_emit_cell(NULL, rng, start));
    ray->direction = sphere_direction(way);
    ray->origin = start_before(scene, ray->direction, start);
    return PM_OK;
}

static pm_status emit_by_type(const pm_scene *scene, const pm_light *light,
                              const pm_projection *projection, pm_rng *rng, pm_ray *ray)
{
    switch (light->type) {
    case PM_LIGHT_POINT:
        return emit_point(light, projection, rng, ray);
    case PM_LIGHT_AREA:
        return emit_area(&scene->shapes[light->shape], projection, rng, ray);
    case PM_LIGHT_DIRECTIONAL:
        return emit_directional(scene, light, projection, rng, ray);
    case PM_LIGHT_SPOT:
        return emit_spot(light, projection, rng, ray);
    case PM_LIGHT_CONSTANT:
        return emit_constant(scene, rng, ray);
    default:
        break;
    }
    return PM_FAIL(PM_EINPUT, "unknown light type %d", (int)light->type);
}

pm_status pm_emit_ray(const pm_scene *scene, const pm_light *light,
                      const pm_projection *projection, pm_rng *rng, pm_ray *ray)
{
    pm_ray leaving = {.t_max = HUGE_VAL, .medium = light->medium};
    PM_TRY(emit_by_type(scene, light, projection, rng, &leaving));
    *ray = leaving;
    return PM_OK;
}

/// Which light sends photon `photon`. Of n photons with s for a light, the light sends those at
/// which floor(j s / n) takes a step; the others are renumbered and asked the next light.
static uint32_t light_of(const pm_emission *emission, uint64_t photon)
{
    uint64_t left = emission->count;
    uint32_t last = (uint32_t)emission->scene->light_count - 1;
    for (uint32_t i = 0; i < last; i++) {
        uint64_t share = emission->share[i];
        uint64_t before = photon * share / left;
        if ((photon + 1) * share / left > before) {
            return i;
        }
        photon -= before;
        left -= share;
    }
    return last;
}

pm_status pm_emit_photons(const pm_emission *emission, uint64_t first, uint32_t count,
                          pm_start *starts)
{
    for (uint32_t i = 0; i < count; i++) {
        pm_start *start = &starts[i];
        start->photon = first + i;
        start->light = light_of(emission, start->photon);
        const pm_light *light = &emission->scene->lights[start->light];
        const pm_projection *projection =
            projection_of(emission->projections, (int)start->light);
        pm_rng rng = pm_rng_at(&emission->source, start->photon, 0);
        PM_TRY(pm_emit_ray(emission->scene, light, projection, &rng, &start->ray));

        double share = (double)emission->count / (double)emission->share[start->light];
        start->power = pm_spectrum_scale(light->flux, share * lit_fraction(projection));
    }
    return PM_OK;
}
