// Beams are made in three steps: photons that count are copied and sorted into leaves, compact
// groups of eight; each gets its radius, and what
// it sees of the medium's end; boxes are put around leaves, and around boxes.
//
// Invariant: a box holds all balls below it and the slack around them.
// @source Jarosz, Zwicker and Jensen, CGF 27(2), 2008, for radii by neighbours of the photons
#include "beams.h"

#include "select.h"
#include "store.h"
#include "tiles.h"

#include <float.h>
#include <stdlib.h>

#define COLUMNS 256     // photons are dealt to threads as pixels of a picture this wide
#define LEAST 0x1p-100f // radius in the beams' unit: its square is far from underflow

typedef struct {
    const pm_intersector *world;
    const pm_photon_map *map;
    double radius;      // for all; INFINITY: by neighbours
    uint32_t neighbour; // which neighbour sets a photon's
    uint16_t skip;
    pm_photon *photons; // those that count
    float *found;       // their radii [m]
    pm_beams beams;
} making;

// --- leaves ---------------------------------------------------------------------------------

/// Copies what counts. Powers stay unscaled, so that floats hold them exactly.
static void copy_photons(making *make)
{
    pm_photon_map raw = *make->map;
    raw.scaled = false;
    uint32_t to = 0;
    for (uint32_t i = 0; i < raw.count && to < make->beams.count; i++) {
        if ((raw.photons[i].flags & make->skip) != 0) {
            continue;
        }
        pm_photon_view photon = pm_store_unpack(&raw, i);
        make->photons[to] = raw.photons[i];
        make->beams.light[to++] = (pm_photon_exact){
            {(float)photon.power.c[0], (float)photon.power.c[1], (float)photon.power.c[2]},
            {(float)photon.direction.x, (float)photon.direction.y, (float)photon.direction.z},
        };
    }
}

static int longest_side(const pm_photon *photons, uint32_t count)
{
    double longest = -1.0;
    int axis = 0;
    for (int a = 0; a < 3; a++) {
        float low = photons[0].position[a];
        float high = low;
        for (uint32_t i = 1; i < count; i++) {
            low = fminf(low, photons[i].position[a]);
            high = fmaxf(high, photons[i].position[a]);
        }
        double side = (double)high - (double)low;
        axis = side > longest ? a : axis;
        longest = pm_most(side, longest);
    }
    return axis;
}

/// Sorts photons first .. first + count - 1 so that any two neighbouring leaves, and any two
/// such pairs, and so on, hold the halves of a group that was cut across its longest side.
static void arrange(const pm_photon_run *run, uint32_t first, uint32_t count)
{
    while (count > PM_BEAMS_LEAF) {
        uint32_t half = PM_BEAMS_LEAF;
        while (half < count - half) {
            half *= 2;
        }
        int axis = longest_side(run->photons + first, count);
        pm_select_place(run, first, first + count - 1, first + half, axis);
        arrange(run, first, half);
        first += half;
        count -= half;
    }
}

// --- radii ----------------------------------------------------------------------------------

/// The smallest radius that float positions around `at` can tell from 0.
static double least_radius(pm_vec3 at)
{
    float reach = (float)pm_vec_reach(at);
    return (double)nextafterf(reach, INFINITY) - (double)reach;
}

/// Asks for one more than the neighbour: a photon finds itself first.
static pm_status radius_by_neighbours(const making *make, pm_vec3 at, pm_neighbour *nearest,
                                      double *radius)
{
    pm_estimate_query query = {{.at = at}, PM_GATHER_SPHERE, 1.0, make->skip, 0};
    pm_search search = {
        .at = at,
        .k = make->neighbour + 1,
        .radius2 = HUGE_VAL,
        .accept = pm_estimate_accept,
        .context = &query,
    };
    uint32_t found;
    PM_TRY(pm_balance_nearest(make->map, &search, nearest, &found, NULL));
    *radius = pm_least(pm_most(sqrt(nearest[0].distance2), least_radius(at)), (double)FLT_MAX);
    return PM_OK;
}

static pm_status make_ball(const void *context, void *scratch, int x, int y)
{
    const making *make = context;
    uint32_t index = (uint32_t)y * COLUMNS + (uint32_t)x;
    if (index >= make->beams.count) {
        return PM_OK;
    }
    const float *place = make->photons[index].position;
    pm_vec3 at = pm_vec((double)place[0], (double)place[1], (double)place[2]);
    double radius = make->radius;
    if (isinf(radius)) {
        PM_TRY(radius_by_neighbours(make, at, scratch, &radius));
    }
    make->found[index] = (float)radius;
    // A ray a radius away may see an end another radius beyond it.
    make->beams.rim[index] = pm_rim_find(make->world, at, 2.0 * radius);
    return PM_OK;
}

static pm_status scratch_begin(const void *context, void **scratch)
{
    const making *make = context;
    *scratch = calloc((size_t)make->neighbour + 1, sizeof(pm_neighbour));
    return *scratch != NULL
               ? PM_OK
               : PM_FAIL(PM_ENOMEM, "no memory for %u neighbours", make->neighbour);
}

static void scratch_end(void *context, void *scratch)
{
    (void)context;
    free(scratch);
}

static pm_status make_balls(making *make)
{
    pm_tiles tiles = {
        .what = "beams",
        .width = COLUMNS,
        .height = (int)(((uint64_t)make->beams.count + COLUMNS - 1) / COLUMNS),
        .context = make,
        .begin = scratch_begin,
        .pixel = make_ball,
        .end = scratch_end,
    };
    return pm_tiles_run(&tiles);
}

// --- balls and boxes ------------------------------------------------------------------------

/// The least power of two that no coordinate of a ball exceeds.
static double unit_of(const making *make)
{
    double reach = 0.0;
    for (uint32_t i = 0; i < make->beams.count; i++) {
        const float *at = make->photons[i].position;
        pm_vec3 center = pm_vec((double)at[0], (double)at[1], (double)at[2]);
        reach = pm_most(reach, pm_vec_reach(center) + (double)make->found[i]);
    }
    int exponent;
    (void)frexp(reach, &exponent);
    return ldexp(1.0, exponent);
}

static void fill_leaves(making *make)
{
    double per_metre = 1.0 / make->beams.unit;
    for (uint32_t i = 0; i < make->beams.count; i++) {
        pm_beam_leaf *leaf = &make->beams.leaf[i / PM_BEAMS_LEAF];
        uint32_t place = i % PM_BEAMS_LEAF;
        for (int axis = 0; axis < 3; axis++) {
            double at = (double)make->photons[i].position[axis];
            leaf->at[axis][place] = (float)(at * per_metre);
        }
        leaf->radius[place] = fmaxf((float)((double)make->found[i] * per_metre), LEAST);
        pm_rim *rim = &make->beams.rim[i];
        rim->distance = (float)((double)rim->distance * per_metre);
    }
}

typedef struct {
    float low[3], high[3];
} box;

static const box empty_box = {{INFINITY, INFINITY, INFINITY},
                              {-INFINITY, -INFINITY, -INFINITY}};

static box box_of_leaf(const pm_beam_leaf *leaf)
{
    box around = empty_box;
    for (int i = 0; i < PM_BEAMS_LEAF && leaf->radius[i] > 0.0f; i++) {
        float reach = leaf->radius[i] + PM_BEAMS_SLACK;
        for (int axis = 0; axis < 3; axis++) {
            around.low[axis] = fminf(around.low[axis], leaf->at[axis][i] - reach);
            around.high[axis] = fmaxf(around.high[axis], leaf->at[axis][i] + reach);
        }
    }
    return around;
}

static box box_of_node(const pm_beam_node *node)
{
    box around = empty_box;
    for (int axis = 0; axis < 3; axis++) {
        for (int i = 0; i < PM_BEAMS_WIDE; i++) {
            around.low[axis] = fminf(around.low[axis], node->low[axis][i]);
            around.high[axis] = fmaxf(around.high[axis], node->high[axis][i]);
        }
    }
    return around;
}

/// The box of child `index` of a level: leaf, node of the level below, or nothing.
static box box_below(const pm_beams *beams, int level, uint64_t index)
{
    if (level == 0) {
        bool there = index * PM_BEAMS_LEAF < beams->count;
        return there ? box_of_leaf(&beams->leaf[index]) : empty_box;
    }
    uint64_t node = beams->first[level - 1] + index;
    return node < beams->first[level] ? box_of_node(&beams->node[node]) : empty_box;
}

static void make_boxes(pm_beams *beams)
{
    for (int level = 0; level < beams->levels; level++) {
        uint32_t first = beams->first[level];
        for (uint32_t i = 0; i < (beams->first[level + 1] - first) * PM_BEAMS_WIDE; i++) {
            pm_beam_node *node = &beams->node[first + i / PM_BEAMS_WIDE];
            box child = box_below(beams, level, i);
            for (int axis = 0; axis < 3; axis++) {
                node->low[axis][i % PM_BEAMS_WIDE] = child.low[axis];
                node->high[axis][i % PM_BEAMS_WIDE] = child.high[axis];
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

/// How many photons count, and which neighbour sets the radius of each.
static void count_photons(making *make, uint32_t k)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < make->map->count; i++) {
        kept += (make->map->photons[i].flags & make->skip) == 0 ? 1 : 0;
    }
    uint32_t others = kept > 0 ? kept - 1 : 0;
    make->neighbour = (uint32_t)lround(sqrt(k < others ? k : others));
    bool alone = isinf(make->radius) && make->neighbour == 0;
    make->beams.count = alone ? 0 : kept;
}

/// The levels for that many photons; one node at least. Returns the number of leaves.
static uint32_t plan_levels(pm_beams *beams)
{
    uint32_t leaves = beams->count > 0 ? (beams->count - 1) / PM_BEAMS_LEAF + 1 : 1;
    uint32_t nodes = leaves;
    do {
        nodes = (nodes - 1) / PM_BEAMS_WIDE + 1;
        beams->first[beams->levels + 1] = beams->first[beams->levels] + nodes;
        beams->levels++;
    } while (nodes > 1);
    return leaves;
}

static pm_status reserve(making *make)
{
    pm_beams *beams = &make->beams;
    size_t room = (size_t)beams->count + 1;
    size_t leaves = plan_levels(beams);
    beams->leaf = calloc(leaves, sizeof *beams->leaf);
    beams->node = calloc(beams->first[beams->levels], sizeof *beams->node);
    beams->light = calloc(room, sizeof *beams->light);
    beams->rim = calloc(room, sizeof *beams->rim);
    make->photons = calloc(room, sizeof *make->photons);
    make->found = calloc(room, sizeof *make->found);
    bool all = beams->leaf != NULL && beams->node != NULL && beams->light != NULL &&
               beams->rim != NULL && make->photons != NULL && make->found != NULL;
    return all ? PM_OK
               : PM_FAIL(PM_ENOMEM, "no memory for the beams of %u photons", beams->count);
}

static pm_status build(making *make)
{
    PM_TRY(reserve(make));
    copy_photons(make);
    pm_photon_run run = {make->photons, make->beams.light};
    arrange(&run, 0, make->beams.count);
    PM_TRY(make_balls(make));
    make->beams.unit = unit_of(make);
    fill_leaves(make);
    make_boxes(&make->beams);
    return PM_OK;
}

pm_status pm_beams_make(const pm_intersector *world, const pm_photon_map *map, double radius,
                        uint32_t k, uint16_t skip, pm_beams *out)
{
    PM_TRY(check(map, radius, k));
    making make = {
        .world = world, .map = map, .radius = radius, .skip = skip, .beams.scale = map->scale};
    count_photons(&make, k);
    pm_status status = build(&make);
    free(make.photons);
    free(make.found);
    if (status != PM_OK) {
        pm_beams_free(&make.beams);
        return status;
    }
    *out = make.beams;
    return PM_OK;
}

void pm_beams_free(pm_beams *beams)
{
    free(beams->node);
    free(beams->leaf);
    free(beams->light);
    free(beams->rim);
    *beams = (pm_beams){0};
}
