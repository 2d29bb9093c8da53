// What `render` says when it is done: a table for people, one JSON object for programs.
#ifndef PM_RENDER_REPORT_H
#define PM_RENDER_REPORT_H

#include "options.h"
#include "render_json.h"

/// After a picture: per stage CPU time, photons, power in and out; then the audit's verdict.
/// @return the audit's refusal too (pm_audit_check)
pm_status pm_render_report(const pm_options *options, const pm_render_done *done);

/// For --explain: the plan, what each part of it costs, and what is left out; `maps` is
/// planned.
pm_status pm_render_report_plan(const pm_options *options, const pm_render_settings *settings,
                                const pm_render_maps *maps);

/// For --check: that the scene is fine, and what it holds.
pm_status pm_render_report_check(const pm_options *options, const pm_scene *scene);

#endif
