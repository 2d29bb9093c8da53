// A kernel ends where its distance reaches 1; only there may another one begin.
#include "kernel_file.h"

#include "csv.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { KERNEL, DISTANCE, WEIGHT, INSIDE };

static const char words[] = "abcdefghijklmnopqrstuvwxyz0123456789-";

static bool is_complete(const pm_kernel_curve *curve)
{
    return curve->distance[curve->count - 1] >= 1.0;
}

const pm_kernel_curve *pm_kernel_file_find(const pm_kernel_set *set, const char *name)
{
    for (int i = 0; i < set->count; i++) {
        if (strcmp(set->curves[i].name, name) == 0) {
            return &set->curves[i];
        }
    }
    return NULL;
}

static pm_status begin_curve(const pm_csv *csv, pm_kernel_set *set)
{
    const char *name = csv->field[KERNEL];
    if (strlen(name) >= PM_KERNEL_NAME_MAX || strspn(name, words) == 0 ||
        name[strspn(name, words)] != '\0') {
        return pm_status_fail(
            PM_EINPUT,
            "%s:%ld: a kernel's name is made of a-z, 0-9 and -, at most %d of "
            "them, got \"%.40s\"",
            csv->path, csv->line, PM_KERNEL_NAME_MAX - 1, name);
    }
    if (pm_kernel_file_find(set, name) != NULL) {
        return pm_status_fail(PM_EINPUT, "%s:%ld: the kernel %s has ended already", csv->path,
                              csv->line, name);
    }
    if (set->count == PM_KERNEL_CURVES_MAX) {
        return pm_status_fail(PM_EINPUT, "%s:%ld: more than %d kernels", csv->path, csv->line,
                              PM_KERNEL_CURVES_MAX);
    }
    snprintf(set->curves[set->count++].name, PM_KERNEL_NAME_MAX, "%s", name);
    return PM_OK;
}

static pm_status refuse_distance(const pm_csv *csv, const char *rule, double got)
{
    return pm_status_fail(PM_EINPUT, "%s:%ld: the distances of a kernel must %s, got %g",
                          csv->path, csv->line, rule, got);
}

static pm_status add_point(const pm_csv *csv, pm_kernel_curve *curve)
{
    double distance;
    PM_TRY(pm_csv_positive(csv, DISTANCE, &distance));
    if (curve->count == 0 && distance > 0.0) {
        return refuse_distance(csv, "begin at 0", distance);
    }
    if (curve->count > 0 && !(distance > curve->distance[curve->count - 1])) {
        return refuse_distance(csv, "rise", distance);
    }
    if (distance > 1.0) {
        return refuse_distance(csv, "end at 1", distance);
    }
    if (curve->count == PM_KERNEL_POINTS_MAX) {
        return pm_status_fail(PM_EINPUT, "%s:%ld: more than %d points of a kernel", csv->path,
                              csv->line, PM_KERNEL_POINTS_MAX);
    }
    PM_TRY(pm_csv_number(csv, WEIGHT, &curve->weight[curve->count]));
    PM_TRY(pm_csv_number(csv, INSIDE, &curve->inside[curve->count]));
    curve->distance[curve->count++] = distance;
    return PM_OK;
}

static pm_status add_row(const pm_csv *csv, pm_kernel_set *set)
{
    pm_kernel_curve *last = set->count > 0 ? &set->curves[set->count - 1] : NULL;
    if (last == NULL || (is_complete(last) && strcmp(last->name, csv->field[KERNEL]) != 0)) {
        PM_TRY(begin_curve(csv, set));
        return add_point(csv, &set->curves[set->count - 1]);
    }
    if (strcmp(last->name, csv->field[KERNEL]) != 0) {
        return refuse_distance(csv, "end at 1 before the next begins",
                               last->distance[last->count - 1]);
    }
    return add_point(csv, last);
}

static pm_status read_rows(pm_csv *csv, pm_kernel_set *set)
{
    for (;;) {
        bool more = false;
        PM_TRY(pm_csv_next(csv, &more));
        if (!more) {
            break;
        }
        PM_TRY(add_row(csv, set));
    }
    if (set->count == 0) {
        return pm_status_fail(PM_EINPUT, "%s:%ld: the file holds no kernel", csv->path,
                              csv->line);
    }
    const pm_kernel_curve *last = &set->curves[set->count - 1];
    return is_complete(last)
               ? PM_OK
               : refuse_distance(csv, "end at 1", last->distance[last->count - 1]);
}

pm_status pm_kernel_file_read(const char *path, pm_kernel_set *set)
{
    pm_csv csv;
    pm_kernel_set got = {calloc(PM_KERNEL_CURVES_MAX, sizeof *got.curves), 0};
    if (got.curves == NULL) {
        return PM_FAIL(PM_ENOMEM, "%s", "no memory for kernels");
    }
    pm_status status = pm_csv_open(path, PM_KERNEL_HEADER, "filtering --curves", &csv);
    if (status == PM_OK) {
        status = read_rows(&csv, &got);
    }
    pm_csv_close(&csv);
    if (status != PM_OK) {
        pm_kernel_file_free(&got);
        return status;
    }
    *set = got;
    return PM_OK;
}

void pm_kernel_file_free(pm_kernel_set *set)
{
    free(set->curves);
    *set = (pm_kernel_set){0};
}
