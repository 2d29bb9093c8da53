// Checks every word of a scene file against the tables of scene_words, before any value is
// read.
#ifndef PM_SCENE_CHECK_H
#define PM_SCENE_CHECK_H

#include "scene_file.h"

/// Reports unknown, misplaced and missing elements, attributes, plugins and parameters. What
/// stands inside an integrator, sampler or reconstruction filter is not looked at: those are
/// not used.
void pm_scene_check_words(pm_scene_file *source);

#endif
