// What is left of light along a ray that ends: closed forms through slabs, balls in balls and
// past their edges, and what a null surface near the end may do to it.
#include "medium.h"

#include "scenes.h"
#include "shapes.h"
#include "test.h"

static pm_ray ray_to(pm_vec3 from, pm_vec3 to, int medium)
{
    pm_vec3 way = pm_vec_sub(to, from);
    double t_max = pm_vec_length(way);
    return (pm_ray){from, pm_vec_scale(way, 1.0 / t_max), t_max, 0.0, medium};
}

/// Share of light that gets from one point to the other, which starts in `medium`.
static double clear(const pm_scenes *s, pm_vec3 from, pm_vec3 to, int medium)
{
    pm_ray ray = ray_to(from, to, medium);
    return pm_medium_clear(&s->world, &ray);
}

static double clear_endless(const pm_scenes *s, pm_vec3 from, pm_vec3 direction, int medium)
{
    pm_ray ray = {from, pm_vec_normalize(direction), HUGE_VAL, 0.0, medium};
    return pm_medium_clear(&s->world, &ray);
}

/// Squares across z at heights 0 and 1 with this much extinction between them.
static void begin_slab(pm_scenes *s, double sigma_t)
{
    pm_scenes_begin(s);
    int fog = pm_scenes_medium(s, sigma_t, pm_gray(0.5), 0.0);
    pm_scenes_bound(s, pm_scenes_square(1000.0, 0.0, true), fog, PM_NONE);
    pm_scenes_bound(s, pm_scenes_square(1000.0, 1.0, false), fog, PM_NONE);
}

static void slabs_take_by_their_depth(void)
{
    static const double densities[5] = {0.0, 1e-9, 0.3, 20.0, 600.0};
    for (int i = 0; i < 5; i++) {
        pm_scenes s;
        begin_slab(&s, densities[i]);
        pm_scenes_ready(&s);
        for (double x = 0.0; x < 300.0; x = 3.0 * x + 1.0) {
            // From one side to the other, from within out, from out within, and all within.
            double slant = sqrt(9.0 + x * x) / 3.0;
            double depth = densities[i] * slant;
            pm_vec3 below = pm_vec(0.0, 0.0, -1.0);
            pm_vec3 above = pm_vec(x, 0.0, 2.0);
            pm_vec3 inside = pm_vec(0.5 * x, 0.0, 0.5);
            double tolerance = 1e-3 * depth * exp(-depth) + 1e-15; // offsets of 2^-19 of 1000
            CHECK_NEAR(clear(&s, below, above, PM_NONE), exp(-depth), tolerance);
            CHECK_NEAR(clear(&s, above, below, PM_NONE), exp(-depth), tolerance);
            CHECK_NEAR(clear(&s, inside, above, 0), exp(-0.5 * depth), 0.01);
            CHECK_NEAR(clear(&s, above, inside, PM_NONE), exp(-0.5 * depth), 0.01);
            CHECK_NEAR(clear(&s, inside, pm_vec(0.51 * x, 0.0, 0.52), 0),
                       exp(-densities[i] * sqrt(0.01 * x * 0.01 * x + 0.02 * 0.02)), 1e-14);
        }
        pm_scenes_free(&s);
    }
}

static void endless_rays(void)
{
    pm_scenes s;
    begin_slab(&s, 2.0);
    pm_scenes_ready(&s);
    pm_vec3 below = pm_vec(0.0, 0.0, -3.0);
    CHECK_NEAR(clear_endless(&s, below, pm_vec(0.0, 0.0, 1.0), PM_NONE), exp(-2.0), 1e-3);
    CHECK_NEAR(clear_endless(&s, below, pm_vec(0.0, 0.0, -1.0), PM_NONE), 1.0, 0.0);
    // Between the sheets there is fog without end; 0 of it takes nothing even so.
    pm_vec3 inside = pm_vec(0.0, 0.0, 0.5);
    CHECK_NEAR(clear_endless(&s, inside, pm_vec(1.0, 0.0, 0.0), 0), 0.0, 0.0);
    s.media[0].sigma_t = 0.0;
    CHECK_NEAR(clear_endless(&s, inside, pm_vec(1.0, 0.0, 0.0), 0), 1.0, 0.0);
    pm_scenes_free(&s);
}

/// Balls of radii 3, 2 and 1 about the origin, of media 0, 1, 2; around them medium `around`.
static void begin_balls(pm_scenes *s, int around)
{
    static const double densities[4] = {0.2, 0.7, 1.1, 0.05};
    pm_scenes_begin(s);
    for (int i = 0; i < 4; i++) {
        pm_scenes_medium(s, densities[i], pm_gray(0.5), 0.0);
    }
    for (int i = 0; i < 3; i++) {
        pm_shape ball = pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 3.0 - i);
        pm_scenes_bound(s, ball, i, i == 0 ? around : i - 1);
    }
    pm_scenes_ready(s);
}

/// Half the chord of a ball at this distance from its middle.
static double half_chord(double radius, double distance)
{
    return sqrt(pm_most(0.0, radius * radius - distance * distance));
}

/// Optical depth of one half of the way past the balls, from z = 10.
static double depth_past(const pm_scenes *s, double distance, int around)
{
    double outer = half_chord(3.0, distance);
    double middle = half_chord(2.0, distance);
    double inner = half_chord(1.0, distance);
    double outside = around == PM_NONE ? 0.0 : s->media[around].sigma_t;
    return s->media[0].sigma_t * (outer - middle) + s->media[1].sigma_t * (middle - inner) +
           s->media[2].sigma_t * inner + outside * (10.0 - outer);
}

static void balls_in_balls(void)
{
    for (int around = PM_NONE; around < 4; around += 4) {
        pm_scenes s;
        begin_balls(&s, around);
        for (double x = 0.0; x < 3.5; x += 0.0937) {
            double depth = depth_past(&s, x, around);
            pm_vec3 low = pm_vec(0.6 * x, 0.8 * x, -10.0);
            pm_vec3 high = pm_vec(0.6 * x, 0.8 * x, 10.0);
            pm_vec3 mid = pm_vec(0.6 * x, 0.8 * x, 0.0);
            int within = x > 3.0 ? around : x > 2.0 ? 0 : x > 1.0 ? 1 : 2;
            CHECK_NEAR(clear(&s, low, high, around), exp(-2.0 * depth), 1e-3);
            CHECK_NEAR(clear(&s, high, mid, around), exp(-depth), 1e-3);
            CHECK_NEAR(clear(&s, mid, low, within), exp(-depth), 1e-3);
        }
        pm_scenes_free(&s);
    }
}

static void grazing_rays_keep_their_medium(void)
{
    // Within offsets of the edge of a ball, and nearly along its surface: the chord is short,
    // or the ray never leaves; either way no medium is left behind.
    pm_scenes s;
    begin_balls(&s, PM_NONE);
    for (double inward = 1e-1; inward > 1e-17; inward *= 0.1) {
        pm_vec3 low = pm_vec(3.0 - inward, 0.0, -10.0);
        pm_vec3 high = pm_vec(3.0 - inward, 0.0, 10.0);
        double depth = depth_past(&s, 3.0 - inward, PM_NONE);
        CHECK_NEAR(clear(&s, low, high, PM_NONE), exp(-2.0 * depth), 2e-3);
    }
    pm_scenes_free(&s);
}

static void surfaces_block_wherever_they_stand(void)
{
    for (int kind = 0; kind < 3; kind++) {
        pm_scenes s;
        begin_slab(&s, 0.5);
        int wear = kind == 0   ? pm_scenes_diffuse(&s, pm_gray(0.5))
                   : kind == 1 ? pm_scenes_glass(&s, 1.5)
                               : pm_scenes_pane(&s, 1.5);
        pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(0.0, 0.0, 0.5), 0.2), wear);
        pm_scenes_ready(&s);
        pm_vec3 low = pm_vec(0.0, 0.0, -1.0);
        CHECK_NEAR(clear(&s, low, pm_vec(0.0, 0.0, 2.0), PM_NONE), 0.0, 0.0);
        CHECK_NEAR(clear(&s, low, pm_vec(0.0, 0.0, 0.31), PM_NONE), 0.0, 0.0);
        CHECK_NEAR(clear(&s, low, pm_vec(0.0, 0.0, 0.29), PM_NONE), exp(-0.145), 1e-3);
        CHECK_NEAR(clear(&s, low, pm_vec(2.0, 0.0, 2.0), PM_NONE), exp(-0.5 * sqrt(13.) / 3.),
                   1e-3);
        CHECK_NEAR(clear_endless(&s, low, pm_vec(0.0, 0.0, 1.0), PM_NONE), 0.0, 0.0);
        pm_scenes_free(&s);
    }
}

static void ends_on_null_surfaces_are_reached(void)
{
    // A light exactly on the slab's upper sheet, or anywhere near it; a wall just above it is
    // no hindrance, one below is.
    pm_scenes s;
    begin_slab(&s, 0.5);
    pm_scenes_wear(&s, pm_scenes_square(10.0, 1.02, true), pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_ready(&s);
    pm_vec3 low = pm_vec(0.1, 0.2, -1.0);
    for (double z = 0.99; z < 1.015; z += 0.0005) {
        double inside = pm_least(z, 1.0);
        CHECK_NEAR(clear(&s, low, pm_vec(0.1, 0.2, z), PM_NONE), exp(-0.5 * inside), 2e-3);
        CHECK_NEAR(clear(&s, pm_vec(0.1, 0.2, z), low, z < 1.0 ? 0 : PM_NONE),
                   exp(-0.5 * inside), 2e-3);
    }
    CHECK_NEAR(clear(&s, low, pm_vec(0.1, 0.2, 1.0), PM_NONE), exp(-0.5), 1e-3);
    CHECK_NEAR(clear(&s, low, pm_vec(0.1, 0.2, 1.03), PM_NONE), 0.0, 0.0);
    pm_scenes_free(&s);
}

static void large_bounds_do_not_push_rays_off_their_end(void)
{
    // The bound's offset is far larger than that of a small wall, which ends lie closely on:
    // the ray must end there, not in the wall.
    pm_scenes s;
    pm_scenes_begin(&s);
    int fog = pm_scenes_medium(&s, 0.1, pm_gray(0.5), 0.0);
    pm_frame askew = pm_shapes_askew();
    pm_shape bound = pm_shapes_cube(&askew, pm_vec(0.0, 0.0, 0.0), 1000.0);
    pm_scenes_bound(&s, bound, fog, PM_NONE);
    pm_shape near = pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 3.0);
    near.reach = 1000.0; // a sphere in the corner of a large scene has such an offset
    pm_scenes_bound(&s, near, fog, fog);
    pm_scenes_wear(&s, pm_scenes_square(0.1, 0.0, false), pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_ready(&s);
    for (int i = 0; i < 300; i++) {
        pm_rng rng = pm_shapes_rng((uint64_t)i, 2);
        pm_vec3 from = pm_vec_scale(pm_shapes_direction(&rng), 5.0);
        double up = from.z < 0.0 ? -1e-6 : 1e-6; // of the wall's own offsets
        pm_vec3 to = pm_vec(0.08 * (pm_rng_draw(&rng) - 0.5), 0.0, up);
        double length = pm_vec_length(pm_vec_sub(to, from));
        CHECK_NEAR(clear(&s, from, to, fog), exp(-0.1 * length), 2e-3);
    }
    pm_scenes_free(&s);
}

static void other_null_surfaces_change_nothing(void)
{
    // A null ball that bounds no medium leaves the ray in the one it is in.
    pm_scenes s;
    pm_scenes_begin(&s);
    int fog = pm_scenes_medium(&s, 0.3, pm_gray(0.5), 0.0);
    pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 1.0), pm_scenes_null(&s));
    pm_scenes_ready(&s);
    pm_vec3 low = pm_vec(0.2, 0.0, -2.0);
    pm_vec3 high = pm_vec(0.2, 0.0, 2.0);
    CHECK_NEAR(clear(&s, low, high, fog), exp(-1.2), 1e-5);
    CHECK_NEAR(clear(&s, low, high, PM_NONE), 1.0, 0.0);
    pm_scenes_free(&s);
}

static void thick_fog_is_dark_not_wrong(void)
{
    static const double densities[4] = {1e3, 1e6, 1e300, 1e-320};
    for (int i = 0; i < 4; i++) {
        pm_scenes s;
        begin_slab(&s, densities[i]);
        pm_scenes_ready(&s);
        double want = densities[i] < 1.0 ? 1.0 : 0.0;
        CHECK_NEAR(clear(&s, pm_vec(0.0, 0.0, -1.0), pm_vec(0.0, 0.0, 2.0), PM_NONE), want,
                   1e-300);
        CHECK_NEAR(clear(&s, pm_vec(0.0, 0.0, 0.5), pm_vec(0.0, 0.0, 0.5 + 1e-6), 0),
                   exp(-1e-6 * densities[i]), 1e-9);
        pm_scenes_free(&s);
    }
}

static void units_cancel(void)
{
    // Lengths times 2^m, extinction times 2^-m: the same bits.
    double first = 0.0;
    for (int m = -20; m <= 20; m += 10) {
        double unit = ldexp(1.0, m);
        pm_scenes s;
        pm_scenes_begin(&s);
        int fog = pm_scenes_medium(&s, 0.7 / unit, pm_gray(0.5), 0.0);
        pm_shape ball = pm_shapes_sphere(pm_vec(0.1 * unit, 0.0, 0.0), unit);
        pm_scenes_bound(&s, ball, fog, PM_NONE);
        pm_scenes_ready(&s);
        double share = clear(&s, pm_vec(0.3 * unit, 0.0, -3.0 * unit),
                             pm_vec(0.0, 0.2 * unit, 3.0 * unit), PM_NONE);
        first = m == -20 ? share : first;
        CHECK(share < 0.4);
        CHECK_NEAR(share, first, 0.0);
        pm_scenes_free(&s);
    }
}

PM_TESTS({"clear.1", "a slab of fog takes by its optical depth, whatever the slant",
          slabs_take_by_their_depth},
         {"clear.2", "an endless ray loses all in endless fog, and nothing in fog of density 0",
          endless_rays},
         {"clear.3", "balls of fog in one another each take for their own part of the way",
          balls_in_balls},
         {"clear.4", "rays that graze a ball of fog end in the right medium",
          grazing_rays_keep_their_medium},
         {"clear.5", "walls, glass and panes block in fog as in air",
          surfaces_block_wherever_they_stand},
         {"clear.6", "light on a bound of fog, or close to it, is reached",
          ends_on_null_surfaces_are_reached},
         {"clear.7", "beyond a bound of large offset rays still end where they were to end",
          large_bounds_do_not_push_rays_off_their_end},
         {"clear.8", "null surfaces that bound nothing leave a ray in its medium",
          other_null_surfaces_change_nothing},
         {"clear.9", "the thickest fog gives 0 and the thinnest 1",
          thick_fog_is_dark_not_wrong},
         {"clear.10", "units cancel to the last bit", units_cancel})
