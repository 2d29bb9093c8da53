// Two caustics that geometry knows: a ring of mirror in slanting light, and a glass ball under
// light from above. Photons of the caustic map against integrals over where the light comes in.
//
// The ring has radius 1 and light travels along +x, downward at an angle e. Light that meets it
// at the turn t, z above the floor, goes on along (-cos 2t, -sin 2t) seen from above and comes
// down after s = z / tan e. A patch dt dz of the wall sends the power E cos e cos t dt dz, so
// the floor gets there E sin e times cos t / |cos t - 2 s|. On the axis that is
// 1 / |2x - 1| from straight ahead and, past the cusp in x = 1/2, 1 / (4 x^2 - 1) from each
// side.
#include "chance.h"
#include "photon_map.h"
#include "photon_pass.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

/// Counts the deposits of one caustic pass that come after `bounce` events.
typedef struct {
    uint32_t bounce;
    int (*cell_of)(const pm_deposit *deposit); // or PM_NONE: anywhere else
    uint64_t *counts;
} tally;

static pm_status count_cell(void *context, const pm_deposit *deposit)
{
    tally *t = context;
    int cell = t->cell_of(deposit);
    if (deposit->bounce == t->bounce && cell != PM_NONE) {
        t->counts[cell]++;
    }
    return PM_OK;
}

/// Runs the caustic pass. What landed in none of the cells is counted behind the last of them.
static void count_photons(const pm_scenes *s, uint64_t photons, tally *t, size_t cells)
{
    pm_pass_settings settings = {.seed = 11, .count = photons};
    settings.tap = (pm_trace_sink){t, count_cell, NULL};
    omp_set_num_threads(1);
    pm_photon_map map;
    CHECK_OK(pm_photon_pass(&s->world, PM_MAP_CAUSTIC, &settings, &map, NULL));
    t->counts[cells] = photons;
    for (size_t i = 0; i < cells; i++) {
        t->counts[cells] -= t->counts[i];
    }
    pm_photon_map_free(&map);
}

/// Turns shares of the light's power into numbers of photons; the last cell has the rest.
static void expect(double *share, size_t cells, uint64_t photons)
{
    double rest = 1.0;
    for (size_t i = 0; i < cells; i++) {
        rest -= share[i];
        share[i] *= (double)photons;
    }
    share[cells] = rest * (double)photons;
}

// --- the ring
// ----------------------------------------------------------------------------------

enum { ALONG = 34, ACROSS = 9, RING_CELLS = ALONG * ACROSS };
static const double ring_height = 0.4;
static const double elevation = PM_PI / 6.0;
static const double ring_cell = 0.02; // side of a cell [m]; they begin at x = 0.3

static void ring_begin(pm_scenes *s)
{
    pm_scenes_begin(s);
    pm_shape floor = pm_scenes_square(2.2, 0.0, false);
    pm_scenes_add(s, floor, pm_scenes_diffuse(s, pm_gray(0.0)), PM_NONE);
    pm_vec3 up = pm_vec(0.0, 0.0, 1.0);
    pm_shape wall = pm_shapes_cylinder(pm_vec(0.0, 0.0, 0.0), up, ring_height, 1.0);
    pm_scenes_wear(s, wall, pm_scenes_mirror(s, pm_gray(1.0)));
    pm_scenes_sun(s, pm_vec(cos(elevation), 0.0, -sin(elevation)), pm_gray(1.0));
    pm_scenes_ready(s);
}

/// The cell of a place on the floor: a grid along the axis, symmetric about it.
static int ring_cell_at(double x, double y)
{
    int along = (int)floor((x - 0.3) / ring_cell);
    int across = (int)floor(y / ring_cell + 0.5 * ACROSS);
    bool within = along >= 0 && along < ALONG && across >= 0 && across < ACROSS;
    return within && hypot(x, y) < 1.0 ? along * ACROSS + across : PM_NONE;
}

static int ring_cell_of(const pm_deposit *deposit)
{
    return ring_cell_at(deposit->position.x, deposit->position.y);
}

/// Adds to `share` the power over the sun's flux that one turn of the wall sends to each cell.
static void add_turn(double *share, double t, double dt, double flux)
{
    enum { HEIGHTS = 4000 };
    double dz = ring_height / HEIGHTS;
    for (int i = 0; i < HEIGHTS; i++) {
        double z = (i + 0.5) * dz;
        double s = z / tan(elevation);
        // The near wall keeps off what would have crossed it below its rim.
        bool lit = z + 2.0 * cos(t) * tan(elevation) > ring_height;
        int cell = ring_cell_at(cos(t) - s * cos(2.0 * t), sin(t) - s * sin(2.0 * t));
        if (lit && cell != PM_NONE) {
            share[cell] += cos(elevation) * cos(t) * dt * dz / flux;
        }
    }
}

static void ring_shares(double *share, double flux)
{
    enum { TURNS = 4001 };
    memset(share, 0, (RING_CELLS + 1) * sizeof *share);
    for (int i = 0; i < TURNS; i++) {
        add_turn(share, PM_PI * ((i + 0.5) / TURNS - 0.5), PM_PI / TURNS, flux);
    }
}

static void photons_draw_a_nephroid(void)
{
    enum { PHOTONS = 600000 };
    static uint64_t counts[RING_CELLS + 1];
    static double expected[RING_CELLS + 1];
    pm_scenes s;
    ring_begin(&s);
    tally t = {1, ring_cell_of, counts};
    count_photons(&s, PHOTONS, &t, RING_CELLS);
    ring_shares(expected, s.scene.lights[0].flux.c[0]);
    expect(expected, RING_CELLS, PHOTONS);
    CHECK_FIT(counts, expected, RING_CELLS + 1);
    pm_scenes_free(&s);
}

/// Photons of the cell on the axis that begins at x.
static uint64_t on_axis(const uint64_t *counts, double x)
{
    return counts[ring_cell_at(x + 0.5 * ring_cell, 0.0)];
}

static void cusp_lies_halfway(void)
{
    // Brightest is a cell on the axis, the first or second past 1/2; half as far again from the
    // centre, and back towards it, there is a quarter of that.
    enum { PHOTONS = 600000 };
    static uint64_t counts[RING_CELLS + 1];
    pm_scenes s;
    ring_begin(&s);
    tally t = {1, ring_cell_of, counts};
    count_photons(&s, PHOTONS, &t, RING_CELLS);
    uint64_t most = 0;
    for (int i = 0; i < RING_CELLS; i++) {
        most = counts[i] > most ? counts[i] : most;
    }
    CHECK(most == on_axis(counts, 0.5) || most == on_axis(counts, 0.52));
    CHECK(most > 4 * on_axis(counts, 0.4) && most > 4 * on_axis(counts, 0.66));
    pm_scenes_free(&s);
}

static double gain_on_axis(double x)
{
    double reach = ring_height / tan(elevation);
    double ahead = 1.0 - x < reach ? 1.0 / fabs(2.0 * x - 1.0) : 0.0;
    double beside = x > 0.5 && x < reach ? 2.0 / (4.0 * x * x - 1.0) : 0.0;
    return ahead + beside;
}

static void gain_on_axis_is_known(void)
{
    // The integral over the wall against the closed form, where cells are small against the
    // way to the cusp; photons_draw_a_nephroid holds photons against the integral.
    static double share[RING_CELLS + 1];
    static const double places[] = {0.34, 0.36, 0.64, 0.66, 0.74, 0.8, 0.86};
    ring_shares(share, 1.0);
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        double x = places[i] + 0.5 * ring_cell;
        double direct = sin(elevation) * ring_cell * ring_cell;
        double gain = share[ring_cell_at(x, 0.0)] / direct;
        CHECK_NEAR(gain, gain_on_axis(x), 0.02 * gain_on_axis(x));
    }
}

// --- the ball
// ----------------------------------------------------------------------------------
//
// Radius 1 about the origin, index 1.5, light straight down. A ray in at the distance b from
// the axis is turned by a - a' twice, with sin a = b and sin a' = b / 1.5.

enum { CIRCLES = 24 };
static const double ball_index = 1.5;
static const double ball_floor = 1.5; // below the centre: in the focus
static const double circle_step = 0.04;

static void ball_begin(pm_scenes *s)
{
    pm_scenes_begin(s);
    pm_shape ball = pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 1.0);
    pm_scenes_wear(s, ball, pm_scenes_glass(s, ball_index));
    pm_shape floor = pm_scenes_square(2.4, -ball_floor, false);
    pm_scenes_add(s, floor, pm_scenes_diffuse(s, pm_gray(0.0)), PM_NONE);
    pm_scenes_sun(s, pm_vec(0.0, 0.0, -1.0), pm_gray(1.0));
    pm_scenes_ready(s);
}

/// Distance from the axis at which a ray comes down, signed; and the share that both faces let
/// through: by symmetry the second reflects what the first did.
static double ball_lands(double b, double *through)
{
    double a = asin(b);
    double inside = asin(b / ball_index);
    double s = sin(a - inside) / sin(a + inside);
    double p = tan(a - inside) / tan(a + inside);
    double reflected = 0.5 * (s * s + p * p);
    *through = (1.0 - reflected) * (1.0 - reflected);
    double turned = 2.0 * (a - inside);
    // It leaves at the angle `turned - a` past the bottom, seen from the centre.
    double height = ball_floor - cos(turned - a);
    return sin(a - turned) - height * tan(turned);
}

static int circle_at(double r)
{
    double number = floor(r / circle_step);
    return number < CIRCLES ? (int)number : PM_NONE;
}

static int circle_of(const pm_deposit *deposit)
{
    return circle_at(hypot(deposit->position.x, deposit->position.y));
}

static void circles_get_their_flux(void)
{
    enum { PHOTONS = 300000, STEPS = 400000 };
    static uint64_t counts[CIRCLES + 1];
    static double expected[CIRCLES + 1];
    pm_scenes s;
    ball_begin(&s);
    tally t = {2, circle_of, counts};
    count_photons(&s, PHOTONS, &t, CIRCLES);
    double flux = s.scene.lights[0].flux.c[0];
    for (int i = 0; i < STEPS; i++) {
        double b = (i + 0.5) / STEPS;
        double through = 0.0;
        int circle = circle_at(fabs(ball_lands(b, &through)));
        if (circle != PM_NONE) {
            expected[circle] += through * 2.0 * PM_PI * b / STEPS / flux;
        }
    }
    expect(expected, CIRCLES, PHOTONS);
    CHECK_FIT(counts, expected, CIRCLES + 1);
    pm_scenes_free(&s);
}

/// Where photons that come down steeply cross the axis.
typedef struct {
    uint64_t count;
    double lowest, highest;
} crossings;

static pm_status note_crossing(void *context, const pm_deposit *d)
{
    crossings *c = context;
    double aside = hypot(d->direction.x, d->direction.y);
    if (d->bounce == 2 && aside > 0.01 && aside < 0.05) {
        double r2 = d->position.x * d->direction.x + d->position.y * d->direction.y;
        double z = d->position.z - r2 / (aside * aside) * d->direction.z;
        c->count++;
        c->lowest = fmin(c->lowest, z);
        c->highest = fmax(c->highest, z);
    }
    return PM_OK;
}

static void steep_light_meets_in_the_focus(void)
{
    // Turned by d, a ray came in at b = 1.5 d, about, and crosses 0.417 b^2 above the focus.
    pm_scenes s;
    ball_begin(&s);
    crossings c = {0, HUGE_VAL, -HUGE_VAL};
    pm_pass_settings settings = {.seed = 12, .count = 400000};
    settings.tap = (pm_trace_sink){&c, note_crossing, NULL};
    pm_photon_map map;
    CHECK_OK(pm_photon_pass(&s.world, PM_MAP_CAUSTIC, &settings, &map, NULL));
    CHECK_THAT(c.count > 100, "%g photons", (double)c.count);
    CHECK_NEAR(c.lowest, -1.5, 5e-4);
    CHECK_NEAR(c.highest, -1.5 + 0.417 * 0.075 * 0.075, 5e-4);
    pm_photon_map_free(&map);
    pm_scenes_free(&s);
}

PM_TESTS({"caustics.1", "photons in a ring of mirror draw the nephroid that geometry draws",
          photons_draw_a_nephroid},
         {"caustics.2", "the cusp lies halfway between the centre and the ring",
          cusp_lies_halfway},
         {"caustics.3", "on the axis of the ring the gain is that of the closed form",
          gain_on_axis_is_known},
         {"caustics.4", "circles on the floor get the flux that a glass ball sends them",
          circles_get_their_flux},
         {"caustics.5", "light near a glass ball's axis meets 1.5 radii from its centre",
          steep_light_meets_in_the_focus})
