// emission: photons leave the lights, and nothing more.
#include "emit_dump.h"
#include "file.h"
#include "interrupt.h"
#include "map_make.h"
#include "program.h"
#include "report.h"
#include "world.h"

#include <stdio.h>
#include <stdlib.h>

#define BATCH 1024u

static const pm_options_program program = {
    .name = "emission",
    .does = "Emits photons from the lights of a scene and says how many came from where.",
    .positional = "SCENE",
    .positional_least = 1,
    .positional_most = 1,
    .options = "n projection dump cells report",
    .notes = "Photons are sent where the global map wants them, or everywhere.\n"
             "--dump writes the rays as " PM_RAY_HEADER "; r,g,b is the power\n"
             "[W]. --cells writes where lights are aimed, for the global and the caustic map, "
             "as\n" PM_CELL_HEADER ".",
};

/// What was emitted.
typedef struct {
    const pm_options *options;
    pm_world world;
    uint64_t count;
    uint64_t *share;
    pm_projections aim;
    pm_spectrum power; // [W]
    pm_file dump, cells;
} pm_job;

/// The photons that the lights send: none where no light sends any power.
static uint64_t shared_out(const pm_job *job)
{
    uint64_t sum = 0;
    for (int i = 0; i < job->world.scene.light_count; i++) {
        sum += job->share[i];
    }
    return sum;
}

static pm_status emit_all(pm_job *job)
{
    pm_emission emission = {
        .scene = &job->world.scene,
        .source = {job->options->seed, PM_STREAM_GLOBAL, 0},
        .count = job->count,
        .share = job->share,
        .projections = pm_projection_of(&job->aim),
    };
    pm_start starts[BATCH];
    uint64_t count = shared_out(job);
    for (uint64_t first = 0; first < count; first += BATCH) {
        uint64_t left = count - first;
        uint32_t batch = left < BATCH ? (uint32_t)left : BATCH;
        PM_TRY(pm_emit_photons(&emission, first, batch, starts));
        for (uint32_t i = 0; i < batch; i++) {
            job->power = pm_spectrum_add(job->power, starts[i].power);
            if (job->dump.stream != NULL) {
                pm_emit_dump_ray(job->dump.stream, &job->world.scene, &starts[i], job->count);
            }
        }
        PM_TRY(pm_interrupt_check());
    }
    job->power = pm_spectrum_scale(job->power, 1.0 / (double)job->count);
    return PM_OK;
}

/// The cells of the caustic map are written, too: there aiming pays most.
static pm_status write_cells(pm_job *job)
{
    pm_projections caustic;
    PM_TRY(pm_map_aim(job->options, &job->world.scene, PM_MAP_CAUSTIC, &caustic));
    pm_status status = pm_file_begin(job->options->cells, &job->cells);
    if (status == PM_OK) {
        FILE *to = job->cells.stream;
        fputs(PM_CELL_HEADER "\n", to);
        pm_emit_dump_cells(to, &job->world.scene, pm_map_name(PM_MAP_GLOBAL), &job->aim);
        pm_emit_dump_cells(to, &job->world.scene, pm_map_name(PM_MAP_CAUSTIC), &caustic);
        status = pm_file_commit(&job->cells);
    }
    pm_projection_free(&caustic);
    return status;
}

static pm_status report(const pm_job *job)
{
    const pm_scene *scene = &job->world.scene;
    for (int i = 0; i < scene->light_count && !job->options->json; i++) {
        const pm_light *light = &scene->lights[i];
        printf("%-20s %12llu photons %14.6g W\n", light->id, (unsigned long long)job->share[i],
               pm_spectrum_mean(light->flux));
    }
    if (shared_out(job) == 0 && !job->options->json) {
        printf("%s: no light sends any power: nothing is emitted\n", scene->path);
    }
    if (job->aim.cells > 0 && !job->options->json) {
        printf("%s: %llu of %llu cells are lit, which saves %llu photons\n", job->aim.why,
               (unsigned long long)job->aim.active, (unsigned long long)job->aim.cells,
               (unsigned long long)pm_projection_saved(&job->aim, shared_out(job)));
    }
    json_t *object =
        pm_report_add(json_object(), "lights", pm_report_lights(scene, job->share));
    object = pm_report_add(object, "power_sum", pm_report_spectrum(job->power));
    object =
        pm_report_add(object, "projection", pm_report_projection(&job->aim, shared_out(job)));
    return pm_report_end(job->options, object);
}

static pm_status run(pm_job *job)
{
    const pm_options *options = job->options;
    PM_TRY(pm_world_open(options, false, &job->world));
    job->count = options->photons[PM_MAP_GLOBAL];
    job->share = calloc((size_t)job->world.scene.light_count, sizeof *job->share);
    if (job->share == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for the lights");
    }
    PM_TRY(pm_map_aim(options, &job->world.scene, PM_MAP_GLOBAL, &job->aim));
    PM_TRY(
        pm_emit_share(&job->world.scene, pm_projection_of(&job->aim), job->count, job->share));
    if (options->dump != NULL) {
        PM_TRY(pm_file_begin(options->dump, &job->dump));
        fputs(PM_RAY_HEADER "\n", job->dump.stream);
    }
    PM_TRY(emit_all(job));
    if (options->dump != NULL) {
        PM_TRY(pm_file_commit(&job->dump));
    }
    if (options->cells != NULL) {
        PM_TRY(write_cells(job));
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
    pm_file_abandon(&job.cells);
    free(job.share);
    pm_projection_free(&job.aim);
    pm_world_close(&job.world);
    return pm_program_end(status);
}
