// tracing: photons travel until they are absorbed, escape or are cut, and the books are kept.
#include "path_dump.h"
#include "photon_map.h"
#include "photon_pass.h"
#include "program.h"
#include "report.h"
#include "world.h"

#include <stdio.h>
#include <stdlib.h>

static const pm_options_program program = {
    .name = "tracing",
    .does = "Emits and traces photons through a scene and keeps the books of their power.",
    .positional = "SCENE",
    .positional_least = 1,
    .positional_most = 1,
    .options = "n photon roulette max-bounces dump report",
    .notes =
        "--dump writes every vertex of every path as photon,step,event,x,y,z,r,g,b; events are"
        " L light, S specular, D diffuse, A absorbed, E escaped, C cut; r,g,b is the power [W]"
        " that goes on.",
};

typedef struct {
    const pm_options *options;
    pm_world world;
    pm_pass_settings settings;
    pm_photon_map map;
    pm_pass_report pass;
    pm_path_dump dump;
} pm_job;

// --- one photon, event by event
// ------------------------------------------------------------------

static void print_event(void *context, const pm_start *start, const pm_event *event)
{
    const pm_job *job = context;
    const pm_scene *scene = &job->world.scene;
    const char *shape = event->hit == NULL ? "-" : scene->shapes[event->hit->shape].id;
    static const char *const kinds[] = {"", "", "escapes", "is cut", "is done"};
    const char *what = event->kind > PM_EVENT_MEDIUM ? kinds[event->kind]
                       : event->scatter == 'S'       ? "turns (specular)"
                       : event->scatter == 'D'       ? "turns (diffuse)"
                                                     : "is absorbed";
    pm_vec3 at = pm_vec_add(event->position, scene->center);
    pm_spectrum watts = pm_spectrum_scale(event->arriving, 1.0 / (double)job->settings.count);
    (void)start;
    printf("%4u  %-18s %-16s at %10.6g %10.6g %10.6g  with %.6g %.6g %.6g W\n", event->bounce,
           what, shape, at.x, at.y, at.z, watts.c[0], watts.c[1], watts.c[2]);
}

static pm_status ignore_deposit(void *context, const pm_deposit *deposit)
{
    (void)context;
    (void)deposit;
    return PM_OK;
}

static pm_status replay(pm_job *job)
{
    const pm_options *options = job->options;
    if (options->photon >= job->settings.count) {
        return pm_status_fail(PM_EINPUT, "tracing: --photon must be below -n %llu, got %llu",
                              (unsigned long long)job->settings.count,
                              (unsigned long long)options->photon);
    }
    uint64_t *share = calloc((size_t)job->world.scene.light_count, sizeof *share);
    if (share == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for the lights");
    }
    pm_rng_source source = {options->seed, PM_STREAM_GLOBAL, 0};
    pm_emission emission = {&job->world.scene, source, job->settings.count, share, NULL};
    pm_tracing tracing = {
        .world = &job->world.rays,
        .source = source,
        .rule = options->roulette,
        .sink = {job, ignore_deposit, print_event},
    };
    pm_photon_pass_caps(&job->world.scene, options->max_bounces, &tracing.max_bounces,
                        &tracing.max_specular);
    pm_start start;
    pm_status status = pm_emit_share(&job->world.scene, job->settings.count, share);
    if (status == PM_OK) {
        status = pm_emit_photons(&emission, options->photon, 1, &start);
    }
    free(share);
    if (status == PM_OK) {
        printf("photon %llu leaves %s\n", (unsigned long long)options->photon,
               job->world.scene.lights[start.light].id);
        status = pm_trace_photons(&tracing, &start, 1);
    }
    return status;
}

// --- all of them
// -----------------------------------------------------------------------------------

static json_t *bounces(const pm_audit *audit)
{
    json_t *array = json_array();
    for (int i = 0; i < PM_AUDIT_BOUNCES && array != NULL; i++) {
        json_array_append_new(array, json_integer((json_int_t)audit->bounces[i]));
    }
    return array;
}

static void print_books(const pm_job *job)
{
    const pm_pass_report *pass = &job->pass;
    const pm_audit *audit = &pass->audit;
    printf("%llu photons emitted, %llu deposits, %.4f a photon\n",
           (unsigned long long)pass->emitted, (unsigned long long)pass->deposits,
           (double)pass->deposits / (double)pass->emitted);
    printf("%-12s %14s %14s %14s\n", "power [W]", "red", "green", "blue");
    const struct {
        const char *name;
        const pm_spectrum *power;
    } rows[] = {{"emitted", &audit->emitted},
                {"absorbed", &audit->absorbed},
                {"escaped", &audit->escaped},
                {"lost", &audit->lost},
                {"roulette", &audit->roulette}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const double *c = rows[i].power->c;
        printf("%-12s %14.6g %14.6g %14.6g\n", rows[i].name, c[0], c[1], c[2]);
    }
}

static pm_status report(const pm_job *job)
{
    const pm_pass_report *pass = &job->pass;
    if (!job->options->json) {
        print_books(job);
    }
    double each = (double)pass->deposits / (double)pass->emitted;
    json_t *object =
        json_pack("{s:I,s:I,s:f}", "emitted", (json_int_t)pass->emitted, "deposits",
                  (json_int_t)pass->deposits, "deposits_per_photon", each);
    object = pm_report_add(object, "bounces", bounces(&pass->audit));
    object = pm_report_add(object, "flux", pm_report_flux(&pass->audit));
    object =
        pm_report_add(object, "by_shape", pm_report_by_shape(&job->world.scene, &pass->audit));
    object = pm_report_add(object, "notes", pm_report_notes(&job->world.scene));
    PM_TRY(pm_report_end(job->options, object));
    return pm_audit_check(&pass->audit);
}

static pm_status trace_all(pm_job *job)
{
    const pm_options *options = job->options;
    if (options->dump != NULL) {
        PM_TRY(pm_path_dump_begin(options->dump, &job->world.scene, job->settings.count,
                                  &job->dump));
        job->settings.tap.context = &job->dump;
        job->settings.tap.event = pm_path_dump_event;
    }
    PM_TRY(
        pm_photon_pass(&job->world.rays, PM_MAP_GLOBAL, &job->settings, &job->map, &job->pass));
    if (options->dump != NULL) {
        PM_TRY(pm_file_commit(&job->dump.file));
    }
    return report(job);
}

static pm_status run(pm_job *job)
{
    const pm_options *options = job->options;
    PM_TRY(pm_world_open(options, false, &job->world));
    job->settings = (pm_pass_settings){
        .seed = options->seed,
        .count = options->photons[PM_MAP_GLOBAL],
        .rule = options->roulette,
        .max_bounces = options->max_bounces,
    };
    return options->has_photon ? replay(job) : trace_all(job);
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
    pm_file_abandon(&job.dump.file);
    pm_photon_map_free(&job.map);
    pm_pass_report_free(&job.pass);
    pm_world_close(&job.world);
    return pm_program_end(status);
}
