// The mean of a kernel over its disc is that over u = d^2 / r^2 from 0 to 1, as equal steps of
// u are rings of equal area. Midpoints of so many steps that those of the curves, which are
// equal in d, begin at one of them.
#include "kernels.h"

#include "file.h"

#include <math.h>

#define POINTS 200                   // of a curve, without the one at 0
#define RINGS (3u * POINTS * POINTS) // of the integral

const char *pm_kernels_name(int row)
{
    static const char *const names[PM_KERNELS_ROWS] = {
        "none",         "cone",         "gaussian",         "epanechnikov",
        "none-lecture", "cone-lecture", "gaussian-lecture", "epanechnikov-lecture",
        "differential"};
    return names[row];
}

pm_estimate_settings pm_kernels_settings(const pm_estimate_settings *base, int row)
{
    pm_estimate_settings settings = *base;
    bool lecture = row >= PM_FILTER_COUNT && row < PM_KERNELS_COUNT;
    settings.filter = row == PM_KERNELS_DIFFERENTIAL ? PM_FILTER_NONE
                                                     : (pm_filter_kind)(row % PM_FILTER_COUNT);
    settings.constants = lecture ? PM_CONSTANTS_LECTURE : PM_CONSTANTS_UNBIASED;
    settings.plain_k = lecture;
    return settings;
}

/// The stage's weight in the ring around `u`, undivided.
static pm_status weigh(int row, double u, double *weight)
{
    const pm_estimate_settings none = pm_estimate_defaults();
    pm_estimate_settings settings = pm_kernels_settings(&none, row);
    return pm_filter_weight(settings.filter, settings.constants, u, weight);
}

static pm_status normalisation(int row, double *divided_by)
{
    const pm_estimate_settings none = pm_estimate_defaults();
    pm_estimate_settings settings = pm_kernels_settings(&none, row);
    return pm_filter_normalisation(settings.filter, settings.constants, divided_by);
}

pm_status pm_kernels_weight(int row, double distance, double *weight)
{
    double whole;
    double divided_by;
    PM_TRY(weigh(row, distance * distance, &whole));
    PM_TRY(normalisation(row, &divided_by));
    *weight = whole / divided_by;
    return PM_OK;
}

/// Adds the rings from number `from` to before `to`.
static pm_status add_rings(int row, unsigned from, unsigned to, double *sum)
{
    for (unsigned i = from; i < to; i++) {
        double weight;
        PM_TRY(weigh(row, (i + 0.5) / RINGS, &weight));
        *sum += weight;
    }
    return PM_OK;
}

pm_status pm_kernels_constants(int row, double *divided_by, double *mean)
{
    double sum = 0.0;
    PM_TRY(add_rings(row, 0, RINGS, &sum));
    PM_TRY(normalisation(row, divided_by));
    *mean = sum / RINGS;
    return PM_OK;
}

static pm_status write_curve(FILE *out, int row)
{
    double divided_by;
    double sum = 0.0;
    unsigned ring = 0;
    PM_TRY(normalisation(row, &divided_by));
    for (unsigned i = 0; i <= POINTS; i++) {
        double distance = (double)i / POINTS;
        double weight;
        unsigned inside = i * i * (RINGS / (POINTS * POINTS));
        PM_TRY(pm_kernels_weight(row, distance, &weight));
        PM_TRY(add_rings(row, ring, inside, &sum));
        ring = inside;
        fprintf(out, "%s,%.9g,%.9g,%.9g\n", pm_kernels_name(row), distance, weight,
                sum / RINGS / divided_by);
    }
    return PM_OK;
}

pm_status pm_kernels_write(const char *path)
{
    pm_file file;
    PM_TRY(pm_file_begin(path, &file));
    fputs(PM_KERNELS_HEADER "\n", file.stream);
    for (int row = 0; row < PM_KERNELS_COUNT; row++) {
        pm_status status = write_curve(file.stream, row);
        if (status != PM_OK) {
            pm_file_abandon(&file);
            return status;
        }
    }
    return pm_file_commit(&file);
}
