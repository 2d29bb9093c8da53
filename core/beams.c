// The boxes hang on the map's own tree: node i has children 2i and 2i + 1, so there are no
// links. A node without children has no box; its ball is asked at once.
//
// Invariant: a box holds its node's ball and all boxes and balls below, rounded outward, so a
// ray that misses it misses them.
// @source Jarosz, Zwicker and Jensen, CGF 27(2), 2008, for radii by neighbours of the photons
#include "beams.h"

#include "medium.h"
#include "store.h"
#include "tiles.h"

#include <float.h>
#include <stdlib.h>

#define COLUMNS 256    // photons are dealt to threads as pixels of a picture this wide
#define TREE_HEIGHT 31 // levels of a tree of PM_MAP_MAX photons

// --- radii ----------------------------------------------------------------------------------

/// What threads share while they find radii.
typedef struct {
    const pm_photon_map *map;
    double radius;      // for all; INFINITY: by neighbours
    uint32_t neighbour; // which neighbour sets a photon's; 0: none does
    uint16_t skip;
    float (*ball)[4];
} making;

static bool is_kept(const void *context, const pm_photon *photon, double *distance2)
{
    (void)distance2; // Euclidean, as it comes
    const making *pass = context;
    return (photon->flags & pass->skip) == 0;
}

/// The smallest radius that float positions around `at` can tell from 0.
static double least_radius(const float at[3])
{
    float reach = fmaxf(fabsf(at[0]), fmaxf(fabsf(at[1]), fabsf(at[2])));
    return (double)nextafterf(reach, INFINITY) - (double)reach;
}

/// A photon finds itself first, so one more is asked for.
static pm_status radius_by_neighbours(const making *pass, const float at[3],
                                      pm_neighbour *scratch, double *radius)
{
    pm_search search = {
        .at = pm_vec((double)at[0], (double)at[1], (double)at[2]),
        .k = pass->neighbour + 1,
        .radius2 = HUGE_VAL,
        .accept = is_kept,
        .context = pass,
    };
    uint32_t found;
    PM_TRY(pm_balance_nearest(pass->map, &search, scratch, &found, NULL));
    *radius = pm_most(sqrt(scratch[0].distance2), least_radius(at));
    return PM_OK;
}

static pm_status make_ball(const void *context, void *scratch, int x, int y)
{
    const making *pass = context;
    uint32_t index = (uint32_t)y * COLUMNS + (uint32_t)x;
    if (index >= pass->map->count) {
        return PM_OK;
    }
    const pm_photon *photon = &pass->map->photons[index];
    double radius = pass->radius;
    if ((photon->flags & pass->skip) != 0) {
        radius = 0.0;
    } else if (isinf(radius) && pass->neighbour == 0) {
        radius = 0.0;
    } else if (isinf(radius)) {
        PM_TRY(radius_by_neighbours(pass, photon->position, scratch, &radius));
    }
    for (int axis = 0; axis < 3; axis++) {
        pass->ball[index][axis] = photon->position[axis];
    }
    pass->ball[index][3] = (float)pm_least(radius, (double)FLT_MAX);
    return PM_OK;
}

static pm_status scratch_begin(const void *context, void **scratch)
{
    const making *pass = context;
    *scratch = calloc((size_t)pass->neighbour + 1, sizeof(pm_neighbour));
    return *scratch != NULL
               ? PM_OK
               : PM_FAIL(PM_ENOMEM, "no memory for %u neighbours", pass->neighbour);
}

static void scratch_end(void *context, void *scratch)
{
    (void)context;
    free(scratch);
}

static pm_status make_balls(making *pass)
{
    pm_tiles tiles = {
        .what = "beams",
        .width = COLUMNS,
        .height = (int)(((uint64_t)pass->map->count + COLUMNS - 1) / COLUMNS),
        .context = pass,
        .begin = scratch_begin,
        .pixel = make_ball,
        .end = scratch_end,
    };
    return pm_tiles_run(&tiles);
}

// --- boxes ----------------------------------------------------------------------------------

static void widen(float box[6], const float low[3], const float high[3])
{
    for (int axis = 0; axis < 3; axis++) {
        box[axis] = low[axis] < box[axis] ? low[axis] : box[axis];
        box[axis + 3] = high[axis] > box[axis + 3] ? high[axis] : box[axis + 3];
    }
}

/// Grows the box around a ball, unless it has no radius.
static void widen_by_ball(float box[6], const float ball[4])
{
    float low[3];
    float high[3];
    if (ball[3] == 0.0f) {
        return;
    }
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = nextafterf(ball[axis] - ball[3], -INFINITY);
        high[axis] = nextafterf(ball[axis] + ball[3], INFINITY);
    }
    widen(box, low, high);
}

/// From the last node that has children up to the root.
static void make_boxes(pm_beams *beams)
{
    uint64_t count = beams->map.count;
    for (uint64_t node = count / 2; node >= 1; node--) {
        float *box = beams->box[node - 1];
        for (int axis = 0; axis < 3; axis++) {
            box[axis] = INFINITY;
            box[axis + 3] = -INFINITY;
        }
        widen_by_ball(box, beams->ball[node - 1]);
        for (uint64_t child = 2 * node; child <= 2 * node + 1 && child <= count; child++) {
            if (2 * child <= count) {
                widen(box, beams->box[child - 1], beams->box[child - 1] + 3);
            } else {
                widen_by_ball(box, beams->ball[child - 1]);
            }
        }
    }
}

// --- making ---------------------------------------------------------------------------------

static pm_status check(const pm_photon_map *map, double radius, uint32_t k)
{
    if (map->kind != PM_MAP_VOLUME) {
        return PM_FAIL(PM_EINPUT, "%s", "beams are made from a volume map");
    }
    if (map->count > 0 && !(map->balanced && map->scaled)) {
        return PM_FAIL(PM_EINPUT, "%s", "a map must be balanced and scaled before its beams");
    }
    if (!((float)radius > 0.0f)) {
        return PM_FAIL(PM_EINPUT, "a beam's radius must be > 0 as a float, got %g", radius);
    }
    if (k == 0) {
        return PM_FAIL(PM_EINPUT, "%s", "k must be at least 1, got 0");
    }
    return PM_OK;
}

static uint32_t count_kept(const pm_photon_map *map, uint16_t skip)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < map->count; i++) {
        kept += (map->photons[i].flags & skip) == 0;
    }
    return kept;
}

/// Which neighbour sets a photon's radius, of `kept` photons.
static uint32_t neighbour_of(uint32_t k, uint32_t kept)
{
    uint32_t others = kept > 0 ? kept - 1 : 0;
    return (uint32_t)lround(sqrt(k < others ? k : others));
}

static pm_status reserve(uint32_t count, pm_beams *made)
{
    // One more than there may be: room for none is no failure.
    made->ball = calloc((size_t)count + 1, sizeof *made->ball);
    made->box = calloc((size_t)count / 2 + 1, sizeof *made->box);
    return made->ball != NULL && made->box != NULL
               ? PM_OK
               : PM_FAIL(PM_ENOMEM, "no memory for the beams of %u photons", count);
}

pm_status pm_beams_make(const pm_photon_map *map, double radius, uint32_t k, uint16_t skip,
                        pm_beams *out)
{
    PM_TRY(check(map, radius, k));
    uint32_t kept = count_kept(map, skip);
    pm_beams made = {.map = *map};
    making pass = {map, radius, neighbour_of(k, kept), skip, NULL};
    pm_status status = reserve(map->count, &made);
    if (status == PM_OK) {
        pass.ball = made.ball;
        status = make_balls(&pass);
    }
    if (status != PM_OK) {
        pm_beams_free(&made);
        return status;
    }
    made.counted = isinf(radius) && pass.neighbour == 0 ? 0 : kept;
    make_boxes(&made);
    *out = made;
    return PM_OK;
}

void pm_beams_free(pm_beams *beams)
{
    free(beams->ball);
    free(beams->box);
    *beams = (pm_beams){0};
}

// --- asking ---------------------------------------------------------------------------------

/// A query on its way through the tree.
typedef struct {
    const pm_beams *beams;
    const pm_medium *medium;
    double origin[3], direction[3], inverse[3]; // inverse: 1 / direction
    int near[3], far[3];                        // places in a box of the sides met first, last
    double t_max;
    pm_spectrum sum; // of power, kernel, what gets through; phase where it is not the same all
                     // around
    double radius_sum;
    uint32_t found;
} walk;

static walk walk_along(const pm_beams *beams, const pm_medium *medium, const pm_ray *along)
{
    walk w = {.beams = beams, .medium = medium, .t_max = along->t_max};
    for (int axis = 0; axis < 3; axis++) {
        w.origin[axis] = pm_vec_axis(along->origin, axis);
        w.direction[axis] = pm_vec_axis(along->direction, axis);
        w.inverse[axis] = 1.0 / w.direction[axis]; // may be infinite
        bool forward = w.inverse[axis] > 0.0;
        w.near[axis] = forward ? axis : axis + 3;
        w.far[axis] = forward ? axis + 3 : axis;
    }
    return w;
}

/// Whether the ray runs through a box. A ray inside one of its planes gives NaN there, which
/// leaves that pair of planes out.
static bool crosses(const walk *w, const float box[6])
{
    double enter = 0.0;
    double leave = w->t_max;
    for (int axis = 0; axis < 3; axis++) {
        double in = ((double)box[w->near[axis]] - w->origin[axis]) * w->inverse[axis];
        double out = ((double)box[w->far[axis]] - w->origin[axis]) * w->inverse[axis];
        enter = in > enter ? in : enter;
        leave = out < leave ? out : leave;
    }
    return enter < leave;
}

/// The light of one photon that counts, at `t` along the ray; `u` is (d / r)^2.
static void add(walk *w, uint32_t index, double t, double u, double radius)
{
    double weight = 3.0 / PM_PI * (1.0 - u) * (1.0 - u) / (radius * radius);
    weight *= pm_medium_transmittance(w->medium, t);
    pm_spectrum power;
    if (w->medium->g == 0.0) {
        power = pm_store_power(&w->beams->map, index);
    } else {
        pm_photon_view photon = pm_store_unpack(&w->beams->map, index);
        pm_vec3 direction = pm_vec(w->direction[0], w->direction[1], w->direction[2]);
        weight *= pm_medium_phase(w->medium, -pm_vec_dot(photon.direction, direction));
        power = photon.power;
    }
    w->sum = pm_spectrum_add(w->sum, pm_spectrum_scale(power, weight));
    w->radius_sum += radius;
    w->found++;
}

static void ask_ball(walk *w, uint32_t index)
{
    const float *ball = w->beams->ball[index];
    double x = (double)ball[0] - w->origin[0];
    double y = (double)ball[1] - w->origin[1];
    double z = (double)ball[2] - w->origin[2];
    double t = x * w->direction[0] + y * w->direction[1] + z * w->direction[2];
    if (!(t > 0.0 && t < w->t_max)) {
        return;
    }
    x -= t * w->direction[0];
    y -= t * w->direction[1];
    z -= t * w->direction[2];
    double distance2 = x * x + y * y + z * z;
    double radius = (double)ball[3];
    if (distance2 < radius * radius) {
        add(w, index, t, distance2 / (radius * radius), radius);
    }
}

/// Asks a child: its ball, or first whether the ray comes near all that is below it. The number
/// of nodes that wait then.
static int approach(walk *w, uint64_t child, uint64_t *later, int waiting)
{
    uint64_t count = w->beams->map.count;
    if (2 * child > count) {
        if (child <= count) {
            ask_ball(w, (uint32_t)(child - 1));
        }
    } else if (crosses(w, w->beams->box[child - 1])) {
        later[waiting++] = child;
    }
    return waiting;
}

pm_beam pm_beams_query(const pm_beams *beams, const pm_medium *medium, const pm_ray *along)
{
    uint64_t later[TREE_HEIGHT + 1];
    walk w = walk_along(beams, medium, along);
    int waiting = approach(&w, 1, later, 0);
    while (waiting > 0) {
        uint64_t node = later[--waiting];
        ask_ball(&w, (uint32_t)(node - 1));
        waiting = approach(&w, 2 * node, later, waiting);
        waiting = approach(&w, 2 * node + 1, later, waiting);
    }
    double phase = medium->g == 0.0 ? pm_medium_phase(medium, 1.0) : 1.0;
    return (pm_beam){
        .radiance = pm_spectrum_scale(pm_spectrum_mul(w.sum, medium->albedo), phase),
        .found = w.found,
        .radius = w.found > 0 ? w.radius_sum / w.found : 0.0,
    };
}
