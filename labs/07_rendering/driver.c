// render: a scene file in, a picture with its layers out.
#include "exr.h"
#include "photon_file.h"
#include "photon_map.h"
#include "png.h"
#include "program.h"
#include "render_passes.h"
#include "render_report.h"
#include "world.h"

#include <stdio.h>
#include <string.h>

static const pm_options_program program = {
    .name = "render",
    .does = "Renders a scene by photon mapping: direct light, mirrors and glass, caustics, and"
            " indirect light, each in a layer of its own.",
    .positional = "SCENE",
    .positional_least = 1,
    .positional_most = 1,
    .options =
        "o png exposure size spp photons n global-photons caustic-photons volume-photons gather"
        " k r shape flatness filter kernel-constants direct caustics media march-step "
        "precompute"
        " projection progressive passes checkpoint resume preset packing roulette max-bounces"
        " view only map explain check report",
    .notes =
        "-o or --png must be given. -o writes an EXR file with the layers direct, specular,\n"
        "caustic, indirect, volume and emission, which add up to R G B, and depth, normal,\n"
        "gather and mask.emitter. --map takes what storage -o wrote of the same scene.\n"
        "--progressive writes its pictures and the checkpoint again every few seconds, each "
        "of\n"
        "whole passes; SIGINT (Ctrl-C) ends with the picture of the passes that are done.",
};

/// What stays open while the program works.
typedef struct {
    const pm_options *options;
    pm_world world;
    pm_render_settings settings;
    pm_render_maps maps;
    pm_progressive progressive;
    pm_image image;
    pm_eye_report eye;
} pm_job;

static pm_render_settings settings_of(const pm_options *options)
{
    pm_render_settings settings = pm_render_defaults();
    settings.seed = options->seed;
    memcpy(settings.photons, options->photons, sizeof settings.photons);
    settings.total = options->photons_total;
    settings.stored = options->stored;
    settings.roulette = options->roulette;
    settings.max_bounces = options->max_bounces;
    settings.unpacked = options->unpacked;
    settings.light.estimate = options->estimate;
    bool quick = options->progressive; // a pass is one of many
    settings.light.rays = quick && !options->gather_given ? 0 : options->gather;
    settings.light.spp = quick && !options->spp_given ? 1 : options->spp;
    settings.light.media = options->media_march ? PM_MEDIA_MARCH : PM_MEDIA_BEAMS;
    settings.light.step = options->march_step;
    settings.light.caustics_global = options->caustics_global;
    settings.only = options->only;
    settings.view_photons = options->view_photons;
    settings.everywhere = options->everywhere;
    settings.direct_photons = options->direct_photons;
    settings.precompute = options->precompute;
    return settings;
}

/// Takes one stored map in place of tracing it.
static pm_status load_map(pm_job *job, const char *path)
{
    pm_photon_map map;
    pm_photon_file_info info;
    PM_TRY(pm_photon_file_read(path, &map, &info, NULL));
    pm_status status = PM_OK;
    if (info.scene_hash != job->world.scene.hash) {
        status = pm_status_fail(PM_EINPUT, "%s: was traced in another scene than %s", path,
                                job->world.scene.path);
    } else if (job->maps.has[map.kind]) {
        status = pm_status_fail(PM_EINPUT, "%s: a map of this kind was given already", path);
    }
    if (status != PM_OK) {
        pm_photon_map_free(&map);
        return status;
    }
    job->maps.map[map.kind] = map;
    job->maps.has[map.kind] = true;
    return PM_OK;
}

static pm_status make_picture(pm_job *job)
{
    const pm_options *options = job->options;
    PM_TRY(pm_render_make_maps(&job->world.rays, &job->settings, &job->maps));
    PM_TRY(
        pm_render_image(&job->world.rays, &job->settings, &job->maps, &job->image, &job->eye));
    if (options->output != NULL) {
        PM_TRY(pm_exr_write(options->output, &job->image));
    }
    if (options->png != NULL) {
        PM_TRY(pm_png_write(options->png, &job->image, options->exposure));
    }
    return PM_OK;
}

static pm_status report(pm_job *job)
{
    pm_render_done done = {
        .scene = &job->world.scene,
        .settings = &job->settings,
        .maps = &job->maps,
        .eye = &job->eye,
        .progressive = job->options->progressive ? &job->progressive : NULL,
        .passes = job->options->passes,
    };
    return pm_render_report(job->options, &done);
}

/// The mean of many pictures. Stopped on the way, it reports what there is.
static pm_status make_passes(pm_job *job)
{
    pm_status made = pm_render_passes(&job->world.rays, job->options, &job->settings,
                                      &job->progressive, &job->image, &job->eye);
    bool stopped = made == PM_ESTOPPED && job->progressive.passes > 0;
    if (made != PM_OK && !stopped) {
        return made;
    }
    PM_TRY(
        pm_progressive_books(&job->world.scene, &job->settings, &job->progressive, &job->maps));
    PM_TRY(report(job));
    return made;
}

static pm_status explain(pm_job *job)
{
    const pm_scene *scene = &job->world.scene;
    PM_TRY(pm_render_plan(scene, &job->settings, &job->maps));
    return pm_render_report_plan(job->options, &job->settings, &job->maps);
}

static pm_status run(pm_job *job)
{
    const pm_options *options = job->options;
    PM_TRY(pm_world_open(options, true, &job->world));
    job->settings = settings_of(options);
    if (options->check_scene) {
        return pm_render_report_check(options, &job->world.scene);
    }
    for (int i = 0; i < options->map_count; i++) {
        PM_TRY(load_map(job, options->map[i]));
    }
    if (options->explain) {
        return explain(job);
    }
    if (options->output == NULL && options->png == NULL) {
        return pm_status_fail(
            PM_EINPUT, "render: say where the picture goes: -o FILE.exr or --png FILE.png");
    }
    if (options->progressive) {
        return make_passes(job);
    }
    PM_TRY(make_picture(job));
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
    pm_image_free(&job.image);
    pm_render_maps_free(&job.maps);
    pm_progressive_free(&job.progressive);
    pm_world_close(&job.world);
    return pm_program_end(status);
}
