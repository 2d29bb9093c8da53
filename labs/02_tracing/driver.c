// tracing: photons travel until they are absorbed, escape or are cut, and the books are kept.
#include "map_make.h"
#include "path_dump.h"
#include "photon_map.h"
#include "photon_pass.h"
#include "program.h"
#include "report.h"
#include "world.h"

#include <stdio.h>

static const pm_options_program program = {
    .name = "tracing",
    .does = "Emits and traces photons through a scene and keeps the books of their power.",
    .positional = "SCENE",
    .positional_least = 1,
    .positional_most = 1,
    .options = "n projection photon roulette max-bounces dump report",
    .notes =
        "--dump writes every vertex of every path as photon,step,event,x,y,z,r,g,b; events\n"
        "are L light, D diffuse, S specular (mirrored), T transmitted (through a surface by a\n"
        "specular lobe), V in a medium, A absorbed, E escaped, C cut; r,g,b is the power [W]\n"
        "that goes on. Deposits are those of the global map.",
};

typedef struct {
    const pm_options *options;
    pm_world world;
    pm_projections aim;
    pm_pass_settings settings;
    pm_photon_map map;
    pm_pass_report pass;
    pm_path_dump dump;
} pm_job;

// --- one photon, event by event -------------------------------------------------------------

/// What --photon shows: lines for people, or a list for --json and --report.
typedef struct {
    const pm_job *job;
    json_t *events;
} pm_replay;

static const char *happened(const pm_event *event)
{
    switch (event->kind) {
    case PM_EVENT_ESCAPED:
        return "escapes";
    case PM_EVENT_CUT:
        return "is cut";
    default:
        return event->scatter == 'S'   ? "turns (specular)"
               : event->scatter == 'D' ? "turns (diffuse)"
               : event->scatter == 'V' ? "turns (medium)"
                                       : "is absorbed";
    }
}

/// The id of the shape or medium that it happened at, "-" outside.
static const char *place(const pm_scene *scene, const pm_event *event)
{
    if (event->hit != NULL) {
        return scene->shapes[event->hit->shape].id;
    }
    return event->medium != PM_NONE ? scene->media[event->medium].id : "-";
}

static void show_event(void *context, const pm_start *start, const pm_event *event)
{
    pm_replay *replay = context;
    const pm_scene *scene = &replay->job->world.scene;
    double scale = 1.0 / (double)replay->job->settings.count;
    const char *where = place(scene, event);
    pm_vec3 at = pm_vec_add(event->position, scene->center);
    pm_spectrum in = pm_spectrum_scale(event->arriving, scale);
    bool lines = !replay->job->options->json;
    if (lines && event->bounce == 0) {
        printf("photon %llu leaves %s\n", (unsigned long long)start->photon,
               scene->lights[start->light].id);
    }
    if (lines) {
        printf("%4u  %-18s %-16s at %10.6g %10.6g %10.6g  with %.6g %.6g %.6g W\n",
               event->bounce, happened(event), where, at.x, at.y, at.z, in.c[0], in.c[1],
               in.c[2]);
    }
    json_t *entry =
        json_pack("{s:i,s:s,s:s}", "bounce", (int)event->bounce, "event", happened(event),
                  event->medium == PM_NONE ? "shape" : "medium", where);
    entry = pm_report_add(entry, "position", pm_report_vector(at));
    entry = pm_report_add(entry, "arriving", pm_report_spectrum(in));
    entry = pm_report_add(entry, "carried",
                          pm_report_spectrum(pm_spectrum_scale(event->carried, scale)));
    json_array_append_new(replay->events, entry);
}

static pm_status replay(const pm_job *job)
{
    const pm_options *options = job->options;
    if (options->photon >= job->settings.count) {
        return pm_status_fail(PM_EINPUT, "tracing: --photon must be below -n %llu, got %llu",
                              (unsigned long long)job->settings.count,
                              (unsigned long long)options->photon);
    }
    pm_replay shown = {job, json_array()};
    pm_trace_sink sink = {.context = &shown, .event = show_event};
    uint32_t light;
    pm_status status = pm_photon_replay(&job->world.rays, PM_MAP_GLOBAL, &job->settings,
                                        options->photon, &sink, &light);
    if (status != PM_OK) {
        json_decref(shown.events);
        return status;
    }
    const char *id = job->world.scene.lights[light].id;
    json_t *object = json_pack("{s:I,s:s}", "photon", (json_int_t)options->photon, "light", id);
    return pm_report_end(options, pm_report_add(object, "events", shown.events));
}

// --- all of them ----------------------------------------------------------------------------

static json_t *bounces(const pm_audit *audit)
{
    json_t *array = json_array();
    for (int i = 0; i < PM_AUDIT_BOUNCES && array != NULL; i++) {
        json_array_append_new(array, json_integer((json_int_t)audit->bounces[i]));
    }
    return array;
}

static double deposits_each(const pm_pass_report *pass)
{
    return pass->emitted == 0 ? 0.0 : (double)pass->deposits / (double)pass->emitted;
}

static void print_power(const char *name, const pm_spectrum *power)
{
    printf("%-12s %14.6g %14.6g %14.6g\n", name, power->c[0], power->c[1], power->c[2]);
}

static void print_media(const pm_scene *scene, const pm_audit *audit)
{
    for (int i = 0; i < scene->medium_count; i++) {
        const pm_audit_medium *books = &audit->media[i];
        printf("%s: %llu collisions, %.4f a photon\n", scene->media[i].id,
               (unsigned long long)books->collisions,
               audit->photons == 0 ? 0.0 : (double)books->collisions / (double)audit->photons);
        print_power(" incident", &books->incident);
        print_power(" absorbed", &books->absorbed);
    }
}

static void print_books(const pm_job *job)
{
    const pm_pass_report *pass = &job->pass;
    const pm_audit *audit = &pass->audit;
    printf("%llu photons emitted, %llu deposits, %.4f a photon\n",
           (unsigned long long)pass->emitted, (unsigned long long)pass->deposits,
           deposits_each(pass));
    printf("%-12s %14s %14s %14s\n", "power [W]", "red", "green", "blue");
    const struct {
        const char *name;
        const pm_spectrum *power;
    } rows[] = {{"emitted", &audit->emitted},   {"absorbed", &audit->absorbed},
                {"escaped", &audit->escaped},   {"lost", &audit->lost},
                {"roulette", &audit->roulette}, {"never sent", &job->aim.dark}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        print_power(rows[i].name, rows[i].power);
    }
    if (!pm_spectrum_is_black(audit->dispersion_variance)) {
        print_power("dispersion", &audit->dispersion);
    }
    print_media(&job->world.scene, audit);
}

static pm_status report(const pm_job *job)
{
    const pm_pass_report *pass = &job->pass;
    if (!job->options->json) {
        print_books(job);
    }
    double each = deposits_each(pass);
    json_t *object =
        json_pack("{s:I,s:I,s:f}", "emitted", (json_int_t)pass->emitted, "deposits",
                  (json_int_t)pass->deposits, "deposits_per_photon", each);
    object = pm_report_add(object, "bounces", bounces(&pass->audit));
    object = pm_report_add(object, "flux", pm_report_flux(&pass->audit));
    object =
        pm_report_add(object, "by_shape", pm_report_by_shape(&job->world.scene, &pass->audit));
    if (job->world.scene.medium_count > 0) {
        object = pm_report_add(object, "by_medium",
                               pm_report_by_medium(&job->world.scene, &pass->audit));
    }
    object =
        pm_report_add(object, "projection", pm_report_projection(&job->aim, pass->emitted));
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
        PM_TRY(pm_path_dump_commit(&job->dump));
    }
    return report(job);
}

static pm_status run(pm_job *job)
{
    const pm_options *options = job->options;
    PM_TRY(pm_world_open(options, false, &job->world));
    PM_TRY(pm_map_aim(options, &job->world.scene, PM_MAP_GLOBAL, &job->aim));
    job->settings = pm_map_settings(options, PM_MAP_GLOBAL, 0);
    job->settings.projections = pm_projection_of(&job->aim);
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
    pm_projection_free(&job.aim);
    pm_pass_report_free(&job.pass);
    pm_world_close(&job.world);
    return pm_program_end(status);
}
