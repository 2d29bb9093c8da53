// What the stages are asked is what the estimate asks them: the same search, the same kernel at
// the same distances. Only who sets the radius is decided here again, by the rule of
// estimate.h.
#include "gathered.h"

#include "file.h"
#include "store.h"

#include <stdio.h>
#include <stdlib.h>

/// One dump on its way.
typedef struct {
    FILE *out;
    const pm_photon_map *map;
    const pm_estimate_settings *settings;
    pm_estimate_query query;
    pm_vec3 center;
    pm_neighbour *nearest; // sorted by index
    uint32_t found;
    uint32_t rim;      // place of the photon that sets the radius, or PM_MAP_MAX
    double reach2;     // squared radius in the measure of the search
    double normalises; // what a weighted sum is divided by, besides the area
} gathering;

static int compare(const void *a, const void *b)
{
    uint32_t x = ((const pm_neighbour *)a)->index;
    uint32_t y = ((const pm_neighbour *)b)->index;
    return (x > y) - (x < y);
}

static pm_status find(gathering *g)
{
    const pm_estimate_settings *s = g->settings;
    pm_search what = {.at = g->query.point.at,
                      .k = s->k,
                      .radius2 = s->radius * s->radius,
                      .accept = pm_estimate_accept,
                      .context = &g->query};
    PM_TRY(pm_balance_nearest(g->map, &what, g->nearest, &g->found, NULL));
    qsort(g->nearest, g->found, sizeof *g->nearest, compare);
    g->rim = PM_MAP_MAX;
    g->reach2 = what.radius2;
    if (g->found == 0 || (g->found < s->k && isfinite(s->radius))) {
        return PM_OK;
    }
    uint32_t last = 0;
    for (uint32_t i = 1; i < g->found; i++) {
        last = g->nearest[i].distance2 > g->nearest[last].distance2 ? i : last;
    }
    g->rim = s->plain_k ? PM_MAP_MAX : g->nearest[last].index;
    g->reach2 = g->nearest[last].distance2;
    return PM_OK;
}

static void write_vector(FILE *out, pm_vec3 v)
{
    fprintf(out, ",%.9g,%.9g,%.9g", v.x, v.y, v.z);
}

static void write_row(const gathering *g, const char *what, uint32_t index, double distance2,
                      double weight)
{
    pm_photon_view photon = pm_store_unpack(g->map, index);
    const double *power = photon.power.c;
    fprintf(g->out, "%s,%u", what, index);
    write_vector(g->out, pm_vec_add(photon.position, g->center));
    write_vector(g->out, photon.normal);
    write_vector(g->out, photon.direction);
    fprintf(g->out, ",%.9g,%.9g,%.9g,%.9g,%.9g\n", power[0], power[1], power[2],
            sqrt(distance2), weight);
}

static void write_region(const gathering *g, const pm_estimate *estimate)
{
    bool ball = g->settings->shape == PM_GATHER_SPHERE;
    const double *value = estimate->value.c;
    fputs("what,number,x,y,z,nx,ny,nz,dx,dy,dz,r,g,b,distance,weight\n", g->out);
    fprintf(g->out, "%s,%u", ball ? "sphere" : "disc", estimate->found);
    write_vector(g->out, pm_vec_add(g->query.point.at, g->center));
    write_vector(g->out, g->query.point.normal);
    fprintf(g->out, ",0,0,0,%.9g,%.9g,%.9g,%.9g,%.9g\n", value[0], value[1], value[2],
            estimate->radius, ball ? 1.0 : g->settings->flatness);
}

static pm_status write_gathered(const gathering *g, const pm_neighbour *neighbour)
{
    double weight = 0.0;
    bool rim = neighbour->index == g->rim;
    double u = g->reach2 > 0.0 ? neighbour->distance2 / g->reach2 : 0.0;
    if (!rim) {
        PM_TRY(pm_filter_weight(g->settings->filter, g->settings->constants, u, &weight));
    }
    write_row(g, rim ? "rim" : "counted", neighbour->index, neighbour->distance2,
              weight / g->normalises);
    return PM_OK;
}

/// A photon that the search did not give.
static void write_other(const gathering *g, uint32_t index, double around2)
{
    const pm_photon *photon = &g->map->photons[index];
    pm_vec3 place = pm_vec((double)photon->position[0], (double)photon->position[1],
                           (double)photon->position[2]);
    pm_vec3 away = pm_vec_sub(place, g->query.point.at);
    double distance2 = pm_vec_dot(away, away);
    if (distance2 <= around2) {
        bool reached = pm_estimate_accept(&g->query, photon, &distance2);
        write_row(g, reached ? "near" : "behind", index, distance2, 0.0);
    }
}

static pm_status write_photons(const gathering *g, double radius)
{
    double around2 = PM_GATHERED_AROUND * PM_GATHERED_AROUND * radius * radius;
    uint32_t next = 0; // of those found
    for (uint32_t i = 0; i < g->map->count; i++) {
        if (next < g->found && g->nearest[next].index == i) {
            PM_TRY(write_gathered(g, &g->nearest[next++]));
        } else {
            write_other(g, i, around2);
        }
    }
    return PM_OK;
}

static pm_status gather(gathering *g, const pm_estimate *estimate)
{
    PM_TRY(
        pm_filter_normalisation(g->settings->filter, g->settings->constants, &g->normalises));
    PM_TRY(find(g));
    write_region(g, estimate);
    return write_photons(g, estimate->radius);
}

pm_status pm_gathered_write(const char *path, const pm_photon_map *map,
                            const pm_estimate_settings *settings,
                            const pm_estimate_point *point, const pm_estimate *estimate,
                            pm_vec3 center)
{
    pm_file file = {0};
    PM_TRY(pm_file_begin(path, &file));
    gathering g = {
        .out = file.stream,
        .map = map,
        .settings = settings,
        .query = {*point, settings->shape, settings->flatness, settings->skip, settings->only},
        .center = center,
        .nearest = malloc((size_t)settings->k * sizeof *g.nearest)};
    pm_status status = g.nearest != NULL
                           ? gather(&g, estimate)
                           : PM_FAIL(PM_ENOMEM, "no memory for %u photons", settings->k);
    free(g.nearest);
    if (status == PM_OK) {
        return pm_file_commit(&file);
    }
    pm_file_abandon(&file);
    return status;
}
