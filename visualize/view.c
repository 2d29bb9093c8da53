// view: pictures of what the other programs wrote, a kind for each thing to be seen.
//
//     view KIND FILE... [--scene SCENE.xml] -o out.png
//
// `view --help` lists the kinds, `view KIND --help` what one of them takes.
#include "view.h"
#include "program.h"
#include "scene_read.h"
#include "view_kinds.h"
#include "window.h"
#include "word.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HELP_MAX 8192
#define FILES_MOST 256

static const pm_view_kind *const kinds[] = {
    &pm_view_emission,   &pm_view_directions, &pm_view_cells,   &pm_view_shares,
    &pm_view_paths,      &pm_view_growth,     &pm_view_photons, &pm_view_packing,
    &pm_view_tree,       &pm_view_trees,      &pm_view_search,  &pm_view_gather,
    &pm_view_irradiance, &pm_view_bias,       &pm_view_kernels, &pm_view_weights,
    &pm_view_edge,       &pm_view_layers,     &pm_view_error,   &pm_view_effort,
    &pm_view_trade,      &pm_view_contact,
};
#define KIND_COUNT (sizeof kinds / sizeof kinds[0])

static const pm_view_kind *find_kind(const char *name)
{
    for (size_t i = 0; i < KIND_COUNT; i++) {
        if (strcmp(kinds[i]->name, name) == 0) {
            return kinds[i];
        }
    }
    return NULL;
}

static const pm_view_kind *nearest_kind(const char *name)
{
    const pm_view_kind *nearest = kinds[0];
    for (size_t i = 1; i < KIND_COUNT; i++) {
        if (pm_word_distance(name, kinds[i]->name) < pm_word_distance(name, nearest->name)) {
            nearest = kinds[i];
        }
    }
    return nearest;
}

/// The kinds, a line each, and what holds for all of them.
static void describe_kinds(char *text)
{
    int used = snprintf(text, HELP_MAX, "%s",
                        "KIND is one of these; `view KIND --help` says what it takes:\n");
    for (size_t i = 0; i < KIND_COUNT; i++) {
        used += snprintf(text + used, HELP_MAX - (size_t)used, "  %-11s %-46s %s\n",
                         kinds[i]->name, kinds[i]->shows, kinds[i]->files);
    }
    snprintf(
        text + used, HELP_MAX - (size_t)used, "%s",
        "-o names a picture by its ending: .png, .webp (smaller, not exact), or .vtp: the\n"
        "data behind it for ParaView. --json prints where everything is, so that a program\n"
        "can find the pixel of any point.");
}

/// What the program takes for a kind, or for none.
typedef struct {
    pm_options_program program;
    char options[256];
    char positional[128];
    char notes[HELP_MAX];
} face;

static void face_of(const pm_view_kind *kind, face *f)
{
    static const char common[] = "o size title display interactive";
    f->program = (pm_options_program){.name = "view",
                                      .does = "Draws what other programs wrote.",
                                      .positional = "KIND FILE...",
                                      .positional_least = 2,
                                      .positional_most = 1 + FILES_MOST,
                                      .options = common};
    if (kind == NULL) {
        describe_kinds(f->notes);
        f->program.notes = f->notes;
        return;
    }
    bool scene = kind->scene != PM_VIEW_NO_SCENE;
    snprintf(f->options, sizeof f->options, "%s %s %s", common, scene ? "scene" : "",
             kind->options);
    snprintf(f->positional, sizeof f->positional, "%s %s", kind->name, kind->files);
    f->program.options = f->options;
    f->program.positional = f->positional;
    f->program.does = kind->shows;
}

/// A name with an unknown ending is refused before any work.
static pm_status check_ending(const char *path)
{
    static const char *const endings[] = {".png", ".webp", ".vtp"};
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; i++) {
        if (pm_view_ends_with(path, endings[i])) {
            return PM_OK;
        }
    }
    return pm_status_fail(PM_EINPUT,
                          "view: -o must end in .png, .webp (smaller, not exact) or .vtp (the "
                          "data, for ParaView), got %s",
                          path);
}

static pm_status check_usage(const pm_view *view)
{
    const pm_view_kind *kind = view->kind;
    const pm_options *options = view->options;
    if (view->file_count < kind->files_least || view->file_count > kind->files_most) {
        return pm_status_fail(PM_EINPUT, "view: %s takes %d to %d files, got %d: %s",
                              kind->name, kind->files_least, kind->files_most, view->file_count,
                              kind->files);
    }
    bool needed = kind->scene == PM_VIEW_IN_SCENE || kind->scene == PM_VIEW_FOR_SCENE;
    if (needed && options->scene == NULL) {
        return pm_status_fail(PM_EINPUT, "view: --scene SCENE.xml must be given for %s",
                              kind->name);
    }
    if (options->output == NULL && !options->interactive) {
        return pm_status_fail(PM_EINPUT, "%s", "view: -o FILE must be given, or --interactive");
    }
    if (options->interactive && options->json) {
        return pm_status_fail(PM_EINPUT, "%s",
                              "view: --json and --interactive cannot be together: picks are "
                              "told on standard output, too");
    }
    return options->output != NULL ? check_ending(options->output) : PM_OK;
}

/// Takes the reference.
static pm_status print_object(json_t *all)
{
    if (all == NULL || json_dumpf(all, stdout, JSON_COMPACT) != 0) {
        json_decref(all);
        return PM_FAIL(PM_EIO, "%s", "cannot write JSON to standard output");
    }
    printf("\n");
    json_decref(all);
    return PM_OK;
}

/// Where everything is in the picture: with this a reader finds the pixel of any point.
static pm_status print_answer(const pm_view *view)
{
    const pm_options *options = view->options;
    json_t *all = json_pack("{s:s*,s:I,s:s}", "picture", options->output, "drawn",
                            (json_int_t)view->drawn, "note", view->note);
    if (view->figure != NULL) {
        json_t *places = pm_figure_json(view->figure, view->scene.center);
        json_object_update(all, places);
        json_decref(places);
    }
    if (view->facts != NULL) {
        json_object_update(all, view->facts);
    }
    return print_object(all);
}

static pm_status make(pm_view *view)
{
    const pm_view_kind *kind = view->kind;
    if (kind->make != NULL) {
        return kind->make(view);
    }
    PM_TRY(kind->scene == PM_VIEW_IN_SCENE ? pm_view_open_scene(view)
                                           : pm_view_open_page(view));
    PM_TRY(kind->draw(view));
    return pm_view_finish(view);
}

static void release(pm_view *view)
{
    pm_figure_close(view->figure);
    for (int i = 0; i < view->kept_count; i++) {
        view->kept[i].release(view->kept[i].data);
    }
    json_decref(view->facts);
    pm_scene_free(&view->scene);
}

static pm_status refuse_kind(const char *name)
{
    return pm_status_fail(PM_EINPUT,
                          "view: there is no kind \"%s\"; the nearest is %s (--help lists all)",
                          name, nearest_kind(name)->name);
}

static pm_status run(const pm_options *options)
{
    const pm_view_kind *kind = find_kind(options->positional[0]);
    if (kind == NULL) {
        return refuse_kind(options->positional[0]);
    }
    pm_view view = {.kind = kind,
                    .options = options,
                    .files = options->positional + 1,
                    .file_count = options->positional_count - 1};
    PM_TRY(check_usage(&view));
    PM_TRY(pm_window_choose(options->display_x, options->interactive));
    if (options->scene != NULL) {
        PM_TRY(pm_scene_read(options->scene, options->define, options->define_count, false,
                             &view.scene));
    }
    pm_status status = make(&view);
    if (status == PM_OK && options->json) {
        status = print_answer(&view);
    }
    release(&view);
    return status;
}

/// The kind on the command line, which says what options there are.
static const pm_view_kind *kind_among(int argc, char **argv)
{
    const pm_view_kind *kind = NULL;
    for (int i = 1; i < argc && kind == NULL; i++) {
        kind = find_kind(argv[i]);
    }
    return kind;
}

int main(int argc, char **argv)
{
    pm_options options;
    face f;
    int code;
    const pm_view_kind *kind = kind_among(argc, argv);
    if (kind == NULL && argc > 1 && argv[1][0] != '-') {
        return pm_program_end(refuse_kind(argv[1]));
    }
    face_of(kind, &f);
    if (!pm_program_start(argc, argv, &f.program, &options, &code)) {
        return code;
    }
    return pm_program_end(run(&options));
}
