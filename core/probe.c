// Points come in the scene file's coordinates and leave centred. Normals leave as unit vectors.
#include "probe.h"

#include "faults.h"
#include "nearest.h"
#include "number.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LINE_MAX_BYTES 1024

static pm_status make_room(pm_probes *probes, uint64_t count)
{
    bool fits = count <= UINT32_MAX && count <= SIZE_MAX / sizeof *probes->points;
    void *moved = fits ? realloc(probes->points, (size_t)count * sizeof *probes->points) : NULL;
    if (moved == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %llu points", (unsigned long long)count);
    }
    probes->points = moved;
    return PM_OK;
}

// --- one point ------------------------------------------------------------------------------

static pm_status from_options(const char *program, const pm_options *options,
                              const pm_scene *scene, pm_probes *probes)
{
    if (!options->has_normal && scene->medium_count == 0) {
        return pm_status_fail(PM_EINPUT, "%s: --at needs --normal X,Y,Z, the side looked at",
                              program);
    }
    PM_TRY(make_room(probes, 1));
    probes->points[0].at = pm_vec_sub(options->at, scene->center);
    probes->points[0].normal = options->has_normal ? options->normal : pm_vec(0.0, 0.0, 0.0);
    probes->count = probes->columns = 1;
    probes->free = !options->has_normal;
    return PM_OK;
}

// --- a file of points -----------------------------------------------------------------------

/// What is wrong with a line, or NULL.
static const char *read_line(const char *line, const pm_scene *scene, pm_estimate_point *point)
{
    double v[6];
    int count;
    const char *fault = pm_number_list(line, v, 6, &count);
    if (fault != NULL) {
        return fault;
    }
    if (count != 6) {
        return "is not six numbers: x y z nx ny nz";
    }
    pm_vec3 normal = pm_vec(v[3], v[4], v[5]);
    double reach = pm_vec_reach(normal);
    if (reach == 0.0) {
        return "has a normal of length 0";
    }
    point->at = pm_vec_sub(pm_vec(v[0], v[1], v[2]), scene->center);
    point->normal =
        pm_vec_normalize(pm_vec(normal.x / reach, normal.y / reach, normal.z / reach));
    return NULL;
}

static pm_status read_lines(FILE *stream, const char *path, const pm_scene *scene,
                            pm_probes *probes, pm_faults *faults)
{
    char line[LINE_MAX_BYTES];
    uint64_t room = 0;
    for (int number = 1; fgets(line, sizeof line, stream) != NULL; number++) {
        line[strcspn(line, "\r\n")] = '\0';
        if (line[strspn(line, " \t")] == '\0' || line[0] == '#') {
            continue;
        }
        if (probes->count == room) {
            room = 2 * room + 64;
            PM_TRY(make_room(probes, room));
        }
        const char *fault = read_line(line, scene, &probes->points[probes->count]);
        if (fault != NULL) {
            pm_faults_add(faults, path, number, "\"%.60s\" %s", line, fault);
        } else {
            probes->count++;
        }
    }
    if (ferror(stream)) {
        return pm_status_fail(PM_EIO, "%s: cannot be read: %s", path, strerror(errno));
    }
    return PM_OK;
}

static pm_status from_file(const char *path, const pm_scene *scene, pm_probes *probes)
{
    FILE *stream = fopen(path, "r");
    if (stream == NULL) {
        return pm_status_fail(PM_EIO, "%s: cannot be opened: %s", path, strerror(errno));
    }
    pm_faults faults = {0};
    pm_status status = read_lines(stream, path, scene, probes, &faults);
    fclose(stream);
    PM_TRY(status);
    PM_TRY(pm_faults_report(&faults));
    if (probes->count == 0) {
        return pm_status_fail(PM_EINPUT, "%s: holds no point; a line each: x y z nx ny nz",
                              path);
    }
    probes->columns = probes->count;
    return PM_OK;
}

// --- a grid on a rectangle ------------------------------------------------------------------

static pm_status find_rectangle(const char *program, const pm_options *options,
                                const pm_scene *scene, const pm_shape **found)
{
    const char *nearest = NULL;
    for (int i = 0; i < scene->shape_count; i++) {
        const pm_shape *shape = &scene->shapes[i];
        if (shape->type != PM_SHAPE_RECTANGLE) {
            continue;
        }
        if (strcmp(shape->id, options->on) == 0) {
            *found = shape;
            return PM_OK;
        }
        const char *const pair[2] = {shape->id, nearest};
        nearest = pm_nearest_word(options->on, pair, nearest == NULL ? 1 : 2);
    }
    if (nearest == NULL) {
        return pm_status_fail(PM_EINPUT, "%s: --on %s: %s has no rectangle", program,
                              options->on, scene->path);
    }
    return pm_status_fail(PM_EINPUT,
                          "%s: --on %s: no rectangle has that id; the nearest is \"%s\"",
                          program, options->on, nearest);
}

static pm_status from_grid(const char *program, const pm_options *options,
                           const pm_scene *scene, pm_probes *probes)
{
    if (options->grid_w == 0) {
        return pm_status_fail(PM_EINPUT, "%s: --on needs --grid WxH, the points on it",
                              program);
    }
    const pm_shape *shape = NULL;
    PM_TRY(find_rectangle(program, options, scene, &shape));
    uint32_t columns = (uint32_t)options->grid_w;
    uint64_t count = (uint64_t)columns * (uint64_t)options->grid_h;
    PM_TRY(make_room(probes, count));
    static const double whole[4] = {0.0, 0.0, 1.0, 1.0};
    const double *part = options->has_part ? options->part : whole;
    double across = part[2] - part[0];
    double along = part[3] - part[1];
    pm_vec3 normal = pm_vec_normalize(pm_vec_cross(shape->edge[0], shape->edge[1]));
    for (uint64_t i = 0; i < count; i++) {
        double u = part[0] + ((double)(i % columns) + 0.5) / options->grid_w * across;
        double v = part[1] + ((double)(i / columns) + 0.5) / options->grid_h * along;
        pm_vec3 at = pm_vec_along(shape->corner, shape->edge[0], u);
        probes->points[i].at = pm_vec_along(at, shape->edge[1], v);
        probes->points[i].normal = shape->flipped ? pm_vec_negate(normal) : normal;
    }
    probes->count = (uint32_t)count;
    probes->columns = columns;
    return PM_OK;
}

pm_status pm_probes_make(const char *program, const pm_options *options, const pm_scene *scene,
                         pm_probes *probes)
{
    int ways = options->has_at + (options->points != NULL) + (options->on != NULL);
    if (ways != 1) {
        return pm_status_fail(PM_EINPUT,
                              "%s: say where by exactly one of --at (with --normal), --points "
                              "and --on (with --grid), got %d of them",
                              program, ways);
    }
    if (options->has_normal && !options->has_at) {
        return pm_status_fail(PM_EINPUT, "%s: --normal goes with --at only", program);
    }
    if (options->grid_w != 0 && options->on == NULL) {
        return pm_status_fail(PM_EINPUT, "%s: --grid goes with --on only", program);
    }
    if (options->has_part && options->on == NULL) {
        return pm_status_fail(PM_EINPUT, "%s: --part goes with --on only", program);
    }
    pm_probes made = {0};
    pm_status status = options->has_at           ? from_options(program, options, scene, &made)
                       : options->points != NULL ? from_file(options->points, scene, &made)
                                                 : from_grid(program, options, scene, &made);
    if (status != PM_OK) {
        pm_probes_free(&made);
        return status;
    }
    *probes = made;
    return PM_OK;
}

void pm_probes_free(pm_probes *probes)
{
    free(probes->points);
    *probes = (pm_probes){0};
}
