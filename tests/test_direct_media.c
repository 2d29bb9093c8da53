// Direct light that comes through fog: closed forms for each kind of light, and domes, where
// every direction has the same way to go, so that each technique must lose the same share.
#include "direct.h"

#include "integrals.h"
#include "receivers.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"

/// What the ray from `wi` meets at the origin, in `medium`.
static void meet(const pm_scenes *s, pm_vec3 wi, int medium, pm_hit *hit, pm_lobes *lobes)
{
    pm_ray ray = {pm_vec_scale(wi, 0.01), pm_vec_negate(wi), HUGE_VAL, 0.0, medium};
    CHECK(pm_closest(&s->world, &ray, hit) && hit->shape == 0);
    pm_material_lobes(&s->scene, hit, &ray, lobes);
}

/// Irradiance at the origin, on a floor of albedo 1/2 that lies in `medium`.
static double irradiance(const pm_scenes *s, int medium, uint32_t samples)
{
    pm_hit hit;
    pm_lobes lobes;
    meet(s, pm_vec(0.0, 0.0, 1.0), medium, &hit, &lobes);
    return pm_receivers_direct(s, &hit, &lobes, samples, 0) * PM_PI / 0.5;
}

/// A floor at z = 0 of albedo 1/2 under a slab of fog from z = 0.5 to 1.5.
static void begin_under_slab(pm_scenes *s, double sigma_t)
{
    pm_scenes_begin(s);
    int fog = pm_scenes_medium(s, sigma_t, pm_gray(0.5), 0.0);
    pm_scenes_wear(s, pm_scenes_square(64.0, 0.0, false), pm_scenes_diffuse(s, pm_gray(0.5)));
    pm_scenes_bound(s, pm_scenes_square(64.0, 0.5, true), fog, PM_NONE);
    pm_scenes_bound(s, pm_scenes_square(64.0, 1.5, false), fog, PM_NONE);
}

static const double densities[4] = {0.0, 0.2, 3.0, 40.0};

static void points_through_slabs(void)
{
    for (int i = 0; i < 12; i++) {
        double x = 1.5 * (i / 4);
        pm_scenes s;
        begin_under_slab(&s, densities[i % 4]);
        pm_scenes_point(&s, pm_vec(x, 0.0, 2.0), pm_gray(4.0 * PM_PI));
        pm_scenes_ready(&s);
        double d = sqrt(x * x + 4.0);
        double want = 2.0 / (d * d * d) * exp(-densities[i % 4] * d / 2.0);
        CHECK_NEAR(irradiance(&s, PM_NONE, 1), want, 1e-2 * want);
        CHECK(densities[i % 4] > 10.0 || fabs(irradiance(&s, PM_NONE, 1) / want - 1.0) < 5e-4);
        pm_scenes_free(&s);
    }
}

static void suns_through_slabs(void)
{
    for (int i = 0; i < 12; i++) {
        double cosine = 1.0 - 0.3 * (i / 4);
        pm_scenes s;
        begin_under_slab(&s, densities[i % 4]);
        pm_scenes_sun(&s, pm_vec(sqrt(1.0 - cosine * cosine), 0.0, -cosine), pm_gray(3.0));
        pm_scenes_ready(&s);
        double want = 3.0 * cosine * exp(-densities[i % 4] / cosine);
        CHECK_NEAR(irradiance(&s, PM_NONE, 1), want, 1e-2 * want);
        pm_scenes_free(&s);
    }
}

static void floors_in_fog_are_dimmed_once(void)
{
    // The light, the floor and all between in one fog: exp(-sigma d), neither its square nor
    // its root.
    for (int i = 0; i < 4; i++) {
        pm_scenes s;
        pm_scenes_begin(&s);
        int fog = pm_scenes_medium(&s, densities[i], pm_gray(0.5), 0.0);
        int gray = pm_scenes_diffuse(&s, pm_gray(0.5));
        pm_scenes_wear(&s, pm_scenes_square(4.0, 0.0, false), gray);
        pm_scenes_point(&s, pm_vec(0.0, 0.0, 2.0), pm_gray(4.0 * PM_PI));
        s.lights[0].medium = fog;
        pm_scenes_ready(&s);
        double want = 0.25 * exp(-2.0 * densities[i]);
        CHECK_NEAR(irradiance(&s, fog, 1), want, 1e-3 * want);
        CHECK_NEAR(irradiance(&s, PM_NONE, 1), 0.25, 1e-5); // the path says where it runs
        pm_scenes_free(&s);
    }
}

// --- lamps ----------------------------------------------------------------------------------

/// Where on the lamp the integral is.
typedef struct {
    double x, height, sigma_t;
} lamp_point;

/// Irradiance at the origin from a lamp of radiance 1 that faces down.
static double from_point(double y, void *context)
{
    const lamp_point *at = context;
    double z = at->height;
    double d2 = at->x * at->x + y * y + z * z;
    return z * z / (d2 * d2) * exp(-at->sigma_t * sqrt(d2));
}

static double from_line(double x, void *context)
{
    lamp_point *at = context;
    at->x = x;
    return 2.0 * pm_integral(from_point, at, 0.0, 0.5);
}

static void lamps_in_fog_are_those_of_the_integral(void)
{
    // Far off; near by, where directions drawn by the floor share the work.
    static const double heights[3] = {2.0, 0.5, 0.05};
    for (int i = 0; i < 6; i++) {
        double height = heights[i % 3];
        pm_scenes s;
        pm_scenes_begin(&s);
        int fog = pm_scenes_medium(&s, 1.5, pm_gray(0.5), 0.0);
        int gray = pm_scenes_diffuse(&s, pm_gray(0.5));
        pm_scenes_wear(&s, pm_scenes_square(4.0, 0.0, false), gray);
        int lamp = pm_scenes_add(&s, pm_scenes_square(1.0, height, true), gray, gray);
        pm_scenes_lamp(&s, lamp, pm_gray(1.0));
        s.lights[0].position = pm_vec(0.0, 0.0, height);
        s.lights[0].extent = i < 3 ? 0.0 : sqrt(0.5);
        pm_scenes_ready(&s);
        lamp_point at = {0.0, height, 1.5};
        double want = 2.0 * pm_integral(from_line, &at, 0.0, 0.5);
        CHECK_NEAR(irradiance(&s, fog, 40000), want, 2e-3 * want);
        pm_scenes_free(&s);
    }
}

// --- domes ----------------------------------------------------------------------------------

enum { DIFFUSE, METAL, PLASTIC, RECEIVERS };
enum { LAMP, NULL_LAMP, SKY, DOMES };

static int receiver(pm_scenes *s, int kind)
{
    return kind == DIFFUSE ? pm_scenes_diffuse(s, pm_gray(0.5))
           : kind == METAL
               ? pm_scenes_rough_mirror(s, PM_MICROFACET_GGX, 0.3)
               : pm_scenes_rough_plastic(s, pm_gray(0.5), 1.5, PM_MICROFACET_GGX, 0.3);
}

/// A floor through the middle of two domes: fog 0 up to radius 1, fog 1 up to 2, where it is
/// light all around.
static void begin_dome(pm_scenes *s, int kind, int dome, double sigma_t)
{
    pm_scenes_begin(s);
    int inner = pm_scenes_medium(s, sigma_t, pm_gray(0.5), 0.0);
    int outer = pm_scenes_medium(s, 0.3 * sigma_t, pm_gray(0.5), 0.0);
    pm_scenes_wear(s, pm_scenes_square(2.0, 0.0, false), receiver(s, kind));
    pm_vec3 middle = pm_vec(0.0, 0.0, 0.0);
    pm_scenes_bound(s, pm_shapes_sphere(middle, 1.0), inner, outer);
    pm_shape shell = pm_shapes_sphere(middle, 2.0);
    if (dome == SKY) {
        pm_scenes_bound(s, shell, outer, PM_NONE);
        pm_scenes_sky(s, pm_gray(0.7));
    } else {
        shell.flipped = true;
        int wear = dome == LAMP ? pm_scenes_diffuse(s, pm_gray(0.0)) : pm_scenes_null(s);
        pm_scenes_lamp(s, pm_scenes_wear(s, shell, wear), pm_gray(0.7));
        s->lights[0].extent = 2.0;
    }
    pm_scenes_ready(s);
}

/// Direct light and glints there, with the same draws for every density.
static void ask_dome(int kind, int dome, double sigma_t, double answer[2])
{
    pm_scenes s;
    begin_dome(&s, kind, dome, sigma_t);
    pm_hit hit;
    pm_lobes lobes;
    meet(&s, pm_scenes_slant(0.7), 0, &hit, &lobes);
    answer[0] = pm_receivers_direct(&s, &hit, &lobes, 16, 5);
    lobes.lobe[0].specular = true; // as if it were narrow
    pm_direct_query query = {.world = &s.world, .samples = 16, .step = 1, .shift = {0.3, 0.7}};
    answer[1] = pm_direct_glint(&query, &hit, &lobes).c[0];
    pm_scenes_free(&s);
}

static void domes_of_fog_take_one_share(void)
{
    for (int i = 0; i < RECEIVERS * DOMES; i++) {
        double clear[2];
        ask_dome(i % RECEIVERS, i / RECEIVERS, 0.0, clear);
        CHECK(clear[0] > 0.01);
        CHECK((clear[1] > 0.0) == (i % RECEIVERS != DIFFUSE && i / RECEIVERS != SKY));
        for (double sigma_t = 0.01; sigma_t < 20.0; sigma_t *= 10.0) {
            double fog[2];
            ask_dome(i % RECEIVERS, i / RECEIVERS, sigma_t, fog);
            double share = exp(-1.3 * sigma_t);
            CHECK_NEAR(fog[0], clear[0] * share, 1e-4 * clear[0] * share);
            CHECK_NEAR(fog[1], clear[1] * share, 1e-4 * clear[1] * share);
        }
    }
}

static void endless_fog_hides_the_sky(void)
{
    for (int kind = 0; kind < RECEIVERS; kind++) {
        pm_scenes s;
        pm_scenes_begin(&s);
        int fog = pm_scenes_medium(&s, 1e-3, pm_gray(0.5), 0.0);
        pm_scenes_wear(&s, pm_scenes_square(2.0, 0.0, false), receiver(&s, kind));
        pm_scenes_sky(&s, pm_gray(0.7));
        pm_scenes_ready(&s);
        pm_hit hit;
        pm_lobes lobes;
        meet(&s, pm_scenes_slant(0.7), fog, &hit, &lobes);
        CHECK(pm_receivers_direct(&s, &hit, &lobes, 16, 5) == 0.0);
        s.media[fog].sigma_t = 0.0;
        CHECK(pm_receivers_direct(&s, &hit, &lobes, 16, 5) > 0.01);
        pm_scenes_free(&s);
    }
}

// --- shadow photons -------------------------------------------------------------------------

static void shadow_photons_know_no_fog(void)
{
    // They say "lit" all over the floor; the fog takes its share even so. In deep shadow they
    // spare the ray as ever.
    pm_scenes s;
    begin_under_slab(&s, 0.5);
    s.shapes[0] = pm_scenes_square(4.0, 0.0, false);
    s.shapes[0].material[0] = s.shapes[0].material[1] = 0;
    pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(1.0, 0.0, 0.3), 0.25), 0);
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 2.0), pm_gray(4.0 * PM_PI));
    pm_scenes_ready(&s);
    pm_shadow_maps maps = {0};
    pm_shadow_run photons = {.seed = 1, .count = 60000};
    CHECK_OK(pm_shadow_make(&s.world, &photons, &maps));
    pm_neighbour scratch[PM_SHADOW_K];
    static const double places[2] = {0.0, 1.12};
    for (int i = 0; i < 2; i++) {
        pm_ray ray = {{places[i], 0.0, 0.01}, {0.0, 0.0, -1.0}, HUGE_VAL, 0.0, PM_NONE};
        pm_hit hit;
        pm_lobes lobes;
        CHECK(pm_closest(&s.world, &ray, &hit) && hit.shape == 0);
        pm_material_lobes(&s.scene, &hit, &ray, &lobes);
        pm_direct_query query = {.world = &s.world, .samples = 1, .step = 1};
        pm_direct_query helped = query;
        helped.shadows = &maps;
        helped.scratch = scratch;
        double rays = pm_direct(&query, &hit, &lobes).c[0];
        CHECK((rays > 0.0) == (i == 0));
        CHECK_NEAR(pm_direct(&helped, &hit, &lobes).c[0], rays, 0.0);
        CHECK(helped.spared == (uint64_t)i);
    }
    pm_shadow_free(&maps);
    pm_scenes_free(&s);
}

PM_TESTS({"direct_media.1", "a point light through a slab of fog loses by its depth",
          points_through_slabs},
         {"direct_media.2", "a sun through a slab of fog loses by its depth",
          suns_through_slabs},
         {"direct_media.3", "a floor in the fog of its light is dimmed once",
          floors_in_fog_are_dimmed_once},
         {"direct_media.4", "a lamp in fog is that of the integral, far off and near by",
          lamps_in_fog_are_those_of_the_integral},
         {"direct_media.5",
          "under a dome of light fog takes the same share from every technique",
          domes_of_fog_take_one_share},
         {"direct_media.6", "no sky is seen through endless fog, but through fog of density 0",
          endless_fog_hides_the_sky},
         {"direct_media.7", "shadow photons that say lit do not spare the fog its share",
          shadow_photons_know_no_fog})
