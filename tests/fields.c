// Contract in the header.
#include "fields.h"

#include "photon_map.h"
#include "store.h"
#include "test.h"

#include <math.h>

const pm_estimate_point pm_fields_floor = {{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};

pm_rng pm_fields_rng(uint64_t trial)
{
    pm_rng_source source = {.seed = 31, .stream = PM_STREAM_TEST};
    return pm_rng_at(&source, trial, 0);
}

double pm_fields_exponential(pm_rng *rng)
{
    return -log(1.0 - pm_rng_draw(rng));
}

void pm_fields_push(pm_photon_map *map, pm_vec3 at, pm_vec3 normal, double power)
{
    pm_deposit deposit = {.position = at,
                          .direction = pm_vec(0.0, 0.0, -1.0),
                          .normal = normal,
                          .power = pm_gray(power),
                          .in_medium = pm_vec_length(normal) == 0.0};
    CHECK_OK(pm_store_push(map, &deposit));
}

void pm_fields_empty(pm_photon_map *map)
{
    map->count = 0;
    map->balanced = map->scaled = false;
}

void pm_fields_finish(pm_photon_map *map)
{
    CHECK_OK(pm_store_scale(map, 1));
    CHECK_OK(pm_balance_build(map));
}

void pm_fields_lay_out(pm_photon_map *map, pm_rng *rng, uint32_t count, double limit,
                       bool uneven)
{
    pm_fields_empty(map);
    double area = 0.0;
    while (map->count < count) {
        area += pm_fields_exponential(rng);
        if (area > limit) {
            break;
        }
        double angle = 2.0 * PM_PI * pm_rng_draw(rng);
        double r = sqrt(area / PM_PI);
        double power = uneven ? (pm_rng_draw(rng) < 0.5 ? 0.5 : 1.5) : 1.0;
        pm_fields_push(map, pm_vec(r * cos(angle), r * sin(angle), 0.0), pm_vec(0.0, 0.0, 1.0),
                       power);
    }
    pm_fields_finish(map);
}

pm_estimate pm_fields_ask(const pm_photon_map *map, const pm_estimate_settings *settings,
                          const pm_estimate_point *point)
{
    pm_neighbour scratch[PM_FIELDS_K_MAX];
    pm_estimate estimate;
    CHECK(settings->k <= PM_FIELDS_K_MAX);
    CHECK_OK(pm_estimate_irradiance(map, settings, point, scratch, &estimate));
    return estimate;
}

pm_moments pm_fields_moments(double sum, double sum2, int trials)
{
    double mean = sum / trials;
    return (pm_moments){mean, sqrt((sum2 / trials - mean * mean) * trials / (trials - 1.0))};
}
