// Keys are looked up where programs write them (render_report.c); what is not there is not
// said.
#include "contact_note.h"

#include <jansson.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

typedef struct {
    char *text;
    size_t room;
} line;

/// Adds a part after a comma; what does not fit is cut.
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static void
add_part(const line *to, const char *format, ...)
{
    size_t used = strlen(to->text);
    used += (size_t)snprintf(to->text + used, to->room - used, "%s", used > 0 ? ", " : "");
    va_list arguments;
    va_start(arguments, format);
    if (used < to->room) {
        vsnprintf(to->text + used, to->room - used, format, arguments);
    }
    va_end(arguments);
}

static void add_photons(const line *to, json_int_t photons)
{
    if (photons >= 10000 && photons % 1000 == 0) {
        add_part(to, "%lldk photons", (long long)photons / 1000);
    } else if (photons > 0) {
        add_part(to, "%lld photons", (long long)photons);
    }
}

static json_int_t count_photons(const json_t *report)
{
    const char *map;
    json_t *about;
    json_int_t sum = 0;
    json_object_foreach(json_object_get(report, "maps"), map, about)
    {
        sum += json_integer_value(json_object_get(about, "emitted"));
    }
    return sum;
}

/// A number under `key` of the settings, or of the report itself.
static const json_t *find_setting(const json_t *report, const char *key)
{
    const json_t *there = json_object_get(json_object_get(report, "settings"), key);
    return there != NULL ? there : json_object_get(report, key);
}

/// How photons are asked, where a report says how many were to be stored: its picture is about
/// that.
static void add_estimate(const line *to, const json_t *settings, json_int_t stored)
{
    const json_t *estimate = json_object_get(settings, "estimate");
    const char *shape = json_string_value(json_object_get(estimate, "shape"));
    if (stored % 1000 == 0) {
        add_part(to, "%lldk stored", (long long)stored / 1000);
    } else {
        add_part(to, "%lld stored", (long long)stored);
    }
    add_part(to, "k %lld", (long long)json_integer_value(json_object_get(estimate, "k")));
    if (shape != NULL) {
        add_part(to, "%s", shape);
    }
}

static void describe(const json_t *report, const line *to)
{
    const json_t *settings = json_object_get(report, "settings");
    json_int_t stored = json_integer_value(json_object_get(settings, "stored"));
    if (stored > 0) {
        add_estimate(to, settings, stored);
        return;
    }
    const json_t *gather = find_setting(report, "gather");
    const json_t *spp = find_setting(report, "spp");
    add_photons(to, count_photons(report));
    if (json_is_integer(gather)) {
        add_part(to, "gather %lld", (long long)json_integer_value(gather));
    }
    if (json_is_integer(spp)) {
        add_part(to, "%lld spp", (long long)json_integer_value(spp));
    }
}

static double find_seconds(const json_t *report)
{
    const json_t *seconds = json_object_get(report, "seconds");
    const json_t *total = json_object_get(seconds, "total");
    return json_number_value(total != NULL ? total : seconds);
}

pm_status pm_contact_note(const char *picture, char *note, size_t room, double *seconds)
{
    char path[4096];
    size_t length = strlen(picture);
    size_t stem = length > 4 && strcmp(picture + length - 4, ".exr") == 0 ? length - 4 : length;
    note[0] = '\0';
    *seconds = 0.0;
    if (stem + sizeof ".json" > sizeof path) {
        return PM_OK; // no file can have such a name
    }
    snprintf(path, sizeof path, "%.*s.json", (int)stem, picture);
    if (access(path, F_OK) != 0) {
        return PM_OK;
    }
    json_error_t fault;
    json_t *report = json_load_file(path, 0, &fault);
    if (report == NULL) {
        return pm_status_fail(PM_EINPUT,
                              "%s: is no report of render: %s; write it again, or remove it",
                              path, fault.text);
    }
    describe(report, &(line){note, room});
    *seconds = find_seconds(report);
    json_decref(report);
    return PM_OK;
}
