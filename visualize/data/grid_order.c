// Rows arrive as j, i = (0, 0), (0, 1) ... ; the first return to i = 0 fixes the grid's width.
#include "grid_order.h"

enum { I, J };

pm_status pm_grid_order_check(const pm_csv *csv, uint64_t count, uint64_t *columns)
{
    uint64_t i = 0;
    uint64_t j = 0;
    PM_TRY(pm_csv_count(csv, I, UINT32_MAX, &i));
    PM_TRY(pm_csv_count(csv, J, UINT32_MAX, &j));
    if (*columns == 0 && i == 0 && j == 1) {
        *columns = count;
    }
    uint64_t want_i = *columns == 0 ? count : count % *columns;
    uint64_t want_j = *columns == 0 ? 0 : count / *columns;
    if (i != want_i || j != want_j) {
        return pm_status_fail(
            PM_EINPUT, "%s:%ld: the next grid point is i,j = %llu,%llu, got %llu,%llu",
            csv->path, csv->line, (unsigned long long)want_i, (unsigned long long)want_j,
            (unsigned long long)i, (unsigned long long)j);
    }
    return PM_OK;
}

pm_status pm_grid_order_end(const pm_csv *csv, uint64_t count, uint64_t columns, uint64_t *rows)
{
    if (columns < 2 || count % columns != 0) {
        return pm_status_fail(PM_EINPUT,
                              "%s:%ld: a grid has at least 2 x 2 points and its last row "
                              "complete; the file ends after point %llu",
                              csv->path, csv->line, (unsigned long long)count);
    }
    *rows = count / columns;
    return PM_OK;
}
