// filtering: the same photons through every kernel, side by side, with the constants that are
// right and with the lecture's; and differential checking, with the photons it keeps. What the
// pictures of this stage are drawn from is written here, too.
#include "file.h"
#include "interrupt.h"
#include "kernels.h"
#include "map_make.h"
#include "photon_map.h"
#include "probe.h"
#include "program.h"
#include "report.h"
#include "store.h"
#include "weighed.h"
#include "world.h"

#include <stdio.h>
#include <stdlib.h>

#define ROWS PM_KERNELS_ROWS
#define LEAST_KEPT 8u

static const pm_options_program program = {
    .name = "filtering",
    .does = "Estimates irradiance at points of a scene with every kernel side by side.",
    .positional = "SCENE",
    .positional_least = 1,
    .positional_most = 1,
    .options = "n k r shape flatness at normal points on grid part runs dump gathered curves "
               "projection roulette max-bounces packing report",
    .notes =
        "Give one of --at with --normal, --points, and --on with --grid. mean and rms go\n"
        "over all points and runs; rms is that of the deviation from the mean. -lecture\n"
        "is the 0.918 of the Gaussian, and k photons in place of k - 1.\n"
        "--dump writes the points as i,j,x,y,z and the irradiance (luminance, W/m^2, mean\n"
        "of the runs) under each kernel. --curves: kernel,distance,weight,inside, over the\n"
        "radius. --gathered: x,y,z,r,g,b,distance and the weight of each photon of the\n"
        "first run under each kernel.",
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
    double *dump; // luminance, sum over the runs, ROWS a point; NULL without --dump
    pm_weighed gathered;
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

/// How many photons differential checking keeps at a point.
static pm_status keep(pm_job *job, const pm_photon_map *map, const pm_estimate_point *point,
                      uint32_t *kept)
{
    uint32_t found;
    PM_TRY(pm_weighed_search(map, &job->options->estimate, point, job->nearest, &found));
    for (uint32_t i = 0; i < found; i++) {
        job->distance2[i] = job->nearest[i].distance2;
        job->power[i] = pm_spectrum_mean(pm_store_power(map, job->nearest[i].index));
    }
    return pm_filter_differential(job->distance2, job->power, found, LEAST_KEPT, kept);
}

/// The estimate of one row of the table.
static pm_status estimate_row(pm_job *job, const pm_photon_map *map,
                              const pm_estimate_point *point, int row, pm_estimate *estimate)
{
    pm_estimate_settings settings = pm_kernels_settings(&job->options->estimate, row);
    if (row == PM_KERNELS_DIFFERENTIAL) {
        uint32_t kept;
        PM_TRY(keep(job, map, point, &kept));
        settings.k = kept > 0 && kept < settings.k ? kept : settings.k;
    }
    return pm_estimate_irradiance(map, &settings, point, job->nearest, estimate);
}

static pm_status estimate_point(pm_job *job, const pm_photon_map *map, uint32_t index)
{
    for (int row = 0; row < ROWS; row++) {
        pm_estimate estimate;
        PM_TRY(estimate_row(job, map, &job->probes.points[index], row, &estimate));
        add(&job->rows[row], &estimate);
        if (job->dump != NULL) {
            job->dump[(size_t)index * ROWS + (size_t)row] +=
                pm_spectrum_luminance(estimate.value);
        }
    }
    return PM_OK;
}

static pm_status estimate_points(pm_job *job, const pm_photon_map *map)
{
    for (uint32_t i = 0; i < job->probes.count; i++) {
        PM_TRY(estimate_point(job, map, i));
        PM_TRY(pm_interrupt_check());
    }
    return PM_OK;
}

/// The photons of the one point there is.
static pm_status write_gathered(pm_job *job, const pm_photon_map *map)
{
    const pm_options *options = job->options;
    return pm_weighed_write(options->gathered, map, &options->estimate, job->probes.points,
                            job->world.scene.center, job->nearest, &job->gathered);
}

static pm_status estimate_runs(pm_job *job)
{
    for (uint32_t run = 0; run < job->options->runs; run++) {
        pm_photon_map map;
        PM_TRY(pm_map_make(job->options, &job->world.rays, PM_MAP_GLOBAL, run, &map));
        pm_status status = estimate_points(job, &map);
        if (status == PM_OK && run == 0 && job->options->gathered != NULL) {
            status = write_gathered(job, &map);
        }
        pm_photon_map_free(&map);
        PM_TRY(status);
    }
    return PM_OK;
}

// --- results --------------------------------------------------------------------------------

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
    PM_TRY(pm_kernels_constants(row, &divided_by, &mean_weight));
    double mean = pm_spectrum_mean(results->mean);
    double rms = pm_spectrum_mean(rms_of(results));
    printf("%-22s %10.6f %12.6f %12.6g %12.6g %10.4f %8.1f\n", pm_kernels_name(row), divided_by,
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
    if (pm_kernels_constants(row, &divided_by, &mean_weight) != PM_OK) {
        return NULL;
    }
    json_t *object = pm_report_add(json_object(), "mean", pm_report_spectrum(results->mean));
    object = pm_report_add(object, "rms", pm_report_spectrum(rms_of(results)));
    object = pm_report_add(object, "normalisation", json_real(divided_by));
    object = pm_report_add(object, "mean_weight", json_real(mean_weight));
    return pm_report_add(object, row == PM_KERNELS_DIFFERENTIAL ? "kept" : "found",
                         json_real(results->found / results->count));
}

static void write_rows(const pm_job *job, FILE *out)
{
    fputs("i,j,x,y,z", out);
    for (int row = 0; row < ROWS; row++) {
        fprintf(out, ",%s", pm_kernels_name(row));
    }
    fputc('\n', out);
    for (uint32_t n = 0; n < job->probes.count; n++) {
        pm_vec3 at = pm_vec_add(job->probes.points[n].at, job->world.scene.center);
        fprintf(out, "%u,%u,%.9g,%.9g,%.9g", n % job->probes.columns, n / job->probes.columns,
                at.x, at.y, at.z);
        for (size_t row = 0; row < ROWS; row++) {
            fprintf(out, ",%.9g", job->dump[n * ROWS + row] / job->options->runs);
        }
        fputc('\n', out);
    }
}

static pm_status write_dump(const pm_job *job)
{
    pm_file file;
    PM_TRY(pm_file_begin(job->options->dump, &file));
    write_rows(job, file.stream);
    return pm_file_commit(&file);
}

/// Of --gathered: where it is, and how large.
static json_t *gathered_json(const pm_job *job)
{
    const pm_estimate_point *point = job->probes.points;
    pm_vec3 at = pm_vec_add(point->at, job->world.scene.center);
    json_t *object = pm_report_add(json_object(), "at", pm_report_vector(at));
    object = pm_report_add(object, "normal", pm_report_vector(point->normal));
    object = pm_report_add(object, "radius", json_real(job->gathered.radius));
    return pm_report_add(object, "photons", json_integer(job->gathered.photons));
}

static pm_status report(const pm_job *job)
{
    if (!job->options->json) {
        PM_TRY(print_table(job));
    }
    json_t *filters = json_object();
    for (int row = 0; row < ROWS; row++) {
        filters = pm_report_add(filters, pm_kernels_name(row), row_json(job, row));
    }
    json_t *object = pm_report_add(json_object(), "filters", filters);
    object = pm_report_add(object, "samples", json_real(job->rows[0].count));
    if (job->options->gathered != NULL) {
        object = pm_report_add(object, "gathered", gathered_json(job));
    }
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
    if (job->options->dump != NULL) {
        job->dump = calloc(job->probes.count, ROWS * sizeof *job->dump);
    }
    return job->options->dump == NULL || job->dump != NULL
               ? PM_OK
               : PM_FAIL(PM_ENOMEM, "no memory for %u points", job->probes.count);
}

static pm_status check_points(const pm_job *job)
{
    if (job->probes.free) {
        return pm_status_fail(PM_EINPUT,
                              "filtering: --at needs --normal X,Y,Z: its kernels are "
                              "those of surfaces, not of media");
    }
    if (job->options->gathered != NULL && !job->options->has_at) {
        return pm_status_fail(PM_EINPUT,
                              "filtering: --gathered needs --at X,Y,Z with --normal: it "
                              "writes the photons of one point, got %u points",
                              job->probes.count);
    }
    return PM_OK;
}

static pm_status run(pm_job *job)
{
    const pm_options *options = job->options;
    PM_TRY(pm_world_open(options, false, &job->world));
    PM_TRY(pm_probes_make(program.name, options, &job->world.scene, &job->probes));
    PM_TRY(check_points(job));
    PM_TRY(make_room(job));
    PM_TRY(estimate_runs(job));
    if (options->dump != NULL) {
        PM_TRY(write_dump(job));
    }
    if (options->curves != NULL) {
        PM_TRY(pm_kernels_write(options->curves));
    }
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
    free(job.dump);
    pm_probes_free(&job.probes);
    pm_world_close(&job.world);
    return pm_program_end(status);
}
