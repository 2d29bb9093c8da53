// Reading the tables that programs dump: a known header line, then rows of plain fields without
// quotes. Every fault is one line that starts with file:line.
#ifndef PM_CSV_H
#define PM_CSV_H

#include "scene.h"
#include "status.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#define PM_CSV_COLUMNS_MAX 32
#define PM_CSV_LINE_MAX 2048

/// One open file and its current row.
typedef struct {
    const char *path; // the caller's
    FILE *stream;
    long line; // of the current row; the header is line 1
    int columns;
    char *field[PM_CSV_COLUMNS_MAX]; // zero-terminated, into `text`
    char names[PM_CSV_LINE_MAX];
    char *name[PM_CSV_COLUMNS_MAX];
    char text[PM_CSV_LINE_MAX];
} pm_csv;

/// Opens `path`, whose first line must be exactly `header`.
/// @param written_by  the command that writes such a file, for the message
/// @param csv  [out] close with pm_csv_close(), whatever is returned
/// @return PM_EIO when it cannot be read, PM_EINPUT for another header
pm_status pm_csv_open(const char *path, const char *header, const char *written_by,
                      pm_csv *csv);

/// Takes the next row.
/// @param more  [out] false at the end of the file
/// @return PM_EINPUT for another number of fields than the header's, an overlong line, or a
/// last
///         line without its end (a file that was cut)
pm_status pm_csv_next(pm_csv *csv, bool *more);

/// Field `column` of the row as a finite number, all of it.
pm_status pm_csv_number(const pm_csv *csv, int column, double *value);

/// Field `column` as a finite number >= 0.
pm_status pm_csv_positive(const pm_csv *csv, int column, double *value);

/// Fields `column` to `column` + 2 as a point [m], from the scene file's coordinates to centred
/// ones. A point further from the scene than light starts or is followed to is refused: the
/// file was written for another scene.
pm_status pm_csv_point(const pm_csv *csv, int column, const pm_scene *scene, pm_vec3 *point);

/// Fields `column` to `column` + 2 as a unit vector.
pm_status pm_csv_unit(const pm_csv *csv, int column, pm_vec3 *direction);

/// Field `column` as a whole number in [0, most].
pm_status pm_csv_count(const pm_csv *csv, int column, uint64_t most, uint64_t *value);

void pm_csv_close(pm_csv *csv);

#endif
