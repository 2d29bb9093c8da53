// One estimate a question; those in the global map are counted for the picture's channels.
#include "lookup.h"

#include "fill.h"
#include "irradiance.h"

#include <stddef.h>

pm_estimate_settings pm_lookup_settings(const pm_estimate_settings *settings, double reach,
                                        const pm_photon_map *map)
{
    pm_estimate_settings asked = *settings;
    if (reach > 0.0) {
        asked.radius = reach;
        asked.k = map->count + 1;
    }
    return asked;
}

pm_estimate_settings pm_lookup_asked(const pm_gather *gather, pm_map_kind kind)
{
    return pm_lookup_settings(&gather->settings.estimate, gather->reach[kind],
                              gather->map[kind]);
}

static pm_status look_up(pm_gather *gather, pm_map_kind kind,
                         const pm_estimate_settings *settings, const pm_vertex *at,
                         pm_estimate *found)
{
    pm_estimate_point point = {at->hit.position, at->lobes.normal};
    return pm_estimate_radiance(gather->map[kind], settings, &point, &at->lobes,
                                gather->scratch, found);
}

static void count(pm_gather *gather, const pm_estimate *found)
{
    gather->radius_sum += found->radius;
    gather->found_sum += found->found;
    gather->lookups++;
}

/// By an irradiance that was estimated before; `covered` says whether one is near enough.
static pm_status look_up_place(const pm_gather *gather, const pm_vertex *at, bool *covered,
                               pm_estimate *found, double *unevenness)
{
    *covered = false;
    if (gather->irradiance == NULL || !pm_material_is_lambertian(&at->lobes)) {
        return PM_OK;
    }
    pm_estimate_point point = {at->hit.position, at->lobes.normal};
    PM_TRY(pm_irradiance_find(gather->irradiance, &gather->settings.estimate,
                              gather->irradiance_reach, &point, covered, found, unevenness));
    if (*covered) {
        pm_spectrum f = pm_material_evaluate(&at->lobes, at->lobes.normal);
        found->value = pm_spectrum_mul(found->value, f);
    }
    return PM_OK;
}

pm_status pm_lookup_global(pm_gather *gather, const pm_vertex *at, pm_lookup *end)
{
    bool covered;
    double unevenness;
    pm_estimate *found = &end->estimate;
    PM_TRY(look_up_place(gather, at, &covered, found, &unevenness));
    if (!covered) {
        const pm_photon_map *global = gather->map[PM_MAP_GLOBAL];
        pm_estimate_point point = {at->hit.position, at->lobes.normal};
        pm_estimate_settings settings = pm_lookup_asked(gather, PM_MAP_GLOBAL);
        PM_TRY(look_up(gather, PM_MAP_GLOBAL, &settings, at, found));
        unevenness = pm_fill_unevenness(global, gather->scratch, found, &point);
    }
    end->uneven = pm_fill_is_uneven(unevenness, found->found);
    count(gather, found);
    return PM_OK;
}

pm_status pm_lookup_indirect(pm_gather *gather, const pm_vertex *at, pm_spectrum *radiance)
{
    pm_estimate found;
    pm_estimate_settings settings = pm_lookup_asked(gather, PM_MAP_GLOBAL);
    settings.skip = PM_PHOTON_FIRST | PM_PHOTON_CAUSTIC;
    PM_TRY(look_up(gather, PM_MAP_GLOBAL, &settings, at, &found));
    count(gather, &found);
    *radiance = found.value;
    return PM_OK;
}

pm_status pm_lookup_caustic(pm_gather *gather, const pm_vertex *at, pm_spectrum *radiance)
{
    pm_estimate found;
    pm_estimate_settings settings = pm_lookup_asked(gather, PM_MAP_CAUSTIC);
    PM_TRY(look_up(gather, PM_MAP_CAUSTIC, &settings, at, &found));
    *radiance = found.value;
    return PM_OK;
}

pm_status pm_lookup_marked(pm_gather *gather, const pm_vertex *at, double reach,
                           pm_spectrum *radiance)
{
    pm_estimate found;
    pm_estimate_settings settings = pm_lookup_asked(gather, PM_MAP_GLOBAL);
    settings.only = PM_PHOTON_CAUSTIC;
    settings.radius = pm_least(settings.radius, reach);
    PM_TRY(look_up(gather, PM_MAP_GLOBAL, &settings, at, &found));
    *radiance = found.value;
    return PM_OK;
}

bool pm_lookup_has_marked(const pm_gather *gather)
{
    const pm_photon_map *global = gather->map[PM_MAP_GLOBAL];
    for (uint32_t i = 0; global != NULL && i < global->count; i++) {
        if ((global->photons[i].flags & PM_PHOTON_CAUSTIC) != 0) {
            return true;
        }
    }
    return false;
}
