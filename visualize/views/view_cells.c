// view cells: where a light's photons are worth sending. Left the cells about the light in the
// scene, right the same cells unrolled: there all have the same size because all send the same
// power, so the bright part of the square is the part of the power that is sent.
#include "draw_cells.h"
#include "draw_scene.h"
#include "light_law.h"
#include "light_pick.h"
#include "view.h"
#include "view_kinds.h"

#include <stdio.h>
#include <stdlib.h>

#define MAPS_SHOWN 2
#define SPHERE 0.3 // scene radii
#define REACH 1.3  // scene radii that rays are drawn
#define FORE 1.05  // scene radii that a disc stands before the middle
#define DEGREES (180.0 / PM_PI)

typedef struct {
    pm_cell_set set;
    const pm_cell_map *map[MAPS_SHOWN]; // of one light
    int count;
    int lights; // that have cells
} job;

// --- which cells -------------------------------------------------------------------------

static pm_status find_light(const pm_view *view, const job *j, uint32_t *light)
{
    const char *wanted = view->options->light;
    *light = j->set.maps[0].light;
    if (wanted != NULL && view->options->scene == NULL) {
        return pm_status_fail(PM_EINPUT,
                              "view: --light %s is looked up in the scene: give "
                              "--scene SCENE.xml, too",
                              wanted);
    }
    int index = PM_NONE;
    PM_TRY(pm_light_pick(&view->scene, wanted, &index));
    *light = index == PM_NONE ? *light : (uint32_t)index;
    return PM_OK;
}

static pm_status check_lights(const pm_view *view, const job *j)
{
    for (int i = 0; i < j->set.count && view->options->scene != NULL; i++) {
        if (j->set.maps[i].light >= (uint32_t)view->scene.light_count) {
            return pm_status_fail(
                PM_EINPUT,
                "%s: light %u is not in %s, which has %d (counted from 0): the file "
                "comes from another scene",
                view->files[0], j->set.maps[i].light, view->scene.path,
                view->scene.light_count);
        }
    }
    return PM_OK;
}

static int count_lights(const pm_cell_set *set)
{
    int count = 0;
    for (int i = 0; i < set->count; i++) {
        bool before = false;
        for (int k = 0; k < i; k++) {
            before |= set->maps[k].light == set->maps[i].light;
        }
        count += !before;
    }
    return count;
}

/// Whether the light has no other map to be seen than this one. A map that nothing can reach is
/// one dark cell: beside another one it is only noted.
static bool alone_of_light(const pm_cell_set *set, int index)
{
    for (int i = 0; i < set->count; i++) {
        bool same = i != index && set->maps[i].light == set->maps[index].light;
        if (same && (set->maps[i].lit > 0 || i < index)) {
            return false;
        }
    }
    return true;
}

static pm_status choose(const pm_view *view, job *j)
{
    uint32_t light = 0;
    PM_TRY(pm_cell_file_read(view->files[0], &j->set));
    PM_TRY(check_lights(view, j));
    PM_TRY(find_light(view, j, &light));
    j->lights = count_lights(&j->set);
    for (int i = 0; i < j->set.count && j->count < MAPS_SHOWN; i++) {
        const pm_cell_map *map = &j->set.maps[i];
        if (map->light == light && (map->lit > 0 || alone_of_light(&j->set, i))) {
            j->map[j->count++] = map;
        }
    }
    if (j->count == 0) {
        return pm_status_fail(PM_EINPUT,
                              "%s: holds no cell of the light \"%s\": it sends "
                              "everywhere",
                              view->files[0], view->options->light);
    }
    return PM_OK;
}

// --- about the light ---------------------------------------------------------------------

static pm_cell_place stand_in_scene(const pm_scene *scene, const pm_cell_map *map)
{
    pm_light_law law = pm_light_law_of(scene, (int)map->light);
    pm_cell_place place = {.middle = law.light->position,
                           .axis = law.axis,
                           .radius = SPHERE * scene->radius,
                           .reach = REACH * scene->radius};
    if (map->flat) {
        place.reach = 2.0 * FORE * scene->radius;
        place.middle = pm_vec_scale(law.axis.n, -FORE * scene->radius);
    }
    return place;
}

static double size_of(const pm_cell_map *map, const pm_cell_place *place)
{
    return map->flat ? map->cells[(size_t)map->rows * map->columns - 1].far : place->radius;
}

/// All of the scene and of the cells.
static pm_status open_panel(pm_view *view, const pm_cell_map *map, const pm_cell_place *place,
                            const pm_rect *where)
{
    bool there = view->options->scene != NULL;
    double size = size_of(map, place);
    pm_vec3 half = pm_vec(size, size, size);
    pm_vec3 low = pm_vec_sub(place->middle, half);
    pm_vec3 high = pm_vec_add(place->middle, half);
    pm_vec3 forward = pm_vec_normalize(pm_vec(-0.5, 0.8, -0.35));
    pm_vec3 up = pm_vec(0.0, 0.0, 1.0);
    if (there) {
        low = pm_vec_min(low, view->scene.low);
        high = pm_vec_max(high, view->scene.high);
    }
    if (there && view->scene.has_camera) {
        forward = view->scene.camera.forward;
        up = view->scene.camera.up;
    }
    pm_viewpoint viewpoint =
        pm_viewpoint_box(low, high, forward, up, where->width, where->height);
    PM_TRY(pm_figure_panel(view->figure, where, &viewpoint));
    return there ? pm_draw_scene(view->figure, &view->scene) : PM_OK;
}

static pm_status draw_about(pm_view *view, const pm_cell_map *map, const pm_rect *where)
{
    pm_cell_place place = {.axis = pm_frame_around(pm_vec(0.0, 0.0, 1.0)), .radius = 1.0};
    if (view->options->scene != NULL) {
        place = stand_in_scene(&view->scene, map);
    }
    PM_TRY(open_panel(view, map, &place, where));
    return pm_draw_cells(view->figure, map, &place);
}

// --- unrolled ----------------------------------------------------------------------------

static pm_status draw_square(pm_view *view, const pm_cell_map *map, const pm_rect *where)
{
    size_t pixels = (size_t)where->width * (size_t)where->height;
    uint8_t *picture = malloc(3 * pixels);
    if (picture == NULL) {
        return PM_FAIL(PM_ENOMEM, "%s", "no memory for cells");
    }
    for (size_t i = 0; i < pixels; i++) {
        size_t row = i / (size_t)where->width * map->rows / (size_t)where->height;
        size_t column = i % (size_t)where->width * map->columns / (size_t)where->width;
        bool lit = map->cells[row * map->columns + column].lit;
        pm_colour colour = lit ? pm_cell_lit() : pm_cell_dark();
        picture[3 * i] = colour.r;
        picture[3 * i + 1] = colour.g;
        picture[3 * i + 2] = colour.b;
    }
    pm_status status = pm_figure_picture(view->figure, picture, where->width, where->height,
                                         where->x, where->y);
    free(picture);
    return status;
}

/// Distances from the axis at the sides of some rows, and azimuths below.
static pm_status write_sides(pm_view *view, const pm_cell_map *map, const pm_rect *where)
{
    char text[64];
    double size = pm_figure_pixels_of(view->figure, 16.0);
    for (int i = 0; i <= 4; i++) {
        uint32_t row = map->rows * (uint32_t)i / 4;
        double at =
            row == 0 ? map->cells[0].near : map->cells[(size_t)(row - 1) * map->columns].far;
        snprintf(text, sizeof text, map->flat ? "%.3g m" : "%.3g\xc2\xb0",
                 map->flat ? at : at * DEGREES);
        double y = where->y + (double)row / map->rows * where->height - 0.5 * size;
        PM_TRY(pm_figure_text(view->figure, text, where->x - 0.5 * size, y, size,
                              PM_TEXT_DIM_RIGHT));
    }
    double below = where->y + where->height + 0.4 * size;
    PM_TRY(pm_figure_text(view->figure, "0\xc2\xb0", where->x, below, size, PM_TEXT_DIM));
    PM_TRY(pm_figure_text(view->figure, "azimuth", where->x + 0.5 * where->width - 2.0 * size,
                          below, size, PM_TEXT_DIM));
    return pm_figure_text(view->figure, "360\xc2\xb0", where->x + where->width, below, size,
                          PM_TEXT_DIM_RIGHT);
}

static void add_fact(const pm_cell_map *map, const pm_rect *where, json_t *maps)
{
    json_array_append_new(maps,
                          json_pack("{s:s,s:I,s:I,s:I,s:i,s:i,s:i,s:i}", "map", map->map,
                                    "light", (json_int_t)map->light, "cells",
                                    (json_int_t)map->rows * (json_int_t)map->columns, "active",
                                    (json_int_t)map->lit, "x", where->x, "y", where->y, "width",
                                    where->width, "height", where->height));
}

// --- the page ----------------------------------------------------------------------------

static double share_lit(const pm_cell_map *map)
{
    return (double)map->lit / ((double)map->rows * map->columns);
}

static pm_status draw_map(pm_view *view, const pm_cell_map *map, const pm_rect *about,
                          const pm_rect *square, json_t *facts)
{
    char heading[96];
    snprintf(heading, sizeof heading, "%s map: about the light", map->map);
    PM_TRY(pm_figure_caption(view->figure, about, heading));
    snprintf(heading, sizeof heading, "unrolled: %.3g %% of the power is sent",
             100.0 * share_lit(map));
    int left = (int)pm_figure_pixels_of(view->figure, 62.0);
    pm_rect over = {square->x - left, square->y, 0, 0};
    PM_TRY(pm_figure_caption(view->figure, &over, heading));
    add_fact(map, square, facts);
    PM_TRY(draw_about(view, map, about));
    PM_TRY(draw_square(view, map, square));
    return write_sides(view, map, square);
}

/// One map has a large panel, and its square stands under the legend; two stand in rows.
static void lay_out(const pm_figure *figure, int count, int index, pm_rect *about,
                    pm_rect *square)
{
    pm_rect room = pm_figure_room(figure);
    pm_rect wide = pm_figure_wide_room(figure);
    pm_rect cells[2];
    int left = (int)pm_figure_pixels_of(figure, 62.0);
    int under = (int)pm_figure_pixels_of(figure, 34.0);
    pm_rect row = {room.x, room.y + index * (room.height / count), room.width,
                   room.height / count};
    pm_figure_columns(figure, &row, 2, cells);
    *about = cells[0];
    *square = (pm_rect){cells[1].x + left, cells[1].y, cells[1].width - left,
                        cells[1].height - under};
    if (count == 1) {
        about->width = wide.width * 56 / 100;
        square->x = about->x + about->width + left + under;
        square->y += about->height * 30 / 100;
        square->width = wide.x + wide.width - square->x;
        square->height -= about->height * 30 / 100;
    } else {
        about->height -= under;
    }
    int side = square->width < square->height ? square->width : square->height;
    square->width = side;
    square->height = side;
}

static pm_status add_legend(pm_view *view)
{
    const pm_legend_entry entries[] = {
        {PM_SWATCH_FILL, pm_cell_lit(), "lit: photons are sent"},
        {PM_SWATCH_FILL, pm_cell_dark(), "dark: none is"},
        {.swatch = PM_SWATCH_NONE, .text = "rows: distance from the axis"},
        {.swatch = PM_SWATCH_NONE, .text = "all cells send the same power"},
    };
    return pm_figure_legend(view->figure, "cells", entries, 4);
}

static void write_note(pm_view *view, const job *j)
{
    char lit[PM_VIEW_GROUPED_MAX];
    char all[PM_VIEW_GROUPED_MAX];
    pm_view_note(view, "%s",
                 "the light sends photons only through cells behind which something "
                 "counts for the map\n");
    if (view->options->scene != NULL) {
        pm_view_note(view, "%s", view->scene.lights[j->map[0]->light].id);
    } else {
        pm_view_note(view, "light %u", j->map[0]->light);
    }
    for (int i = 0; i < j->set.count; i++) {
        const pm_cell_map *map = &j->set.maps[i];
        if (map->light == j->map[0]->light) {
            uint64_t cells = (uint64_t)map->rows * map->columns;
            bool none = cells == 1 && map->lit == 0;
            pm_view_note(view,
                         none ? "; %s map: nothing to aim at (%s of %s cells lit)"
                              : "; %s map: %s of %s cells lit",
                         map->map, pm_view_grouped(map->lit, lit), pm_view_grouped(cells, all));
        }
    }
    for (int i = 0; i < j->count; i++) {
        view->drawn += (uint64_t)j->map[i]->rows * j->map[i]->columns;
    }
    if (j->lights > 1) {
        pm_view_note(view, "; one of %d lights, --light picks", j->lights);
    }
}

static pm_status draw_job(pm_view *view, job *j)
{
    PM_TRY(choose(view, j));
    json_t *facts = json_array();
    pm_view_fact(view, "maps", facts);
    for (int i = 0; i < j->count; i++) {
        pm_rect about;
        pm_rect square;
        lay_out(view->figure, j->count, i, &about, &square);
        PM_TRY(draw_map(view, j->map[i], &about, &square, facts));
    }
    write_note(view, j);
    return add_legend(view);
}

static pm_status draw(pm_view *view)
{
    job j = {0};
    pm_status status = draw_job(view, &j);
    pm_cell_file_free(&j.set);
    return status;
}

const pm_view_kind pm_view_cells = {
    .name = "cells",
    .files = "CELLS.csv (emission --cells)",
    .shows = "where lights are aimed: projection maps",
    .files_least = 1,
    .files_most = 1,
    .scene = PM_VIEW_MAY_SCENE,
    .options = "light",
    .title = "Projection map: where photons are worth sending",
    .draw = draw,
};
