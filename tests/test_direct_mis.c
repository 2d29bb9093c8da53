// Direct light where two techniques share the work: glossy surfaces under lamps. The oracle is
// either technique alone.
#include "direct.h"

#include "light.h"
#include "receivers.h"
#include "scenes.h"
#include "shapes.h"
#include "tally.h"
#include "test.h"

static const pm_vec3 origin = {0.0, 0.0, 0.0};

// --- either technique alone -----------------------------------------------------------------

/// One point on lamp `light`, weighed in full; `only` a lobe.
static double by_light(const pm_scenes *s, int light, const pm_hit *hit, const pm_lobes *lobes,
                       int only, pm_rng *rng)
{
    double u[2];
    u[0] = pm_rng_draw(rng);
    u[1] = pm_rng_draw(rng);
    pm_light_sample sample;
    if (!pm_light_sample_from(&s->scene, &s->lights[light], hit->position, u, &sample)) {
        return 0.0;
    }
    pm_ray ray = pm_hit_ray(hit, sample.direction, 0.0, PM_NONE);
    pm_vec3 way = pm_vec_sub(sample.target, ray.origin);
    ray.t_max = pm_vec_length(way);
    ray.direction = pm_vec_scale(way, 1.0 / ray.t_max);
    if (pm_blocked(&s->world, &ray)) {
        return 0.0;
    }
    double cosine = pm_most(0.0, pm_vec_dot(sample.direction, lobes->normal));
    return pm_material_value(lobes, only, sample.direction).c[0] * cosine *
           sample.radiance.c[0];
}

/// One direction of a lobe, followed through null surfaces to its end; lamps count by `share`,
/// or in full without.
static double by_lobe(const pm_scenes *s, const pm_hit *hit, const pm_lobes *lobes, int which,
                      bool share, pm_rng *rng)
{
    pm_scatter scatter;
    pm_material_sample(lobes, which, rng, &scatter);
    double weight = lobes->lobe[which].albedo.c[0] * scatter.weight.c[0];
    pm_ray ray = pm_hit_ray(hit, scatter.wo, 0.0, PM_NONE);
    double seen = 0.0;
    pm_hit met;
    while (pm_closest(&s->world, &ray, &met)) {
        double lamp = pm_light_emitted(&s->scene, &met, pm_vec_negate(scatter.wo)).c[0];
        double other = pm_light_pdf(&s->scene, &met, hit->position, scatter.wo);
        seen += share ? lamp * scatter.pdf / (scatter.pdf + other) : lamp;
        int material = s->shapes[met.shape].material[0];
        if (material == PM_NONE || s->materials[material].type != PM_BSDF_NULL) {
            return weight * seen;
        }
        ray = pm_hit_ray(&met, scatter.wo, 0.0, PM_NONE);
    }
    return weight * (seen + pm_light_sky(&s->scene).c[0]);
}

// --- lamps ----------------------------------------------------------------------------------

/// A rough mirror in the origin and a square lamp of radiance 3 at height 1, moved along x to
/// where `wi` mirrors to.
static void begin_gloss(pm_scenes *s, pm_microfacet_kind kind, double alpha, double width)
{
    pm_scenes_begin(s);
    int mirror = pm_scenes_rough_mirror(s, kind, alpha);
    pm_scenes_wear(s, pm_scenes_square(20.0, 0.0, false), mirror);
    pm_shape lamp = pm_scenes_square(width, 1.0, true);
    lamp.corner = pm_vec_sub(lamp.corner, pm_vec(0.5, 0.6, 0.0));
    pm_scenes_lamp(s, pm_scenes_add(s, lamp, PM_NONE, PM_NONE), pm_gray(3.0));
    pm_scenes_ready(s);
}

enum { RUNS = 6000 };

/// All three ways on one scene, two draws each.
static void compare_ways(const pm_scenes *s, int lamps, pm_tally *both, pm_tally *lights,
                         pm_tally *lobe)
{
    pm_hit hit;
    pm_lobes lobes;
    pm_receivers_meet(s, pm_scenes_slant(0.8), &hit, &lobes);
    CHECK(lobes.diffuse && lobes.count == 1);
    *both = *lights = *lobe = (pm_tally){0};
    for (uint64_t run = 0; run < RUNS; run++) {
        pm_rng rng = pm_rng_at(&pm_receivers_source, run, 2);
        pm_tally_take(both, pm_receivers_direct(s, &hit, &lobes, 1, run));
        double sum = 0.0;
        for (int i = 0; i < 2 * lamps; i++) {
            sum += 0.5 * by_light(s, i % lamps, &hit, &lobes, 0, &rng);
        }
        pm_tally_take(lights, sum);
        double first = by_lobe(s, &hit, &lobes, 0, false, &rng);
        double second = by_lobe(s, &hit, &lobes, 0, false, &rng);
        pm_tally_take(lobe, 0.5 * (first + second));
    }
}

static void gloss_agrees_with_either_way(void)
{
    static const struct {
        double alpha, width;
    } cases[5] = {{0.15, 0.25}, {0.15, 1.0}, {0.15, 3.0}, {0.5, 0.5}, {0.5, 3.0}};
    for (int i = 0; i < 10; i++) {
        pm_scenes s;
        pm_tally both, lights, lobe;
        pm_microfacet_kind kind = i < 5 ? PM_MICROFACET_GGX : PM_MICROFACET_BECKMANN;
        begin_gloss(&s, kind, cases[i % 5].alpha, cases[i % 5].width);
        compare_ways(&s, 1, &both, &lights, &lobe);
        double worse = pm_most(pm_tally_variance(&lights), pm_tally_variance(&lobe));
        pm_tally_same("lights", &both, &lights);
        pm_tally_same("lobe", &both, &lobe);
        CHECK_THAT(pm_tally_variance(&both) < 0.7 * worse,
                   "variance %g, of lights %g, of lobe %g", pm_tally_variance(&both),
                   pm_tally_variance(&lights), pm_tally_variance(&lobe));
        pm_scenes_free(&s);
    }
}

/// Two lamps, one above the other; the lower one wears `material`.
static void check_stack(bool null_below)
{
    pm_scenes s;
    begin_gloss(&s, PM_MICROFACET_GGX, 0.3, 1.0);
    pm_shape higher = pm_scenes_square(2.5, 1.5, true);
    pm_scenes_lamp(&s, pm_scenes_add(&s, higher, PM_NONE, PM_NONE), pm_gray(2.0));
    int null = pm_scenes_null(&s);
    s.shapes[1].material[0] = s.shapes[1].material[1] = null_below ? null : PM_NONE;
    pm_tally both, lights, lobe;
    compare_ways(&s, 2, &both, &lights, &lobe);
    pm_tally_same("lights", &both, &lights);
    pm_tally_same("lobe", &both, &lobe);
    pm_scenes_free(&s);
}

static void lamps_behind_lamps(void)
{
    check_stack(false);
    check_stack(true);
}

static void lights_without_extent_come_in_full(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    int mirror = pm_scenes_rough_mirror(&s, PM_MICROFACET_GGX, 0.2);
    pm_scenes_wear(&s, pm_scenes_square(20.0, 0.0, false), mirror);
    const double cone[2] = {0.5, 1.0};
    pm_scenes_spot(&s, pm_vec(-1.0, -0.6, 2.0), pm_vec(0.5, 0.3, -1.0), cone, pm_gray(3.0));
    pm_scenes_point(&s, pm_vec(-0.4, -0.5, 2.0), pm_gray(5.0));
    pm_scenes_sun(&s, pm_vec(0.7, 0.6, -1.0), pm_gray(0.5));
    pm_scenes_ready(&s);
    pm_hit hit;
    pm_lobes lobes;
    pm_receivers_meet(&s, pm_scenes_slant(0.8), &hit, &lobes);
    double want = 0.0;
    for (int i = 0; i < 3; i++) {
        const double u[2] = {0.0, 0.0};
        pm_light_sample sample;
        CHECK(pm_light_sample_from(&s.scene, &s.lights[i], origin, u, &sample));
        want += pm_material_evaluate(&lobes, sample.direction).c[0] * sample.direction.z *
                sample.radiance.c[0];
    }
    pm_direct_query query = {.world = &s.world, .samples = 64, .step = 1};
    CHECK(want > 0.1);
    CHECK_NEAR(pm_direct(&query, &hit, &lobes).c[0], want, 1e-5 * want);
    CHECK(query.rays == 3); // no lamp, no sky: no direction is drawn
    pm_scenes_free(&s);
}

// --- glints ---------------------------------------------------------------------------------

static double by_glint(const pm_scenes *s, const pm_hit *hit, const pm_lobes *lobes,
                       uint64_t run, uint64_t *rays)
{
    pm_direct_query query = {.world = &s->world, .samples = 4, .step = 1};
    pm_rng rng = pm_rng_at(&pm_receivers_source, run, 0);
    query.shift[0] = pm_rng_draw(&rng);
    query.shift[1] = pm_rng_draw(&rng);
    double glint = pm_direct_glint(&query, hit, lobes).c[0];
    *rays += query.rays;
    return glint;
}

static void glint_and_lobe_make_the_whole(void)
{
    static const double widths[3] = {0.1, 0.5, 3.0};
    for (int i = 0; i < 3; i++) {
        pm_scenes s;
        begin_gloss(&s, PM_MICROFACET_BECKMANN, 0.08, widths[i]);
        pm_scenes_sky(&s, pm_gray(0.1));
        pm_hit hit;
        pm_lobes lobes;
        pm_receivers_meet(&s, pm_scenes_slant(0.8), &hit, &lobes);
        CHECK(lobes.count == 1 && lobes.lobe[0].specular && !lobes.diffuse);
        pm_tally shared = {0};
        pm_tally whole = {0};
        double glints = 0.0;
        uint64_t rays = 0;
        for (uint64_t run = 0; run < RUNS; run++) {
            pm_rng rng = pm_rng_at(&pm_receivers_source, run, 2);
            double glint = by_glint(&s, &hit, &lobes, run, &rays);
            pm_tally_take(&shared, glint + by_lobe(&s, &hit, &lobes, 0, true, &rng));
            pm_tally_take(&whole, by_lobe(&s, &hit, &lobes, 0, false, &rng));
            glints += glint;
        }
        pm_tally_same("glint and lobe", &shared, &whole);
        CHECK(glints > 0.001 * whole.sum && glints < 0.999 * whole.sum);
        CHECK(i > 0 || pm_tally_variance(&shared) < 0.1 * pm_tally_variance(&whole));
        CHECK(rays > RUNS);
        CHECK(pm_receivers_direct(&s, &hit, &lobes, 4, 0) == 0.0); // no D lobe
        pm_scenes_free(&s);
    }
}

static void glints_need_a_rough_mirror(void)
{
    // Diffuse, smooth and rough enough to be D: nothing, and no ray.
    for (int i = 0; i < 4; i++) {
        pm_scenes s;
        begin_gloss(&s, PM_MICROFACET_GGX, 0.2, 1.0);
        int other[3] = {pm_scenes_diffuse(&s, pm_gray(0.5)), pm_scenes_mirror(&s, pm_gray(1.0)),
                        pm_scenes_plastic(&s, pm_gray(0.5), 1.5)};
        if (i < 3) {
            s.shapes[0].material[0] = other[i];
        }
        pm_hit hit;
        pm_lobes lobes;
        pm_receivers_meet(&s, pm_scenes_slant(0.8), &hit, &lobes);
        uint64_t rays = 0;
        CHECK(by_glint(&s, &hit, &lobes, 1, &rays) == 0.0 && rays == 0);
        pm_scenes_free(&s);
    }
}

// --- bookkeeping ----------------------------------------------------------------------------

static void plain_surfaces_pay_nothing(void)
{
    // A diffuse floor under a lamp: one ray a point and not one random number.
    pm_scenes s;
    begin_gloss(&s, PM_MICROFACET_GGX, 0.2, 1.0);
    s.shapes[0].material[0] = pm_scenes_diffuse(&s, pm_gray(0.5));
    pm_hit hit;
    pm_lobes lobes;
    pm_receivers_meet(&s, pm_scenes_slant(0.8), &hit, &lobes);
    pm_direct_query query = {.world = &s.world, .samples = 9, .step = 1};
    query.rng = pm_rng_at(&pm_receivers_source, 5, 5);
    pm_rng before = query.rng;
    CHECK(pm_direct(&query, &hit, &lobes).c[0] > 0.0);
    CHECK(query.rays == 9 && query.spared == 0);
    CHECK(pm_rng_draw(&before) == pm_rng_draw(&query.rng));
    pm_scenes_free(&s);
}

static void weights_add_up(void)
{
    static const double pdfs[6] = {1e-310, 1e-9, 1.0, 1e9, 1e300, HUGE_VAL};
    for (int i = 0; i < 6; i++) {
        CHECK(pm_direct_weight(pdfs[i], 0.0) == 1.0 && pm_direct_weight(0.0, pdfs[i]) == 0.0);
        for (int j = 0; j < 5; j++) {
            double sum =
                pm_direct_weight(pdfs[i], pdfs[j]) + pm_direct_weight(pdfs[j], pdfs[i]);
            CHECK_NEAR(sum, 1.0, 1e-15);
        }
    }
}

PM_TESTS({"direct_mis.1", "glossy light agrees with either technique alone, and is calmer",
          gloss_agrees_with_either_way},
         {"direct_mis.2", "a lamp hides the one behind it, unless its surface is null",
          lamps_behind_lamps},
         {"direct_mis.3", "lights without extent come in full, by one ray each",
          lights_without_extent_come_in_full},
         {"direct_mis.4", "glint and the lamps that the lobe meets make the whole",
          glint_and_lobe_make_the_whole},
         {"direct_mis.5", "only rough mirrors have glints", glints_need_a_rough_mirror},
         {"direct_mis.6", "a diffuse floor under a lamp costs one ray a point",
          plain_surfaces_pay_nothing},
         {"direct_mis.7", "the two shares of a direction add up to 1", weights_add_up})
