// A scene per class of paths in which only that class carries light, spelled from the light to
// the eye: LDE is direct light, LSDE a caustic. classes.h says what is checked.
//
// Black things (PM_NONE) keep the other classes out. Where a mirror or a pane hangs over a
// floor, it hangs to the side: light leaving the floor would have to meet it halfway back.
#include "classes.h"
#include "references.h"
#include "shapes.h"
#include "test.h"

static const double mirrored = PM_CLASSES_MIRRORED;
static const double map_slack = PM_CLASSES_MAP;
static const double float_slack = PM_CLASSES_FLOAT;

static void emission(void)
{
    const double want[3] = {2.0, 1.0, 0.5};
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_classes_lamp(&s, pm_scenes_square(1.0, 0.0, false));
    pm_classes_look_down(&s, 0.03);
    pm_classes_check(&s, PM_LAYER_EMISSION, want, float_slack);
}

static void direct(void)
{
    const double want[3] = {0.5 / PM_PI * 3.0 * 0.6, 0.5 / PM_PI * 2.0 * 0.6,
                            0.5 / PM_PI * 0.6};
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_classes_floor(&s, 2.0, 0.5);
    pm_scenes_sun(&s, pm_vec(0.0, 0.8, -0.6), pm_rgb(3.0, 2.0, 1.0));
    pm_classes_look_down(&s, 0.03);
    pm_classes_check(&s, PM_LAYER_DIRECT, want, float_slack);
}

/// A floor in slanting sunlight that comes by a thing above it, to one side. The irradiance is
/// that of the sun times the cosine, 1 / sqrt(2), times what the thing lets through.
static void check_sun(pm_scenes *s, pm_vec3 direction, double through)
{
    const double power[3] = {3.0, 2.0, 1.0};
    double want[3];
    for (int c = 0; c < 3; c++) {
        want[c] = 0.5 / PM_PI * power[c] * sqrt(0.5) * through;
    }
    pm_classes_floor(s, 0.8, 0.5);
    pm_scenes_sun(s, direction, pm_rgb(3.0, 2.0, 1.0));
    pm_classes_look_down(s, 0.15);
    pm_classes_check(s, PM_LAYER_CAUSTIC, want, map_slack);
}

// The sun shines up past the floor's edge onto a mirror that faces down.
static void mirror_caustic(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_add(&s, pm_classes_lid(-1.5, -0.5, 1.0), pm_scenes_mirror(&s, pm_gray(mirrored)),
                  PM_NONE);
    check_sun(&s, pm_vec(0.0, 1.0, 1.0), mirrored);
}

/// Unpolarized reflectance of glass of index 1.5 at 45 degrees from outside.
static double reflected_at_45(void)
{
    double outside = sqrt(0.5);
    double inside = sqrt(1.0 - 0.5 / 2.25);
    double across = (outside - 1.5 * inside) / (outside + 1.5 * inside);
    double along = (1.5 * outside - inside) / (1.5 * outside + inside);
    return 0.5 * (across * across + along * along);
}

// Between two faces light goes to and fro: (1 - R)^2 (1 + R^2 + R^4 ...) gets through.
static void pane_caustic(void)
{
    double r = reflected_at_45();
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_wear(&s, pm_classes_lid(-1.5, -0.5, 1.0), pm_scenes_pane(&s, 1.5));
    check_sun(&s, pm_vec(0.0, 1.0, -1.0), (1.0 - r) / (1.0 + r));
}

static void slab_caustic(void)
{
    double r = reflected_at_45();
    pm_scenes s;
    pm_scenes_begin(&s);
    int glass = pm_scenes_glass(&s, 1.5);
    pm_shape top = pm_classes_lid(-1.5, -0.5, 1.01);
    top.flipped = true;
    pm_scenes_wear(&s, top, glass);
    pm_scenes_wear(&s, pm_classes_lid(-1.5, -0.5, 1.0), glass);
    check_sun(&s, pm_vec(0.0, 1.0, -1.0), (1.0 - r) / (1.0 + r));
}

/// A diffuse disk of radius 1 at the height 1 that faces down, over a small floor.
static void ceiling_begin(pm_scenes *s)
{
    pm_scenes_begin(s);
    pm_shape disk = pm_shapes_disk(pm_vec(0.0, 0.0, 1.0), pm_vec(0.0, 0.0, -1.0), 1.0);
    pm_scenes_add(s, disk, pm_scenes_diffuse(s, pm_gray(0.5)), PM_NONE);
    pm_classes_floor(s, 0.4, 0.1);
}

// The sun shines up at a slope at which the floor's shadow misses the disk. A disk of radius h
// at the height h fills half of the floor's sky, weighed by the cosine. What goes to and fro
// between the two is less than 0.001 of it.
static void diffuse_diffuse(void)
{
    double want[3];
    for (int c = 0; c < 3; c++) {
        want[c] = 0.1 / PM_PI * 0.5 * 0.5 * (3.0 - c) / sqrt(5.0);
    }
    pm_scenes s;
    ceiling_begin(&s);
    pm_scenes_sun(&s, pm_vec(0.0, 2.0, 1.0), pm_rgb(3.0, 2.0, 1.0));
    pm_classes_look_down(&s, 0.03);
    pm_classes_check(&s, PM_LAYER_INDIRECT, want, map_slack);
}

// The same disk, lit by way of a mirror in the floor's plane; a black plate keeps the sun off
// the floor.
static void specular_diffuse_diffuse(void)
{
    pm_scenes s;
    ceiling_begin(&s);
    pm_shape ground = pm_classes_lid(-4.0, -0.5, 0.0);
    ground.flipped = true;
    pm_scenes_add(&s, ground, pm_scenes_mirror(&s, pm_gray(mirrored)), PM_NONE);
    pm_shape plate = pm_shapes_rectangle(pm_vec(-0.3, -1.3, 0.5), pm_vec(0.6, 0.0, 0.0),
                                         pm_vec(0.0, 0.6, 0.0));
    pm_scenes_wear(&s, plate, PM_NONE);
    pm_scenes_sun(&s, pm_vec(0.0, 2.0, -1.0), pm_rgb(3.0, 2.0, 1.0));
    pm_classes_look_down(&s, 0.1);
    pm_classes_check(&s, PM_LAYER_INDIRECT, NULL, map_slack);
}

// A lamp close over a diffuse square, and a black wall between both and the floor: only the
// mirror above sees over it.
static void diffuse_specular_diffuse(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_shape lit = pm_shapes_rectangle(pm_vec(-0.5, -2.5, 0.0), pm_vec(1.0, 0.0, 0.0),
                                       pm_vec(0.0, 1.0, 0.0));
    pm_shape lamp = pm_shapes_rectangle(pm_vec(-0.2, -2.2, 0.4), pm_vec(0.0, 0.4, 0.0),
                                        pm_vec(0.4, 0.0, 0.0));
    pm_shape wall = pm_shapes_rectangle(pm_vec(-3.0, -1.0, 0.0), pm_vec(6.0, 0.0, 0.0),
                                        pm_vec(0.0, 0.0, 0.6));
    pm_scenes_add(&s, lit, pm_scenes_diffuse(&s, pm_gray(0.7)), PM_NONE);
    pm_classes_lamp(&s, lamp);
    pm_scenes_wear(&s, wall, PM_NONE);
    pm_scenes_add(&s, pm_classes_lid(-1.8, -0.2, 1.0), pm_scenes_mirror(&s, pm_gray(mirrored)),
                  PM_NONE);
    pm_classes_floor(&s, 0.4, 0.5);
    pm_classes_look_down(&s, 0.03);
    pm_classes_check(&s, PM_LAYER_INDIRECT, NULL, map_slack);
}

static void diffuse_in_a_mirror(void)
{
    double want[3];
    for (int c = 0; c < 3; c++) {
        want[c] = mirrored * 0.5 / PM_PI * (3.0 - c);
    }
    pm_scenes s;
    pm_classes_upright_mirror(&s);
    pm_classes_floor(&s, 1.5, 0.5);
    pm_scenes_sun(&s, pm_vec(0.0, 0.0, -1.0), pm_rgb(3.0, 2.0, 1.0));
    pm_classes_look_at_the_image(&s);
    pm_classes_check(&s, PM_LAYER_SPECULAR, want, map_slack);
}

static void lamp_in_a_mirror(void)
{
    const double want[3] = {2.0 * mirrored, mirrored, 0.5 * mirrored};
    pm_scenes s;
    pm_classes_upright_mirror(&s);
    pm_classes_lamp(&s, pm_scenes_square(1.5, 0.0, false));
    pm_classes_look_at_the_image(&s);
    pm_classes_check(&s, PM_LAYER_SPECULAR, want, float_slack);
}

// Straight through both faces of glass of index 1.5, which throws back 0.04 at each.
static void lamp_through_glass(void)
{
    double through = (1.0 - 0.04) / (1.0 + 0.04);
    const double want[3] = {2.0 * through, through, 0.5 * through};
    pm_scenes s;
    pm_scenes_begin(&s);
    int glass = pm_scenes_glass(&s, 1.5);
    pm_classes_lamp(&s, pm_scenes_square(2.0, 0.0, false));
    pm_scenes_wear(&s, pm_scenes_square(2.0, 0.2, true), glass);
    pm_scenes_wear(&s, pm_scenes_square(2.0, 0.3, false), glass);
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, 0.0, 1.0), pm_vec(0.0, 0.0, 0.0), 1e-3, 4);
    pm_classes_check(&s, PM_LAYER_SPECULAR, want, 1e-5);
}

/// A rough mirror in the floor under a lamp: below a roughness of 0.1 an S event, above one D.
static void check_rough(double alpha, pm_layer layer)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    int metal = pm_scenes_rough_mirror(&s, PM_MICROFACET_GGX, alpha);
    pm_scenes_add(&s, pm_scenes_square(2.0, 0.0, false), metal, PM_NONE);
    pm_classes_lamp(&s, pm_scenes_square(0.8, 1.0, true));
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, -1.0, 0.9), pm_vec(0.0, 0.0, 0.0), 0.3, 6);
    pm_classes_check(&s, layer, NULL, 0.0);
}

static void rough_mirrors(void)
{
    check_rough(0.1, PM_LAYER_SPECULAR);
    check_rough(0.3, PM_LAYER_DIRECT);
}

static void sky_seen(void)
{
    const double want[3] = {1.0, 2.0, 3.0};
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_wear(&s, pm_scenes_square(1.0, 0.0, false), PM_NONE);
    pm_scenes_sky(&s, pm_rgb(1.0, 2.0, 3.0));
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, 0.0, 1.0), pm_vec(0.0, 0.0, 2.0), 0.5, 4);
    pm_classes_check(&s, PM_LAYER_EMISSION, want, float_slack);
}

// Nothing convex lights itself: all that a diffuse ball sends back came straight from the sky.
static void sky_on_a_ball(void)
{
    const double want[3] = {0.6, 1.2, 1.8};
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 1.0),
                   pm_scenes_diffuse(&s, pm_gray(0.6)));
    pm_scenes_sky(&s, pm_rgb(1.0, 2.0, 3.0));
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, -3.0, 0.0), pm_vec(0.0, 0.0, 0.0), 0.2, 6);
    pm_classes_check(&s, PM_LAYER_DIRECT, want, float_slack);
}

static void sky_in_a_mirror(void)
{
    const double want[3] = {mirrored, 2.0 * mirrored, 3.0 * mirrored};
    pm_scenes s;
    pm_classes_upright_mirror(&s);
    pm_scenes_sky(&s, pm_rgb(1.0, 2.0, 3.0));
    pm_classes_look_at_the_image(&s);
    pm_classes_check(&s, PM_LAYER_SPECULAR, want, float_slack);
}

// Under a dome of glass all light of the sky has passed a pane; at the dome's centre it has
// passed it straight. The floor is black but for its middle, which is too small for what the
// dome throws back to count.
static void sky_under_a_dome(void)
{
    double through = (1.0 - 0.04) / (1.0 + 0.04);
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 1.0), pm_scenes_pane(&s, 1.5));
    pm_classes_floor(&s, 0.4, 0.5);
    pm_scenes_sky(&s, pm_rgb(1.0, 2.0, 3.0));
    pm_classes_look_down(&s, 0.03);
    pm_pictures_means truth = pm_references_trace(&s, 1024);
    pm_pictures_means got = pm_pictures_repeat(&s, pm_classes_settings(8), 6);
    CHECK(pm_spectrum_is_black(truth.mean[PM_LAYER_DIRECT]));
    CHECK(pm_spectrum_is_black(got.mean[PM_LAYER_DIRECT]));
    for (int c = 0; c < 3; c++) {
        double want = 0.5 * (c + 1.0) * through;
        CHECK_CLOSE("reference", truth.mean[PM_LAYER_CAUSTIC].c[c], want,
                    truth.variance[PM_LAYER_CAUSTIC].c[c], 1e-4);
        CHECK_CLOSE("render", got.mean[PM_LAYER_CAUSTIC].c[c], want,
                    got.variance[PM_LAYER_CAUSTIC].c[c], map_slack);
    }
    pm_scenes_free(&s);
}

PM_TESTS({"path_classes.1", "LE is emission alone", emission},
         {"path_classes.2", "LDE is direct light alone", direct},
         {"path_classes.3", "LSDE by a mirror is a caustic alone, of closed form",
          mirror_caustic},
         {"path_classes.4", "LSDE by a pane is a caustic alone, of closed form", pane_caustic},
         {"path_classes.5", "LSSDE by a slab is a caustic alone, of closed form", slab_caustic},
         {"path_classes.6", "LDDE is indirect alone, of closed form", diffuse_diffuse},
         {"path_classes.7", "LSDDE is indirect alone", specular_diffuse_diffuse},
         {"path_classes.8", "LDSDE is indirect alone", diffuse_specular_diffuse},
         {"path_classes.9", "LDSE is specular alone, of closed form", diffuse_in_a_mirror},
         {"path_classes.10", "LSE is specular alone, of closed form", lamp_in_a_mirror},
         {"path_classes.11", "LSSE is specular alone, of closed form", lamp_through_glass},
         {"path_classes.12", "a lamp in a rough mirror is specular, in a rougher one direct",
          rough_mirrors},
         {"path_classes.13", "the sky seen is emission alone", sky_seen},
         {"path_classes.14", "the sky on a ball is direct light alone", sky_on_a_ball},
         {"path_classes.15", "the sky in a mirror is specular alone", sky_in_a_mirror},
         {"path_classes.16", "the sky through a dome of glass is a caustic of closed form",
          sky_under_a_dome})
