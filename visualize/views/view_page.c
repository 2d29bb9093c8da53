// What all kinds of pictures share: opening the figure, the note, and the files in the end.
#include "draw_scene.h"
#include "interrupt.h"
#include "view.h"
#include "webp.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define WIDTH 1200
#define HEIGHT 900

const char *pm_view_grouped(uint64_t value, char *text)
{
    char digits[PM_VIEW_GROUPED_MAX];
    int count = snprintf(digits, sizeof digits, "%llu", (unsigned long long)value);
    char *to = text;
    for (int i = 0; i < count; i++) {
        if (i > 0 && (count - i) % 3 == 0) {
            *to++ = ',';
        }
        *to++ = digits[i];
    }
    *to = '\0';
    return text;
}

void pm_view_note(pm_view *view, const char *format, ...)
{
    size_t used = strlen(view->note);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(view->note + used, sizeof view->note - used, format, arguments);
    va_end(arguments);
}

void pm_view_fact(pm_view *view, const char *key, json_t *value)
{
    if (view->facts == NULL) {
        view->facts = json_object();
    }
    json_object_set_new(view->facts, key, value);
}

pm_status pm_view_keep(pm_view *view, void *data, void (*release)(void *data))
{
    if (view->kept_count == PM_VIEW_KEPT_MAX) {
        release(data);
        return PM_FAIL(PM_ELIMIT, "more than %d things behind a picture", PM_VIEW_KEPT_MAX);
    }
    view->kept[view->kept_count].data = data;
    view->kept[view->kept_count].release = release;
    view->kept_count++;
    return PM_OK;
}

pm_status pm_view_check_hash(const pm_view *view, const char *path, uint64_t scene_hash)
{
    if (scene_hash == view->scene.hash) {
        return PM_OK;
    }
    return pm_status_fail(PM_EINPUT,
                          "%s: these photons were traced in another scene than %s, or in an "
                          "earlier version of it; write the file again",
                          path, view->scene.path);
}

static void choose_size(const pm_view *view, int *width, int *height)
{
    *width = view->options->width > 0 ? view->options->width : WIDTH;
    *height = view->options->height > 0 ? view->options->height : HEIGHT;
}

pm_status pm_view_open_page(pm_view *view)
{
    int width;
    int height;
    choose_size(view, &width, &height);
    return pm_figure_open_flat(width, height, &view->figure);
}

pm_status pm_view_open_scene(pm_view *view)
{
    int width;
    int height;
    choose_size(view, &width, &height);
    pm_viewpoint viewpoint = pm_viewpoint_of(&view->scene, width, height);
    PM_TRY(pm_figure_open(&viewpoint, &view->figure));
    return pm_draw_scene(view->figure, &view->scene);
}

pm_status pm_view_wordless_panel(pm_view *view, const pm_rect *where,
                                 const pm_viewpoint *viewpoint, const char *heading)
{
    pm_viewpoint all = pm_viewpoint_fill(&view->scene, where->width, where->height);
    PM_TRY(pm_figure_panel(view->figure, where, viewpoint != NULL ? viewpoint : &all));
    PM_TRY(pm_figure_caption(view->figure, where, heading));
    return pm_draw_scene_wordless(view->figure, &view->scene);
}

bool pm_view_ends_with(const char *path, const char *ending)
{
    size_t length = strlen(path);
    size_t tail = strlen(ending);
    return length > tail && strcmp(path + length - tail, ending) == 0;
}

static pm_status write_webp(pm_figure *figure, const char *path)
{
    uint8_t *pixels = NULL;
    int width;
    int height;
    pm_figure_size(figure, &width, &height);
    PM_TRY(pm_figure_pixels(figure, &pixels));
    pm_status status = pm_interrupt_check();
    if (status == PM_OK) {
        status = pm_webp_write_bytes(path, pixels, width, height);
    }
    free(pixels);
    return status;
}

pm_status pm_view_write(pm_view *view)
{
    const char *path = view->options->output;
    PM_TRY(pm_interrupt_check());
    if (pm_view_ends_with(path, ".vtp")) {
        return pm_figure_export(view->figure, path, view->scene.center);
    }
    return pm_view_ends_with(path, ".webp") ? write_webp(view->figure, path)
                                            : pm_figure_write(view->figure, path);
}

pm_status pm_view_finish(pm_view *view)
{
    const pm_options *options = view->options;
    const char *title = options->title != NULL ? options->title : view->kind->title;
    PM_TRY(pm_figure_title(view->figure, title, view->note));
    if (options->output != NULL) {
        PM_TRY(pm_view_write(view));
    }
    return options->interactive ? pm_figure_show(view->figure, title, view->scene.center)
                                : PM_OK;
}
