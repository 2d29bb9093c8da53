// Invariant: a map holds every meeting of its light's straight rays with a surface that has a D
// lobe, on the side that the light comes from. So around any point that the light could reach
// if nothing stood between, photons are as dense as its unshadowed irradiance asks for.
#include "shadow.h"

#include "chunks.h"
#include "emit.h"
#include "photon_map.h"
#include "store.h"

#include <stdlib.h>

/// What all threads share while one light's map is filled.
typedef struct {
    const pm_intersector *world;
    pm_emission emission;
    pm_photon_map *map;
    pm_progress *progress;
} shadow_pass;

/// What one thread works in.
typedef struct {
    pm_start starts[PM_CHUNK];
    pm_photon_map part;
} shadow_worker;

// --- one ray --------------------------------------------------------------------------------

static pm_deposit deposit_at(const pm_start *start, const pm_ray *ray, const pm_hit *hit,
                             const pm_lobes *lobes)
{
    return (pm_deposit){
        .position = hit->position,
        .direction = ray->direction,
        .normal = lobes->normal,
        .power = pm_gray(1.0), // what is asked is where, not how much
        .photon = start->photon,
        .light = start->light,
    };
}

/// Along the photon's straight line to its end: light on the first surface, shadow on all
/// behind it, and marks only where there is a D lobe.
static pm_status send(const pm_intersector *world, const pm_start *start, pm_photon_map *part)
{
    pm_ray ray = start->ray;
    bool lit = true;
    pm_hit hit;
    while (pm_closest(world, &ray, &hit)) {
        pm_lobes lobes;
        pm_material_lobes(world->scene, &hit, &ray, &lobes);
        if (lobes.diffuse) {
            pm_deposit deposit = deposit_at(start, &ray, &hit, &lobes);
            deposit.first = lit;
            PM_TRY(pm_store_push(part, &deposit));
        }
        lit = lit && lobes.passes;
        ray = pm_hit_ray(&hit, ray.direction, 0.0, lobes.medium_beyond);
    }
    return PM_OK;
}

// --- one light ------------------------------------------------------------------------------

static pm_status worker_begin(const void *context, void **worker)
{
    (void)context;
    *worker = calloc(1, sizeof(shadow_worker));
    return *worker != NULL ? PM_OK : PM_FAIL(PM_ENOMEM, "no memory to send shadow photons in");
}

static void worker_end(void *worker)
{
    if (worker != NULL) {
        pm_photon_map_free(&((shadow_worker *)worker)->part);
        free(worker);
    }
}

static pm_status send_chunk(const void *context, void *worker, uint64_t first, uint32_t count)
{
    const shadow_pass *pass = context;
    shadow_worker *w = worker;
    w->part.count = 0;
    w->part.refused = w->part.clamped = w->part.vanished = 0;
    PM_TRY(pm_emit_photons(&pass->emission, first, count, w->starts));
    for (uint32_t i = 0; i < count; i++) {
        PM_TRY(send(pass->world, &w->starts[i], &w->part));
    }
    return PM_OK;
}

static pm_status take_chunk(void *context, const void *worker)
{
    const shadow_pass *pass = context;
    return pm_photon_map_append(pass->map, &((const shadow_worker *)worker)->part);
}

/// Fills and balances the map of the one light that has a share. Its number is the pass, so
/// that lights do not repeat each other's random numbers.
static pm_status make_map(shadow_pass *pass)
{
    pm_chunks chunks = {
        .count = pass->emission.count,
        .progress = pass->progress,
        .context = pass,
        .begin = worker_begin,
        .work = send_chunk,
        .take = take_chunk,
        .end = worker_end,
    };
    PM_TRY(pm_chunks_run(&chunks));
    pm_photon_map_trim(pass->map);
    PM_TRY(pm_store_scale(pass->map, pass->emission.count));
    return pm_balance_build(pass->map);
}

// --- all lights -----------------------------------------------------------------------------

/// Whether the light has a direction or a place from which shadows fall, and any power.
static bool throws_shadow(const pm_light *light)
{
    return light->type != PM_LIGHT_CONSTANT && !pm_spectrum_is_black(light->flux);
}

static uint64_t count_throwing(const pm_scene *scene)
{
    uint64_t count = 0;
    for (int i = 0; i < scene->light_count; i++) {
        count += throws_shadow(&scene->lights[i]);
    }
    return count;
}

/// Part number `place` of `count` cut into `parts` that differ by one at most.
static uint64_t even_part(uint64_t count, uint64_t place, uint64_t parts)
{
    return count * (place + 1) / parts - count * place / parts;
}

/// The map of light number `light`, alone in the pass.
static pm_status make_one(const pm_intersector *world, const pm_shadow_run *run, int light,
                          const uint64_t *share, pm_progress *progress, pm_photon_map *map)
{
    // The lights of a pass are told apart as passes are.
    uint32_t place = run->pass * (uint32_t)world->scene->light_count + (uint32_t)light;
    pm_rng_source source = {run->seed, PM_STREAM_SHADOW, place};
    shadow_pass pass = {
        .world = world,
        .emission = {world->scene, source, share[light], share, NULL},
        .map = map,
        .progress = progress,
    };
    return share[light] == 0 ? PM_OK : make_map(&pass);
}

static pm_status make_maps(const pm_intersector *world, const pm_shadow_run *run,
                           uint64_t *share, pm_shadow_maps *maps)
{
    const pm_scene *scene = world->scene;
    uint64_t parts = count_throwing(scene);
    uint64_t place = 0;
    pm_status status = PM_OK;
    pm_progress progress = pm_progress_begin("shadows", run->count);
    for (int i = 0; i < scene->light_count && status == PM_OK; i++) {
        maps->map[i] = (pm_photon_map){.kind = PM_MAP_GLOBAL, .scale = 1.0};
        if (parts > 0 && throws_shadow(&scene->lights[i])) {
            share[i] = even_part(run->count, place++, parts);
            status = make_one(world, run, i, share, &progress, &maps->map[i]);
            share[i] = 0;
        }
    }
    pm_progress_end(&progress);
    return status;
}

pm_status pm_shadow_make(const pm_intersector *world, const pm_shadow_run *run,
                         pm_shadow_maps *maps)
{
    size_t lights = (size_t)world->scene->light_count;
    pm_shadow_maps made = {calloc(lights + 1, sizeof *made.map), world->scene->light_count};
    uint64_t *share = calloc(lights + 1, sizeof *share);
    pm_status status =
        made.map == NULL || share == NULL
            ? PM_FAIL(PM_ENOMEM, "no memory for the shadow maps of %d lights", made.light_count)
            : make_maps(world, run, share, &made);
    free(share);
    if (status != PM_OK) {
        made.light_count = made.map == NULL ? 0 : made.light_count;
        pm_shadow_free(&made);
        return status;
    }
    *maps = made;
    return PM_OK;
}

void pm_shadow_free(pm_shadow_maps *maps)
{
    for (int i = 0; i < maps->light_count; i++) {
        pm_photon_map_free(&maps->map[i]);
    }
    free(maps->map);
    *maps = (pm_shadow_maps){0};
}

// --- asking ---------------------------------------------------------------------------------

pm_shadow_answer pm_shadow_ask(const pm_shadow_maps *maps, int light,
                               const pm_estimate_point *point, pm_neighbour *scratch)
{
    const pm_photon_map *map = &maps->map[light];
    pm_estimate_settings settings = pm_estimate_defaults();
    pm_estimate_query query = {*point, settings.shape, settings.flatness, 0, 0};
    pm_search search = {
        .at = point->at,
        .k = PM_SHADOW_K,
        .radius2 = HUGE_VAL,
        .accept = pm_estimate_accept,
        .context = &query,
    };
    uint32_t found;
    if (map->count < PM_SHADOW_K ||
        pm_balance_nearest(map, &search, scratch, &found, NULL) != PM_OK ||
        found < PM_SHADOW_K) {
        return PM_SHADOW_UNSURE;
    }
    uint32_t lit = 0;
    for (uint32_t i = 0; i < found; i++) {
        lit += (map->photons[scratch[i].index].flags & PM_PHOTON_FIRST) != 0;
    }
    return lit == found ? PM_SHADOW_LIT : lit == 0 ? PM_SHADOW_DARK : PM_SHADOW_UNSURE;
}
