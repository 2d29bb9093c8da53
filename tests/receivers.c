// Contracts are in the header. Place 0 of a run shifts the lattice, place 1 is for the lobes.
#include "receivers.h"

#include "test.h"

const pm_rng_source pm_receivers_source = {.seed = 31, .stream = PM_STREAM_TEST};

void pm_receivers_meet(const pm_scenes *s, pm_vec3 wi, pm_hit *hit, pm_lobes *lobes)
{
    pm_ray ray = {pm_vec_scale(wi, 0.01), pm_vec_negate(wi), HUGE_VAL, 0.0, PM_NONE};
    CHECK(pm_closest(&s->world, &ray, hit) && hit->shape == 0);
    pm_ray along = {.direction = pm_vec_negate(wi), .medium = PM_NONE};
    pm_material_lobes(&s->scene, hit, &along, lobes);
}

double pm_receivers_direct(const pm_scenes *s, const pm_hit *hit, const pm_lobes *lobes,
                           uint32_t samples, uint64_t run)
{
    pm_direct_query query = {.world = &s->world, .samples = samples, .step = 1};
    query.rng = pm_rng_at(&pm_receivers_source, run, 1);
    pm_rng rng = pm_rng_at(&pm_receivers_source, run, 0);
    query.shift[0] = pm_rng_draw(&rng);
    query.shift[1] = pm_rng_draw(&rng);
    return pm_direct(&query, hit, lobes).c[0];
}
