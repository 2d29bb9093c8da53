// view tree: the split planes of a balanced map.
#include "draw_photons.h"
#include "draw_tree.h"
#include "photon_file.h"
#include "photon_map.h"
#include "tree_split.h"
#include "view.h"
#include "view_backdrop.h"
#include "view_kinds.h"

#define FEW 5000 // so many photons or fewer get larger dots

static pm_status draw_backdrop(pm_view *view, const pm_photon_map *map)
{
    char shown[PM_VIEW_GROUPED_MAX];
    const pm_photon_cloud *cloud = NULL;
    PM_TRY(pm_view_backdrop_make(view, map, &cloud));
    pm_view_note(view, "; dots: %s photons", pm_view_grouped(cloud->count, shown));
    return pm_draw_photons(view->figure, cloud, cloud->count > FEW ? 1.5 : 2.2, 0.6);
}

static pm_status draw_planes(pm_view *view, const pm_tree_split_set *tree)
{
    PM_TRY(pm_draw_tree(view->figure, tree, tree->depths, "split plane", view->scene.center,
                        &view->drawn));
    return pm_draw_tree_legend(view->figure, tree->depths);
}

static pm_status draw_splits(pm_view *view, const pm_photon_map *map)
{
    pm_tree_split_set tree;
    char count[PM_VIEW_GROUPED_MAX];
    char planes[PM_VIEW_GROUPED_MAX];
    PM_TRY(pm_tree_split_make(map, view->files[0], (int)view->options->depth, &tree));
    int last = tree.depths > 0 ? tree.depths - 1 : 0;
    pm_view_note(
        view,
        "every plane goes through the median photon of its cell, across its longest side\n"
        "%s photons, tree of height %d; planes down to depth %d: %s",
        pm_view_grouped(map->count, count), tree.height > 0 ? tree.height - 1 : 0, last,
        pm_view_grouped(tree.count, planes));
    pm_status status = draw_backdrop(view, map);
    if (status == PM_OK) {
        status = draw_planes(view, &tree);
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
