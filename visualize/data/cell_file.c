// A map's cells stand row by row, so the number of columns is known when the second row begins,
// and the number of rows when another map does.
#include "cell_file.h"

#include "csv.h"
#include "emit_dump.h"

#include <stdlib.h>
#include <string.h>

#define SIDE_MOST 8192
#define MAPS_MOST 4096
#define BEYOND 1.000001 // what the digits of a file make of pi

enum { MAP, LIGHT, FLAT, ROW, COLUMN, NEAR, FAR, AZIMUTH, AZIMUTH_END, LIT };

typedef struct {
    pm_cell_set set;
    uint64_t used, room; // cells of the last map
} reader;

static pm_status out_of_order(const pm_csv *csv, const char *what)
{
    return pm_status_fail(PM_EINPUT, "%s:%ld: %s", csv->path, csv->line, what);
}

static pm_status read_bounds(const pm_csv *csv, bool flat, pm_cell *cell)
{
    PM_TRY(pm_csv_positive(csv, NEAR, &cell->near));
    PM_TRY(pm_csv_positive(csv, FAR, &cell->far));
    PM_TRY(pm_csv_positive(csv, AZIMUTH, &cell->azimuth));
    PM_TRY(pm_csv_positive(csv, AZIMUTH_END, &cell->azimuth_end));
    if (cell->near >= cell->far || cell->azimuth >= cell->azimuth_end) {
        return out_of_order(csv, "a cell must end behind its beginning: near < far, azimuth < "
                                 "azimuth_end");
    }
    if (cell->azimuth_end > 2.0 * PM_PI * BEYOND || (!flat && cell->far > PM_PI * BEYOND)) {
        return out_of_order(csv,
                            "angles are radians: far at most pi, azimuth_end at most 2 pi");
    }
    return PM_OK;
}

static pm_status begin_map(const pm_csv *csv, reader *to, uint64_t light, bool flat)
{
    if (to->set.count == MAPS_MOST || strlen(csv->field[MAP]) >= sizeof to->set.maps->map) {
        return out_of_order(csv, "too many maps, or too long a name of one");
    }
    size_t wanted = (size_t)to->set.count + 1;
    pm_cell_map *moved = realloc(to->set.maps, wanted * sizeof *moved);
    if (moved == NULL) {
        return PM_FAIL(PM_ENOMEM, "%s", "no memory for cells");
    }
    to->set.maps = moved;
    pm_cell_map *map = &moved[to->set.count++];
    *map = (pm_cell_map){.light = (uint32_t)light, .flat = flat};
    memcpy(map->map, csv->field[MAP], strlen(csv->field[MAP]));
    to->used = 0;
    to->room = 0;
    return PM_OK;
}

static pm_status add_cell(reader *to, const pm_cell *cell)
{
    pm_cell_map *map = &to->set.maps[to->set.count - 1];
    if (to->used == to->room) {
        uint64_t wanted = to->room == 0 ? 1024 : 2 * to->room;
        pm_cell *moved = realloc(map->cells, (size_t)wanted * sizeof *moved);
        if (moved == NULL) {
            return PM_FAIL(PM_ENOMEM, "%s", "no memory for cells");
        }
        map->cells = moved;
        to->room = wanted;
    }
    map->cells[to->used++] = *cell;
    map->lit += cell->lit;
    return PM_OK;
}

/// Is the cell the next one of its map? Counts rows and columns as they come.
static pm_status check_place(const pm_csv *csv, const reader *to, uint64_t row, uint64_t column)
{
    pm_cell_map *map = &to->set.maps[to->set.count - 1];
    bool first_row = map->rows <= 1;
    if (first_row && row == 0 && column == to->used) {
        map->rows = 1;
        map->columns = (uint32_t)column + 1;
        return PM_OK;
    }
    uint64_t due = map->columns > 0 ? to->used / map->columns : 0;
    if (map->columns == 0 || row != due || column != to->used % map->columns) {
        return out_of_order(csv, "cells must stand row by row, each row from column 0 to the "
                                 "last, none left out");
    }
    map->rows = (uint32_t)row + 1;
    return PM_OK;
}

static pm_status check_whole(const pm_csv *csv, const reader *to)
{
    if (to->set.count == 0) {
        return PM_OK;
    }
    const pm_cell_map *map = &to->set.maps[to->set.count - 1];
    return to->used == (uint64_t)map->rows * map->columns
               ? PM_OK
               : out_of_order(csv, "the map before ends in the middle of a row");
}

static bool begins_map(const pm_csv *csv, const reader *to, uint64_t light)
{
    if (to->set.count == 0) {
        return true;
    }
    const pm_cell_map *last = &to->set.maps[to->set.count - 1];
    return light != last->light || strcmp(csv->field[MAP], last->map) != 0;
}

static pm_status read_row(const pm_csv *csv, reader *to)
{
    uint64_t light = 0;
    uint64_t flat = 0;
    uint64_t row = 0;
    uint64_t column = 0;
    uint64_t lit = 0;
    pm_cell cell;
    PM_TRY(pm_csv_count(csv, LIGHT, UINT32_MAX, &light));
    PM_TRY(pm_csv_count(csv, FLAT, 1, &flat));
    PM_TRY(pm_csv_count(csv, ROW, SIDE_MOST, &row));
    PM_TRY(pm_csv_count(csv, COLUMN, SIDE_MOST, &column));
    PM_TRY(pm_csv_count(csv, LIT, 1, &lit));
    PM_TRY(read_bounds(csv, flat == 1, &cell));
    cell.lit = lit == 1;
    if (begins_map(csv, to, light)) {
        PM_TRY(check_whole(csv, to));
        PM_TRY(begin_map(csv, to, light, flat == 1));
    }
    PM_TRY(check_place(csv, to, row, column));
    return add_cell(to, &cell);
}

static pm_status read_rows(pm_csv *csv, reader *to)
{
    for (;;) {
        bool more = false;
        PM_TRY(pm_csv_next(csv, &more));
        if (!more) {
            break;
        }
        PM_TRY(read_row(csv, to));
    }
    if (to->set.count == 0) {
        return pm_status_fail(PM_EINPUT,
                              "%s:2: the file holds no cell: in that scene no light gains by "
                              "aiming, or it was written with --projection off",
                              csv->path);
    }
    return check_whole(csv, to);
}

pm_status pm_cell_file_read(const char *path, pm_cell_set *cells)
{
    pm_csv csv;
    reader to = {0};
    pm_status status = pm_csv_open(path, PM_CELL_HEADER, "emission --cells", &csv);
    if (status == PM_OK) {
        status = read_rows(&csv, &to);
    }
    pm_csv_close(&csv);
    if (status != PM_OK) {
        pm_cell_file_free(&to.set);
        return status;
    }
    *cells = to.set;
    return PM_OK;
}

void pm_cell_file_free(pm_cell_set *cells)
{
    for (int i = 0; i < cells->count; i++) {
        free(cells->maps[i].cells);
    }
    free(cells->maps);
    *cells = (pm_cell_set){0};
}
