// radiance: the irradiance at points, from the nearest photons of one or several independent
// global maps; or the fluence at a point in a medium, from volume maps.
#include "file.h"
#include "gathered.h"
#include "inside.h"
#include "interrupt.h"
#include "map_make.h"
#include "photon_map.h"
#include "probe.h"
#include "program.h"
#include "progress.h"
#include "report.h"
#include "world.h"

#include <stdio.h>
#include <stdlib.h>

static const pm_options_program program = {
    .name = "radiance",
    .does = "Estimates irradiance [W/m^2] at points of a scene from its global photon map, or "
            "fluence [W/m^2] at a point in a medium from its volume map.",
    .positional = "SCENE",
    .positional_least = 1,
    .positional_most = 1,
    .options = "n " PM_OPTIONS_ESTIMATE
               " at normal points on grid runs dump gathered projection roulette max-bounces "
               "packing report",
    .notes =
        "Give one of --at with --normal, --points, and --on with --grid. --at without\n"
        "--normal asks for the fluence in the medium there: radiance from all around, summed\n"
        "up; the photons of a ball, whatever --shape and --filter say. --dump writes the\n"
        "points as i,j,x,y,z,nx,ny,nz,r,g,b,radius,found, row by row; with --runs all\n"
        "values are means over the runs, and sd is the deviation of one run. --gathered\n"
        "writes, at one point in one run, the photons that the estimate is made of and those\n"
        "around it: what,number,x,y,z,nx,ny,nz,dx,dy,dz,r,g,b,distance,weight. Its first row\n"
        "is the ball or disc: photons found, point, normal, irradiance, radius, flatness.",
};

/// One point's results over the runs so far.
typedef struct {
    pm_spectrum mean, spread; // of the irradiance; sum of squared distances from the mean
    double radius, found;     // sums
    uint32_t runs;
} tally;

typedef struct {
    const pm_options *options;
    pm_world world;
    pm_probes probes;
    const pm_medium *medium; // that fluence is asked for in; NULL: irradiance is
    tally *tallies;
    pm_file dump;
} pm_job;

// --- estimating -----------------------------------------------------------------------------

/// @source Welford, Technometrics 4(3), 1962: no difference of large sums
static void add(tally *point, const pm_estimate *estimate)
{
    point->runs++;
    for (int c = 0; c < 3; c++) {
        double before = estimate->value.c[c] - point->mean.c[c];
        point->mean.c[c] += before / point->runs;
        point->spread.c[c] += before * (estimate->value.c[c] - point->mean.c[c]);
    }
    point->radius += estimate->radius;
    point->found += estimate->found;
}

/// Fluence is the density of the power that collides over the share of it that does, a metre.
static pm_status estimate_fluence(const pm_photon_map *map,
                                  const pm_estimate_settings *settings, pm_vec3 at,
                                  const pm_medium *medium, pm_neighbour *scratch,
                                  pm_estimate *estimate)
{
    pm_vec3 anywhere = {0.0, 0.0, 0.0};
    PM_TRY(pm_estimate_volume(map, settings, at, NULL, anywhere, scratch, estimate));
    estimate->value = pm_spectrum_scale(estimate->value, 1.0 / medium->sigma_t);
    return PM_OK;
}

static pm_status estimate_at(const pm_job *job, const pm_photon_map *map, uint32_t i,
                             pm_neighbour *scratch, pm_estimate *estimate)
{
    const pm_estimate_settings *settings = &job->options->estimate;
    const pm_estimate_point *point = &job->probes.points[i];
    return job->medium != NULL
               ? estimate_fluence(map, settings, point->at, job->medium, scratch, estimate)
               : pm_estimate_irradiance(map, settings, point, scratch, estimate);
}

/// Points are independent, so threads share them out; each has its own room to search in.
static pm_status estimate_all(pm_job *job, const pm_photon_map *map)
{
    const pm_estimate_settings *settings = &job->options->estimate;
    pm_status worst = PM_OK;
    char message[1024] = "";
#pragma omp parallel
    {
        pm_neighbour *scratch = malloc((size_t)settings->k * sizeof *scratch);
        pm_status status =
            scratch != NULL
                ? PM_OK
                : PM_FAIL(PM_ENOMEM, "no memory to search for %u photons", settings->k);
#pragma omp for schedule(static)
        for (int64_t i = 0; i < (int64_t)job->probes.count; i++) {
            pm_estimate estimate;
            if (status == PM_OK) {
                status = estimate_at(job, map, (uint32_t)i, scratch, &estimate);
            }
            if (status == PM_OK) {
                add(&job->tallies[i], &estimate);
            }
        }
        free(scratch);
        if (status != PM_OK) {
#pragma omp critical
            {
                worst = status;
                snprintf(message, sizeof message, "%s", pm_status_message());
            }
        }
    }
    return worst == PM_OK ? PM_OK : pm_status_fail(worst, "%s", message);
}

/// The first point's only estimate, as it was told.
static pm_status write_gathered(const pm_job *job, const pm_photon_map *map)
{
    const tally *told = &job->tallies[0];
    pm_estimate estimate = {
        .value = told->mean, .radius = told->radius, .found = (uint32_t)told->found};
    return pm_gathered_write(job->options->gathered, map, &job->options->estimate,
                             &job->probes.points[0], &estimate, job->world.scene.center);
}

static pm_status estimate_runs(pm_job *job)
{
    pm_map_kind kind = job->medium != NULL ? PM_MAP_VOLUME : PM_MAP_GLOBAL;
    pm_progress progress = pm_progress_begin("radiance", job->options->runs);
    for (uint32_t run = 0; run < job->options->runs; run++) {
        pm_photon_map map;
        PM_TRY(pm_map_make(job->options, &job->world.rays, kind, run, &map));
        pm_status status = estimate_all(job, &map);
        if (status == PM_OK && job->options->gathered != NULL) {
            status = write_gathered(job, &map);
        }
        pm_photon_map_free(&map);
        PM_TRY(status);
        PM_TRY(pm_interrupt_check());
        pm_progress_add(&progress, 1);
    }
    pm_progress_end(&progress);
    return PM_OK;
}

// --- results --------------------------------------------------------------------------------

/// Standard deviation of one run; for two runs and more.
static pm_spectrum deviation_of(const tally *point)
{
    pm_spectrum deviation;
    for (int c = 0; c < 3; c++) {
        deviation.c[c] = sqrt(point->spread.c[c] / (point->runs - 1.0));
    }
    return deviation;
}

static json_t *point_json(const pm_job *job, uint32_t i)
{
    const tally *point = &job->tallies[i];
    uint32_t runs = job->options->runs;
    json_t *sd = runs > 1 ? pm_report_spectrum(deviation_of(point))
                          : json_pack("[n,n,n]"); // one run has no deviation
    json_t *found =
        runs > 1 ? json_real(point->found / runs) : json_integer((json_int_t)point->found);
    const char *key = job->medium != NULL ? "fluence" : "irradiance";
    json_t *object = pm_report_add(json_object(), key, pm_report_spectrum(point->mean));
    object = pm_report_add(object, "sd", sd);
    object = pm_report_add(object, "radius", json_real(point->radius / runs));
    return pm_report_add(object, "found", found);
}

static json_t *points_json(const pm_job *job)
{
    json_t *array = json_array();
    for (uint32_t i = 0; i < job->probes.count && array != NULL; i++) {
        const pm_estimate_point *point = &job->probes.points[i];
        json_t *object = point_json(job, i);
        pm_vec3 at = pm_vec_add(point->at, job->world.scene.center);
        object = pm_report_add(object, "at", pm_report_vector(at));
        object = pm_report_add(object, "normal", pm_report_vector(point->normal));
        if (object == NULL || json_array_append_new(array, object) != 0) {
            json_decref(array);
            return NULL;
        }
    }
    return array;
}

static void print_point(const pm_job *job, uint32_t i)
{
    const tally *point = &job->tallies[i];
    const double *mean = point->mean.c;
    pm_vec3 at = pm_vec_add(job->probes.points[i].at, job->world.scene.center);
    printf("%10.5g %10.5g %10.5g %12.6g %12.6g %12.6g %10.4g %8.6g\n", at.x, at.y, at.z,
           mean[0], mean[1], mean[2], point->radius / point->runs, point->found / point->runs);
    if (point->runs > 1) {
        pm_spectrum sd = deviation_of(point);
        printf("%32s %12.6g %12.6g %12.6g\n", "sd of one run", sd.c[0], sd.c[1], sd.c[2]);
    }
}

static void print_summary(const pm_job *job)
{
    pm_spectrum least = pm_gray((double)INFINITY);
    pm_spectrum sum = pm_gray(0.0);
    pm_spectrum most = pm_gray(0.0);
    for (uint32_t i = 0; i < job->probes.count; i++) {
        pm_spectrum mean = job->tallies[i].mean;
        sum = pm_spectrum_add(sum, mean);
        for (int c = 0; c < 3; c++) {
            least.c[c] = fmin(least.c[c], mean.c[c]);
            most.c[c] = fmax(most.c[c], mean.c[c]);
        }
    }
    sum = pm_spectrum_scale(sum, 1.0 / job->probes.count);
    printf("irradiance at %u points [W/m^2]\n", job->probes.count);
    printf("%-8s %12.6g %12.6g %12.6g\n", "least", least.c[0], least.c[1], least.c[2]);
    printf("%-8s %12.6g %12.6g %12.6g\n", "mean", sum.c[0], sum.c[1], sum.c[2]);
    printf("%-8s %12.6g %12.6g %12.6g\n", "most", most.c[0], most.c[1], most.c[2]);
}

static void print_results(const pm_job *job)
{
    if (job->probes.columns < job->probes.count) { // a grid
        print_summary(job);
        return;
    }
    printf("%-32s %12s %12s %12s %10s %8s\n", "point", "red [W/m^2]", "green", "blue", "radius",
           "found");
    for (uint32_t i = 0; i < job->probes.count; i++) {
        print_point(job, i);
    }
}

static void write_rows(const pm_job *job)
{
    FILE *out = job->dump.stream;
    uint32_t runs = job->options->runs;
    fputs("i,j,x,y,z,nx,ny,nz,r,g,b,radius,found\n", out);
    for (uint32_t n = 0; n < job->probes.count; n++) {
        pm_vec3 at = pm_vec_add(job->probes.points[n].at, job->world.scene.center);
        pm_vec3 normal = job->probes.points[n].normal;
        const tally *point = &job->tallies[n];
        pm_spectrum mean = point->mean;
        fprintf(out, "%u,%u,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.0f\n",
                n % job->probes.columns, n / job->probes.columns, at.x, at.y, at.z, normal.x,
                normal.y, normal.z, mean.c[0], mean.c[1], mean.c[2], point->radius / runs,
                point->found / runs);
    }
}

static pm_status report(const pm_job *job)
{
    if (!job->options->json) {
        print_results(job);
    }
    json_t *object = job->probes.count == 1
                         ? point_json(job, 0)
                         : pm_report_add(json_object(), "points", points_json(job));
    if (job->medium != NULL) {
        object = pm_report_add(object, "medium", json_string(job->medium->id));
    }
    object = pm_report_add(object, "runs", json_integer((json_int_t)job->options->runs));
    object = pm_report_add(object, "notes", pm_report_notes(&job->world.scene));
    return pm_report_end(job->options, object);
}

/// The medium that a point without a normal lies in.
static pm_status find_medium(pm_job *job)
{
    const pm_scene *scene = &job->world.scene;
    pm_vec3 at = job->options->at;
    int index = pm_inside_medium(&job->world.rays, job->probes.points[0].at);
    if (index == PM_NONE) {
        return pm_status_fail(PM_EINPUT,
                              "radiance: --at %g,%g,%g lies in no medium: on a surface it needs"
                              " --normal X,Y,Z, the side looked at",
                              at.x, at.y, at.z);
    }
    if (!(scene->media[index].sigma_t > 0.0)) {
        return pm_status_fail(PM_EINPUT,
                              "radiance: --at %g,%g,%g lies in %.60s, whose sigma_t is 0: no"
                              " photon collides there, so none tells the fluence",
                              at.x, at.y, at.z, scene->media[index].id);
    }
    job->medium = &scene->media[index];
    return PM_OK;
}

static pm_status check_gathered(const pm_options *options)
{
    if (options->gathered == NULL ||
        (options->has_at && options->has_normal && options->runs == 1)) {
        return PM_OK;
    }
    return PM_FAIL(
        PM_EINPUT, "%s",
        "radiance: --gathered shows one estimate on a surface: it goes with --at and "
        "--normal, and without --runs");
}

static pm_status run(pm_job *job)
{
    const pm_options *options = job->options;
    PM_TRY(check_gathered(options));
    PM_TRY(pm_world_open(options, false, &job->world));
    PM_TRY(pm_probes_make(program.name, options, &job->world.scene, &job->probes));
    if (job->probes.free) {
        PM_TRY(find_medium(job));
    }
    job->tallies = calloc(job->probes.count, sizeof *job->tallies);
    if (job->tallies == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %u points", job->probes.count);
    }
    if (options->dump != NULL) {
        PM_TRY(pm_file_begin(options->dump, &job->dump));
    }
    PM_TRY(estimate_runs(job));
    if (options->dump != NULL) {
        write_rows(job);
        PM_TRY(pm_file_commit(&job->dump));
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
    pm_file_abandon(&job.dump);
    free(job.tallies);
    pm_probes_free(&job.probes);
    pm_world_close(&job.world);
    return pm_program_end(status);
}
