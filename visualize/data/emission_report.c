// JSON has no lines once it is read, so a fault beyond the syntax is named by its key.
#include "emission_report.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LIGHTS_MOST 100000
#define WHOLE_MOST 9007199254740992.0 // 2^53

static pm_status wrong(const char *path, const char *key, const char *rule)
{
    return pm_status_fail(PM_EINPUT, "%s: %s must be %s; write it with emission --report", path,
                          key, rule);
}

static pm_status load(const char *path, json_t **root)
{
    json_error_t error;
    *root = json_load_file(path, JSON_REJECT_DUPLICATES, &error);
    if (*root != NULL) {
        return PM_OK;
    }
    if (error.line < 1) {
        return pm_status_fail(PM_EIO, "%s: cannot read: %s", path, error.text);
    }
    return pm_status_fail(PM_EINPUT, "%s:%d: this is not JSON: %s", path, error.line,
                          error.text);
}

/// The mean of three powers [W].
static pm_status read_power(const char *path, const char *key, const json_t *array,
                            double *mean)
{
    double sum = 0.0;
    if (!json_is_array(array) || json_array_size(array) != 3) {
        return wrong(path, key, "three numbers [W]");
    }
    for (size_t c = 0; c < 3; c++) {
        const json_t *value = json_array_get(array, c);
        double watts = json_number_value(value);
        if (!json_is_number(value) || !(watts >= 0.0) || !isfinite(watts)) {
            return wrong(path, key, "three numbers >= 0 [W]");
        }
        sum += watts;
    }
    *mean = sum / 3.0;
    return PM_OK;
}

static pm_status read_count(const char *path, const char *key, const json_t *value,
                            uint64_t *count)
{
    json_int_t got = json_integer_value(value);
    if (!json_is_integer(value) || got < 0 || (double)got > WHOLE_MOST) {
        return wrong(path, key, "a whole number >= 0");
    }
    *count = (uint64_t)got;
    return PM_OK;
}

static pm_status read_text(const char *path, const char *key, const json_t *value, char **text)
{
    if (!json_is_string(value) || json_string_length(value) == 0) {
        return wrong(path, key, "a name");
    }
    *text = strdup(json_string_value(value));
    return *text != NULL ? PM_OK : PM_FAIL(PM_ENOMEM, "%s", "no memory for a report");
}

static pm_status read_light(const char *path, const json_t *entry, pm_report_light *light)
{
    PM_TRY(read_text(path, "lights[].id", json_object_get(entry, "id"), &light->id));
    PM_TRY(read_text(path, "lights[].type", json_object_get(entry, "type"), &light->type));
    PM_TRY(read_power(path, "lights[].flux", json_object_get(entry, "flux"), &light->power));
    return read_count(path, "lights[].photons", json_object_get(entry, "photons"),
                      &light->photons);
}

static pm_status read_lights(const char *path, const json_t *array, pm_emission_report *to)
{
    size_t count = json_array_size(array);
    if (!json_is_array(array) || count == 0 || count > LIGHTS_MOST) {
        return wrong(path, "lights", "a list of lights");
    }
    to->lights = calloc(count, sizeof *to->lights);
    if (to->lights == NULL) {
        return PM_FAIL(PM_ENOMEM, "%s", "no memory for a report");
    }
    for (size_t i = 0; i < count; i++) {
        pm_report_light *light = &to->lights[to->count++];
        PM_TRY(read_light(path, json_array_get(array, i), light));
        to->power += light->power;
        to->photons += light->photons;
    }
    if (!(to->power > 0.0) || to->photons == 0) {
        return pm_status_fail(PM_EINPUT,
                              "%s: no light sends any power: there is nothing to share", path);
    }
    return PM_OK;
}

static pm_status read_root(const char *path, const json_t *root, pm_emission_report *to)
{
    const json_t *projection = json_object_get(root, "projection");
    PM_TRY(read_lights(path, json_object_get(root, "lights"), to));
    PM_TRY(read_power(path, "power_sum", json_object_get(root, "power_sum"), &to->sent));
    PM_TRY(
        read_count(path, "projection.cells", json_object_get(projection, "cells"), &to->cells));
    return read_count(path, "projection.active", json_object_get(projection, "active"),
                      &to->active);
}

pm_status pm_emission_report_read(const char *path, pm_emission_report *report)
{
    json_t *root = NULL;
    pm_emission_report made = {0};
    PM_TRY(load(path, &root));
    pm_status status = read_root(path, root, &made);
    json_decref(root);
    if (status != PM_OK) {
        pm_emission_report_free(&made);
        return status;
    }
    *report = made;
    return PM_OK;
}

void pm_emission_report_free(pm_emission_report *report)
{
    for (int i = 0; i < report->count; i++) {
        free(report->lights[i].id);
        free(report->lights[i].type);
    }
    free(report->lights);
    *report = (pm_emission_report){0};
}
