// One line at a time into a fixed buffer: a file without line ends, or a binary one, costs no
// memory before it is refused.
#include "csv.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Light starts, and is followed, within so many scene radii of the centre.
#define RADII 4.0

// Unit vectors are written with nine digits.
#define UNIT_SLACK 1e-5

/// Cuts `text` at its commas; returns the number of fields, PM_CSV_COLUMNS_MAX + 1 for too
/// many.
static int split(char *text, char **field)
{
    char *at = text;
    for (int count = 1; count <= PM_CSV_COLUMNS_MAX; count++) {
        field[count - 1] = at;
        char *comma = strchr(at, ',');
        if (comma == NULL) {
            return count;
        }
        *comma = '\0';
        at = comma + 1;
    }
    return PM_CSV_COLUMNS_MAX + 1;
}

/// The next line into `csv->text`, without its end.
static pm_status read_line(pm_csv *csv, bool *more)
{
    errno = 0;
    csv->line++;
    if (fgets(csv->text, sizeof csv->text, csv->stream) == NULL) {
        *more = false;
        return ferror(csv->stream)
                   ? pm_status_fail(PM_EIO, "%s: cannot read: %s", csv->path, strerror(errno))
                   : PM_OK;
    }
    size_t length = strlen(csv->text);
    if (length == 0 || csv->text[length - 1] != '\n') {
        const char *what = feof(csv->stream)
                               ? "the file ends in the middle of a line: it was cut"
                               : "this is no line of text: too long, or not text";
        return pm_status_fail(PM_EINPUT, "%s:%ld: %s", csv->path, csv->line, what);
    }
    csv->text[--length] = '\0';
    if (length > 0 && csv->text[length - 1] == '\r') {
        csv->text[length - 1] = '\0';
    }
    for (const char *c = csv->text; *c != '\0'; c++) {
        if (*c < ' ' || *c > '~') {
            return pm_status_fail(PM_EINPUT, "%s:%ld: this is not plain text (byte 0x%02x)",
                                  csv->path, csv->line, (unsigned)(unsigned char)*c);
        }
    }
    *more = true;
    return PM_OK;
}

pm_status pm_csv_open(const char *path, const char *header, const char *written_by, pm_csv *csv)
{
    memset(csv, 0, sizeof *csv);
    csv->path = path;
    csv->stream = fopen(path, "r");
    if (csv->stream == NULL) {
        return pm_status_fail(PM_EIO, "%s: cannot open: %s", path, strerror(errno));
    }
    bool more = false;
    PM_TRY(read_line(csv, &more));
    if (!more) {
        return pm_status_fail(PM_EINPUT, "%s:1: the file is empty; write it with %s", path,
                              written_by);
    }
    if (strcmp(csv->text, header) != 0) {
        return pm_status_fail(PM_EINPUT,
                              "%s:1: the header must be \"%s\" (written by %s), got \"%.60s\"",
                              path, header, written_by, csv->text);
    }
    memcpy(csv->names, csv->text, sizeof csv->names);
    csv->columns = split(csv->names, csv->name);
    return PM_OK;
}

pm_status pm_csv_next(pm_csv *csv, bool *more)
{
    bool got = false;
    PM_TRY(read_line(csv, &got));
    if (got) {
        int fields = split(csv->text, csv->field);
        if (fields != csv->columns) {
            return pm_status_fail(PM_EINPUT, "%s:%ld: a row has %d fields, got %s%d", csv->path,
                                  csv->line, csv->columns,
                                  fields > PM_CSV_COLUMNS_MAX ? "at least " : "", fields);
        }
    }
    *more = got;
    return PM_OK;
}

pm_status pm_csv_number(const pm_csv *csv, int column, double *value)
{
    const char *text = csv->field[column];
    char *end = NULL;
    double got = strtod(text, &end);
    bool decimal = strspn(text, "0123456789+-.eE") == strlen(text);
    if (!decimal || end == text || *end != '\0' || !isfinite(got)) {
        return pm_status_fail(PM_EINPUT, "%s:%ld: %s must be a finite number, got \"%.40s\"",
                              csv->path, csv->line, csv->name[column], text);
    }
    *value = got;
    return PM_OK;
}

pm_status pm_csv_positive(const pm_csv *csv, int column, double *value)
{
    double got = 0.0;
    PM_TRY(pm_csv_number(csv, column, &got));
    if (got < 0.0) {
        return pm_status_fail(PM_EINPUT, "%s:%ld: %s must be >= 0, got %g", csv->path,
                              csv->line, csv->name[column], got);
    }
    *value = got;
    return PM_OK;
}

pm_status pm_csv_point(const pm_csv *csv, int column, const pm_scene *scene, pm_vec3 *point)
{
    pm_vec3 at;
    PM_TRY(pm_csv_number(csv, column, &at.x));
    PM_TRY(pm_csv_number(csv, column + 1, &at.y));
    PM_TRY(pm_csv_number(csv, column + 2, &at.z));
    at = pm_vec_sub(at, scene->center);
    if (pm_vec_reach(at) > RADII * scene->radius) {
        return pm_status_fail(
            PM_EINPUT,
            "%s:%ld: the point %s,%s,%s lies far outside of %s: it comes from "
            "another scene",
            csv->path, csv->line, csv->field[column], csv->field[column + 1],
            csv->field[column + 2], scene->path);
    }
    *point = at;
    return PM_OK;
}

pm_status pm_csv_unit(const pm_csv *csv, int column, pm_vec3 *direction)
{
    pm_vec3 v;
    PM_TRY(pm_csv_number(csv, column, &v.x));
    PM_TRY(pm_csv_number(csv, column + 1, &v.y));
    PM_TRY(pm_csv_number(csv, column + 2, &v.z));
    double length = pm_vec_length(v);
    if (!(fabs(length - 1.0) <= UNIT_SLACK)) {
        return pm_status_fail(PM_EINPUT,
                              "%s:%ld: %s and the two fields behind it must be a unit vector, "
                              "got length %g",
                              csv->path, csv->line, csv->name[column], length);
    }
    *direction = pm_vec_scale(v, 1.0 / length);
    return PM_OK;
}

pm_status pm_csv_count(const pm_csv *csv, int column, uint64_t most, uint64_t *value)
{
    const char *text = csv->field[column];
    char *end = NULL;
    errno = 0;
    unsigned long long got = strtoull(text, &end, 10);
    bool digits = text[0] != '\0' && strspn(text, "0123456789") == strlen(text);
    if (!digits || errno != 0 || *end != '\0' || got > most) {
        return pm_status_fail(
            PM_EINPUT, "%s:%ld: %s must be a whole number from 0 to %llu, got \"%.40s\"",
            csv->path, csv->line, csv->name[column], (unsigned long long)most, text);
    }
    *value = got;
    return PM_OK;
}

void pm_csv_close(pm_csv *csv)
{
    if (csv->stream != NULL) {
        fclose(csv->stream);
    }
    csv->stream = NULL;
}
