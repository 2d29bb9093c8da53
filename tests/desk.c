// Made-up sources that count how often they are asked.
#include "desk.h"

#include "test.h"

static pm_status say_emitted(void *context, const pm_vertex *at, pm_spectrum *radiance)
{
    pm_desk *desk = context;
    bool lamp = desk->s.shapes[at->hit.shape].light != PM_NONE;
    desk->lamp = *at;
    *radiance = pm_gray(lamp ? PM_DESK_EMITTED : 0.0);
    return PM_OK;
}

static pm_status say_sky(void *context, const pm_ray *ray, pm_spectrum *radiance)
{
    const pm_desk *desk = context;
    (void)ray;
    *radiance = pm_gray(desk->sky);
    return PM_OK;
}

static pm_status say(pm_desk *desk, int *calls, double answer, const pm_vertex *at,
                     pm_spectrum *radiance)
{
    *calls += 1;
    desk->last = *at;
    *radiance = pm_gray(answer);
    return PM_OK;
}

static pm_status say_direct(void *context, const pm_vertex *at, pm_spectrum *radiance)
{
    pm_desk *desk = context;
    return say(desk, &desk->direct, PM_DESK_DIRECT, at, radiance);
}

static pm_status say_caustic(void *context, const pm_vertex *at, pm_spectrum *radiance)
{
    pm_desk *desk = context;
    return say(desk, &desk->caustic, PM_DESK_CAUSTIC, at, radiance);
}

static pm_status say_indirect(void *context, const pm_vertex *at, pm_spectrum *radiance)
{
    pm_desk *desk = context;
    return say(desk, &desk->indirect, PM_DESK_INDIRECT, at, radiance);
}

static pm_status say_glint(void *context, const pm_vertex *at, pm_spectrum *radiance)
{
    pm_desk *desk = context;
    return say(desk, &desk->glint, PM_DESK_GLINT, at, radiance);
}

static pm_status say_global(void *context, const pm_vertex *at, pm_rng *rng,
                            pm_spectrum *radiance)
{
    pm_desk *desk = context;
    (void)rng;
    return say(desk, &desk->global, PM_DESK_GLOBAL, at, radiance);
}

void pm_desk_ready(pm_desk *desk)
{
    pm_scenes_ready(&desk->s);
    desk->compose = (pm_compose){
        .world = &desk->s.world,
        .source = {.seed = 5, .stream = PM_STREAM_CAMERA},
        .max_specular = 1000,
        .splits = 2,
        .ask = {.context = desk,
                .emitted = say_emitted,
                .sky = say_sky,
                .glint = say_glint,
                .direct = say_direct,
                .caustic = say_caustic,
                .indirect = say_indirect,
                .global = say_global},
    };
    for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
        desk->compose.wanted[layer] = true;
    }
}

static pm_ray ray_to(pm_vec3 from, pm_vec3 to)
{
    pm_vec3 way = pm_vec_normalize(pm_vec_sub(to, from));
    return (pm_ray){from, way, HUGE_VAL, 0.0, PM_NONE};
}

pm_eye pm_desk_look(const pm_desk *desk, pm_vec3 from, pm_vec3 to, uint64_t index)
{
    pm_ray ray = ray_to(from, to);
    pm_eye eye = {0};
    CHECK_OK(pm_compose_eye(&desk->compose, &ray, 3, 2, index, &eye));
    return eye;
}

double pm_desk_gather(pm_desk *desk, pm_vec3 from, pm_vec3 to, uint64_t index)
{
    pm_ray ray = ray_to(from, to);
    pm_vertex at = {.pixel = 3, .sample = 2, .vertex = 1};
    pm_rng rng = pm_rng_at(&desk->compose.source, index, 9);
    pm_spectrum radiance;
    CHECK_OK(pm_compose_gather(&desk->compose, &ray, &at, &rng, &radiance, &desk->cut));
    return radiance.c[0];
}
