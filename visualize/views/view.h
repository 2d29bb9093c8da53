// One picture on its way, and the kinds of pictures there are. A kind is a file view_*.c here:
// it reads what a program wrote, puts it on the figure by a draw_*.h, and writes the note.
// Nothing is traced or estimated here: pictures show what the stages did, a student's as well
// as ours.
#ifndef PM_VIEW_H
#define PM_VIEW_H

#include "figure.h"
#include "options.h"
#include "scene.h"
#include "status.h"

#include <jansson.h>
#include <stdint.h>

#define PM_VIEW_NOTE_MAX 512
#define PM_VIEW_KEPT_MAX 64
#define PM_VIEW_GROUPED_MAX 32 // bytes of a number with commas

typedef struct pm_view_kind pm_view_kind;

typedef struct {
    const pm_view_kind *kind;
    const pm_options *options;
    const char *const *files;
    int file_count;
    pm_scene scene;    // without shapes or lights when the kind takes none
    pm_figure *figure; // already open, with the scene drawn faintly, unless kind->page
    uint64_t drawn;    // photons, paths, split planes or grid points
    char note[PM_VIEW_NOTE_MAX];
    json_t *facts; // numbers that the picture shows: added to the answer of --json
    struct {
        void *data;
        void (*release)(void *data);
    } kept[PM_VIEW_KEPT_MAX];
    int kept_count;
} pm_view;

typedef enum {
    PM_VIEW_NO_SCENE,  // charts, pictures: --scene is refused
    PM_VIEW_IN_SCENE,  // --scene must be given; the figure shows it
    PM_VIEW_FOR_SCENE, // --scene must be given, but the kind lays out the page itself
    PM_VIEW_MAY_SCENE, // --scene may be given; the kind lays out the page itself
} pm_view_scene;

struct pm_view_kind {
    const char *name;
    const char *files; // for --help: "RAYS.csv (emission --dump)"
    const char *shows; // for --help: one line
    int files_least, files_most;
    pm_view_scene scene;
    const char *options; // that only some kinds take, separated by blanks: "by paths"; or ""
    const char *title;
    /// Draws the data on view->figure and writes the note.
    pm_status (*draw)(pm_view *view);
    /// Instead of all: opens, draws and writes by itself. NULL for nearly all kinds.
    pm_status (*make)(pm_view *view);
};

/// Adds to the note under the title; what does not fit is cut.
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void pm_view_note(pm_view *view, const char *format, ...);

/// Frees `data` by `release` after the figure is closed: for what is drawn without a copy.
/// @return PM_ELIMIT beyond PM_VIEW_KEPT_MAX; then it is released at once
pm_status pm_view_keep(pm_view *view, void *data, void (*release)(void *data));

/// Opens an empty page of the size asked for as view->figure: for kinds that lay it out.
pm_status pm_view_open_page(pm_view *view);

/// Opens view->figure with the scene drawn faintly in it.
pm_status pm_view_open_scene(pm_view *view);

/// A panel on the page, under a heading, with the scene drawn faintly in it and without words
/// on lights and glass.
/// @param viewpoint  of the rectangle's size; NULL: one that shows the whole scene
pm_status pm_view_wordless_panel(pm_view *view, const pm_rect *where,
                                 const pm_viewpoint *viewpoint, const char *heading);

/// Whether a file's name has this ending and something before it.
bool pm_view_ends_with(const char *path, const char *ending);

/// Title, note, and then the file of -o by its ending (.png, .webp, .vtp), or the window.
pm_status pm_view_finish(pm_view *view);

/// Writes view->figure as the file of -o, which must be given.
pm_status pm_view_write(pm_view *view);

/// A number for --json under its key. Takes the reference; what there was no memory for is left
/// out.
void pm_view_fact(pm_view *view, const char *key, json_t *value);

/// 1234567 as 1,234,567.
/// @param text  [out] room for PM_VIEW_GROUPED_MAX bytes; also returned
const char *pm_view_grouped(uint64_t value, char *text);

/// The line for data that was traced in another scene than --scene, or an earlier version.
pm_status pm_view_check_hash(const pm_view *view, const char *path, uint64_t scene_hash);

#endif
