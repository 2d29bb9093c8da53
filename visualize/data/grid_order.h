// Points of a grid in a table, row by row: i counts the columns and is the first field, j the
// rows and is the second.
#ifndef PM_GRID_ORDER_H
#define PM_GRID_ORDER_H

#include "csv.h"

/// Refuses a row of the table that is not point number `count` of the grid.
/// @param columns  0 until the first return to i = 0, then the points of a row
pm_status pm_grid_order_check(const pm_csv *csv, uint64_t count, uint64_t *columns);

/// At the table's end: refuses a grid below 2 x 2, and a last row that is not complete.
/// @param rows  [out]
pm_status pm_grid_order_end(const pm_csv *csv, uint64_t count, uint64_t columns,
                            uint64_t *rows);

#endif
