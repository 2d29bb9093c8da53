// Positions are pure functions of kind and index, so that any test can be repeated alone.
#include "clouds.h"

#include "photon_map.h"
#include "rng.h"
#include "store.h"
#include "test.h"

#include <math.h>

const char *pm_cloud_name(pm_cloud_kind kind)
{
    static const char *const names[PM_CLOUD_COUNT] = {
        "random",    "sorted",   "reversed", "organ pipe", "coincident",
        "collinear", "coplanar", "walls",    "lattice",    "sites"};
    return names[kind];
}

static pm_vec3 random_point(uint64_t i, uint32_t pass)
{
    pm_rng_source source = {.seed = 11, .stream = PM_STREAM_TEST, .pass = pass};
    pm_rng rng = pm_rng_at(&source, i, 0);
    pm_vec3 point;
    point.x = pm_rng_draw(&rng);
    point.y = pm_rng_draw(&rng);
    point.z = pm_rng_draw(&rng);
    return point;
}

pm_vec3 pm_cloud_query(uint64_t i)
{
    return random_point(i, 77);
}

static pm_vec3 on_walls(pm_vec3 p, uint32_t i)
{
    double side = i & 1 ? 1.0 : 0.0;
    switch (i / 2 % 3) {
    case 0:
        return pm_vec(side, p.y, p.z);
    case 1:
        return pm_vec(p.x, side, p.z);
    default:
        return pm_vec(p.x, p.y, side);
    }
}

static pm_vec3 place(pm_cloud_kind kind, uint32_t i, uint32_t count)
{
    pm_vec3 p = random_point(i, (uint32_t)kind);
    double rank = (i + 0.5) / count;
    switch (kind) {
    case PM_CLOUD_SORTED:
        return pm_vec(rank, p.y * 0.5, p.z * 0.5);
    case PM_CLOUD_REVERSED:
        return pm_vec(1.0 - rank, p.y * 0.5, p.z * 0.5);
    case PM_CLOUD_ORGAN_PIPE:
        return pm_vec(1.0 - fabs(2.0 * rank - 1.0), 0.25, 0.5);
    case PM_CLOUD_COINCIDENT:
        return pm_vec(0.25, 0.5, 0.75);
    case PM_CLOUD_COLLINEAR:
        return pm_vec(p.x, p.x, p.x);
    case PM_CLOUD_COPLANAR:
        return pm_vec(p.x, 0.5, p.z);
    case PM_CLOUD_WALLS:
        return on_walls(p, i);
    case PM_CLOUD_LATTICE:
        return pm_vec(floor(4.0 * p.x) / 4.0, floor(4.0 * p.y) / 4.0, floor(4.0 * p.z) / 4.0);
    case PM_CLOUD_SITES:
        return random_point((uint64_t)(7.0 * p.x), 99);
    default:
        return p;
    }
}

pm_photon_map pm_cloud_make(pm_cloud_kind kind, uint32_t count, double scale, bool unpacked)
{
    pm_photon_map map = {.kind = PM_MAP_GLOBAL, .unpacked = unpacked};
    for (uint32_t i = 0; i < count; i++) {
        pm_deposit deposit = {.position = pm_vec_scale(place(kind, i, count), scale),
                              .direction = pm_vec(0.0, 0.0, -1.0),
                              .normal = pm_vec(0.0, 0.0, 1.0),
                              .power = pm_rgb(i + 1.0, 0.0, 0.0)};
        CHECK_OK(pm_store_push(&map, &deposit));
    }
    return map;
}
