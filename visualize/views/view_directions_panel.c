// A narrow cone is seen from near by, face on; anything wider is the whole sphere, its axis
// leaning towards the eye.
#include "view_directions_panel.h"

#include "chart.h"

#include <math.h>
#include <stdio.h>

#define RINGS 64
#define CURVE 121
#define NARROW 0.5 // [rad] a cone with less reach is enlarged
#define APART 4.0  // spheres of several lights do not overlap in a .vtp
#define DEGREES (180.0 / PM_PI)

// --- the sphere --------------------------------------------------------------------------

pm_colour pm_direction_colour(double t)
{
    return pm_colour_viridis(0.68 * t);
}

static bool is_enlarged(const pm_direction_light *s)
{
    return !s->law.single && s->law.reach < NARROW;
}

/// From the side that the scene's camera is on, but with the axis towards the eye.
static pm_viewpoint look_at(const pm_direction_light *s, pm_vec3 middle, const pm_rect *where)
{
    const pm_scene *scene = s->law.scene;
    pm_vec3 axis = s->law.axis.n;
    pm_vec3 back = scene->has_camera ? pm_vec_negate(scene->camera.forward)
                                     : pm_vec_normalize(pm_vec(0.5, 0.35, 1.0));
    pm_vec3 aside = pm_vec_along(back, axis, -pm_vec_dot(back, axis));
    double length = pm_vec_length(aside);
    aside = length > 0.05 ? pm_vec_scale(aside, 1.0 / length) : s->law.axis.s;
    double lean = is_enlarged(s) ? 0.3 : 1.5;
    pm_vec3 toward = pm_vec_normalize(pm_vec_along(axis, aside, lean));
    pm_vec3 up = scene->has_camera ? scene->camera.up : pm_vec(0.0, 1.0, 0.0);
    double radius = is_enlarged(s) ? 1.5 * sin(s->law.reach) : 1.3;
    pm_vec3 target = is_enlarged(s) ? pm_vec_along(middle, axis, cos(s->law.reach)) : middle;
    pm_viewpoint v = {.width = where->width, .height = where->height};
    v.forward = pm_vec_negate(toward);
    pm_vec3 right = pm_vec_cross(v.forward, up);
    v.right = pm_vec_length(right) > 1e-3 ? pm_vec_normalize(right) : s->law.axis.s;
    v.up = pm_vec_cross(v.right, v.forward);
    v.position = pm_vec_along(target, toward, 5.0 * radius);
    double small = where->width < where->height ? where->width : where->height;
    v.tan_x = 0.2 * where->width / small;
    v.tan_y = 0.2 * where->height / small;
    return v;
}

static const char *axis_word(const pm_direction_light *s)
{
    if (is_enlarged(s)) {
        return NULL;
    }
    switch (s->law.light->type) {
    case PM_LIGHT_AREA:
        return "normal";
    case PM_LIGHT_POINT:
    case PM_LIGHT_CONSTANT:
        return "z";
    case PM_LIGHT_DIRECTIONAL:
        return "its direction";
    default:
        return "axis";
    }
}

static pm_status draw_sphere(pm_view *view, const pm_direction_light *s, int place,
                             const pm_rect *where)
{
    pm_colour colours[RINGS];
    double circles[5];
    double most = pm_light_law_density(&s->law, 0.0);
    for (int i = 0; i < RINGS && !s->law.single; i++) {
        double at = s->law.reach * (i + 0.5) / RINGS;
        colours[i] = pm_direction_colour(pm_light_law_density(&s->law, at) / most);
    }
    for (int i = 0; i < 5; i++) {
        circles[i] = s->law.reach * (i + 1) / 6.0;
    }
    pm_direction_sphere sphere = {
        .middle = pm_vec(APART * place, 0.0, 0.0),
        .axis = s->law.axis,
        .axis_word = axis_word(s),
        .reach = s->law.single ? 0.0 : s->law.reach,
        .colours = colours,
        .ring_count = s->law.single ? 0 : RINGS,
        .circle = circles,
        .circle_count = s->law.single ? 0 : 5,
        .dots = s->dots,
        .count = s->dot_count,
        .light = s->index,
    };
    pm_viewpoint viewpoint = look_at(s, sphere.middle, where);
    PM_TRY(pm_figure_panel(view->figure, where, &viewpoint));
    return pm_draw_directions(view->figure, &sphere,
                              s->law.single        ? 16.0
                              : s->dot_count > 100 ? 4.0
                                                   : 6.0);
}

// --- the chart ---------------------------------------------------------------------------

static pm_status draw_curve(pm_chart *chart, const pm_light_law *law, double end)
{
    double x[CURVE];
    double y[CURVE];
    for (int i = 0; i < CURVE; i++) {
        double angle = end * i / (CURVE - 1);
        x[i] = angle * DEGREES;
        y[i] = angle <= law->reach ? pm_light_law_density(law, angle) : 0.0;
    }
    return pm_chart_curve(chart, NULL, pm_colour_named(PM_COLOUR_ORANGE), PM_CHART_LINE, x, y,
                          CURVE);
}

static pm_status draw_counts(pm_chart *chart, const pm_ray_tally *tally)
{
    double x[PM_RAY_BANDS_MAX + 1];
    double low[PM_RAY_BANDS_MAX + 1];
    double high[PM_RAY_BANDS_MAX + 1];
    int count = tally->bands + (tally->strays > 0);
    for (int i = 0; i < count; i++) {
        x[i] = 0.5 * (tally->border[i] + tally->border[i + 1]) * DEGREES;
        low[i] = pm_most(0.0, tally->density[i] - tally->error[i]);
        high[i] = tally->density[i] + tally->error[i];
    }
    pm_colour white = pm_colour_named(PM_COLOUR_WHITE);
    PM_TRY(pm_chart_errors(chart, white, x, low, high, count));
    return pm_chart_curve(chart, NULL, white, PM_CHART_DOTS, x, tally->density, count);
}

static double highest(const pm_direction_light *s)
{
    double most = pm_light_law_density(&s->law, 0.0);
    for (int i = 0; i <= s->tally.bands; i++) {
        most = pm_most(most, s->tally.density[i] + s->tally.error[i]);
    }
    return most;
}

static pm_status draw_chart(pm_view *view, const pm_direction_light *s, bool beside,
                            const pm_rect *where)
{
    double end = s->tally.strays > 0 ? PM_PI : s->law.reach;
    pm_chart_axes axes = {
        .x_title = beside                                ? "angle [degrees]"
                   : s->law.light->type == PM_LIGHT_AREA ? "angle to the normal [degrees]"
                                                         : "angle to the axis [degrees]",
        .y_title = "density [1/sr]",
        .x_high = end * DEGREES,
        .y_high = 1.12 * highest(s),
    };
    pm_chart *chart;
    PM_TRY(pm_chart_open(view->figure, where, &axes, &chart));
    PM_TRY(draw_curve(chart, &s->law, end));
    PM_TRY(draw_counts(chart, &s->tally));
    return pm_chart_close(chart);
}

/// A directional light has no density to draw: a sentence in place of the chart.
static pm_status write_single(pm_view *view, const pm_direction_light *s, const pm_rect *where)
{
    char text[160];
    double size = pm_figure_pixels_of(view->figure, 18.0);
    int used = snprintf(text, sizeof text, "%s", "parallel light has one direction:\n");
    if (s->tally.strays == 0) {
        snprintf(text + used, sizeof text - (size_t)used, "%s", "all its photons keep to it");
    } else {
        char off[PM_VIEW_GROUPED_MAX];
        snprintf(text + used, sizeof text - (size_t)used, "%s of its photons leave it",
                 pm_view_grouped(s->tally.strays, off));
    }
    return pm_figure_text(view->figure, text, where->x, where->y + size, size, PM_TEXT_DIM);
}

pm_status pm_draw_direction_light(pm_view *view, const pm_direction_light *s, int place,
                                  bool beside, const pm_rect *cell)
{
    char heading[128];
    int gap = (int)pm_figure_pixels_of(view->figure, 14.0);
    int part = beside ? cell->width * 43 / 100 : cell->height * 55 / 100;
    pm_rect sphere = {cell->x, cell->y, beside ? part : cell->width, part};
    pm_rect chart = {cell->x + (beside ? part : 0), cell->y + (beside ? 0 : part + gap),
                     cell->width - (beside ? part : 0),
                     cell->height - gap - (beside ? 0 : part)};
    snprintf(heading, sizeof heading, "%s%s", s->law.light->id,
             is_enlarged(s)  ? " (enlarged)"
             : s->law.turned ? " (about its normals)"
                             : "");
    PM_TRY(pm_figure_caption(view->figure, &sphere, heading));
    PM_TRY(draw_sphere(view, s, place, &sphere));
    return s->law.single ? write_single(view, s, &chart) : draw_chart(view, s, beside, &chart);
}
