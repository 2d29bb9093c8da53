// view growth: the ways that photons took, as a film. All photons fly equally fast, so that one
// sees light spread; frame f of N shows them after the part (f - 1) / (N - 1) of the longest
// way.
#include "draw_growth.h"
#include "draw_scene.h"
#include "film.h"
#include "interrupt.h"
#include "path_by.h"
#include "path_file.h"
#include "view.h"
#include "view_kinds.h"

#include <stdlib.h>

#define WIDTH 800
#define HEIGHT 600

/// What a film is made of; all of it is freed together.
typedef struct {
    pm_path_set paths;
    pm_growth *growth;
    pm_film *film;
    uint32_t frames;
} making;

static pm_status write_title(pm_view *view, uint64_t all)
{
    char drawn[PM_VIEW_GROUPED_MAX];
    char of[PM_VIEW_GROUPED_MAX];
    const pm_options *options = view->options;
    view->drawn = options->paths < all ? options->paths : all;
    pm_view_note(
        view, "all photons leave the light at once and fly equally fast\n%s of %s paths drawn",
        pm_view_grouped(view->drawn, drawn), pm_view_grouped(all, of));
    return pm_figure_title(
        view->figure, options->title != NULL ? options->title : view->kind->title, view->note);
}

/// The picture without any path.
static pm_status open_figure(pm_view *view, const pm_viewpoint *viewpoint, uint64_t all)
{
    PM_TRY(pm_figure_open(viewpoint, &view->figure));
    PM_TRY(pm_draw_scene(view->figure, &view->scene));
    return write_title(view, all);
}

static pm_status add_frame(pm_view *view, making *m, double reach)
{
    uint8_t *pixels = NULL;
    PM_TRY(pm_interrupt_check());
    PM_TRY(pm_growth_show(m->growth, reach));
    PM_TRY(pm_figure_pixels(view->figure, &pixels));
    pm_status status = pm_film_add(m->film, pixels);
    free(pixels);
    return status;
}

static pm_status shoot(pm_view *view, making *m)
{
    double length = pm_growth_length(m->growth);
    for (uint32_t f = 0; f < m->frames; f++) {
        double part = (double)f / (m->frames - 1);
        PM_TRY(add_frame(view, m, part * length));
    }
    PM_TRY(pm_interrupt_check());
    return pm_film_write(m->film);
}

/// Smaller than a picture, as a film has many.
static pm_viewpoint choose_viewpoint(const pm_view *view)
{
    const pm_options *options = view->options;
    return pm_viewpoint_of(&view->scene, options->width > 0 ? options->width : WIDTH,
                           options->height > 0 ? options->height : HEIGHT);
}

static pm_status make_film(pm_view *view, making *m)
{
    const pm_options *options = view->options;
    pm_viewpoint viewpoint = choose_viewpoint(view);
    bool by_bounce = false;
    m->frames = options->frames;
    PM_TRY(pm_path_by(view, &by_bounce));
    PM_TRY(
        pm_film_open(options->output, viewpoint.width, viewpoint.height, m->frames, &m->film));
    PM_TRY(pm_path_file_read(view->files[0], &view->scene, &m->paths));
    PM_TRY(open_figure(view, &viewpoint, m->paths.path_count));
    PM_TRY(pm_growth_open(view->figure, &m->paths, options->paths, by_bounce, &m->growth));
    pm_view_fact(view, "frames", json_integer((json_int_t)m->frames));
    pm_view_fact(view, "length", json_real(pm_growth_length(m->growth)));
    return shoot(view, m);
}

static pm_status make(pm_view *view)
{
    if (view->options->interactive || view->options->output == NULL) {
        return pm_status_fail(PM_EINPUT, "%s",
                              "view: growth makes a film, not a window: leave out "
                              "--interactive, and give -o FILE.webp");
    }
    making m = {0};
    pm_status status = make_film(view, &m);
    pm_growth_close(m.growth);
    pm_film_close(m.film);
    pm_path_file_free(&m.paths);
    return status;
}

const pm_view_kind pm_view_growth = {
    .name = "growth",
    .files = "PATHS.csv (tracing --dump)",
    .shows = "light spreading, a film of -o X.webp and X.001.png ...",
    .files_least = 1,
    .files_most = 1,
    .scene = PM_VIEW_FOR_SCENE,
    .options = "by paths frames",
    .title = "Light spreads",
    .make = make,
};
