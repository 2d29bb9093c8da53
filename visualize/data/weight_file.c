// The report says where and how large the disc is and how many photons the other file has: so
// two files of different calls are told from each other.
#include "weight_file.h"

#include "csv.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>

enum { X, RED = 3, DISTANCE = 6, FIRST_WEIGHT = 7 };

const char *pm_weight_file_kernel(int kernel)
{
    static const char *const names[PM_WEIGHT_KERNELS] = {"none", "cone", "gaussian",
                                                         "epanechnikov"};
    return names[kernel];
}

// --- photons --------------------------------------------------------------------------------

static pm_status grow(pm_weighed_set *set, uint64_t *room)
{
    if (set->count < *room) {
        return PM_OK;
    }
    uint64_t wanted = *room == 0 ? 256 : *room * 2;
    pm_weighed_photon *bigger =
        wanted <= UINT32_MAX ? realloc(set->photons, (size_t)wanted * sizeof *bigger) : NULL;
    if (bigger == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %llu photons", (unsigned long long)wanted);
    }
    set->photons = bigger;
    *room = wanted;
    return PM_OK;
}

static pm_status read_photon(const pm_csv *csv, const pm_scene *scene,
                             pm_weighed_photon *photon)
{
    PM_TRY(pm_csv_point(csv, X, scene, &photon->position));
    for (int c = 0; c < 3; c++) {
        PM_TRY(pm_csv_positive(csv, RED + c, &photon->power[c]));
    }
    PM_TRY(pm_csv_positive(csv, DISTANCE, &photon->distance));
    for (int kernel = 0; kernel < PM_WEIGHT_KERNELS; kernel++) {
        PM_TRY(pm_csv_number(csv, FIRST_WEIGHT + kernel, &photon->weight[kernel]));
    }
    return PM_OK;
}

static pm_status read_photons(pm_csv *csv, const pm_scene *scene, pm_weighed_set *set)
{
    uint64_t room = 0;
    for (;; set->count++) {
        bool more = false;
        PM_TRY(pm_csv_next(csv, &more));
        if (!more) {
            break;
        }
        PM_TRY(grow(set, &room));
        pm_weighed_photon *photon = &set->photons[set->count];
        PM_TRY(read_photon(csv, scene, photon));
        if (set->count > 0 && photon->distance < photon[-1].distance) {
            return pm_status_fail(PM_EINPUT,
                                  "%s:%ld: the photons stand nearest first, got %g after %g",
                                  csv->path, csv->line, photon->distance, photon[-1].distance);
        }
    }
    if (set->count == 0) {
        return pm_status_fail(PM_EINPUT, "%s:%ld: the file holds no photon", csv->path,
                              csv->line);
    }
    return PM_OK;
}

// --- the report -----------------------------------------------------------------------------

static pm_status refuse_member(const char *path, const char *rule)
{
    return pm_status_fail(PM_EINPUT,
                          "%s: %s; write it with filtering --at --normal --gathered --report",
                          path, rule);
}

static bool read_vector(const json_t *array, double numbers[3])
{
    bool good = json_array_size(array) == 3;
    for (size_t i = 0; i < 3 && good; i++) {
        good = json_is_number(json_array_get(array, i));
        numbers[i] = json_number_value(json_array_get(array, i));
    }
    return good;
}

static pm_status read_region(const char *path, const json_t *report, const pm_scene *scene,
                             pm_weighed_set *set)
{
    double at[3];
    double normal[3];
    const json_t *gathered = json_object_get(report, "gathered");
    const json_t *radius = json_object_get(gathered, "radius");
    if (!read_vector(json_object_get(gathered, "at"), at) ||
        !read_vector(json_object_get(gathered, "normal"), normal) || !json_is_number(radius) ||
        !(json_number_value(radius) > 0.0)) {
        return refuse_member(path, "it must have \"gathered\" with \"at\", \"normal\" and a "
                                   "\"radius\" above 0");
    }
    json_int_t photons = json_integer_value(json_object_get(gathered, "photons"));
    if (photons != (json_int_t)set->count) {
        return pm_status_fail(PM_EINPUT,
                              "%s: the report is of %lld photons, and the other file has %u: "
                              "both must come from one call of filtering",
                              path, (long long)photons, set->count);
    }
    pm_vec3 side = pm_vec(normal[0], normal[1], normal[2]);
    if (!(fabs(pm_vec_length(side) - 1.0) < 1e-6)) {
        return refuse_member(path, "the normal must have length 1");
    }
    set->at = pm_vec_sub(pm_vec(at[0], at[1], at[2]), scene->center);
    set->normal = side;
    set->radius = json_number_value(radius);
    return PM_OK;
}

static pm_status read_results(const char *path, const json_t *report, pm_weighed_set *set)
{
    const json_t *filters = json_object_get(report, "filters");
    for (int kernel = 0; kernel < PM_WEIGHT_KERNELS; kernel++) {
        double mean[3];
        double rms[3];
        const json_t *row = json_object_get(filters, pm_weight_file_kernel(kernel));
        if (!read_vector(json_object_get(row, "mean"), mean) ||
            !read_vector(json_object_get(row, "rms"), rms)) {
            return refuse_member(path, "it must have \"filters\" with \"mean\" and \"rms\" of "
                                       "every kernel");
        }
        set->result[kernel] = (pm_kernel_result){(mean[0] + mean[1] + mean[2]) / 3.0,
                                                 (rms[0] + rms[1] + rms[2]) / 3.0};
    }
    set->samples = json_number_value(json_object_get(report, "samples"));
    return set->samples >= 1.0 ? PM_OK
                               : refuse_member(path, "it must have \"samples\", at least 1");
}

static pm_status read_report(const char *path, const pm_scene *scene, pm_weighed_set *set)
{
    json_error_t fault;
    json_t *report = json_load_file(path, 0, &fault);
    if (report == NULL) {
        return pm_status_fail(PM_EINPUT, "%s:%d: this is no JSON: %.80s", path,
                              fault.line > 0 ? fault.line : 1, fault.text);
    }
    pm_status status = read_region(path, report, scene, set);
    if (status == PM_OK) {
        status = read_results(path, report, set);
    }
    json_decref(report);
    return status;
}

/// A photon farther from the disc's middle than its rim belongs to another estimate.
static pm_status check_places(const char *path, const pm_weighed_set *set)
{
    for (uint32_t i = 0; i < set->count; i++) {
        pm_vec3 away = pm_vec_sub(set->photons[i].position, set->at);
        double height = pm_vec_dot(away, set->normal);
        double flat = sqrt(pm_most(0.0, pm_vec_dot(away, away) - height * height));
        if (flat > 1.001 * set->radius) {
            return pm_status_fail(PM_EINPUT,
                                  "%s:%u: this photon is %g m from the middle of a disc of "
                                  "radius %g: both files must come from one call of filtering",
                                  path, i + 2, flat, set->radius);
        }
    }
    return PM_OK;
}

pm_status pm_weight_file_read(const char *photons, const char *report, const pm_scene *scene,
                              pm_weighed_set *set)
{
    pm_csv csv;
    pm_weighed_set got = {0};
    pm_status status = pm_csv_open(photons, PM_WEIGHT_HEADER, "filtering --gathered", &csv);
    if (status == PM_OK) {
        status = read_photons(&csv, scene, &got);
    }
    pm_csv_close(&csv);
    if (status == PM_OK) {
        status = read_report(report, scene, &got);
    }
    if (status == PM_OK) {
        status = check_places(photons, &got);
    }
    if (status != PM_OK) {
        pm_weight_file_free(&got);
        return status;
    }
    *set = got;
    return PM_OK;
}

void pm_weight_file_free(pm_weighed_set *set)
{
    free(set->photons);
    *set = (pm_weighed_set){0};
}
