// Which lights are aimed at what, and whether that pays. The geometry is in cells.h.
#include "projection.h"

#include "cells.h"
#include "material.h"
#include "shape.h"

#include <stdio.h>
#include <stdlib.h>

#define PAYS_FROM 0.25 // share of all power that must be saved

/// What a map asks to be met first.
typedef struct {
    const pm_scene *scene;
    bool *wanted; // one a shape
    int count;
    const char *example; // id of the first one
    bool in_fog;         // photons that meet no shape may count: a medium may turn them
} targets;

/// Whether photons of this light may collide before they meet anything.
static bool stands_in_fog(const pm_scene *scene, const pm_light *light)
{
    return light->medium != PM_NONE && scene->media[light->medium].sigma_t > 0.0;
}

static bool any_in_fog(const pm_scene *scene)
{
    for (int i = 0; i < scene->light_count; i++) {
        if (stands_in_fog(scene, &scene->lights[i])) {
            return true;
        }
    }
    return false;
}

static bool is_specular(const pm_scene *scene, const pm_shape *shape)
{
    for (int side = 0; side < 2; side++) {
        int material = shape->material[side];
        if (material != PM_NONE &&
            pm_material_traits_of(&scene->materials[material]).specular) {
            return true;
        }
    }
    return false;
}

/// Whether a photon on the way past does not go on as if nothing were there.
static bool is_met(const pm_scene *scene, const pm_shape *shape)
{
    return shape->boundary || !pm_shape_is_null(scene, shape);
}

static pm_status choose_targets(const pm_scene *scene, pm_map_kind kind, targets *out)
{
    targets chosen = {.scene = scene};
    chosen.in_fog = kind != PM_MAP_CAUSTIC && any_in_fog(scene);
    chosen.wanted = calloc((size_t)scene->shape_count + 1, sizeof *chosen.wanted);
    if (chosen.wanted == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %d targets", scene->shape_count);
    }
    for (int i = 0; i < scene->shape_count; i++) {
        const pm_shape *shape = &scene->shapes[i];
        chosen.wanted[i] =
            kind == PM_MAP_CAUSTIC ? is_specular(scene, shape) : is_met(scene, shape);
        if (chosen.wanted[i] && chosen.count++ == 0) {
            chosen.example = shape->id;
        }
    }
    *out = chosen;
    return PM_OK;
}

/// The pieces of all targets, shape by shape: those of shape i end at end[i].
typedef struct {
    pm_pieces pieces;
    size_t *end;
} cut_targets;

static void free_cut(cut_targets *cut)
{
    pm_pieces_free(&cut->pieces);
    free(cut->end);
}

static pm_status cut_up(const targets *aim, cut_targets *out)
{
    int count = aim->scene->shape_count;
    cut_targets cut = {.end = calloc((size_t)count + 1, sizeof *cut.end)};
    pm_status status =
        cut.end == NULL ? PM_FAIL(PM_ENOMEM, "no memory for %d targets", count) : PM_OK;
    for (int i = 0; i < count && status == PM_OK; i++) {
        if (aim->wanted[i]) {
            status = pm_pieces_add(&cut.pieces, &aim->scene->shapes[i]);
        }
        cut.end[i] = cut.pieces.count;
    }
    if (status != PM_OK) {
        free_cut(&cut);
        return status;
    }
    *out = cut;
    return PM_OK;
}

// --- one light ---------------------------------------------------------------------------

/// Lights the cells of everything but the light's own shape: it is flat, and no ray from a
/// plane comes back to it.
static void light_cells(const cut_targets *cut, const pm_light *light, int shape_count,
                        pm_cells *cells)
{
    size_t first = 0;
    for (int i = 0; i < shape_count; i++) {
        for (size_t j = first; j < cut->end[i] && i != light->shape; j++) {
            pm_cells_light(cells, &cut->pieces.ball[j]);
        }
        first = cut->end[i];
    }
}

/// Appends the lit cells to the storage, which moves: only where all lists stand is
/// point_at_lists() to be called.
static pm_status list_lit(const pm_cells *cells, uint32_t **storage, size_t *used,
                          pm_projection *out)
{
    uint32_t *moved = realloc(*storage, (*used + cells->lit_count + 1) * sizeof *moved);
    if (moved == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %u lit cells", cells->lit_count);
    }
    *storage = moved;
    for (uint32_t i = 0; i < PM_CELLS; i++) {
        if (cells->lit[i]) {
            moved[(*used)++] = i;
        }
    }
    *out = (pm_projection){PM_CELLS_ROWS, PM_CELLS_COLUMNS, NULL, cells->lit_count};
    return PM_OK;
}

static void point_at_lists(pm_projections *out)
{
    size_t used = 0;
    for (int i = 0; i < out->light_count && out->storage != NULL; i++) {
        out->light[i].lit = &out->storage[used];
        used += out->light[i].lit_count;
    }
}

/// Whether the map of `kind` aims `light` at all.
static bool is_aimed(const pm_scene *scene, const pm_light *light, pm_map_kind kind)
{
    bool spread = light->type == PM_LIGHT_AREA || light->type == PM_LIGHT_CONSTANT ||
                  stands_in_fog(scene, light);
    return !pm_spectrum_is_black(light->flux) && (kind == PM_MAP_CAUSTIC || !spread);
}

// --- all lights --------------------------------------------------------------------------

/// Every light with nothing to reach: one dark cell each.
static void send_nothing(const targets *aim, pm_projections *out)
{
    for (int i = 0; i < out->light_count; i++) {
        if (!aim->in_fog || !stands_in_fog(aim->scene, &aim->scene->lights[i])) {
            out->light[i] = (pm_projection){.rows = 1, .columns = 1};
        }
    }
}

static bool aims_any(const pm_scene *scene, pm_map_kind kind)
{
    for (int i = 0; i < scene->light_count; i++) {
        if (is_aimed(scene, &scene->lights[i], kind)) {
            return true;
        }
    }
    return false;
}

static pm_status aim_all(const pm_scene *scene, pm_map_kind kind, const targets *aim,
                         pm_projections *out)
{
    if (aim->count == 0) {
        send_nothing(aim, out);
        return PM_OK;
    }
    if (!aims_any(scene, kind)) {
        return PM_OK;
    }
    cut_targets cut;
    PM_TRY(cut_up(aim, &cut));
    pm_status status = PM_OK;
    size_t used = 0;
    for (int i = 0; i < scene->light_count && status == PM_OK; i++) {
        const pm_light *light = &scene->lights[i];
        pm_cells cells;
        if (!is_aimed(scene, light, kind) || !pm_cells_begin(scene, light, &cells)) {
            continue;
        }
        light_cells(&cut, light, scene->shape_count, &cells);
        if (cells.lit_count < PM_CELLS) {
            status = list_lit(&cells, &out->storage, &used, &out->light[i]);
        }
    }
    free_cut(&cut);
    point_at_lists(out);
    return status;
}

static void sum_up(const pm_scene *scene, pm_projections *out)
{
    pm_spectrum all = pm_gray(0.0);
    for (int i = 0; i < scene->light_count; i++) {
        const pm_projection *p = &out->light[i];
        all = pm_spectrum_add(all, scene->lights[i].flux);
        uint64_t cells = (uint64_t)p->rows * p->columns;
        if (cells > 0) {
            double dark = (double)(cells - p->lit_count) / (double)cells;
            out->dark =
                pm_spectrum_add(out->dark, pm_spectrum_scale(scene->lights[i].flux, dark));
            out->cells += cells;
            out->active += p->lit_count;
        }
    }
    double total = pm_spectrum_mean(all);
    out->sent = total > 0.0 ? 1.0 - pm_spectrum_mean(out->dark) / total : 1.0;
}

/// Says what was done; undoes it when it does not pay.
static void settle(const targets *aim, pm_projections *out)
{
    double saved = 1.0 - out->sent;
    if (out->cells == 0) {
        pm_projection_free(out);
        out->sent = 1.0;
        snprintf(out->why, sizeof out->why, "%s: photons are sent everywhere",
                 aim->in_fog ? "the medium around the lights may turn light anywhere"
                             : "no light gains by aiming");
    } else if (saved < PAYS_FROM) {
        pm_projection_free(out);
        out->sent = 1.0;
        snprintf(out->why, sizeof out->why,
                 "aiming would save only %.3g %% of the power: photons are sent everywhere",
                 100.0 * saved);
    } else if (aim->count == 0) {
        snprintf(out->why, sizeof out->why, "no shape starts a path of this map: none is sent");
    } else if (aim->count == 1) {
        snprintf(out->why, sizeof out->why, "photons are aimed at %.80s", aim->example);
    } else {
        snprintf(out->why, sizeof out->why, "photons are aimed at %d shapes such as %.80s",
                 aim->count, aim->example);
    }
}

static pm_status make(const pm_scene *scene, pm_map_kind kind, const targets *aim,
                      pm_projections *out)
{
    pm_projections made = {.light_count = scene->light_count};
    made.light = calloc((size_t)scene->light_count + 1, sizeof *made.light);
    pm_status status = made.light == NULL
                           ? PM_FAIL(PM_ENOMEM, "no memory for %d lights", scene->light_count)
                           : aim_all(scene, kind, aim, &made);
    if (status != PM_OK) {
        pm_projection_free(&made);
        return status;
    }
    sum_up(scene, &made);
    settle(aim, &made);
    *out = made;
    return PM_OK;
}

pm_status pm_projection_make(const pm_scene *scene, pm_map_kind kind, pm_projections *out)
{
    targets aim = {0};
    PM_TRY(choose_targets(scene, kind, &aim));
    pm_status status = make(scene, kind, &aim, out);
    free(aim.wanted);
    return status;
}

void pm_projection_free(pm_projections *projections)
{
    free(projections->light);
    free(projections->storage);
    *projections = (pm_projections){0};
}

uint64_t pm_projection_saved(const pm_projections *projections, uint64_t emitted)
{
    double all = projections->sent > 0.0 ? (double)emitted / projections->sent : 0.0;
    return all > (double)emitted ? (uint64_t)(all - (double)emitted) : 0;
}
