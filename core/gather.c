// Each source answers for one vertex. Lattice shifts hang on the pixel and the vertex number,
// not on the sample, so that all samples of a pixel together look around evenly.
#include "gather.h"

#include "irradiance.h"
#include "lattice.h"
#include "light.h"
#include "look.h"
#include "lookup.h"
#include "media.h"
#include "photon_map.h"

#include <stddef.h>

// Bounce numbers of the camera stream; eye paths use small ones.
#define PLACE_LATTICE 0x80000000u // these two by pixel, the others by sample
#define PLACE_GATHER 0x40000000u
#define PLACE_DIRECT 0x20000000u
#define PLACE_GLINT 0x30000000u
#define PLACE_FOG 0x10000000u

static void lattice_shift(const pm_gather *gather, uint64_t pixel, uint32_t number,
                          pm_gather_purpose purpose, double shift[2])
{
    uint32_t place = PLACE_LATTICE | number << 2 | purpose;
    pm_rng rng = pm_rng_at(&gather->compose->source, pixel, place);
    shift[0] = pm_rng_draw(&rng);
    shift[1] = pm_rng_draw(&rng);
}

static pm_rng sample_rng(const pm_gather *gather, uint64_t pixel, uint32_t sample,
                         uint32_t place)
{
    uint64_t index = pixel * gather->settings.spp + sample;
    return pm_rng_at(&gather->compose->source, index, place);
}

static uint32_t per_sample(uint32_t per_pixel, uint32_t spp)
{
    return (per_pixel + spp - 1) / spp;
}

// --- lamps and shadow rays -------------------------------------------------------------------

/// All of it where only this path can meet the lamp; else the share that drawing a direction
/// has beside drawing a point on the lamp.
static pm_status ask_emitted(void *context, const pm_vertex *at, pm_spectrum *radiance)
{
    const pm_gather *gather = context;
    const pm_scene *scene = gather->compose->world->scene;
    *radiance = pm_light_emitted(scene, &at->hit, at->lobes.wi);
    if (at->pdf > 0.0) {
        double other = pm_light_pdf(scene, &at->hit, at->from, pm_vec_negate(at->lobes.wi));
        *radiance = pm_spectrum_scale(*radiance, pm_direct_weight(at->pdf, other));
    }
    return PM_OK;
}

static pm_status ask_sky(void *context, const pm_ray *ray, pm_spectrum *radiance)
{
    const pm_gather *gather = context;
    (void)ray; // the same all around
    *radiance = pm_light_sky(gather->compose->world->scene);
    return PM_OK;
}

static pm_direct_query query_of(const pm_gather *gather)
{
    return (pm_direct_query){
        .world = gather->compose->world,
        .samples = 1,
        .step = 1,
        .shadows = gather->shadows,
        .scratch = gather->scratch,
    };
}

pm_direct_query pm_gather_share(const pm_gather *gather, uint64_t pixel, uint32_t sample,
                                uint32_t number, pm_gather_purpose purpose)
{
    static const uint32_t place[] = {PLACE_DIRECT, PLACE_GATHER, PLACE_GLINT, PLACE_FOG};
    pm_direct_query query = query_of(gather);
    query.samples = per_sample(gather->settings.light_samples, gather->settings.spp);
    query.first = sample;
    query.step = gather->settings.spp;
    query.rng = sample_rng(gather, pixel, sample, place[purpose] | number);
    lattice_shift(gather, pixel, number, purpose, query.shift);
    return query;
}

pm_direct_query pm_gather_single(const pm_gather *gather, pm_rng *rng)
{
    pm_direct_query query = query_of(gather);
    query.shift[0] = pm_rng_draw(rng);
    query.shift[1] = pm_rng_draw(rng);
    query.rng = *rng;
    return query;
}

void pm_gather_count(pm_gather *gather, const pm_direct_query *query)
{
    gather->shadow_rays += query->rays;
    gather->shadow_spared += query->spared;
}

static pm_status ask_direct(void *context, const pm_vertex *at, pm_spectrum *radiance)
{
    pm_gather *gather = context;
    pm_direct_query query =
        pm_gather_share(gather, at->pixel, at->sample, at->vertex, PM_GATHER_LIGHTS);
    *radiance = pm_direct(&query, &at->hit, &at->lobes);
    pm_gather_count(gather, &query);
    return PM_OK;
}

static pm_status ask_glint(void *context, const pm_vertex *at, pm_spectrum *radiance)
{
    pm_gather *gather = context;
    pm_direct_query query =
        pm_gather_share(gather, at->pixel, at->sample, at->vertex, PM_GATHER_GLINT);
    *radiance = pm_direct_glint(&query, &at->hit, &at->lobes);
    pm_gather_count(gather, &query);
    return PM_OK;
}

// --- maps ------------------------------------------------------------------------------------

static pm_status ask_caustic(void *context, const pm_vertex *at, pm_spectrum *radiance)
{
    return pm_lookup_caustic(context, at, radiance);
}

static pm_status ask_caustic_marked(void *context, const pm_vertex *at, pm_spectrum *radiance)
{
    return pm_lookup_marked(context, at, HUGE_VAL, radiance);
}

static pm_status ask_indirect_seen(void *context, const pm_vertex *at, pm_spectrum *radiance)
{
    return pm_lookup_indirect(context, at, radiance);
}

// --- final gather ----------------------------------------------------------------------------

/// What one ray brings to a vertex.
static pm_status gather_ray(const pm_compose *compose, const pm_vertex *at,
                            const pm_look *along, pm_rng *rng, pm_spectrum *radiance,
                            uint64_t *cut)
{
    *radiance = pm_gray(0.0);
    if (pm_spectrum_is_black(along->response)) {
        return PM_OK;
    }
    pm_ray ray = pm_hit_ray(&at->hit, along->wo, 0.0, at->lobes.medium_here);
    pm_spectrum arriving;
    PM_TRY(pm_compose_gather(compose, &ray, at, rng, &arriving, cut));
    *radiance = pm_spectrum_mul(along->response, arriving);
    return PM_OK;
}

/// Where Lambert's law holds directions come from a lattice; else each lobe knows its own best.
static pm_status ask_indirect_gathered(void *context, const pm_vertex *at,
                                       pm_spectrum *radiance)
{
    pm_gather *gather = context;
    uint32_t spp = gather->settings.spp;
    uint32_t rays = per_sample(gather->settings.rays, spp);
    bool lambertian = pm_material_is_lambertian(&at->lobes);
    *radiance = pm_gray(0.0);
    if (pm_look_albedo(&at->lobes) == 0.0) {
        return PM_OK;
    }
    double shift[2];
    lattice_shift(gather, at->pixel, at->vertex, PM_GATHER_RAYS, shift);
    for (uint32_t i = 0; i < rays; i++) {
        double u[2];
        pm_lattice_point(shift, at->sample + spp * i, rays * spp, u);
        uint32_t place = PLACE_GATHER + at->vertex * rays + i;
        pm_rng rng = sample_rng(gather, at->pixel, at->sample, place);
        pm_look along =
            lambertian ? pm_look_by_cosine(&at->lobes, u) : pm_look_by_lobe(&at->lobes, &rng);
        pm_spectrum one;
        PM_TRY(gather_ray(gather->compose, at, &along, &rng, &one, &gather->cut));
        *radiance = pm_spectrum_add(*radiance, one);
    }
    *radiance = pm_spectrum_scale(*radiance, 1.0 / rays);
    return PM_OK;
}

// --- media -----------------------------------------------------------------------------------

static pm_status ask_volume(void *context, const pm_stretch *along, pm_spectrum *radiance)
{
    return pm_media_seen(context, along, radiance);
}

static pm_status ask_haze(void *context, const pm_stretch *along, pm_rng *rng,
                          pm_spectrum *radiance)
{
    return pm_media_gathered(context, along, rng, radiance);
}

// --- ends of gather rays ---------------------------------------------------------------------

static pm_status ask_global(void *context, const pm_vertex *at, pm_rng *rng,
                            pm_spectrum *radiance)
{
    (void)rng;
    pm_lookup end;
    PM_TRY(pm_lookup_global(context, at, &end));
    *radiance = end.estimate.value;
    return PM_OK;
}

/// LD at the near surface, one shadow ray for each light.
static pm_spectrum near_direct(pm_gather *gather, const pm_vertex *at, pm_rng *rng)
{
    pm_direct_query query = pm_gather_single(gather, rng);
    pm_spectrum radiance = pm_direct(&query, &at->hit, &at->lobes);
    *rng = query.rng;
    pm_gather_count(gather, &query);
    return radiance;
}

/// All paths but LD and LS+D at the near surface: by one ray, whose own end is looked up
/// plainly.
static pm_status near_indirect(pm_gather *gather, const pm_vertex *at, pm_rng *rng,
                               pm_spectrum *radiance)
{
    *radiance = pm_gray(0.0);
    if (pm_look_albedo(&at->lobes) == 0.0) {
        return PM_OK;
    }
    pm_compose last = *gather->compose;
    last.ask.global = ask_global;
    pm_look along = pm_look_by_lobe(&at->lobes, rng);
    return gather_ray(&last, at, &along, rng, radiance, &gather->cut);
}

/// What leaves `at` without a lookup there, but for caustics, `reach` around.
static pm_status go_on(pm_gather *gather, const pm_vertex *at, double reach, pm_rng *rng,
                       pm_spectrum *radiance)
{
    pm_spectrum caustic = pm_gray(0.0);
    pm_spectrum indirect;
    pm_spectrum direct = near_direct(gather, at, rng);
    if (gather->marked) {
        PM_TRY(pm_lookup_marked(gather, at, reach, &caustic));
    }
    PM_TRY(near_indirect(gather, at, rng, &indirect));
    *radiance = pm_spectrum_add(direct, pm_spectrum_add(caustic, indirect));
    return PM_OK;
}

/// The lookup that a gather ray ends with, unless its disc is too large for the place.
static pm_status ask_global_or_go_on(void *context, const pm_vertex *at, pm_rng *rng,
                                     pm_spectrum *radiance)
{
    pm_gather *gather = context;
    pm_lookup end;
    PM_TRY(pm_lookup_global(gather, at, &end));
    double leg = pm_vec_length(pm_vec_sub(at->hit.position, at->from));
    if (leg < end.estimate.radius || end.uneven) {
        gather->near++;
        return go_on(gather, at, end.estimate.radius, rng, radiance);
    }
    *radiance = end.estimate.value;
    return PM_OK;
}

void pm_gather_sources(pm_gather *gather, pm_compose *compose)
{
    bool has_global = gather->map[PM_MAP_GLOBAL] != NULL;
    bool has_caustic = gather->map[PM_MAP_CAUSTIC] != NULL;
    bool own = !gather->settings.caustics_global;
    bool gathers = gather->settings.rays > 0;
    bool has_media = compose->world->scene->medium_count > 0;
    gather->compose = compose;
    gather->marked = pm_lookup_has_marked(gather);
    if (gather->irradiance != NULL) {
        gather->irradiance_reach = pm_irradiance_reach(gather->irradiance);
    }
    if (gather->map[PM_MAP_VOLUME] != NULL) {
        pm_photon_map_box(gather->map[PM_MAP_VOLUME], &gather->low, &gather->high);
    }
    compose->ask = (pm_compose_sources){
        .context = gather,
        .emitted = ask_emitted,
        .sky = ask_sky,
        .glint = ask_glint,
        .direct = ask_direct,
        .caustic = own && has_caustic       ? ask_caustic
                   : !own && gather->marked ? ask_caustic_marked
                                            : NULL,
        .indirect = !has_global ? NULL
                    : gathers   ? ask_indirect_gathered
                                : ask_indirect_seen,
        .global = has_global ? ask_global_or_go_on : NULL,
        .volume = has_media ? ask_volume : NULL,
        .haze = has_media ? ask_haze : NULL,
    };
}
