// The sources of light one by one: maps made by hand, the final gather under skies of known
// radiance.
#include "balance.h"
#include "chance.h"
#include "gather.h"
#include "photon_map.h"
#include "photon_pass.h"
#include "pictures.h"
#include "scenes.h"
#include "shapes.h"
#include "store.h"
#include "test.h"

static const double albedo = 0.8;

/// A scene with everything that answers for a vertex of it.
typedef struct {
    pm_scenes s;
    pm_photon_map map[PM_MAP_COUNT];
    pm_compose compose;
    pm_gather gather;
    pm_neighbour scratch[64];
} site;

static void site_ready(site *at)
{
    pm_scenes_ready(&at->s);
    at->compose = (pm_compose){
        .world = &at->s.world,
        .source = {.seed = 11, .stream = PM_STREAM_CAMERA},
        .max_specular = 1000,
    };
    at->gather = (pm_gather){
        .settings = {pm_estimate_defaults(), .rays = 0, .light_samples = 1, .spp = 1},
        .scratch = at->scratch,
    };
    at->gather.settings.estimate.k = 64;
    pm_gather_sources(&at->gather, &at->compose);
}

static void site_free(site *at)
{
    for (int kind = 0; kind < PM_MAP_COUNT; kind++) {
        pm_photon_map_free(&at->map[kind]);
    }
    pm_scenes_free(&at->s);
}

static void add_floor(pm_scenes *s)
{
    int white = pm_scenes_diffuse(s, pm_gray(albedo));
    pm_scenes_wear(s, pm_scenes_square(4.0, 0.0, false), white);
}

static void lamps_glow_on_one_side(void)
{
    site at = {0};
    pm_scenes_begin(&at.s);
    int lamp = pm_scenes_wear(&at.s, pm_scenes_square(1.0, 0.0, false), PM_NONE);
    pm_scenes_lamp(&at.s, lamp, pm_rgb(1.0, 2.0, 3.0));
    site_ready(&at);
    pm_spectrum radiance;
    pm_vertex front = pm_pictures_meet(&at.s, pm_vec(0.0, 0.0, 1.0), pm_vec(0.0, 0.0, -1.0));
    CHECK_OK(at.compose.ask.emitted(&at.gather, &front, &radiance));
    CHECK_NEAR(radiance.c[2], 3.0, 0.0);
    pm_vertex back = pm_pictures_meet(&at.s, pm_vec(0.0, 0.0, -1.0), pm_vec(0.0, 0.0, 1.0));
    CHECK_OK(at.compose.ask.emitted(&at.gather, &back, &radiance));
    CHECK(pm_spectrum_is_black(radiance));
    site_free(&at);
}

/// Photons on the floor within 1 of the origin: red ones that came straight, green ones by S
/// events only, blue ones by others. `count` of each, 1 W together.
static void sow(pm_photon_map *map, pm_map_kind kind, uint32_t count)
{
    *map = (pm_photon_map){.kind = kind, .scale = 1.0, .unpacked = true};
    for (uint32_t i = 0; i < 3 * count; i++) {
        pm_rng rng = pm_shapes_rng(i, 5);
        pm_spectrum power = pm_gray(0.0);
        power.c[i % 3] = 1.0;
        double radius = sqrt(pm_rng_draw(&rng));
        double turn = 2.0 * PM_PI * pm_rng_draw(&rng);
        pm_deposit deposit = {
            .position = pm_vec(radius * cos(turn), radius * sin(turn), 0.0),
            .direction = pm_vec(0.0, 0.0, -1.0),
            .normal = pm_vec(0.0, 0.0, 1.0),
            .power = power,
            .first = i % 3 == 0,
            .caustic = i % 3 == 1,
        };
        CHECK_OK(pm_store_push(map, &deposit));
    }
    CHECK_OK(pm_store_scale(map, count));
    CHECK_OK(pm_balance_build(map));
}

static void sown_site(site *at)
{
    pm_scenes_begin(&at->s);
    add_floor(&at->s);
    pm_scenes_point(&at->s, pm_vec(0.0, 0.0, 1.0), pm_gray(1.0));
    sow(&at->map[PM_MAP_GLOBAL], PM_MAP_GLOBAL, 20);
    sow(&at->map[PM_MAP_CAUSTIC], PM_MAP_CAUSTIC, 20);
    site_ready(at);
    at->gather.settings.estimate.radius = 1.0; // holds all 60
    at->gather.map[PM_MAP_GLOBAL] = &at->map[PM_MAP_GLOBAL];
    at->gather.map[PM_MAP_CAUSTIC] = &at->map[PM_MAP_CAUSTIC];
    pm_gather_sources(&at->gather, &at->compose);
}

// With all photons in reach and a reach of 1, 1 W in a channel is E = 1 / pi there.
static void check_radiance(const char *who, pm_spectrum got, pm_spectrum power)
{
    for (int c = 0; c < 3; c++) {
        double want = albedo / (PM_PI * PM_PI) * power.c[c];
        CHECK_THAT(fabs(got.c[c] - want) <= 1e-12, "%s, channel %d: got %g, want %g", who, c,
                   got.c[c], want);
    }
}

static void each_map_is_asked_for_its_own_light(void)
{
    site at = {0};
    sown_site(&at);
    pm_vertex floor = pm_pictures_meet(&at.s, pm_vec(0.0, 0.0, 2.0), pm_vec(0.0, 0.0, -1.0));
    pm_spectrum radiance;
    pm_rng unused = pm_shapes_rng(0, 7);
    CHECK_OK(at.compose.ask.global(&at.gather, &floor, &unused, &radiance));
    check_radiance("a gather ray's end takes all", radiance, pm_gray(1.0));
    CHECK_NEAR((double)at.gather.lookups, 1.0, 0.0);
    CHECK_NEAR((double)at.gather.found_sum, 60.0, 0.0);
    CHECK_NEAR(at.gather.radius_sum, 1.0, 1e-12);
    CHECK_OK(at.compose.ask.indirect(&at.gather, &floor, &radiance));
    check_radiance("seen directly, less what others bring", radiance, pm_rgb(0.0, 0.0, 1.0));
    CHECK_OK(at.compose.ask.caustic(&at.gather, &floor, &radiance));
    check_radiance("all of the caustic map", radiance, pm_gray(1.0));
    CHECK_NEAR((double)at.gather.lookups, 2.0, 0.0); // in the global map
    at.gather.settings.caustics_global = true;
    pm_gather_sources(&at.gather, &at.compose);
    CHECK_OK(at.compose.ask.caustic(&at.gather, &floor, &radiance));
    check_radiance("what the global map marks", radiance, pm_rgb(0.0, 1.0, 0.0));
    site_free(&at);
}

static void maps_that_are_not_there_are_not_asked(void)
{
    site at = {0};
    sown_site(&at);
    at.gather.map[PM_MAP_CAUSTIC] = NULL;
    pm_gather_sources(&at.gather, &at.compose);
    CHECK(at.compose.ask.caustic == NULL && at.compose.ask.indirect != NULL);
    at.gather.map[PM_MAP_CAUSTIC] = &at.map[PM_MAP_CAUSTIC];
    at.gather.map[PM_MAP_GLOBAL] = NULL;
    at.gather.settings.rays = 16;
    pm_gather_sources(&at.gather, &at.compose);
    CHECK(at.compose.ask.caustic != NULL && at.compose.ask.direct != NULL);
    CHECK(at.compose.ask.indirect == NULL && at.compose.ask.global == NULL);
    at.gather.settings.caustics_global = true; // asks the global map or nothing
    pm_gather_sources(&at.gather, &at.compose);
    CHECK(at.compose.ask.caustic == NULL);
    at.gather.map[PM_MAP_GLOBAL] = &at.map[PM_MAP_GLOBAL];
    pm_gather_sources(&at.gather, &at.compose);
    CHECK(at.compose.ask.caustic != NULL);
    for (uint32_t i = 0; i < at.map[PM_MAP_GLOBAL].count; i++) {
        at.map[PM_MAP_GLOBAL].photons[i].flags &= (uint16_t)~PM_PHOTON_CAUSTIC;
    }
    pm_gather_sources(&at.gather, &at.compose);
    CHECK(at.compose.ask.caustic == NULL); // the whole tree would be searched for none
    site_free(&at);
}

// --- final gather ----------------------------------------------------------------------------

static pm_status bright_everywhere(void *context, const pm_vertex *at, pm_rng *rng,
                                   pm_spectrum *radiance)
{
    (void)context;
    (void)rng;
    (void)at;
    *radiance = pm_gray(1.0);
    return PM_OK;
}

static pm_status bright_at_plus_x(void *context, const pm_vertex *at, pm_rng *rng,
                                  pm_spectrum *radiance)
{
    (void)context;
    (void)rng;
    *radiance = pm_gray(at->hit.position.x > 0.0 ? 1.0 : 0.0);
    return PM_OK;
}

static pm_status bright_within_60_degrees(void *context, const pm_vertex *at, pm_rng *rng,
                                          pm_spectrum *radiance)
{
    (void)context;
    (void)rng;
    pm_vec3 way = at->hit.position;
    *radiance = pm_gray(way.z > 0.5 * pm_vec_length(way) ? 1.0 : 0.0);
    return PM_OK;
}

typedef pm_status (*sky_fn)(void *context, const pm_vertex *at, pm_rng *rng,
                            pm_spectrum *radiance);

/// Mean and variance of the gathered light at the middle of a room under `sky`, over pixels and
/// their samples.
static void gather_under(sky_fn sky, uint32_t rays, double *mean, double *variance)
{
    enum { PIXELS = 500 };
    site at = {0};
    sown_site(&at);
    pm_scenes_room(&at.s, 3.0, pm_scenes_diffuse(&at.s, pm_gray(0.5)));
    at.gather.settings.rays = rays;
    at.gather.settings.spp = 4;
    pm_gather_sources(&at.gather, &at.compose);
    at.compose.ask.global = sky;
    pm_vertex floor = pm_pictures_meet(&at.s, pm_vec(0.0, 0.0, 0.5), pm_vec(0.0, 0.0, -1.0));
    double sum = 0.0;
    double square = 0.0;
    for (uint32_t i = 0; i < 4 * PIXELS; i++) {
        pm_spectrum radiance;
        floor.pixel = i / 4;
        floor.sample = i % 4;
        CHECK_OK(at.compose.ask.indirect(&at.gather, &floor, &radiance));
        sum += radiance.c[0];
        square += radiance.c[0] * radiance.c[0];
    }
    *mean = sum / (4 * PIXELS);
    *variance = fmax(0.0, square / (4 * PIXELS) - *mean * *mean);
    site_free(&at);
}

static void gathering_follows_closed_forms(void)
{
    double mean;
    double variance;
    gather_under(bright_everywhere, 16, &mean, &variance);
    CHECK_NEAR(mean, albedo, 1e-12);
    CHECK_NEAR(variance, 0.0, 1e-12);
    const uint32_t rays[] = {1, 16, 64}; // fewer than samples: one each
    for (int i = 0; i < 3; i++) {
        gather_under(bright_at_plus_x, rays[i], &mean, &variance);
        CHECK_NEAR(mean, 0.5 * albedo, pm_chance_bound(variance, 500.0));
        gather_under(bright_within_60_degrees, rays[i], &mean, &variance);
        CHECK_NEAR(mean, 0.75 * albedo, pm_chance_bound(variance, 500.0));
    }
}

// --- a thin wall -----------------------------------------------------------------------------

static void a_thin_wall_leaks_nothing(void)
{
    const pm_gather_shape shapes[] = {PM_GATHER_DISC, PM_GATHER_SPHERE};
    site at = {0};
    pm_scenes_begin(&at.s);
    add_floor(&at.s); // the wall: two sides, no thickness
    pm_scenes_point(&at.s, pm_vec(0.0, 0.0, -1.0), pm_gray(5.0));
    pm_scenes_point(&at.s, pm_vec(1.0, 0.5, -0.1), pm_gray(5.0));
    site_ready(&at);
    pm_pass_settings pass = {.seed = 1, .count = 20000};
    CHECK_OK(pm_photon_pass(&at.s.world, PM_MAP_GLOBAL, &pass, &at.map[PM_MAP_GLOBAL], NULL));
    CHECK_OK(pm_balance_build(&at.map[PM_MAP_GLOBAL]));
    at.gather.map[PM_MAP_GLOBAL] = &at.map[PM_MAP_GLOBAL];
    pm_gather_sources(&at.gather, &at.compose);
    for (uint64_t i = 0; i < 200; i++) {
        pm_rng rng = pm_shapes_rng(i, 6);
        pm_vec3 place = pm_shapes_inside(&rng, 1.9);
        pm_spectrum radiance;
        at.gather.settings.estimate.shape = shapes[i % 2];
        pm_vertex dark =
            pm_pictures_meet(&at.s, pm_vec(place.x, place.y, 1.0), pm_vec(0.0, 0.0, -1.0));
        CHECK_OK(at.compose.ask.global(&at.gather, &dark, &rng, &radiance));
        CHECK(pm_spectrum_is_black(radiance) && at.gather.found_sum == 0);
        CHECK_OK(at.compose.ask.direct(&at.gather, &dark, &radiance));
        CHECK(pm_spectrum_is_black(radiance));
        pm_vertex lit =
            pm_pictures_meet(&at.s, pm_vec(place.x, place.y, -1.0), pm_vec(0.0, 0.0, 1.0));
        CHECK_OK(at.compose.ask.global(&at.gather, &lit, &rng, &radiance));
        CHECK(radiance.c[0] > 0.0 && at.gather.found_sum == 64);
        at.gather.found_sum = 0;
    }
    site_free(&at);
}

// --- fair shares -----------------------------------------------------------------------------

// Samples of one pixel may stand on different surfaces; so each sample's share of the lattice
// has to be fair by itself. Below the centre of a square of side 1, half above:
// E = (4 / pi) q atan(q) pi L with q = 1 / sqrt(2).
static void each_sample_gets_a_fair_share(void)
{
    enum { PIXELS = 8000, SPP = 4 };
    site at = {0};
    pm_scenes_begin(&at.s);
    add_floor(&at.s);
    int lamp = pm_scenes_add(&at.s, pm_scenes_square(1.0, 0.5, true), PM_NONE, PM_NONE);
    pm_scenes_lamp(&at.s, lamp, pm_gray(3.0));
    site_ready(&at);
    at.gather.settings.light_samples = SPP;
    at.gather.settings.spp = SPP;
    pm_vertex floor = pm_pictures_meet(&at.s, pm_vec(0.0, 0.0, 0.01), pm_vec(0.0, 0.0, -1.0));
    double q = sqrt(0.5);
    double want = albedo * 3.0 * 4.0 / PM_PI * q * atan(q);
    for (uint32_t sample = 0; sample < SPP; sample++) {
        double sum = 0.0;
        double square = 0.0;
        floor.sample = sample;
        for (floor.pixel = 0; floor.pixel < PIXELS; floor.pixel++) {
            pm_spectrum radiance;
            CHECK_OK(at.compose.ask.direct(&at.gather, &floor, &radiance));
            sum += radiance.c[0];
            square += radiance.c[0] * radiance.c[0];
        }
        double mean = sum / PIXELS;
        CHECK_NEAR(mean, want, pm_chance_bound(square / PIXELS - mean * mean, PIXELS));
    }
    site_free(&at);
}

PM_TESTS({"gather.1", "a lamp glows on the side of its normal only", lamps_glow_on_one_side},
         {"gather.2", "each light is looked up in one map, and no photon counts in two layers",
          each_map_is_asked_for_its_own_light},
         {"gather.3", "without a map its light is not asked for",
          maps_that_are_not_there_are_not_asked},
         {"gather.4", "gathering under known skies gives albedo times their mean over cosines",
          gathering_follows_closed_forms},
         {"gather.5", "the dark side of a thin wall gets exactly nothing, by rays and by map",
          a_thin_wall_leaks_nothing},
         {"gather.6", "each sample's share of a pixel's shadow rays is fair by itself",
          each_sample_gets_a_fair_share})
