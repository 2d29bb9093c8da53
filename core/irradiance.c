// Invariant: a place has the position and the coarse normal of one photon, and the estimate
// there.
//
// The photon itself counts, though near it photons are known to be: a point takes the nearest
// place, and between the two no other place is, which lacks as much.
#include "irradiance.h"

#include "coarse_normal.h"
#include "fill.h"
#include "photon_map.h"
#include "store.h"
#include "tiles.h"

#include <stdlib.h>

#define COLUMNS 256 // places are dealt to threads as pixels of a picture this wide
#define ALIKE 0.9   // least cosine between normals of surfaces that face alike
#define SAME 0.99   // and between a surface's normal and its coarse one
// From where the surface under a photon is looked for, over the photon's largest coordinate:
// far more than float rounding.
#define ABOVE 0x1p-17

/// What a place keeps in the direction that it has no other use for.
enum { RADIUS, FOUND, UNEVEN };

typedef struct {
    const pm_intersector *world;
    const pm_photon_map *global;
    const pm_estimate_settings *settings;
    uint32_t spacing;
    pm_photon_map *places;
} making;

/// The normal of the surface that holds the photon. The coarse one would tilt the disc, which
/// then misses photons at its rim: some percent of the irradiance.
static pm_vec3 normal_under(const pm_intersector *world, const pm_photon_view *photon)
{
    double above = ABOVE * pm_vec_reach(photon->position);
    pm_ray ray = {
        .origin = pm_vec_along(photon->position, photon->normal, above),
        .direction = pm_vec_negate(photon->normal),
        .t_max = 2.0 * above,
        .medium = PM_NONE,
    };
    pm_hit hit;
    if (above == 0.0 || !pm_closest(world, &ray, &hit)) {
        return photon->normal;
    }
    bool behind = pm_vec_dot(hit.normal, photon->normal) < 0.0;
    pm_vec3 normal = behind ? pm_vec_negate(hit.normal) : hit.normal;
    return pm_vec_dot(normal, photon->normal) >= SAME ? normal : photon->normal;
}

static pm_photon_exact pack(const pm_estimate *found, double unevenness)
{
    pm_photon_exact exact;
    for (int c = 0; c < 3; c++) {
        exact.power[c] = (float)found->value.c[c];
    }
    exact.direction[RADIUS] = (float)found->radius;
    exact.direction[FOUND] = (float)found->found;
    exact.direction[UNEVEN] = (float)unevenness;
    return exact;
}

static pm_status make_place(const void *context, void *scratch, int x, int y)
{
    const making *pass = context;
    uint32_t index = (uint32_t)y * COLUMNS + (uint32_t)x;
    if (index >= pass->places->count) {
        return PM_OK;
    }
    uint32_t from = index * pass->spacing;
    pm_photon_view photon = pm_store_unpack(pass->global, from);
    pm_estimate_point point = {photon.position, normal_under(pass->world, &photon)};
    pm_estimate found;
    PM_TRY(pm_estimate_irradiance(pass->global, pass->settings, &point, scratch, &found));
    double unevenness = pm_fill_unevenness(pass->global, scratch, &found, &point);
    pass->places->photons[index] = pass->global->photons[from];
    pass->places->exact[index] = pack(&found, unevenness);
    return PM_OK;
}

static pm_status scratch_begin(const void *context, void **scratch)
{
    const making *pass = context;
    *scratch = calloc(pass->settings->k, sizeof(pm_neighbour));
    return *scratch != NULL
               ? PM_OK
               : PM_FAIL(PM_ENOMEM, "no memory for %u neighbours", pass->settings->k);
}

static void scratch_end(void *context, void *scratch)
{
    (void)context;
    free(scratch);
}

static pm_status make_all(making *pass)
{
    pm_tiles tiles = {
        .what = "irradiance",
        .width = COLUMNS,
        .height = (int)(((uint64_t)pass->places->count + COLUMNS - 1) / COLUMNS),
        .context = pass,
        .begin = scratch_begin,
        .pixel = make_place,
        .end = scratch_end,
    };
    PM_TRY(pm_tiles_run(&tiles));
    return pm_balance_build(pass->places);
}

pm_status pm_irradiance_make(const pm_intersector *world, const pm_photon_map *global,
                             const pm_estimate_settings *settings, uint32_t spacing,
                             pm_photon_map *places)
{
    if (settings->k == 0 || spacing == 0) {
        return PM_FAIL(PM_EINPUT, "k and spacing must be >= 1, got %u and %u", settings->k,
                       spacing);
    }
    pm_photon_map made = {
        .kind = PM_MAP_GLOBAL,
        .unpacked = true,
        .scaled = true,
        .emitted = global->emitted,
        .scale = 1.0,
    };
    making pass = {world, global, settings, spacing, &made};
    uint32_t count = (uint32_t)(((uint64_t)global->count + spacing - 1) / spacing);
    PM_TRY(pm_photon_map_reserve(&made, count));
    made.count = count;
    pm_status status = make_all(&pass);
    if (status != PM_OK) {
        pm_photon_map_free(&made);
        return status;
    }
    *places = made;
    return PM_OK;
}

double pm_irradiance_reach(const pm_photon_map *places)
{
    double reach = 0.0;
    for (uint32_t i = 0; i < places->count; i++) {
        reach = pm_most(reach, (double)places->exact[i].direction[RADIUS]);
    }
    return reach;
}

/// Who asks which place covers a point.
typedef struct {
    pm_estimate_query query;
    const pm_photon_map *places;
} asking;

/// In the manner of pm_estimate_accept().
static bool covers(const void *context, const pm_photon *place, double *distance2)
{
    const asking *who = context;
    if (!pm_normal_within(place->flags >> PM_PHOTON_NORMAL_SHIFT, who->query.point.normal,
                          ALIKE) ||
        !pm_estimate_accept(&who->query, place, distance2)) {
        return false;
    }
    double radius = (double)who->places->exact[place - who->places->photons].direction[RADIUS];
    return *distance2 <= radius * radius;
}

static void read_place(const pm_photon_map *places, uint32_t index, pm_estimate *found,
                       double *unevenness)
{
    const float *kept = places->exact[index].direction;
    *found = (pm_estimate){
        .value = pm_store_power(places, index),
        .radius = (double)kept[RADIUS],
        .found = (uint32_t)kept[FOUND],
    };
    *unevenness = (double)kept[UNEVEN];
}

pm_status pm_irradiance_find(const pm_photon_map *places, const pm_estimate_settings *settings,
                             double reach, const pm_estimate_point *point, bool *covered,
                             pm_estimate *found, double *unevenness)
{
    asking who = {{*point, settings->shape, settings->flatness, 0, 0}, places};
    pm_search search = {
        .at = point->at,
        .k = 1,
        .radius2 = reach * reach,
        .accept = covers,
        .context = &who,
    };
    *covered = false;
    if (search.radius2 == 0.0) {
        return PM_OK;
    }
    pm_neighbour nearest;
    uint32_t count;
    PM_TRY(pm_balance_nearest(places, &search, &nearest, &count, NULL));
    *covered = count > 0;
    if (*covered) {
        read_place(places, nearest.index, found, unevenness);
    }
    return PM_OK;
}
