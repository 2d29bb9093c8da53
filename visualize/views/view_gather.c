// view gather: the photons that an estimate is made of, one or two regions side by side. All
// panels show a piece of the scene of the same size, so that regions can be compared.
#include "draw_gather.h"
#include "draw_scene.h"
#include "gathered_file.h"
#include "view.h"
#include "view_kinds.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define FILES_MOST 2

static const double around = 0.98;   // half side of what is shown, in radii
static const double height = 0.47;   // sine of the angle from which a surface is looked at
static const double beside = 1.1;    // how far the eye turns to face a wall nearby
static const double tallest = 1.25;  // height over width of a panel
static const double lines = 5.0;     // of text under a panel
static const double line_900 = 29.0; // pixels from one to the next
static const double size_900 = 20.0;

/// The regions of one picture.
typedef struct {
    pm_gathered region[FILES_MOST];
    int count;
} regions;

static void release(void *data)
{
    regions *all = data;
    for (int i = 0; i < all->count; i++) {
        pm_gathered_file_free(&all->region[i]);
    }
    free(all);
}

/// `v` without its part along the unit vector `n`, of length 1, or 0 where nothing remains.
static pm_vec3 flatten(pm_vec3 v, pm_vec3 n)
{
    pm_vec3 flat = pm_vec_along(v, n, -pm_vec_dot(v, n));
    double length = pm_vec_length(flat);
    return length > 1e-6 ? pm_vec_scale(flat, 1.0 / length) : pm_vec(0.0, 0.0, 0.0);
}

/// Where walls around the region look to, in its plane.
static pm_vec3 face_of_walls(const pm_gathered *g)
{
    pm_vec3 sum = pm_vec(0.0, 0.0, 0.0);
    for (uint64_t i = 0; i < g->count; i++) {
        if (pm_vec_dot(g->photons[i].normal, g->normal) <= PM_GATHER_SAME) {
            sum = pm_vec_add(sum, g->photons[i].normal);
        }
    }
    return flatten(sum, g->normal);
}

/// Obliquely from above the surface, from the scene's camera's side, but never from behind a
/// wall that stands beside it.
static pm_viewpoint aim(const pm_scene *scene, const pm_gathered *g, double reach,
                        const pm_rect *where)
{
    pm_vec3 back =
        scene->has_camera ? pm_vec_negate(scene->camera.forward) : pm_vec(0.5, 0.35, 1.0);
    pm_vec3 top = scene->has_camera ? scene->camera.up : pm_vec(0.0, 1.0, 0.0);
    pm_vec3 side = flatten(back, g->normal);
    side = pm_vec_length(side) > 0.0 ? side : pm_frame_around(g->normal).s;
    pm_vec3 wall = face_of_walls(g);
    side = pm_vec_along(side, wall, beside - fmin(pm_vec_dot(side, wall), 0.0));
    side = flatten(side, g->normal);
    pm_vec3 eye =
        pm_vec_along(pm_vec_scale(g->normal, height), side, sqrt(1.0 - height * height));
    double upright = pm_vec_dot(top, g->normal);
    pm_vec3 up = fabs(upright) < 0.5 ? top : g->normal;
    up = upright <= -0.5 ? pm_vec_negate(up) : up;
    pm_vec3 half = pm_vec(reach, reach, reach);
    return pm_viewpoint_box(pm_vec_sub(g->at, half), pm_vec_add(g->at, half),
                            pm_vec_negate(eye), up, where->width, where->height);
}

// --- numbers --------------------------------------------------------------------------------

/// What stands under a panel.
typedef struct {
    uint64_t here, elsewhere, rim, near, behind; // photons; the first two count
    double sum; // their powers times weights over pi r^2, as luminance [W/m^2]
} account;

static account add_up(const pm_gathered *g)
{
    account a = {0};
    double power = 0.0;
    for (uint64_t i = 0; i < g->count; i++) {
        const pm_gathered_photon *photon = &g->photons[i];
        bool counts = photon->fate == PM_GATHERED_COUNTED;
        bool same = pm_vec_dot(photon->normal, g->normal) > PM_GATHER_SAME;
        a.here += counts && same;
        a.elsewhere += counts && !same;
        a.rim += photon->fate == PM_GATHERED_RIM;
        a.near += photon->fate == PM_GATHERED_NEAR;
        a.behind += photon->fate == PM_GATHERED_BEHIND;
        power += photon->weight * pm_spectrum_luminance(photon->power);
    }
    a.sum = g->radius > 0.0 ? power / (PM_PI * g->radius * g->radius) : 0.0;
    return a;
}

static json_t *facts_of(const pm_gathered *g, const account *a)
{
    const double *e = g->irradiance.c;
    return json_pack("{s:s,s:f,s:I,s:I,s:I,s:I,s:I,s:I,s:[f,f,f],s:f}", "shape",
                     g->disc ? "disc" : "sphere", "radius", g->radius, "found",
                     (json_int_t)g->found, "here", (json_int_t)a->here, "elsewhere",
                     (json_int_t)a->elsewhere, "rim", (json_int_t)a->rim, "near",
                     (json_int_t)a->near, "behind", (json_int_t)a->behind, "irradiance", e[0],
                     e[1], e[2], "sum", a->sum);
}

static pm_status write_line(const pm_view *view, const pm_rect *under, int number,
                            pm_text_look look, const char *text)
{
    double size = pm_figure_pixels_of(view->figure, size_900);
    double step = pm_figure_pixels_of(view->figure, line_900);
    return pm_figure_text(view->figure, text, under->x,
                          under->y + under->height + (number + 0.4) * step, size, look);
}

static pm_status write_account(const pm_view *view, const pm_gathered *g, const account *a,
                               const pm_rect *under)
{
    char text[160];
    const double *e = g->irradiance.c;
    double told = pm_spectrum_luminance(g->irradiance);
    snprintf(text, sizeof text, "found %llu photons, radius r = %.4g m",
             (unsigned long long)g->found, g->radius);
    PM_TRY(write_line(view, under, 0, PM_TEXT_PLAIN, text));
    snprintf(text, sizeof text, "%llu count on this surface, %llu on another",
             (unsigned long long)a->here, (unsigned long long)a->elsewhere);
    PM_TRY(write_line(view, under, 1, PM_TEXT_PLAIN, text));
    snprintf(text, sizeof text, "irradiance %.4g W/m\xC2\xB2", told);
    PM_TRY(write_line(view, under, 2, PM_TEXT_STRONG, text));
    snprintf(text, sizeof text, "red %.4g, green %.4g, blue %.4g", e[0], e[1], e[2]);
    PM_TRY(write_line(view, under, 3, PM_TEXT_DIM, text));
    if (fabs(a->sum - told) <= 1e-3 * told) {
        return PM_OK;
    }
    snprintf(text, sizeof text, "but the powers over pi r\xC2\xB2 are %.4g", a->sum);
    return write_line(view, under, 4, PM_TEXT_STRONG, text);
}

// --- the picture ----------------------------------------------------------------------------

static pm_status draw_region(pm_view *view, const pm_gathered *g, double reach,
                             const pm_rect *cell, json_t *facts)
{
    char heading[80];
    double text = lines * pm_figure_pixels_of(view->figure, line_900);
    int high = cell->height - (int)text;
    int most = (int)(tallest * cell->width);
    pm_rect where = {cell->x, cell->y, cell->width, high < most ? high : most};
    pm_viewpoint viewpoint = aim(&view->scene, g, reach, &where);
    if (g->disc) {
        snprintf(heading, sizeof heading, "disc, height / radius %g", g->flatness);
    } else {
        snprintf(heading, sizeof heading, "sphere");
    }
    account a = add_up(g);
    json_array_append_new(facts, facts_of(g, &a));
    view->drawn += g->count;
    PM_TRY(pm_figure_caption(view->figure, &where, heading));
    PM_TRY(pm_figure_panel(view->figure, &where, &viewpoint));
    PM_TRY(pm_draw_scene(view->figure, &view->scene));
    PM_TRY(pm_draw_gather(view->figure, g));
    return write_account(view, g, &a, &where);
}

/// Half a side of what is shown: enough for the largest region; without any, a twentieth of the
/// scene.
static double choose_reach(const pm_view *view, const regions *all)
{
    double radius = 0.0;
    for (int i = 0; i < all->count; i++) {
        radius = fmax(radius, all->region[i].radius);
    }
    return radius > 0.0 ? around * radius : 0.05 * view->scene.radius;
}

static bool has_behind(const regions *all)
{
    for (int i = 0; i < all->count; i++) {
        if (add_up(&all->region[i]).behind > 0) {
            return true;
        }
    }
    return false;
}

static pm_status draw_regions(pm_view *view, const regions *all)
{
    pm_rect room = pm_figure_room(view->figure);
    pm_rect cells[FILES_MOST];
    json_t *facts = json_array();
    pm_status status = PM_OK;
    pm_figure_columns(view->figure, &room, all->count, cells);
    for (int i = 0; i < all->count && status == PM_OK; i++) {
        status = draw_region(view, &all->region[i], choose_reach(view, all), &cells[i], facts);
    }
    pm_view_fact(view, "regions", facts);
    PM_TRY(status);
    return pm_draw_gather_legend(view->figure, has_behind(all));
}

static pm_status draw(pm_view *view)
{
    regions *all = calloc(1, sizeof *all);
    if (all == NULL) {
        return PM_FAIL(PM_ENOMEM, "%s", "no memory for photons");
    }
    PM_TRY(pm_view_keep(view, all, release));
    for (int i = 0; i < view->file_count; i++) {
        PM_TRY(pm_gathered_file_read(view->files[i], &view->scene, &all->region[i]));
        all->count++;
    }
    pm_vec3 at = pm_vec_add(all->region[0].at, view->scene.center);
    pm_view_note(view,
                 "irradiance = power of the nearest photons over the area pi r\xC2\xB2 "
                 "that they fill\nat %.4g, %.4g, %.4g; bright: the photons found, dim: the "
                 "others around",
                 at.x, at.y, at.z);
    return draw_regions(view, all);
}

const pm_view_kind pm_view_gather = {
    .name = "gather",
    .files = "GATHERED.csv [ANOTHER.csv] (radiance --gathered)",
    .shows = "the photons that an estimate is made of",
    .files_least = 1,
    .files_most = FILES_MOST,
    .scene = PM_VIEW_FOR_SCENE,
    .options = "",
    .title = "Radiance estimate: which photons it takes",
    .draw = draw,
};
