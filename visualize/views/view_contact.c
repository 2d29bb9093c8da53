// view contact: many pictures on one sheet.
#include "contact.h"
#include "view.h"
#include "view_kinds.h"

/// Everything about a sheet, which has no scene and no camera.
static pm_status make_sheet(pm_view *view, pm_contact *sheet)
{
    const pm_options *options = view->options;
    const char *title = options->title != NULL ? options->title : view->kind->title;
    PM_TRY(pm_contact_lay(sheet));
    PM_TRY(pm_contact_draw(sheet, title, &view->figure));
    PM_TRY(pm_view_write(view));
    view->facts = pm_contact_json(sheet, options->output);
    return PM_OK;
}

static pm_status make(pm_view *view)
{
    const pm_options *options = view->options;
    pm_contact sheet;
    if (options->width > 0 || options->interactive) {
        return pm_status_fail(PM_EINPUT,
                              "view: contact takes no --%s: a sheet is as large as "
                              "its pictures ask, and they are whole",
                              options->width > 0 ? "size" : "interactive");
    }
    PM_TRY(pm_contact_read(view->files, view->file_count, options->exposure, &sheet));
    pm_status status = make_sheet(view, &sheet);
    pm_contact_free(&sheet);
    return status;
}

const pm_view_kind pm_view_contact = {
    .name = "contact",
    .files = "A.exr B.exr ... (render -o)",
    .shows = "one sheet of pictures named SCENE.SETTINGS.exr",
    .files_least = 1,
    .files_most = PM_CONTACT_MOST,
    .scene = PM_VIEW_NO_SCENE,
    .options = "exposure",
    .title = "Contact sheet",
    .make = make,
};
