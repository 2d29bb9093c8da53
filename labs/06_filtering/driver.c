// filtering: the same photons through every kernel, side by side, with the constants that are
// right and with the lecture's; and differential checking, with the photons it keeps.
#include "interrupt.h"
#include "map_make.h"
#include "photon_map.h"
#include "probe.h"
#include "program.h"
#include "report.h"
#include "store.h"
#include "world.h"

#include <stdio.h>
#include <stdlib.h>

#define KERNELS (2 * PM_FILTER_COUNT) // each with both kinds of constants
#define ROWS (KERNELS + 1)            // and differential checking
#define LEAST_KEPT 8u
#define STEPS 100000 // of the integral over a kernel

static const pm_options_program program = {
    .name = "filtering",
    .does = "Estimates irradiance at points of a scene with every kernel side by side.",
    .positional = "SCENE",
    .positional_least = 1,
    .positional_most = 1,
    .options = "n k r shape flatness at normal points on grid runs projection roulette "
               "max-bounces packing report",
    .notes = "Give one of --at with --normal, --points, and --on with --grid. mean and rms go\n"
             "over all points and runs; rms is that of the deviation from the mean. -lecture\n"
             "is the 0.918 of the Gaussian, and k photons in place of k - 1.",
};

/// One kernel's results over all points and runs so far.
typedef struct {
    pm_spectrum mean, spread; // spread: sum of squared distances from the mean
    double found;             // sum
    double count;
} tally;

typedef struct {
    const pm_options *options;
    pm_world world;
    pm_probes probes;
    pm_neighbour *nearest;
    double *distance2, *power; // of differential checking, by distance
    tally rows[ROWS];
} pm_job;

// --- estimating -----------------------------------------------------------------------------

static void add(tally *row, const pm_estimate *estimate)
{
    row->count += 1.0;
    row->found += estimate->found;
    for (int c = 0; c < 3; c++) {
        double before = estimate->value.c[c] - row->mean.c[c];
        row->mean.c[c] += before / row->count;
        row->spread.c[c] += before * (estimate->value.c[c] - row->mean.c[c]);
    }
}

static pm_estimate_settings settings_of(const pm_job *job, int kernel)
{
    pm_estimate_settings settings = job->options->estimate;
    bool lecture = kernel >= PM_FILTER_COUNT;
    settings.filter = (pm_filter_kind)(kernel % PM_FILTER_COUNT);
    settings.constants = lecture ? PM_CONSTANTS_LECTURE : PM_CONSTANTS_UNBIASED;
    settings.plain_k = lecture;
    return settings;
}

static int by_distance(const void *a, const void *b)
{
    const pm_neighbour *first = a;
    const pm_neighbour *second = b;
    if (first->distance2 != second->distance2) {
        return first->distance2 < second->distance2 ? -1 : 1;
    }
    return (first->index > second->index) - (first->index < second->index);
}

/// How many photons differential checking keeps at a point.
static pm_status keep(pm_job *job, const pm_photon_map *map, const pm_estimate_point *point,
                      uint32_t *kept)
{
    const pm_estimate_settings *settings = &job->options->estimate;
    pm_estimate_query query = {*point, settings->shape, settings->flatness, settings->skip,
                               settings->only};
    pm_search search = {.at = point->at,
                        .k = settings->k,
                        .radius2 = settings->radius * settings->radius,
                        .accept = pm_estimate_accept,
                        .context = &query};
    uint32_t found;
    PM_TRY(pm_balance_nearest(map, &search, job->nearest, &found, NULL));
    qsort(job->nearest, found, sizeof *job->nearest, by_distance);
    for (uint32_t i = 0; i < found; i++) {
        job->distance2[i] = job->nearest[i].distance2;
        job->power[i] = pm_spectrum_mean(pm_store_power(map, job->nearest[i].index));
    }
    return pm_filter_differential(job->distance2, job->power, found, LEAST_KEPT, kept);
}

static pm_status estimate_point(pm_job *job, const pm_photon_map *map,
                                const pm_estimate_point *point)
{
    pm_estimate estimate;
    for (int kernel = 0; kernel < KERNELS; kernel++) {
        pm_estimate_settings settings = settings_of(job, kernel);
        PM_TRY(pm_estimate_irradiance(map, &settings, point, job->nearest, &estimate));
        add(&job->rows[kernel], &estimate);
    }
    pm_estimate_settings settings = settings_of(job, PM_FILTER_NONE);
    uint32_t kept;
    PM_TRY(keep(job, map, point, &kept));
    settings.k = kept > 0 && kept < settings.k ? kept : settings.k;
    PM_TRY(pm_estimate_irradiance(map, &settings, point, job->nearest, &estimate));
    add(&job->rows[KERNELS], &estimate);
    return PM_OK;
}

static pm_status estimate_points(pm_job *job, const pm_photon_map *map)
{
    for (uint32_t i = 0; i < job->probes.count; i++) {
        PM_TRY(estimate_point(job, map, &job->probes.points[i]));
        PM_TRY(pm_interrupt_check());
    }
    return PM_OK;
}

static pm_status estimate_runs(pm_job *job)
{
    for (uint32_t run = 0; run < job->options->runs; run++) {
        pm_photon_map map;
        PM_TRY(pm_map_make(job->options, &job->world.rays, PM_MAP_GLOBAL, run, &map));
        pm_status status = estimate_points(job, &map);
        pm_photon_map_free(&map);
        PM_TRY(status);
    }
    return PM_OK;
}

// --- results --------------------------------------------------------------------------------

static const char *name_of(int row)
{
    static const char *const names[ROWS] = {
        "none",         "cone",         "gaussian",         "epanechnikov",
        "none-lecture", "cone-lecture", "gaussian-lecture", "epanechnikov-lecture",
        "differential"};
    return names[row];
}

/// What a kernel's weights are divided by, and what its mean weight over the disc is: the two
/// should be one.
static pm_status kernel_constants(const pm_job *job, int row, double *divided_by, double *mean)
{
    pm_estimate_settings settings = settings_of(job, row == KERNELS ? PM_FILTER_NONE : row);
    PM_TRY(pm_filter_normalisation(settings.filter, settings.constants, divided_by));
    double sum = 0.0;
    for (int i = 0; i < STEPS; i++) {
        double weight;
        double u = (i + 0.5) / STEPS;
        PM_TRY(pm_filter_weight(settings.filter, settings.constants, u, &weight));
        sum += weight;
    }
    *mean = sum / STEPS;
    return PM_OK;
}

static pm_spectrum rms_of(const tally *row)
{
    const double *spread = row->spread.c;
    return pm_rgb(sqrt(spread[0] / row->count), sqrt(spread[1] / row->count),
                  sqrt(spread[2] / row->count));
}

static pm_status print_row(const pm_job *job, int row)
{
    const tally *results = &job->rows[row];
    double divided_by;
    double mean_weight;
    PM_TRY(kernel_constants(job, row, &divided_by, &mean_weight));
    double mean = pm_spectrum_mean(results->mean);
    double rms = pm_spectrum_mean(rms_of(results));
    printf("%-22s %10.6f %12.6f %12.6g %12.6g %10.4f %8.1f\n", name_of(row), divided_by,
           mean_weight, mean, rms, mean > 0.0 ? rms / mean : 0.0,
           results->found / results->count);
    return PM_OK;
}

static pm_status print_table(const pm_job *job)
{
    printf("%-22s %10s %12s %12s %12s %10s %8s\n", "kernel", "divides by", "mean weight",
           "mean W/m^2", "rms", "rms/mean", "photons");
    for (int row = 0; row < ROWS; row++) {
        PM_TRY(print_row(job, row));
    }
    return PM_OK;
}

static json_t *row_json(const pm_job *job, int row)
{
    const tally *results = &job->rows[row];
    double divided_by;
    double mean_weight;
    if (kernel_constants(job, row, &divided_by, &mean_weight) != PM_OK) {
        return NULL;
    }
    json_t *object = pm_report_add(json_object(), "mean", pm_report_spectrum(results->mean));
    object = pm_report_add(object, "rms", pm_report_spectrum(rms_of(results)));
    object = pm_report_add(object, "normalisation", json_real(divided_by));
    object = pm_report_add(object, "mean_weight", json_real(mean_weight));
    return pm_report_add(object, row == KERNELS ? "kept" : "found",
                         json_real(results->found / results->count));
}

static pm_status report(const pm_job *job)
{
    if (!job->options->json) {
        PM_TRY(print_table(job));
    }
    json_t *filters = json_object();
    for (int row = 0; row < ROWS; row++) {
        filters = pm_report_add(filters, name_of(row), row_json(job, row));
    }
    json_t *object = pm_report_add(json_object(), "filters", filters);
    object = pm_report_add(object, "samples", json_real(job->rows[0].count));
    object = pm_report_add(object, "notes", pm_report_notes(&job->world.scene));
    return pm_report_end(job->options, object);
}

// --- the job --------------------------------------------------------------------------------

static pm_status make_room(pm_job *job)
{
    size_t k = job->options->estimate.k;
    job->nearest = malloc(k * sizeof *job->nearest);
    job->distance2 = malloc(k * sizeof *job->distance2);
    job->power = malloc(k * sizeof *job->power);
    if (job->nearest == NULL || job->distance2 == NULL || job->power == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory to search for %zu photons", k);
    }
    return PM_OK;
}

static pm_status run(pm_job *job)
{
    const pm_options *options = job->options;
    PM_TRY(pm_world_open(options, false, &job->world));
    PM_TRY(pm_probes_make(program.name, options, &job->world.scene, &job->probes));
    if (job->probes.free) {
        return pm_status_fail(PM_EINPUT,
                              "filtering: --at needs --normal X,Y,Z: its kernels are "
                              "those of surfaces, not of media");
    }
    PM_TRY(make_room(job));
    PM_TRY(estimate_runs(job));
    return report(job);
}

int main(int argc, char **argv)
{
    pm_options options;
    int code;
    if (!pm_program_start(argc, argv, &program, &options, &code)) {
        return code;
    }
    pm_job job = {.options = &options};
    pm_status status = run(&job);
    free(job.nearest);
    free(job.distance2);
    free(job.power);
    pm_probes_free(&job.probes);
    pm_world_close(&job.world);
    return pm_program_end(status);
}
