// Rows go straight into the arrays that are drawn, which grow by doubling: a million photons
// are read in one pass.
#include "photon_table.h"

#include "csv.h"
#include "map_make.h"
#include "photon_cloud.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { X, Y, Z, DX, DY, DZ, R, G, B, MAP, PATH, BOUNCE, LIGHT };

#define ROOM_FIRST 1024u

typedef struct {
    pm_csv csv;
    const pm_scene *scene;
    pm_photon_cloud cloud[PM_MAP_COUNT];
    uint32_t room[PM_MAP_COUNT];
} reading;

static pm_status find_map(const reading *r, pm_map_kind *map)
{
    const char *word = r->csv.field[MAP];
    for (pm_map_kind kind = 0; kind < PM_MAP_COUNT; kind++) {
        if (strcmp(word, pm_map_name(kind)) == 0) {
            *map = kind;
            return PM_OK;
        }
    }
    return pm_status_fail(PM_EINPUT,
                          "%s:%ld: map must be global, caustic or volume, got \"%.40s\"",
                          r->csv.path, r->csv.line, word);
}

/// `path` spells as many events as `bounce` says, between the light and the deposit.
static pm_status check_path(const reading *r, uint64_t bounce)
{
    const char *path = r->csv.field[PATH];
    size_t length = strlen(path);
    size_t events = length > 0 ? strspn(path + 1, "SDV") : 0;
    bool whole = path[0] == 'L' && length >= 2 && events == length - 1;
    if (!whole || path[length - 1] == 'S') {
        return pm_status_fail(PM_EINPUT,
                              "%s:%ld: path must go from L over S, D, V to the D or V where "
                              "the photon is stored, got \"%.40s\"",
                              r->csv.path, r->csv.line, path);
    }
    if (bounce != length - 2) {
        return pm_status_fail(
            PM_EINPUT, "%s:%ld: the path %.40s has %zu events, bounce is %llu", r->csv.path,
            r->csv.line, path, length - 2, (unsigned long long)bounce);
    }
    return PM_OK;
}

static pm_status make_room(reading *r, pm_map_kind map)
{
    if (r->cloud[map].count < r->room[map]) {
        return PM_OK;
    }
    if (r->room[map] > PM_MAP_MAX / 2) {
        return pm_status_fail(PM_ELIMIT, "%s:%ld: more photons than a map can hold",
                              r->csv.path, r->csv.line);
    }
    uint32_t room = r->room[map] > 0 ? 2 * r->room[map] : ROOM_FIRST;
    PM_TRY(pm_photon_cloud_reserve(&r->cloud[map], room, true));
    r->room[map] = room;
    return PM_OK;
}

static pm_status read_vector(const reading *r, int column, bool positive, float *to)
{
    for (int c = 0; c < 3; c++) {
        double value = 0.0;
        PM_TRY(positive ? pm_csv_positive(&r->csv, column + c, &value)
                        : pm_csv_number(&r->csv, column + c, &value));
        if (fabs(value) > (double)FLT_MAX) {
            return pm_status_fail(PM_EINPUT, "%s:%ld: %s is too large, got %s", r->csv.path,
                                  r->csv.line, r->csv.name[column + c],
                                  r->csv.field[column + c]);
        }
        to[c] = (float)value;
    }
    return PM_OK;
}

static pm_status read_row(reading *r)
{
    pm_map_kind map = PM_MAP_GLOBAL;
    pm_vec3 at;
    uint64_t bounce = 0;
    uint64_t light = 0;
    PM_TRY(find_map(r, &map));
    PM_TRY(make_room(r, map));
    pm_photon_cloud *cloud = &r->cloud[map];
    uint32_t i = cloud->count;
    PM_TRY(pm_csv_point(&r->csv, X, r->scene, &at));
    PM_TRY(read_vector(r, DX, false, cloud->direction[i]));
    PM_TRY(read_vector(r, R, true, cloud->power[i]));
    PM_TRY(pm_csv_count(&r->csv, BOUNCE, UINT32_MAX, &bounce));
    PM_TRY(check_path(r, bounce));
    PM_TRY(pm_csv_count(&r->csv, LIGHT, (uint64_t)r->scene->light_count - 1, &light));
    const float position[3] = {(float)at.x, (float)at.y, (float)at.z};
    memcpy(cloud->position[i], position, sizeof position);
    cloud->bounce[i] = (uint32_t)bounce;
    cloud->light[i] = (uint32_t)light;
    cloud->count++;
    return PM_OK;
}

static pm_status read_all(reading *r, const char *path)
{
    bool more = true;
    PM_TRY(pm_csv_open(path, PM_PHOTON_TABLE_HEADER, "storage --dump", &r->csv));
    PM_TRY(pm_csv_next(&r->csv, &more));
    while (more) {
        PM_TRY(read_row(r));
        PM_TRY(pm_csv_next(&r->csv, &more));
    }
    return PM_OK;
}

pm_status pm_photon_table_read(const char *path, const pm_scene *scene, pm_photon_cloud *clouds)
{
    reading r = {.scene = scene};
    for (pm_map_kind map = 0; map < PM_MAP_COUNT; map++) {
        r.cloud[map] = pm_photon_cloud_of(map);
    }
    pm_status status = read_all(&r, path);
    pm_csv_close(&r.csv);
    for (pm_map_kind map = 0; map < PM_MAP_COUNT; map++) {
        r.cloud[map].stored = r.cloud[map].count;
        if (status == PM_OK) {
            pm_photon_cloud_measure(&r.cloud[map]);
            clouds[map] = r.cloud[map];
        } else {
            pm_photon_cloud_free(&r.cloud[map]);
        }
    }
    return status;
}
