// Photons are thinned at even steps of the file: its beginning alone would be one corner of a
// tree.
#include "view_backdrop.h"

#include "photon_cloud.h"
#include "photon_file.h"
#include "photon_map.h"

#include <stdlib.h>

#define MOST 20000

static void release(void *data)
{
    pm_photon_cloud_free(data);
    free(data);
}

pm_status pm_view_backdrop_make(pm_view *view, const pm_photon_map *map,
                                const pm_photon_cloud **cloud)
{
    pm_photon_cloud *made = calloc(1, sizeof *made);
    if (made == NULL) {
        return PM_FAIL(PM_ENOMEM, "%s", "no memory for photons");
    }
    PM_TRY(pm_view_keep(view, made, release));
    PM_TRY(pm_photon_cloud_make(map, MOST, made));
    *cloud = made;
    return PM_OK;
}

static pm_status check_map(const pm_view *view, const char *path, const char *other,
                           uint64_t photons, const pm_photon_map *map,
                           const pm_photon_file_info *info)
{
    PM_TRY(pm_view_check_hash(view, path, info->scene_hash));
    if (map->count != photons) {
        return pm_status_fail(PM_EINPUT,
                              "%s: this map holds %u photons, the trees of %s hold %llu; write "
                              "both in one run of balancing",
                              path, map->count, other, (unsigned long long)photons);
    }
    return PM_OK;
}

pm_status pm_view_backdrop_read(pm_view *view, const char *path, const char *other,
                                uint64_t photons, pm_photon_map *map,
                                const pm_photon_cloud **cloud)
{
    pm_photon_map read = {0};
    pm_photon_file_info info = {0};
    PM_TRY(pm_photon_file_read(path, &read, &info, NULL));
    pm_status status = check_map(view, path, other, photons, &read, &info);
    if (status == PM_OK) {
        status = pm_view_backdrop_make(view, &read, cloud);
    }
    if (status != PM_OK) {
        pm_photon_map_free(&read);
        return status;
    }
    *map = read;
    return PM_OK;
}
