// The options that only `view` has. They are taken out of the command line before core's
// parser, which knows all others, sees it.
#ifndef PM_VIEW_OPTIONS_H
#define PM_VIEW_OPTIONS_H

#include "status.h"

#include <stdint.h>

#define PM_VIEW_DEPTH_DEFAULT 5
#define PM_VIEW_PATHS_DEFAULT 150

typedef struct {
    const char *scene; // --scene SCENE.xml; NULL: not given
    int depth;         // --depth D: levels of the tree, 1..PM_TREE_DEPTHS_MAX
    uint64_t paths;    // --paths N: paths drawn at most, >= 1
} pm_view_options;

/// Removes these options and their values from argv.
/// @param view  [out] defaults where nothing is given; texts point into argv
/// @return PM_EINPUT with a line that names the option
pm_status pm_view_options_take(int *argc, char **argv, pm_view_options *view);

#endif
