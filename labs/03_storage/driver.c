// storage: photons are packed into maps; what packing costs is measured, and the maps are
// written as files or such a file is checked.
#include "map_make.h"
#include "map_power.h"
#include "packing_loss.h"
#include "photon_dump.h"
#include "photon_file.h"
#include "photon_map.h"
#include "plan.h"
#include "program.h"
#include "report.h"
#include "store.h"
#include "world.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const pm_options_program program = {
    .name = "storage",
    .does = "Stores photons of a scene and measures what packing them into 20 bytes costs; or "
            "checks a photon file.",
    .positional = "SCENE",
    .positional_least = 1,
    .positional_most = 1,
    .options =
        "n global-photons caustic-photons volume-photons projection roulette max-bounces "
        "packing o dump check-file report",
    .notes = "-o FILE.ply writes the global map; a caustic and a volume map, where the scene\n"
             "needs them, go beside it as FILE.caustic.ply and FILE.volume.ply. Their x y z\n"
             "are the scene's less the centre that a comment in their header names; --dump\n"
             "writes the scene's own.\n"
             "--dump writes the photons as x,y,z,dx,dy,dz,r,g,b,map,path,bounce,light; path\n"
             "spells the events from the light to the deposit (L, S specular, D diffuse, V in\n"
             "a medium).",
};

typedef struct {
    const pm_options *options;
    pm_world world;
    pm_photon_map map[PM_MAP_COUNT];
    pm_projections aim[PM_MAP_COUNT];
    bool has[PM_MAP_COUNT];
    pm_photon_dump dump;
    pm_packing_loss packing; // over all photons of all maps
} pm_job;

// --- making maps ----------------------------------------------------------------------------

static void drop_exact(pm_photon_map *map)
{
    free(map->exact);
    map->exact = NULL;
    map->unpacked = false;
}

static pm_status make_map(pm_job *job, pm_map_kind kind)
{
    const pm_options *options = job->options;
    pm_pass_settings settings = pm_map_settings(options, kind, 0);
    settings.unpacked = true; // to compare with
    PM_TRY(pm_map_aim(options, &job->world.scene, kind, &job->aim[kind]));
    settings.projections = pm_projection_of(&job->aim[kind]);
    if (options->dump != NULL) {
        pm_photon_dump_map(&job->dump, kind, options->unpacked, settings.count);
        settings.tap =
            (pm_trace_sink){&job->dump, pm_photon_dump_deposit, pm_photon_dump_event};
    }
    pm_photon_map *map = &job->map[kind];
    PM_TRY(pm_photon_pass(&job->world.rays, kind, &settings, map, NULL));
    job->has[kind] = true;
    pm_packing_loss_add(&job->packing, map);
    if (!options->unpacked) {
        drop_exact(map);
    }
    return PM_OK;
}

/// The global map is what this program is about; the others only where there is such light.
static pm_status make_maps(pm_job *job)
{
    pm_plan plan = pm_plan_scene(&job->world.scene);
    for (pm_map_kind kind = 0; kind < PM_MAP_COUNT; kind++) {
        bool wanted = kind == PM_MAP_GLOBAL || pm_plan_needs_map(&plan, kind);
        if (wanted && job->options->photons[kind] > 0) {
            PM_TRY(make_map(job, kind));
        }
    }
    return PM_OK;
}

// --- files ----------------------------------------------------------------------------------

/// "a/b.ply" becomes "a/b.caustic.ply".
static char *name_beside(const char *path, const char *kind)
{
    const char *slash = strrchr(path, '/');
    const char *dot = strrchr(slash != NULL ? slash : path, '.');
    size_t stem = dot != NULL ? (size_t)(dot - path) : strlen(path);
    size_t room = strlen(path) + strlen(kind) + 2;
    char *name = malloc(room);
    if (name != NULL) {
        snprintf(name, room, "%.*s.%s%s", (int)stem, path, kind, path + stem);
    }
    return name;
}

static pm_status write_map(const pm_job *job, pm_map_kind kind)
{
    const pm_scene *scene = &job->world.scene;
    pm_photon_file_info info = {job->options->seed, scene->hash, scene->center};
    const char *path = job->options->output;
    if (kind == PM_MAP_GLOBAL) {
        return pm_photon_file_write(path, &job->map[kind], &info, NULL);
    }
    char *name = name_beside(path, pm_map_name(kind));
    if (name == NULL) {
        return PM_FAIL(PM_ENOMEM, "%s", "no memory for a file name");
    }
    pm_status status = pm_photon_file_write(name, &job->map[kind], &info, NULL);
    free(name);
    return status;
}

static pm_status write_maps(const pm_job *job)
{
    for (pm_map_kind kind = 0; kind < PM_MAP_COUNT && job->options->output != NULL; kind++) {
        if (job->has[kind]) {
            PM_TRY(write_map(job, kind));
        }
    }
    return PM_OK;
}

// --- reporting ------------------------------------------------------------------------------

static int bytes_per_photon(const pm_job *job)
{
    bool exact = job->options->unpacked;
    return (int)(sizeof(pm_photon) + (exact ? sizeof(pm_photon_exact) : 0));
}

static void print_table(const pm_job *job)
{
    printf("%-8s %12s %12s %12s %12s %12s\n", "map", "emitted", "stored", "red [W]",
           "green [W]", "blue [W]");
    for (pm_map_kind kind = 0; kind < PM_MAP_COUNT; kind++) {
        const pm_photon_map *map = &job->map[kind];
        pm_spectrum power = pm_map_power(map);
        if (job->has[kind]) {
            printf("%-8s %12llu %12u %12.6g %12.6g %12.6g\n", pm_map_name(kind),
                   (unsigned long long)map->emitted, map->count, power.c[0], power.c[1],
                   power.c[2]);
        }
    }
    const pm_packing_loss *loss = &job->packing;
    pm_spectrum bias = pm_packing_loss_bias(loss);
    printf("%d bytes a photon\n", bytes_per_photon(job));
    printf("packing: power off by %+.3g %+.3g %+.3g in the mean, by %.3g rms;"
           " direction by %.3f degrees in the mean, %.3f at most\n",
           bias.c[0], bias.c[1], bias.c[2], pm_packing_loss_rms(loss),
           pm_packing_loss_mean_degrees(loss), pm_packing_loss_max_degrees(loss));
}

static json_t *maps_json(const pm_job *job)
{
    json_t *maps = json_object();
    for (pm_map_kind kind = 0; kind < PM_MAP_COUNT; kind++) {
        const pm_photon_map *map = &job->map[kind];
        json_t *entry = pm_report_map(map);
        if (job->has[kind]) {
            entry = pm_report_add(entry, "projection",
                                  pm_report_projection(&job->aim[kind], map->emitted));
        }
        maps = pm_report_add(maps, pm_map_name(kind), entry);
    }
    return maps;
}

static pm_status report(const pm_job *job)
{
    if (!job->options->json) {
        print_table(job);
    }
    json_t *object = json_pack("{s:i}", "bytes_per_photon", bytes_per_photon(job));
    object = pm_report_add(object, "maps", maps_json(job));
    object = pm_report_add(object, "packing", pm_packing_loss_json(&job->packing));
    object = pm_report_add(object, "notes", pm_report_notes(&job->world.scene));
    return pm_report_end(job->options, object);
}

// --- the two jobs ---------------------------------------------------------------------------

static pm_status check_file(pm_job *job)
{
    const char *path = job->options->check_file;
    pm_photon_file_info info;
    pm_photon_map map;
    PM_TRY(pm_photon_file_read(path, &map, &info, NULL));
    job->map[map.kind] = map;
    int each = (int)(sizeof(pm_photon) + (map.unpacked ? sizeof(pm_photon_exact) : 0));
    if (!job->options->json) {
        printf("%s: good: %u photons of the %s map, %llu emitted, seed %u, %s\n", path,
               map.count, pm_map_name(map.kind), (unsigned long long)map.emitted, info.seed,
               map.balanced ? "balanced" : "not balanced");
    }
    json_t *maps = pm_report_add(json_object(), pm_map_name(map.kind), pm_report_map(&map));
    json_t *object =
        json_pack("{s:s,s:i,s:b,s:I,s:o}", "file", path, "bytes_per_photon", each, "balanced",
                  (int)map.balanced, "seed", (json_int_t)info.seed, "maps", maps);
    return pm_report_end(job->options, object);
}

static pm_status store_scene(pm_job *job)
{
    const pm_options *options = job->options;
    PM_TRY(pm_world_open(options, false, &job->world));
    if (options->dump != NULL) {
        PM_TRY(pm_photon_dump_begin(options->dump, &job->world.scene, &job->dump));
    }
    PM_TRY(make_maps(job));
    PM_TRY(write_maps(job));
    if (options->dump != NULL) {
        PM_TRY(pm_photon_dump_commit(&job->dump));
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
    pm_status status = options.check_file != NULL ? check_file(&job) : store_scene(&job);
    pm_photon_dump_free(&job.dump);
    for (pm_map_kind kind = 0; kind < PM_MAP_COUNT; kind++) {
        pm_photon_map_free(&job.map[kind]);
        pm_projection_free(&job.aim[kind]);
    }
    pm_world_close(&job.world);
    return pm_program_end(status);
}
