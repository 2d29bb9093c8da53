// Composing around rough mirrors and under a sky: who is asked, for which layer, and what a
// vertex knows of the ray that met it.
#include "chance.h"
#include "desk.h"
#include "light.h"
#include "shapes.h"
#include "test.h"

static const pm_vec3 middle = {0.0, 0.0, 0.0};
static const pm_vec3 up = {0.0, 0.0, 1.0};
static const pm_vec3 down = {0.0, 0.0, -1.0};

/// A diffuse lamp below that faces up, and something else above.
static void begin(pm_desk *d, int above)
{
    int white = pm_scenes_diffuse(&d->s, pm_gray(0.5));
    int lamp = pm_scenes_wear(&d->s, pm_scenes_square(4.0, -1.0, false), white);
    pm_scenes_lamp(&d->s, lamp, pm_gray(1.0));
    pm_scenes_wear(&d->s, pm_scenes_square(4.0, 1.0, true), above);
}

// --- sky -------------------------------------------------------------------------------------

static void sky_is_emission_or_shown_by_mirrors(void)
{
    pm_desk d = {.sky = 7.0};
    pm_scenes_begin(&d.s);
    begin(&d, pm_scenes_mirror(&d.s, pm_gray(0.5)));
    int null = pm_scenes_null(&d.s);
    pm_scenes_wear(&d.s, pm_shapes_sphere(middle, 5.0), null);
    pm_desk_ready(&d);
    pm_eye seen = pm_desk_look(&d, middle, pm_vec(1.0, 0.0, 0.0), 0);
    CHECK_NEAR(seen.layer[PM_LAYER_EMISSION].c[0], 7.0, 1e-12);
    CHECK_NEAR(seen.layer[PM_LAYER_SPECULAR].c[0], 0.0, 0.0);
    CHECK(seen.emitter && !seen.hit);

    pm_eye shown = pm_desk_look(&d, pm_vec(0.0, -10.0, -4.0), pm_vec(0.0, 0.0, 1.0), 0);
    CHECK_NEAR(shown.layer[PM_LAYER_EMISSION].c[0], 0.0, 0.0);
    CHECK_NEAR(shown.layer[PM_LAYER_SPECULAR].c[0], 0.5 * 7.0, 1e-12);
    CHECK(shown.emitter && shown.hit);

    pm_eye floor = pm_desk_look(&d, middle, pm_vec(0.1, 0.0, -1.0), 0);
    CHECK_NEAR(floor.layer[PM_LAYER_EMISSION].c[0], PM_DESK_EMITTED, 0.0);
    pm_scenes_free(&d.s);
}

static void black_sky_leaves_no_mask(void)
{
    pm_desk d = {.sky = 0.0};
    pm_scenes_begin(&d.s);
    begin(&d, pm_scenes_mirror(&d.s, pm_gray(0.5)));
    pm_desk_ready(&d);
    CHECK(!pm_desk_look(&d, middle, pm_vec(1.0, 0.0, 0.0), 0).emitter);
    d.sky = 1.0;
    d.compose.wanted[PM_LAYER_EMISSION] = false;
    pm_eye unwanted = pm_desk_look(&d, middle, pm_vec(1.0, 0.0, 0.0), 0);
    CHECK(unwanted.emitter && pm_spectrum_is_black(unwanted.layer[PM_LAYER_EMISSION]));
    d.compose.ask.sky = NULL;
    CHECK(!pm_desk_look(&d, middle, pm_vec(1.0, 0.0, 0.0), 0).emitter);
    pm_scenes_free(&d.s);
}

static void gather_rays_see_no_sky(void)
{
    pm_desk d = {.sky = 7.0};
    pm_scenes_begin(&d.s);
    begin(&d, pm_scenes_mirror(&d.s, pm_gray(1.0)));
    pm_desk_ready(&d);
    CHECK_NEAR(pm_desk_gather(&d, middle, pm_vec(1.0, 0.0, 0.0), 0), 0.0, 0.0);
    CHECK_NEAR(pm_desk_gather(&d, middle, pm_vec(1.9, 0.0, 1.0), 0), 0.0, 0.0); // mirrored
    CHECK_NEAR(pm_desk_gather(&d, middle, down, 0), PM_DESK_GLOBAL, 0.0);
    pm_scenes_free(&d.s);
}

// --- rough mirrors ---------------------------------------------------------------------------

static void glint_is_asked_at_rough_mirrors_only(void)
{
    pm_desk d = {0};
    pm_scenes_begin(&d.s);
    begin(&d, pm_scenes_rough_mirror(&d.s, PM_MICROFACET_GGX, 0.05));
    pm_desk_ready(&d);
    pm_eye eye = pm_desk_look(&d, middle, up, 0);
    CHECK(d.glint == 1 && d.direct == 1); // the second at the lamp below
    CHECK(eye.layer[PM_LAYER_SPECULAR].c[0] > PM_DESK_GLINT);
    CHECK_NEAR(eye.layer[PM_LAYER_DIRECT].c[0], 0.0, 0.0);
    pm_desk_look(&d, middle, down, 0);
    CHECK(d.glint == 1);

    d.compose.wanted[PM_LAYER_SPECULAR] = false;
    pm_desk_look(&d, middle, up, 0);
    CHECK(d.glint == 1);
    d.compose.wanted[PM_LAYER_SPECULAR] = true;
    d.compose.max_specular = 0; // the S event that a glint stands for is cut as well
    eye = pm_desk_look(&d, middle, up, 0);
    CHECK(d.glint == 1 && eye.cut == 1);
    pm_scenes_free(&d.s);
}

static void smooth_and_wide_lobes_have_no_glint(void)
{
    pm_desk d = {0};
    pm_scenes_begin(&d.s);
    begin(&d, pm_scenes_mirror(&d.s, pm_gray(1.0)));
    pm_desk_ready(&d);
    pm_desk_look(&d, middle, up, 0);
    int wide = pm_scenes_rough_mirror(&d.s, PM_MICROFACET_BECKMANN, 0.3);
    d.s.shapes[1].material[0] = wide;
    pm_eye eye = pm_desk_look(&d, middle, up, 0);
    CHECK(d.glint == 0);
    CHECK_NEAR(eye.layer[PM_LAYER_DIRECT].c[0], PM_DESK_DIRECT, 0.0);
    CHECK(eye.vertices == 1); // its lobe is D: the path ends
    pm_scenes_free(&d.s);
}

static void a_vertex_knows_the_ray_that_met_it(void)
{
    pm_desk d = {0};
    pm_scenes_begin(&d.s);
    begin(&d, pm_scenes_rough_mirror(&d.s, PM_MICROFACET_GGX, 0.05));
    int null = pm_scenes_null(&d.s);
    pm_scenes_wear(&d.s, pm_scenes_square(4.0, -0.5, false), null);
    pm_scenes_wear(&d.s, pm_scenes_square(4.0, 0.5, false), null);
    pm_desk_ready(&d);
    pm_desk_look(&d, middle, down, 0);
    CHECK_NEAR(d.lamp.pdf, 0.0, 0.0);
    CHECK_NEAR(d.lamp.from.z, 0.0, 0.0); // the eye, not the pane

    pm_desk_look(&d, middle, up, 0);
    CHECK_NEAR(d.lamp.from.z, 1.0, 1e-12); // the rough mirror
    pm_hit hit = {.normal = down, .shape = 1};
    pm_lobes lobes;
    pm_ray along = {.direction = pm_vec_negate(down), .medium = PM_NONE};
    pm_material_lobes(&d.s.scene, &hit, &along, &lobes);
    double pdf = pm_material_pdf(&lobes, 0, pm_vec_negate(d.lamp.lobes.wi));
    CHECK(pdf > 0.0);
    CHECK_NEAR(d.lamp.pdf, pdf, 1e-9 * pdf);

    int mirror = pm_scenes_mirror(&d.s, pm_gray(1.0));
    d.s.shapes[1].material[0] = mirror;
    pm_desk_look(&d, middle, up, 0);
    CHECK_NEAR(d.lamp.pdf, 0.0, 0.0);
    pm_scenes_free(&d.s);
}

PM_TESTS({"compose.15", "the sky is emission, what mirrors show of it specular, and both mask",
          sky_is_emission_or_shown_by_mirrors},
         {"compose.16", "a black sky masks nothing; one that is not wanted masks all the same",
          black_sky_leaves_no_mask},
         {"compose.17", "gather rays add nothing from the sky", gather_rays_see_no_sky},
         {"compose.18", "glints are asked for at rough mirrors, into specular, within the cap",
          glint_is_asked_at_rough_mirrors_only},
         {"compose.19", "smooth mirrors and wide lobes are not asked for glints",
          smooth_and_wide_lobes_have_no_glint},
         {"compose.20", "a vertex knows where its ray last turned, and by what density",
          a_vertex_knows_the_ray_that_met_it})
