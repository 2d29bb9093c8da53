// From a light a ball is a cap on the sphere of directions, or a disc on a plane across the
// light: in both worlds a round spot at a distance from an axis. A row of cells crosses it in
// an interval of azimuths, whose half width is largest at one of the row's borders or where
// meridians touch the spot.
#include "cells.h"

#include "intersect.h"
#include "shape.h"
#include "spot.h"

#include <string.h>

/// A ball as the light sees it.
typedef struct {
    double middle;  // distance from the axis [rad or m]
    double azimuth; // [rad]
    double radius;  // [rad or m]
    double touch;   // distance at which meridians touch it, and the half width there [rad];
    double widest;  // touch < 0: it holds the pole
} round_spot;

// --- the light's square ------------------------------------------------------------------

static bool is_flat(const pm_shape *shape)
{
    return shape->type == PM_SHAPE_RECTANGLE || shape->type == PM_SHAPE_DISK;
}

/// Where row `row` begins, by what emit.h says that u[0] means.
static double border_at(const pm_scene *scene, const pm_light *light, int row)
{
    double u = (double)row / PM_CELLS_ROWS;
    switch (light->type) {
    case PM_LIGHT_POINT:
        return acos(1.0 - 2.0 * u);
    case PM_LIGHT_SPOT:
        return pm_spot_angle(light, u);
    case PM_LIGHT_AREA:
        return asin(sqrt(u));
    default:
        return scene->radius * sqrt(u);
    }
}

static void stand_on_lamp(const pm_shape *shape, pm_cells *cells)
{
    pm_hit start = {0};
    pm_shape_point(shape, 0.5, 0.5, &start);
    pm_ball whole = pm_pieces_whole(shape);
    cells->axis = pm_frame_around(start.normal);
    cells->apex = whole.center;
    cells->spread = whole.radius;
}

bool pm_cells_begin(const pm_scene *scene, const pm_light *light, pm_cells *cells)
{
    *cells = (pm_cells){.apex = light->position};
    switch (light->type) {
    case PM_LIGHT_POINT:
        cells->axis = pm_frame_around(pm_vec(0.0, 0.0, 1.0));
        break;
    case PM_LIGHT_SPOT:
        cells->axis = pm_frame_around(light->direction);
        break;
    case PM_LIGHT_AREA:
        if (!is_flat(&scene->shapes[light->shape])) {
            return false;
        }
        stand_on_lamp(&scene->shapes[light->shape], cells);
        break;
    case PM_LIGHT_DIRECTIONAL:
        cells->flat = true;
        cells->apex = pm_vec(0.0, 0.0, 0.0);
        cells->axis = pm_frame_around(light->direction);
        break;
    case PM_LIGHT_CONSTANT:
        return false;
    }
    for (int row = 0; row <= PM_CELLS_ROWS; row++) {
        cells->border[row] = border_at(scene, light, row);
    }
    return true;
}

// --- the spot that a ball makes on it ----------------------------------------------------

static void touch_flat(round_spot *spot)
{
    if (spot->middle > spot->radius) {
        spot->touch = sqrt(spot->middle * spot->middle - spot->radius * spot->radius);
        spot->widest = asin(spot->radius / spot->middle);
    }
}

static void touch_round(round_spot *spot)
{
    if (spot->middle > spot->radius && spot->middle + spot->radius < PM_PI) {
        spot->touch = acos(cos(spot->middle) / cos(spot->radius));
        spot->widest = asin(pm_least(1.0, sin(spot->radius) / sin(spot->middle)));
    }
}

/// @return false when it may lie in any direction
static bool see(const pm_cells *cells, const pm_ball *ball, round_spot *spot)
{
    pm_vec3 way = pm_vec_sub(ball->center, cells->apex);
    double x = pm_vec_dot(way, cells->axis.s);
    double y = pm_vec_dot(way, cells->axis.t);
    double aside = hypot(x, y);
    *spot = (round_spot){.azimuth = atan2(y, x), .touch = -1.0};
    if (cells->flat) {
        spot->middle = aside;
        spot->radius = ball->radius;
        touch_flat(spot);
        return true;
    }
    double distance = pm_vec_length(way);
    double reach = ball->radius + cells->spread;
    if (!(reach < distance)) {
        return false;
    }
    spot->middle = atan2(aside, pm_vec_dot(way, cells->axis.n));
    spot->radius = asin(reach / distance) + PM_OFFSET; // more than rounding of any direction
    touch_round(spot);
    return spot->radius < 0.5 * PM_PI;
}

/// Half the width [rad] of the spot at `distance` from the axis; below 0: it is not there.
static double half_width_at(const pm_cells *cells, const round_spot *spot, double distance)
{
    double m = spot->middle;
    double r = spot->radius;
    double num;
    double den;
    if (cells->flat) {
        num = distance * distance + m * m - r * r;
        den = 2.0 * distance * m;
    } else {
        num = cos(r) - cos(distance) * cos(m);
        den = sin(distance) * sin(m);
    }
    return num > den ? -1.0 : num <= -den ? PM_PI : acos(num / den);
}

// --- cells -------------------------------------------------------------------------------

static void light_columns(pm_cells *cells, int row, double azimuth, double half_width)
{
    const double column = 2.0 * PM_PI / PM_CELLS_COLUMNS;
    int first = (int)floor((azimuth - half_width) / column);
    int last = (int)floor((azimuth + half_width) / column);
    if (last - first >= PM_CELLS_COLUMNS) {
        last = first + PM_CELLS_COLUMNS - 1;
    }
    bool *lit = &cells->lit[(size_t)row * PM_CELLS_COLUMNS];
    for (int i = first; i <= last; i++) {
        bool *cell = &lit[(i + 2 * PM_CELLS_COLUMNS) % PM_CELLS_COLUMNS];
        cells->lit_count += !*cell;
        *cell = true;
    }
}

static void light_row(pm_cells *cells, int row, const round_spot *spot)
{
    double from = cells->border[row];
    double to = cells->border[row + 1];
    double half_width =
        pm_most(half_width_at(cells, spot, from), half_width_at(cells, spot, to));
    if (spot->touch > from && spot->touch < to) {
        half_width = pm_most(half_width, spot->widest);
    }
    if (half_width >= 0.0) {
        light_columns(cells, row, spot->azimuth, half_width);
    }
}

void pm_cells_light(pm_cells *cells, const pm_ball *ball)
{
    if (cells->lit_count == PM_CELLS) {
        return;
    }
    round_spot spot;
    if (!see(cells, ball, &spot)) {
        memset(cells->lit, true, sizeof cells->lit);
        cells->lit_count = PM_CELLS;
        return;
    }
    for (int row = 0; row < PM_CELLS_ROWS; row++) {
        bool beyond = cells->border[row] > spot.middle + spot.radius;
        bool before = cells->border[row + 1] < spot.middle - spot.radius;
        if (!beyond && !before) {
            light_row(cells, row, &spot);
        }
    }
}
