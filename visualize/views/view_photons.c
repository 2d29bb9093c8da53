// view photons: where the light landed, photon by photon.
#include "draw_photons.h"
#include "photon_cloud.h"
#include "photon_file.h"
#include "photon_map.h"
#include "view.h"
#include "view_kinds.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define FILES_MOST 4

/// The clouds of one picture, drawn without a copy.
typedef struct {
    pm_photon_cloud cloud[FILES_MOST];
    int count;
} clouds;

static void release_clouds(void *data)
{
    clouds *all = data;
    for (int i = 0; i < all->count; i++) {
        pm_photon_cloud_free(&all->cloud[i]);
    }
    free(all);
}

/// Unpacks a map as the next cloud.
static pm_status add_cloud(pm_view *view, clouds *all, const char *path)
{
    pm_photon_map map = {0};
    pm_photon_file_info info = {0};
    PM_TRY(pm_photon_file_read(path, &map, &info, NULL));
    pm_status status = pm_view_check_hash(view, path, info.scene_hash);
    if (status == PM_OK) {
        status = pm_photon_cloud_make(&map, PM_MAP_MAX, &all->cloud[all->count]);
    }
    pm_photon_map_free(&map);
    if (status == PM_OK) {
        view->drawn += all->cloud[all->count++].count;
    }
    return status;
}

/// So large that all dots together cover about the same area, whatever their number.
static double dot_size(uint64_t count)
{
    double size = 1.4 * sqrt(1e5 / (double)(count > 0 ? count : 1));
    return fmin(fmax(size, 1.0), 4.0);
}

/// One scale for all maps where their photons are equally strong, else one each.
static pm_status add_scales(const pm_view *view, const clouds *all)
{
    double first = all->cloud[0].full_power;
    bool same = true;
    for (int i = 1; i < all->count; i++) {
        same = same && fabs(all->cloud[i].full_power - first) <= 0.01 * first;
    }
    for (int i = 0; i < (same ? 1 : all->count); i++) {
        char heading[64];
        snprintf(heading, sizeof heading, "%s%spower of a photon [W]",
                 same ? "" : all->cloud[i].name, same ? "" : " map:\n");
        PM_TRY(pm_draw_photon_scale(view->figure, heading, all->cloud[i].full_power));
    }
    return PM_OK;
}

static pm_status draw_clouds(pm_view *view, clouds *all)
{
    for (int i = 0; i < view->file_count; i++) {
        PM_TRY(add_cloud(view, all, view->files[i]));
    }
    for (int i = 0; i < all->count; i++) {
        char stored[PM_VIEW_GROUPED_MAX];
        char emitted[PM_VIEW_GROUPED_MAX];
        const pm_photon_cloud *cloud = &all->cloud[i];
        pm_view_note(view, "%s%s map: %s stored of %s emitted", i > 0 ? "   |   " : "",
                     cloud->name, pm_view_grouped(cloud->count, stored),
                     pm_view_grouped(cloud->emitted, emitted));
        PM_TRY(pm_draw_photons(view->figure, cloud, dot_size(view->drawn), 1.0));
    }
    return add_scales(view, all);
}

static pm_status draw(pm_view *view)
{
    clouds *all = calloc(1, sizeof *all);
    if (all == NULL) {
        return PM_FAIL(PM_ENOMEM, "%s", "no memory for photons");
    }
    PM_TRY(pm_view_keep(view, all, release_clouds));
    pm_view_note(view,
                 "every dot is a photon, in the colour of the light it brings (not of the "
                 "wall it hits)\n");
    return draw_clouds(view, all);
}

const pm_view_kind pm_view_photons = {
    .name = "photons",
    .files = "MAP.ply ... (storage -o)",
    .shows = "where the light landed",
    .files_least = 1,
    .files_most = FILES_MOST,
    .scene = PM_VIEW_IN_SCENE,
    .options = "",
    .title = "Photon map: where the light landed",
    .draw = draw,
};
