// A ball of scattering medium with a point light in its middle. How many collisions a photon
// has before it is absorbed or escapes is the solution of an integral equation, solved here by
// quadrature; nothing of it is ours but the nodes.
//
// With lengths in mean free paths, v(r) = r times the number of collisions of a photon that
// starts anywhere at distance r in any direction:
//     v(r) = 1/2 integral from 0 to R of (s + albedo v(s)) (E1(|r - s|) - E1(r + s)) ds.
#include "trace.h"

#include "chance.h"
#include "ledger.h"
#include "quadrature.h"
#include "scenes.h"
#include "shapes.h"
#include "tally.h"
#include "test.h"

#include <gsl/gsl_sf_expint.h>
#include <stdlib.h>

// --- the integral equation

enum { PANELS = 10, IN_PANEL = 12, NODES = PANELS * IN_PANEL };

typedef struct {
    double r[NODES], weight[NODES];
    double kernel[NODES][NODES]; // times the weight of the second; 0 on the diagonal
    double whole[NODES];         // the kernel's integral, of closed form
    double gap[NODES];           // by how much its sum without the diagonal falls short
} equation;

static void lay_nodes(equation *e, double radius)
{
    double node[IN_PANEL];
    double weight[IN_PANEL];
    pm_quadrature_nodes(IN_PANEL, node, weight);
    for (int i = 0; i < NODES; i++) {
        e->r[i] = radius / PANELS * (i / IN_PANEL + node[i % IN_PANEL]);
        e->weight[i] = radius / PANELS * weight[i % IN_PANEL];
    }
}

static void lay_kernel(equation *e, double radius)
{
    for (int i = 0; i < NODES; i++) {
        double r = e->r[i];
        e->whole[i] = 2.0 - 2.0 * gsl_sf_expint_E2(r) - gsl_sf_expint_E2(radius - r) +
                      gsl_sf_expint_E2(radius + r);
        e->gap[i] = e->whole[i];
        for (int j = 0; j < NODES; j++) {
            double s = e->r[j];
            double value = gsl_sf_expint_E1(fabs(r - s) + (i == j)) - gsl_sf_expint_E1(r + s);
            e->kernel[i][j] = i == j ? 0.0 : e->weight[j] * value;
            e->gap[i] -= e->kernel[i][j];
        }
    }
}

/// One step of the iteration; returns by how much v changed. The kernel is singular where r and
/// s meet: there w(s) - w(r) is integrated in place of w(s).
static double iterate(const equation *e, double albedo, double *v)
{
    double next[NODES];
    double change = 0.0;
    for (int i = 0; i < NODES; i++) {
        double sum = e->gap[i] * (e->r[i] + albedo * v[i]);
        for (int j = 0; j < NODES; j++) {
            sum += e->kernel[i][j] * (e->r[j] + albedo * v[j]);
        }
        next[i] = 0.5 * sum;
        change = fmax(change, fabs(next[i] - v[i]));
    }
    for (int i = 0; i < NODES; i++) {
        v[i] = next[i];
    }
    return change;
}

/// Collisions of a photon that starts in the middle of a ball of this optical radius.
static double collisions(const equation *e, double albedo)
{
    double v[NODES] = {0};
    for (int i = 0; i < 5000 && iterate(e, albedo, v) > 1e-10; i++) {
    }
    double sum = 0.0;
    for (int i = 0; i < NODES; i++) {
        sum += e->weight[i] * exp(-e->r[i]) * (1.0 + albedo * v[i] / e->r[i]);
    }
    return sum;
}

static equation *solve_for(double radius)
{
    equation *e = calloc(1, sizeof *e);
    CHECK(e != NULL);
    lay_nodes(e, radius);
    lay_kernel(e, radius);
    return e;
}

static void the_equation_is_solved(void)
{
    // Where nothing is scattered, 1 - exp(-R); in a vast ball 1 / (1 - albedo); and in a thin
    // one the second collision, over the mean way from a random place of a radius to the rim.
    equation *e = solve_for(2.0);
    CHECK_NEAR(collisions(e, 0.0), 1.0 - exp(-2.0), 1e-12);
    free(e);
    e = solve_for(15.0);
    CHECK_NEAR(collisions(e, 0.5), 2.0, 1e-3);
    free(e);
    double thin = 1e-3;
    e = solve_for(thin);
    double once = collisions(e, 0.0);
    double twice = (collisions(e, 1.0) - once) / (once * thin);
    CHECK_NEAR(twice, 0.25 + PM_PI * PM_PI / 16.0, 2e-3);
    free(e);
}

// --- photons

/// One photon's way, and sums over those that ended.
typedef struct {
    pm_vec3 at;    // where it was last
    double way;    // [m] that it went inside
    double radius; // of the ball, about the origin
    pm_tally number, length;
    uint64_t escaped, collided;
} walk;

static void note_step(void *context, const pm_start *start, const pm_event *event)
{
    walk *w = context;
    if (event->bounce == 0) {
        w->at = start->ray.origin;
        w->way = 0.0;
    }
    bool out = event->kind == PM_EVENT_ESCAPED;
    pm_vec3 to = out ? event->from : event->position; // it left the ball there
    w->way += pm_vec_length(pm_vec_sub(to, w->at));
    w->at = to;
    w->collided += !out;
    w->escaped += out;
    if (event->scatter == 0) {
        pm_tally_take(&w->number, event->bounce + (out ? 0.0 : 1.0));
        pm_tally_take(&w->length, w->way);
    }
}

static pm_status pass_by(void *context, const pm_deposit *d)
{
    (void)context;
    (void)d;
    return PM_OK;
}

static double bound_of(const pm_tally *tally)
{
    return pm_chance_bound(pm_tally_variance(tally), tally->count);
}

/// Photons from the middle, against the solution, at one density and albedo.
static void check_ball(const equation *e, double depth, double albedo)
{
    enum { COUNT = 10000 };
    const double radius = 0.25;
    walk w = {.radius = radius};
    pm_scenes s;
    pm_ledger l;
    pm_scenes_begin(&s);
    int milk = pm_scenes_medium(&s, depth / radius, pm_gray(albedo), 0.0);
    pm_scenes_bound(&s, pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), radius), milk, PM_NONE);
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 0.0), pm_gray(1.0));
    s.lights[0].medium = milk;
    pm_scenes_ready(&s);
    pm_tracing tracing = pm_ledger_open(&s, &l);
    tracing.map = PM_MAP_VOLUME;
    tracing.sink = (pm_trace_sink){&w, pass_by, note_step};
    pm_ledger_trace(&s, &tracing, COUNT);
    double want = collisions(e, albedo);
    double gone = 1.0 - (1.0 - albedo) * want;
    double slack = 1e-3 * want; // of the quadrature
    CHECK(w.number.count == COUNT);
    CHECK_NEAR(pm_tally_mean(&w.number), want, bound_of(&w.number) + slack);
    CHECK_NEAR(pm_tally_mean(&w.length), want * radius / depth,
               bound_of(&w.length) + slack * radius / depth);
    CHECK_NEAR((double)w.escaped / COUNT, gone,
               pm_chance_bound(gone * (1.0 - gone), COUNT) + slack * (1.0 - albedo));
    pm_scenes_free(&s);
}

static void the_scattering_ball(void)
{
    static const double depths[3] = {0.5, 2.0, 5.0};
    for (int i = 0; i < 3; i++) {
        equation *e = solve_for(depths[i]);
        check_ball(e, depths[i], 0.8);
        check_ball(e, depths[i], 1.0);
        free(e);
    }
}

// --- light from all around

/// Where a straight way enters the ball.
static bool enters_at(const walk *w, const pm_ray *ray, pm_vec3 *place)
{
    double middle = -pm_vec_dot(ray->origin, ray->direction);
    pm_vec3 nearest = pm_vec_along(ray->origin, ray->direction, middle);
    double half2 = w->radius * w->radius - pm_vec_dot(nearest, nearest);
    if (half2 <= 0.0) {
        return false;
    }
    *place = pm_vec_along(nearest, ray->direction, -sqrt(half2));
    return true;
}

static void note_crossing(void *context, const pm_start *start, const pm_event *event)
{
    walk *w = context;
    pm_start inside = *start;
    if (enters_at(w, &start->ray, &inside.ray.origin)) {
        note_step(context, &inside, event);
    }
}

static void the_mean_way_through_a_white_ball(void)
{
    // 4/3 of the radius for light from all around, however much it is scattered on the way.
    // @source Blanco and Fournier, Europhysics Letters 61(2), 2003
    static const double depths[4] = {0.01, 0.5, 2.0, 8.0};
    static const double gs[4] = {0.0, 0.0, 0.9, -0.3};
    for (int i = 0; i < 4; i++) {
        walk w = {.radius = 0.25};
        pm_scenes s;
        pm_ledger l;
        pm_scenes_begin(&s);
        int milk = pm_scenes_medium(&s, depths[i] / w.radius, pm_gray(1.0), gs[i]);
        pm_scenes_bound(&s, pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), w.radius), milk, PM_NONE);
        pm_scenes_sky(&s, pm_gray(1.0));
        pm_scenes_ready(&s);
        pm_tracing tracing = pm_ledger_open(&s, &l);
        tracing.map = PM_MAP_VOLUME;
        tracing.sink = (pm_trace_sink){&w, pass_by, note_crossing};
        pm_ledger_trace(&s, &tracing, 30000);
        CHECK(w.length.count > 5000 && w.escaped == (uint64_t)w.length.count);
        CHECK_NEAR(pm_tally_mean(&w.length), 4.0 / 3.0 * w.radius, bound_of(&w.length));
        pm_scenes_free(&s);
    }
}

PM_TESTS({"media_ball.1", "the integral equation is solved where its solution is known",
          the_equation_is_solved},
         {"media_ball.2", "a scattering ball: escape, collisions and mean path as they must be",
          the_scattering_ball},
         {"media_ball.3", "light from all around goes 4/3 of the radius in a white ball",
          the_mean_way_through_a_white_ball})
