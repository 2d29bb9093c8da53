// Looks: drawn by lobes or by the cosine, they see the same sky.
#include "chance.h"
#include "look.h"
#include "scenes.h"
#include "test.h"

enum { LOOKS = 40000 };

typedef struct {
    pm_spectrum sum, square;
} sums;

/// Adds a look at a sky that is brighter towards +x.
static void add(sums *to, const pm_look *look)
{
    double sky = 1.0 + look->wo.x;
    for (int c = 0; c < 3; c++) {
        double seen = look->response.c[c] * sky;
        to->sum.c[c] += seen;
        to->square.c[c] += seen * seen;
    }
}

static void check_same(const sums *a, const sums *b)
{
    for (int c = 0; c < 3; c++) {
        double mean = a->sum.c[c] / LOOKS;
        double other = b->sum.c[c] / LOOKS;
        double variance = a->square.c[c] / LOOKS - mean * mean;
        variance += b->square.c[c] / LOOKS - other * other;
        CHECK_NEAR(mean, other, pm_chance_bound(variance, LOOKS));
    }
}

static void lobes_and_cosine_see_the_same(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_spectrum gold = pm_rgb(0.2, 0.9, 1.4);
    const int materials[] = {
        pm_scenes_diffuse(&s, pm_rgb(0.7, 0.4, 0.1)),
        pm_scenes_plastic(&s, pm_rgb(0.7, 0.4, 0.0), 1.5),
        pm_scenes_rough_metal(&s, gold, pm_gray(3.0), 0.4),
        pm_scenes_rough_plastic(&s, pm_rgb(0.6, 0.3, 0.1), 1.5, PM_MICROFACET_GGX, 0.5),
        pm_scenes_rough_plastic(&s, pm_gray(0.0), 1.5, PM_MICROFACET_BECKMANN, 0.3),
    };
    pm_scenes_sheet(&s, materials[0], materials[0]);
    for (int m = 0; m < 5; m++) {
        s.shapes[0].material[0] = materials[m];
        pm_lobes lobes = pm_scenes_lobes(&s, pm_scenes_slant(0.6));
        CHECK(pm_look_albedo(&lobes) > 0.0);
        sums by_lobe = {0};
        sums by_cosine = {0};
        const pm_rng_source source = {.seed = 41, .stream = PM_STREAM_TEST};
        pm_rng rng = pm_rng_at(&source, (uint64_t)m, 0);
        for (int i = 0; i < LOOKS; i++) {
            double u[2];
            u[0] = pm_rng_draw(&rng);
            u[1] = pm_rng_draw(&rng);
            pm_look look = pm_look_by_cosine(&lobes, u);
            add(&by_cosine, &look);
            look = pm_look_by_lobe(&lobes, &rng);
            add(&by_lobe, &look);
        }
        check_same(&by_lobe, &by_cosine);
    }
    pm_scenes_free(&s);
}

static void mirrors_and_black_look_for_nothing(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    int mirror = pm_scenes_rough_mirror(&s, PM_MICROFACET_GGX, 0.05);
    int black = pm_scenes_diffuse(&s, pm_gray(0.0));
    pm_scenes_sheet(&s, mirror, black);
    pm_lobes shiny = pm_scenes_lobes(&s, pm_scenes_slant(0.6));
    pm_lobes dull = pm_scenes_lobes(&s, pm_scenes_slant(-0.6));
    CHECK(shiny.count == 1 && dull.count == 1);
    CHECK_NEAR(pm_look_albedo(&shiny), 0.0, 0.0);
    CHECK_NEAR(pm_look_albedo(&dull), 0.0, 0.0);
    pm_scenes_free(&s);
}

PM_TESTS({"look.1", "looks by lobes and by the cosine have one mean",
          lobes_and_cosine_see_the_same},
         {"look.2", "rough mirrors and black surfaces look for nothing",
          mirrors_and_black_look_for_nothing})
