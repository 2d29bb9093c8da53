// view tree: the split planes of a balanced map.
#include "draw_photons.h"
#include "draw_tree.h"
#include "photon_cloud.h"
#include "photon_file.h"
#include "photon_map.h"
#include "tree_split.h"
#include "view.h"
#include "view_kinds.h"

#include <stdlib.h>

// Photons behind a tree: so bright, and so many at most.
#define BACKDROP 0.6
#define BACKDROP_MOST 20000

static void release_cloud(void *data)
{
    pm_photon_cloud_free(data);
    free(data);
}

static pm_status draw_backdrop(pm_view *view, const pm_photon_map *map)
{
    char shown[PM_VIEW_GROUPED_MAX];
    pm_photon_cloud *cloud = calloc(1, sizeof *cloud);
    if (cloud == NULL) {
        return PM_FAIL(PM_ENOMEM, "%s", "no memory for photons");
    }
    PM_TRY(pm_view_keep(view, cloud, release_cloud));
    PM_TRY(pm_photon_cloud_make(map, BACKDROP_MOST, cloud));
    pm_view_note(view, ", %s photons as dots", pm_view_grouped(cloud->count, shown));
    return pm_draw_photons(view->figure, cloud, 1.0, BACKDROP);
}

static pm_status draw_splits(pm_view *view, const pm_photon_map *map)
{
    pm_tree_split_set tree;
    char count[PM_VIEW_GROUPED_MAX];
    char shown[PM_VIEW_GROUPED_MAX];
    PM_TRY(pm_tree_split_make(map, view->files[0], (int)view->options->depth, &tree));
    view->drawn = tree.count;
    pm_view_note(
        view,
        "every plane goes through the median photon of its cell and cuts its longest side\n"
        "%s photons, tree %d deep; the first %d depths: %s planes",
        pm_view_grouped(map->count, count), tree.height, tree.depths,
        pm_view_grouped(tree.count, shown));
    pm_status status = draw_backdrop(view, map);
    if (status == PM_OK) {
        status = pm_draw_tree(view->figure, &tree);
    }
    pm_tree_split_free(&tree);
    return status;
}

static pm_status draw(pm_view *view)
{
    pm_photon_map map = {0};
    pm_photon_file_info info = {0};
    PM_TRY(pm_photon_file_read(view->files[0], &map, &info, NULL));
    pm_status status = pm_view_check_hash(view, view->files[0], info.scene_hash);
    if (status == PM_OK) {
        status = draw_splits(view, &map);
    }
    pm_photon_map_free(&map);
    return status;
}

const pm_view_kind pm_view_tree = {
    .name = "tree",
    .files = "MAP.ply (balancing -o)",
    .shows = "split planes by depth",
    .files_least = 1,
    .files_most = 1,
    .scene = PM_VIEW_IN_SCENE,
    .options = "depth",
    .title = "kd-tree: how the photons are divided",
    .draw = draw,
};
