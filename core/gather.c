// Each source answers for one vertex. Lattice shifts hang on the pixel and the vertex number,
// not on the sample, so that all samples of a pixel together look around evenly.
#include "gather.h"

#include "direct.h"
#include "lattice.h"
#include "light.h"

#include <stddef.h>

// Bounce numbers of the camera stream; eye paths use small ones.
#define PLACE_LATTICE 0x80000000u
#define PLACE_GATHER 0x40000000u

/// What a lattice's shift is for.
enum { FOR_LIGHTS, FOR_GATHER };

static void lattice_shift(const pm_gather *gather, const pm_vertex *at, uint32_t purpose,
                          double shift[2])
{
    uint32_t place = PLACE_LATTICE | at->vertex << 1 | purpose;
    pm_rng rng = pm_rng_at(&gather->compose->source, at->pixel, place);
    shift[0] = pm_rng_draw(&rng);
    shift[1] = pm_rng_draw(&rng);
}

static uint32_t per_sample(uint32_t per_pixel, uint32_t spp)
{
    return (per_pixel + spp - 1) / spp;
}

static pm_status ask_emitted(void *context, const pm_vertex *at, pm_spectrum *radiance)
{
    const pm_gather *gather = context;
    *radiance = pm_light_emitted(gather->compose->world->scene, &at->hit, at->lobes.wi);
    return PM_OK;
}

static pm_status ask_direct(void *context, const pm_vertex *at, pm_spectrum *radiance)
{
    pm_gather *gather = context;
    pm_direct_query query = {
        .world = gather->compose->world,
        .samples = per_sample(gather->settings.light_samples, gather->settings.spp),
        .first = at->sample,
        .step = gather->settings.spp,
    };
    lattice_shift(gather, at, FOR_LIGHTS, query.shift);
    *radiance = pm_direct(&query, &at->hit, &at->lobes);
    gather->shadow_rays += query.rays;
    return PM_OK;
}

static pm_status look_up(pm_gather *gather, pm_map_kind kind, uint16_t skip,
                         const pm_vertex *at, pm_estimate *found)
{
    pm_estimate_settings settings = gather->settings.estimate;
    settings.skip = skip;
    pm_estimate_point point = {at->hit.position, at->lobes.normal};
    return pm_estimate_radiance(gather->map[kind], &settings, &point, &at->lobes,
                                gather->scratch, found);
}

static pm_status look_up_global(pm_gather *gather, uint16_t skip, const pm_vertex *at,
                                pm_spectrum *radiance)
{
    pm_estimate found;
    PM_TRY(look_up(gather, PM_MAP_GLOBAL, skip, at, &found));
    gather->radius_sum += found.radius;
    gather->found_sum += found.found;
    gather->lookups++;
    *radiance = found.value;
    return PM_OK;
}

static pm_status ask_caustic(void *context, const pm_vertex *at, pm_spectrum *radiance)
{
    pm_estimate found;
    PM_TRY(look_up(context, PM_MAP_CAUSTIC, 0, at, &found));
    *radiance = found.value;
    return PM_OK;
}

static pm_status ask_global(void *context, const pm_vertex *at, pm_spectrum *radiance)
{
    return look_up_global(context, 0, at, radiance);
}

/// The global map seen directly: without what shadow rays and the caustic map bring.
static pm_status ask_indirect_seen(void *context, const pm_vertex *at, pm_spectrum *radiance)
{
    return look_up_global(context, PM_PHOTON_FIRST | PM_PHOTON_CAUSTIC, at, radiance);
}

/// L = mean over cosine-distributed directions of f pi L_i.
static pm_status ask_indirect_gathered(void *context, const pm_vertex *at,
                                       pm_spectrum *radiance)
{
    pm_gather *gather = context;
    uint32_t spp = gather->settings.spp;
    uint32_t rays = per_sample(gather->settings.rays, spp);
    double shift[2];
    lattice_shift(gather, at, FOR_GATHER, shift);
    pm_frame frame = pm_frame_around(at->lobes.normal);
    pm_spectrum sum = pm_gray(0.0);
    for (uint32_t i = 0; i < rays; i++) {
        double u[2];
        pm_lattice_point(shift, at->sample + spp * i, rays * spp, u);
        double radius = sqrt(u[0]);
        double phi = 2.0 * PM_PI * u[1];
        pm_vec3 local = pm_vec(radius * cos(phi), radius * sin(phi), sqrt(1.0 - u[0]));
        pm_vec3 wo = pm_frame_to_world(&frame, local);

        pm_ray ray = pm_hit_ray(&at->hit, wo, 0.0, at->lobes.medium_here);
        uint32_t place = PLACE_GATHER + at->vertex * rays + i;
        pm_rng rng = pm_rng_at(&gather->compose->source, at->pixel * spp + at->sample, place);
        pm_spectrum arriving;
        PM_TRY(pm_compose_gather(gather->compose, &ray, at, &rng, &arriving, &gather->cut));
        pm_spectrum response = pm_spectrum_scale(pm_material_evaluate(&at->lobes, wo), PM_PI);
        sum = pm_spectrum_add(sum, pm_spectrum_mul(response, arriving));
    }
    *radiance = pm_spectrum_scale(sum, 1.0 / rays);
    return PM_OK;
}

void pm_gather_sources(pm_gather *gather, pm_compose *compose)
{
    bool has_global = gather->map[PM_MAP_GLOBAL] != NULL;
    bool gathers = gather->settings.rays > 0;
    gather->compose = compose;
    compose->ask = (pm_compose_sources){
        .context = gather,
        .emitted = ask_emitted,
        .direct = ask_direct,
        .caustic = gather->map[PM_MAP_CAUSTIC] != NULL ? ask_caustic : NULL,
        .indirect = !has_global ? NULL
                    : gathers   ? ask_indirect_gathered
                                : ask_indirect_seen,
        .global = has_global ? ask_global : NULL,
    };
}
