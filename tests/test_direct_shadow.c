// Direct light with the help of shadow photons: how many rays that spares, and what it costs in
// accuracy, against rays to the same points of the lamps.
#include "direct.h"

#include "scenes.h"
#include "shapes.h"
#include "test.h"

/// A floor of side 2 at z = 0 and, above its middle at height 1/2, a square of side `blocker`.
static void begin_floor(pm_scenes *s, double blocker)
{
    pm_scenes_begin(s);
    int gray = pm_scenes_diffuse(s, pm_gray(0.5));
    pm_scenes_wear(s, pm_scenes_square(2.0, 0.0, false), gray);
    if (blocker > 0.0) {
        pm_scenes_wear(s, pm_scenes_square(blocker, 0.5, false), gray);
    }
}

static void add_lamp(pm_scenes *s)
{
    int lamp = pm_scenes_add(s, pm_scenes_square(0.3, 1.0, true), PM_NONE, PM_NONE);
    pm_scenes_lamp(s, lamp, pm_gray(1.0));
}

static void make(pm_scenes *s, uint64_t count, pm_shadow_maps *maps)
{
    pm_scenes_ready(s);
    CHECK_OK(pm_shadow_make(&s->world, &(pm_shadow_run){.seed = 1, .count = count}, maps));
}

static void done(pm_scenes *s, pm_shadow_maps *maps)
{
    pm_shadow_free(maps);
    pm_scenes_free(s);
}

/// Direct light on a grid over the floor, by rays and by shadow photons.
typedef struct {
    double spared; // share of the rays
    double rms;    // of the difference, over the mean by rays
    double bias;   // mean difference, over that mean
    double wrong;  // share of the points that differ
    double mean;   // by rays
} comparison;

enum { SIDE = 40, POINTS = 16 };

/// One point of the grid, off the symmetries of the scene.
static void visit(const pm_scenes *s, const pm_shadow_maps *maps, int i, double value[2],
                  uint64_t rays[2])
{
    pm_vec3 above = pm_vec(-1.0 + 2.0 * (i % SIDE + 0.43) / SIDE,
                           -1.0 + 2.0 * (i / SIDE + 0.38) / SIDE, 0.25);
    pm_ray ray = {above, pm_vec(0.0, 0.0, -1.0), HUGE_VAL, 0.0, PM_NONE};
    pm_hit hit;
    pm_lobes lobes;
    CHECK(pm_closest(&s->world, &ray, &hit));
    pm_material_lobes(&s->scene, &hit, &ray, &lobes);
    pm_neighbour scratch[PM_SHADOW_K];
    pm_direct_query query = {.world = &s->world, .samples = POINTS, .step = 1};
    value[0] = pm_direct(&query, &hit, &lobes).c[0];
    uint64_t all = query.rays;
    query.rays = 0;
    query.shadows = maps;
    query.scratch = scratch;
    value[1] = pm_direct(&query, &hit, &lobes).c[0];
    CHECK(query.rays + query.spared == all);
    rays[0] += query.rays;
    rays[1] += query.spared;
}

static comparison compare(pm_scenes *s, uint64_t photons)
{
    pm_shadow_maps maps;
    make(s, photons, &maps);
    comparison c = {0};
    uint64_t rays[2] = {0, 0};
    for (int i = 0; i < SIDE * SIDE; i++) {
        double value[2];
        visit(s, &maps, i, value, rays);
        double off = value[1] - value[0];
        c.mean += value[0] / (SIDE * SIDE);
        c.bias += off / (SIDE * SIDE);
        c.rms += off * off / (SIDE * SIDE);
        c.wrong += (off != 0.0) / (double)(SIDE * SIDE);
    }
    c.rms = sqrt(c.rms) / c.mean;
    c.bias /= c.mean;
    c.spared = (double)rays[1] / (double)(rays[0] + rays[1]);
    done(s, &maps);
    return c;
}

static void check_worth(const char *what, comparison c, double spared, double rms)
{
    CHECK_THAT(c.spared >= spared && c.rms <= rms && fabs(c.bias) <= 0.3 * rms && c.mean > 0.0,
               "%s: %g of the rays spared, rms %g, bias %g, %g of the points differ", what,
               c.spared, c.rms, c.bias, c.wrong);
}

static void an_empty_floor_spares_all(void)
{
    for (int light = 0; light < 3; light++) {
        pm_scenes s;
        begin_floor(&s, 0.0);
        if (light == 0) {
            add_lamp(&s);
        } else if (light == 1) {
            pm_scenes_point(&s, pm_vec(0.2, 0.0, 1.0), pm_gray(1.0));
        } else {
            pm_scenes_sun(&s, pm_vec(0.3, 0.1, -1.0), pm_gray(1.0));
        }
        check_worth("an empty floor", compare(&s, 20000), 1.0, 0.0);
    }
}

static void hard_shadows_are_exact(void)
{
    // Rays are asked only near the edge of the shadow, and nothing differs.
    pm_scenes s;
    begin_floor(&s, 0.6);
    pm_scenes_sun(&s, pm_vec(0.1, 0.2, -1.0), pm_gray(1.0));
    check_worth("a hard shadow", compare(&s, 100000), 0.94, 0.0);
}

static void soft_shadows_are_nearly_right(void)
{
    // A penumbra 0.3 wide all around: half of it or more must still be asked by rays.
    pm_scenes s;
    begin_floor(&s, 0.3);
    add_lamp(&s);
    comparison c = compare(&s, 50000);
    check_worth("a soft shadow", c, 0.75, 0.015);
    CHECK(c.wrong < 0.015);
}

static void glossy_lamps_are_shared_out_alike(void)
{
    // What shadow photons spare are rays to points; a glossy lobe's own rays are shot.
    pm_scenes s;
    begin_floor(&s, 0.0);
    s.shapes[0].material[0] = pm_scenes_rough_mirror(&s, PM_MICROFACET_GGX, 0.5);
    add_lamp(&s);
    pm_shadow_maps maps;
    make(&s, 20000, &maps);
    pm_hit hit;
    pm_lobes lobes;
    pm_ray ray = {pm_vec(0.1, 0.0, 0.5), pm_vec(0.0, 0.0, -1.0), HUGE_VAL, 0.0, PM_NONE};
    CHECK(pm_closest(&s.world, &ray, &hit));
    pm_material_lobes(&s.scene, &hit, &ray, &lobes);
    pm_neighbour scratch[PM_SHADOW_K];
    pm_direct_query rays = {.world = &s.world, .samples = 8, .step = 1};
    pm_direct_query photons = rays;
    photons.shadows = &maps;
    photons.scratch = scratch;
    double want = pm_direct(&rays, &hit, &lobes).c[0];
    CHECK(want > 0.0);
    CHECK_NEAR(pm_direct(&photons, &hit, &lobes).c[0], want, 0.0);
    CHECK(photons.spared == 8 && photons.rays > 0 && rays.rays == photons.rays + 8);
    done(&s, &maps);
}

PM_TESTS({"direct_shadow.1", "an empty floor needs no ray and loses nothing",
          an_empty_floor_spares_all},
         {"direct_shadow.2", "hard shadows need rays at their edges only, and stay exact",
          hard_shadows_are_exact},
         {"direct_shadow.3", "soft shadows are nearly those of rays",
          soft_shadows_are_nearly_right},
         {"direct_shadow.4", "glossy lobes keep their own rays",
          glossy_lamps_are_shared_out_alike})
