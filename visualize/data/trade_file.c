// jansson tells the line of what is no JSON; of what JSON may say and a trade may not, only the
// place is known, so the messages spell it out.
#include "trade_file.h"

#include <errno.h>
#include <float.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// A value's place in the file, for messages.
typedef struct {
    const char *path;
    char text[3 * PM_TRADE_WORD + 32];
} place;

static place place_of(const char *path, size_t point, const char *key)
{
    place at = {.path = path};
    snprintf(at.text, sizeof at.text, "points[%zu]%s%s", point, key[0] != '\0' ? "." : "", key);
    return at;
}

static const char *type_of(const json_t *value)
{
    static const char *const names[] = {"an object", "a list", "a text", "a number",
                                        "a number",  "true",   "false",  "null"};
    return value != NULL ? names[json_typeof(value)] : "nothing";
}

static pm_status read_number(const place *at, const json_t *value, double low, double *number)
{
    if (!json_is_number(value)) {
        return pm_status_fail(PM_EINPUT, "%s: %s must be a number, got %s", at->path, at->text,
                              type_of(value));
    }
    double got = json_number_value(value);
    if (!isfinite(got) || got < low) {
        return pm_status_fail(PM_EINPUT, "%s: %s must be finite%s, got %g", at->path, at->text,
                              low == 0.0 ? " and >= 0" : "", got);
    }
    *number = got;
    return PM_OK;
}

/// A number, or {mean, sd}.
static pm_status read_value(const place *at, const json_t *value, double low,
                            pm_trade_value *out)
{
    pm_trade_value got = {0};
    if (!json_is_object(value)) {
        PM_TRY(read_number(at, value, low, &got.mean));
    } else {
        place part = *at;
        snprintf(part.text, sizeof part.text, "%.120s.mean", at->text);
        PM_TRY(read_number(&part, json_object_get(value, "mean"), low, &got.mean));
        snprintf(part.text, sizeof part.text, "%.120s.sd", at->text);
        PM_TRY(read_number(&part, json_object_get(value, "sd"), 0.0, &got.sd));
    }
    *out = got;
    return PM_OK;
}

static pm_status write_setting(const place *at, const json_t *value, char text[PM_TRADE_WORD])
{
    if (json_is_string(value)) {
        snprintf(text, PM_TRADE_WORD, "%s", json_string_value(value));
    } else if (json_is_integer(value)) {
        snprintf(text, PM_TRADE_WORD, "%lld", (long long)json_integer_value(value));
    } else if (json_is_real(value)) {
        snprintf(text, PM_TRADE_WORD, "%.6g", json_real_value(value));
    } else if (json_is_boolean(value)) {
        snprintf(text, PM_TRADE_WORD, "%s", json_is_true(value) ? "on" : "off");
    } else {
        return pm_status_fail(PM_EINPUT, "%s: %s must be a number, a text or a boolean, got %s",
                              at->path, at->text, type_of(value));
    }
    return PM_OK;
}

static pm_status read_settings(const char *path, size_t index, json_t *object,
                               pm_trade_point *point)
{
    const char *option;
    json_t *value;
    if (!json_is_object(object) || json_object_size(object) > PM_TRADE_SETTINGS_MAX) {
        return pm_status_fail(
            PM_EINPUT,
            "%s: points[%zu].settings must be an object with at most %d members, "
            "got %s",
            path, index, PM_TRADE_SETTINGS_MAX, type_of(object));
    }
    json_object_foreach(object, option, value)
    {
        pm_trade_setting *to = &point->setting[point->setting_count++];
        place at = {.path = path};
        snprintf(at.text, sizeof at.text, "points[%zu].settings.%.39s", index, option);
        snprintf(to->option, sizeof to->option, "%s", option);
        PM_TRY(write_setting(&at, value, to->value));
    }
    return PM_OK;
}

/// Bias and variance: both, or none.
static pm_status read_split(const char *path, size_t index, const json_t *object,
                            pm_trade_point *point)
{
    const json_t *bias = json_object_get(object, "bias");
    const json_t *variance = json_object_get(object, "variance");
    point->split = bias != NULL || variance != NULL;
    if (point->split) {
        place at = place_of(path, index, "bias");
        PM_TRY(read_number(&at, bias, 0.0, &point->bias));
        at = place_of(path, index, "variance");
        PM_TRY(read_number(&at, variance, 0.0, &point->variance));
    }
    return PM_OK;
}

static pm_status read_point(const char *path, size_t index, const json_t *object,
                            pm_trade_point *point)
{
    place at = place_of(path, index, "seconds");
    PM_TRY(read_value(&at, json_object_get(object, "seconds"), 0.0, &point->seconds));
    if (point->seconds.mean == 0.0) {
        return pm_status_fail(PM_EINPUT, "%s: %s must be > 0, got 0", path, at.text);
    }
    at = place_of(path, index, "rel_mse");
    PM_TRY(read_value(&at, json_object_get(object, "rel_mse"), -DBL_MAX, &point->rel_mse));
    PM_TRY(read_settings(path, index, json_object_get(object, "settings"), point));
    PM_TRY(read_split(path, index, object, point));
    const json_t *bytes = json_object_get(object, "peak_bytes");
    const json_t *name = json_object_get(object, "name");
    at = place_of(path, index, "peak_bytes");
    if (name != NULL) {
        place here = place_of(path, index, "name");
        PM_TRY(write_setting(&here, name, point->name));
    }
    return bytes != NULL ? read_number(&at, bytes, 0.0, &point->peak_bytes) : PM_OK;
}

static pm_status read_points(const char *path, const json_t *list, pm_trade *trade)
{
    size_t count = json_array_size(list);
    if (count < 1 || count > PM_TRADE_POINTS_MAX) {
        return pm_status_fail(PM_EINPUT, "%s: points must be a list of 1 to %d, got %s of %zu",
                              path, PM_TRADE_POINTS_MAX, type_of(list), count);
    }
    trade->point = calloc(count, sizeof *trade->point);
    if (trade->point == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %zu points", count);
    }
    trade->point_count = (int)count;
    for (size_t i = 0; i < count; i++) {
        PM_TRY(read_point(path, i, json_array_get(list, i), &trade->point[i]));
    }
    return PM_OK;
}

static bool is_among(const pm_trade *trade, json_int_t index)
{
    for (int i = 0; i < trade->pareto_count; i++) {
        if (trade->pareto[i] == index) {
            return true;
        }
    }
    return false;
}

/// Puts a Pareto point behind those that are faster.
static void insert(pm_trade *trade, int index)
{
    int at = trade->pareto_count++;
    double seconds = trade->point[index].seconds.mean;
    while (at > 0 && trade->point[trade->pareto[at - 1]].seconds.mean > seconds) {
        trade->pareto[at] = trade->pareto[at - 1];
        at--;
    }
    trade->pareto[at] = index;
}

static pm_status read_pareto(const char *path, const json_t *list, pm_trade *trade)
{
    size_t count = json_array_size(list);
    if (!json_is_array(list)) {
        return pm_status_fail(PM_EINPUT, "%s: pareto must be a list of points' numbers, got %s",
                              path, type_of(list));
    }
    trade->pareto = calloc(count + 1, sizeof *trade->pareto);
    if (trade->pareto == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %zu points", count);
    }
    for (size_t i = 0; i < count; i++) {
        const json_t *value = json_array_get(list, i);
        json_int_t index = json_is_integer(value) ? json_integer_value(value) : -1;
        if (index < 0 || index >= trade->point_count || is_among(trade, index)) {
            return pm_status_fail(PM_EINPUT,
                                  "%s: pareto[%zu] must be a point's number from 0 to %d, each "
                                  "once, got %lld",
                                  path, i, trade->point_count - 1, (long long)index);
        }
        insert(trade, (int)index);
    }
    return PM_OK;
}

static pm_status read_slope(const char *path, const char *name, const json_t *value,
                            pm_trade *trade)
{
    pm_trade_slope *slope = &trade->slope[trade->slope_count++];
    place at = {.path = path};
    snprintf(slope->name, sizeof slope->name, "%s", name);
    snprintf(at.text, sizeof at.text, "slope%s%.39s", name[0] != '\0' ? "." : "", name);
    if (!json_is_object(value)) {
        return read_number(&at, value, -DBL_MAX, &slope->measured);
    }
    const json_t *predicted = json_object_get(value, "predicted");
    slope->has_predicted = predicted != NULL;
    PM_TRY(read_number(&at, json_object_get(value, "measured"), -DBL_MAX, &slope->measured));
    return predicted != NULL ? read_number(&at, predicted, -DBL_MAX, &slope->predicted) : PM_OK;
}

static pm_status read_slopes(const char *path, json_t *value, pm_trade *trade)
{
    const char *name;
    json_t *one;
    if (value == NULL || json_is_null(value)) {
        return PM_OK;
    }
    if (!json_is_object(value)) {
        return read_slope(path, "", value, trade);
    }
    if (json_object_size(value) > PM_TRADE_SLOPES_MAX) {
        return pm_status_fail(PM_EINPUT, "%s: slope has at most %d members, got %zu", path,
                              PM_TRADE_SLOPES_MAX, json_object_size(value));
    }
    json_object_foreach(value, name, one)
    {
        PM_TRY(read_slope(path, name, one, trade));
    }
    return PM_OK;
}

static pm_status read_object(const char *path, const json_t *root, pm_trade *trade)
{
    if (!json_is_object(root)) {
        return pm_status_fail(PM_EINPUT, "%s: must be an object as tradeoff writes it, got %s",
                              path, type_of(root));
    }
    PM_TRY(read_points(path, json_object_get(root, "points"), trade));
    PM_TRY(read_pareto(path, json_object_get(root, "pareto"), trade));
    return read_slopes(path, json_object_get(root, "slope"), trade);
}

pm_status pm_trade_file_read(const char *path, pm_trade *trade)
{
    pm_trade read = {0};
    json_error_t fault;
    FILE *stream = fopen(path, "r");
    if (stream == NULL) {
        return pm_status_fail(PM_EIO, "%s: cannot be read: %s", path, strerror(errno));
    }
    json_t *root = json_loadf(stream, JSON_REJECT_DUPLICATES, &fault);
    fclose(stream);
    if (root == NULL) {
        return pm_status_fail(PM_EINPUT, "%s:%d: this is no JSON: %s; write it with tradeoff",
                              path, fault.line, fault.text);
    }
    pm_status status = read_object(path, root, &read);
    json_decref(root);
    if (status != PM_OK) {
        pm_trade_file_free(&read);
        return status;
    }
    *trade = read;
    return PM_OK;
}

void pm_trade_file_free(pm_trade *trade)
{
    free(trade->point);
    free(trade->pareto);
    *trade = (pm_trade){0};
}

const char *pm_trade_setting_of(const pm_trade_point *point, const char *option)
{
    for (int i = 0; i < point->setting_count; i++) {
        if (strcmp(point->setting[i].option, option) == 0) {
            return point->setting[i].value;
        }
    }
    return NULL;
}

bool pm_trade_drawable(const pm_trade_point *point)
{
    return point->rel_mse.mean > 0.0;
}
