// What a picture gathers where lookups alone would be wrong: in corners, where discs hang over
// the edge, and on rough mirrors, where lamps are met by chance.
#include "balance.h"
#include "chance.h"
#include "gather.h"
#include "lookup.h"
#include "photon_map.h"
#include "photon_pass.h"
#include "pictures.h"
#include "scenes.h"
#include "store.h"
#include "test.h"

enum { K = 50 };

/// A scene with everything that answers for a vertex of it.
typedef struct {
    pm_scenes s;
    pm_photon_map map;
    pm_compose compose;
    pm_gather gather;
    pm_neighbour scratch[K];
} site;

/// To be called with the scene and, if any, the map ready.
static void site_ready(site *at, uint32_t rays)
{
    at->compose = (pm_compose){
        .world = &at->s.world,
        .source = {.seed = 31, .stream = PM_STREAM_CAMERA},
        .max_specular = 1000,
        .splits = 2,
        .wanted = {true, true, true, true, true, true},
    };
    at->gather = (pm_gather){
        .map = {[PM_MAP_GLOBAL] = at->map.count > 0 ? &at->map : NULL},
        .settings = {pm_estimate_defaults(), .rays = rays, .light_samples = 1, .spp = 1},
        .scratch = at->scratch,
    };
    at->gather.settings.estimate.k = K;
    pm_gather_sources(&at->gather, &at->compose);
}

static void site_free(site *at)
{
    pm_photon_map_free(&at->map);
    pm_scenes_free(&at->s);
}

/// Mean of the indirect light that leaves the floor at x, over pixels along y.
static double indirect_at(site *at, double x, uint64_t pixels)
{
    double sum = 0.0;
    for (uint64_t i = 0; i < pixels; i++) {
        double y = ((double)i + 0.5) / (double)pixels - 0.5;
        pm_vertex floor =
            pm_pictures_meet(&at->s, pm_vec(x, 0.01 * y, 0.01), pm_vec(0.0, 0.0, -1.0));
        pm_spectrum radiance;
        floor.pixel = i;
        CHECK_OK(at->compose.ask.indirect(&at->gather, &floor, &radiance));
        sum += radiance.c[0];
    }
    return sum / (double)pixels;
}

// --- near hits -------------------------------------------------------------------------------

static void put_photon(pm_photon_map *map, bool caustic, double power)
{
    pm_deposit deposit = {
        .position = pm_vec(0.0, 0.0, 1.0),
        .direction = pm_vec(0.0, 0.0, 1.0),
        .normal = pm_vec(0.0, 0.0, -1.0),
        .power = pm_gray(power),
        .first = !caustic,
        .caustic = caustic,
    };
    CHECK_OK(pm_store_push(map, &deposit));
}

// A crumb of floor under a ceiling 4 wide that sunlight from below lights with 2 W/m^2. Its map
// lies: 1000 W of light that came straight, which shadow rays replace; 9 pi W of caustics in
// discs of radius 3, which count: 1 W/m^2 everywhere. What leaves the ceiling is then
// 0.5 / pi (2 + 1), and the floor sees it by the closed form of a square overhead.
static void near_ceilings_are_lit_by_shadow_rays(void)
{
    site at = {0};
    pm_scenes_begin(&at.s);
    int white = pm_scenes_diffuse(&at.s, pm_gray(0.8));
    int gray = pm_scenes_diffuse(&at.s, pm_gray(0.5));
    pm_scenes_wear(&at.s, pm_scenes_square(0.02, 0.0, false), white);
    pm_scenes_wear(&at.s, pm_scenes_square(4.0, 1.0, true), gray);
    pm_scenes_sun(&at.s, pm_vec(0.0, 0.0, 1.0), pm_gray(2.0));
    pm_scenes_ready(&at.s);
    at.map = (pm_photon_map){.kind = PM_MAP_GLOBAL, .unpacked = true, .scale = 1.0};
    put_photon(&at.map, false, 1000.0);
    put_photon(&at.map, true, 9.0 * PM_PI);
    CHECK_OK(pm_store_scale(&at.map, 1));
    CHECK_OK(pm_balance_build(&at.map));
    site_ready(&at, 64);
    at.gather.settings.estimate.radius = 3.0;
    double q = 2.0 / sqrt(5.0);
    double seen = 4.0 / PM_PI * q * atan(q);
    double want = 0.8 * seen * 0.5 / PM_PI * 3.0;
    CHECK_NEAR(indirect_at(&at, 0.0, 200), want, 0.01 * want);
    CHECK(at.gather.near > 200 * 64 * 8 / 10 && at.gather.near < 200 * 64 * 9 / 10);
    CHECK(at.gather.shadow_rays == at.gather.near);
    site_free(&at);
}

static pm_status plainly(void *context, const pm_vertex *at, pm_rng *rng, pm_spectrum *radiance)
{
    (void)rng;
    pm_lookup end;
    PM_TRY(pm_lookup_global(context, at, &end));
    *radiance = end.estimate.value;
    return PM_OK;
}

/// The same by random walks that shadow rays light at each turn: walls reflect 0.6, so 3 of 5
/// walks go on.
static double walk(site *at, double x, uint64_t index)
{
    const double albedo = 0.6;
    pm_rng rng = pm_rng_at(&at->compose.source, index, 999);
    pm_vertex here = pm_pictures_meet(&at->s, pm_vec(x, 0.0, 0.01), pm_vec(0.0, 0.0, -1.0));
    pm_direct_query query = {.world = &at->s.world, .samples = 1, .step = 1};
    double sum = 0.0;
    while (pm_rng_draw(&rng) < albedo) {
        pm_scatter scatter;
        pm_material_sample(&here.lobes, 0, &rng, &scatter);
        pm_vec3 start = pm_hit_leave(&here.hit, scatter.wo);
        here = pm_pictures_meet(&at->s, start, scatter.wo);
        sum += pm_direct(&query, &here.hit, &here.lobes).c[0];
    }
    return sum;
}

static double brute_force(site *at, double x)
{
    enum { WALKS = 20000 };
    double sum = 0.0;
    for (uint64_t i = 0; i < WALKS; i++) {
        sum += walk(at, x, i);
    }
    return sum / WALKS;
}

// At 0.02 and 0.04 of a room 2 wide, whose discs reach 0.1.
static void corners_are_as_bright_as_they_are(void)
{
    site at = {0};
    pm_scenes_lit_room(&at.s, 0.6);
    pm_pass_settings pass = {.seed = 1, .count = 30000};
    CHECK_OK(pm_photon_pass(&at.s.world, PM_MAP_GLOBAL, &pass, &at.map, NULL));
    CHECK_OK(pm_balance_build(&at.map));
    for (int i = 0; i < 2; i++) {
        site_ready(&at, 64);
        double x = -1.0 + 0.02 * (i + 1);
        double want = brute_force(&at, x);
        double with = indirect_at(&at, x, 60);
        CHECK(at.gather.near > 0);
        at.compose.ask.global = plainly;
        double without = indirect_at(&at, x, 60);
        CHECK_THAT(without < 0.95 * want, "got %g of %g", without, want);
        CHECK_NEAR(with, want, 0.5 * (want - without));
    }
    site_free(&at);
}

// --- lamps in rough mirrors ------------------------------------------------------------------

static pm_status in_full(void *context, const pm_vertex *at, pm_spectrum *radiance)
{
    const pm_gather *gather = context;
    int light = gather->compose->world->scene->shapes[at->hit.shape].light;
    bool front = pm_vec_dot(at->lobes.wi, at->hit.normal) > 0.0;
    *radiance = light != PM_NONE && front ? pm_gray(1.0) : pm_gray(0.0);
    return PM_OK;
}

/// Mean and variance of what a rough mirror shows.
static void look(const site *at, double *mean, double *variance)
{
    enum { LOOKS = 6000 };
    pm_ray ray = {pm_vec(-1.0, 0.0, 1.0), pm_vec_normalize(pm_vec(1.0, 0.0, -1.0)), HUGE_VAL,
                  0.0, PM_NONE};
    double sum = 0.0;
    double square = 0.0;
    for (uint64_t i = 0; i < LOOKS; i++) {
        pm_eye eye = {0};
        CHECK_OK(pm_compose_eye(&at->compose, &ray, i, 0, i, &eye));
        double x = eye.layer[PM_LAYER_SPECULAR].c[0];
        sum += x;
        square += x * x;
    }
    *mean = sum / LOOKS;
    *variance = fmax(0.0, square / LOOKS - *mean * *mean) / LOOKS;
}

/// A rough mirror and a lamp above it, half way behind a null surface.
static void mirror_begin(site *at, double alpha, double width)
{
    pm_scenes_begin(&at->s);
    pm_scenes_wear(&at->s, pm_scenes_square(0.5, 0.0, false),
                   pm_scenes_rough_mirror(&at->s, PM_MICROFACET_GGX, alpha));
    pm_shape lamp = pm_scenes_square(width, 1.0, true);
    lamp.corner.x += 0.9;
    pm_scenes_lamp(&at->s, pm_scenes_wear(&at->s, lamp, PM_NONE), pm_gray(1.0));
    pm_scenes_wear(&at->s, pm_scenes_square(2.0, 0.5, true), pm_scenes_null(&at->s));
    pm_scenes_ready(&at->s);
    site_ready(at, 0);
}

static void lamps_in_rough_mirrors_count_once(void)
{
    const double alpha[] = {0.02, 0.1, 0.1};
    const double width[] = {0.5, 0.1, 2.0}; // as sharp as they are, small, large
    for (int i = 0; i < 3; i++) {
        site at = {0};
        mirror_begin(&at, alpha[i], width[i]);
        double shared;
        double chance;
        double variance[2];
        look(&at, &shared, &variance[0]);
        at.compose.ask.glint = NULL;
        at.compose.ask.emitted = in_full;
        look(&at, &chance, &variance[1]);
        CHECK(chance > 0.0);
        CHECK_NEAR(shared, chance, pm_chance_bound(variance[0] + variance[1], 1.0));
        CHECK(width[i] > 0.1 || variance[0] < 0.5 * variance[1]);
        site_free(&at);
    }
}

PM_TESTS({"gather.7",
          "a surface nearer than its disc is lit by shadow rays, caustics by its map",
          near_ceilings_are_lit_by_shadow_rays},
         {"gather.8", "near hits take most of the darkness out of corners",
          corners_are_as_bright_as_they_are},
         {"gather.9",
          "lamps in rough mirrors count once, met or drawn, and drawing finds small ones",
          lamps_in_rough_mirrors_count_once})
