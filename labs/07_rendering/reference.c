// reference: a scene file in, the picture that others are judged by out, with its layers and
// two independent halves.
#include "reference.h"
#include "exr.h"
#include "png.h"
#include "program.h"
#include "report.h"
#include "world.h"

#include <stdio.h>

static const pm_options_program program = {
    .name = "reference",
    .does = "Renders a scene by unbiased path tracing, for other pictures to be compared with.",
    .positional = "SCENE",
    .positional_least = 1,
    .positional_most = 1,
    .options = "o png exposure spp size roulette max-bounces light-paths report",
    .needs = "o spp",
    .notes =
        "-o writes an EXR file with the layers of render, and with half1 and half2: the "
        "picture\n"
        "and its layers from each half of the samples alone, so that compare can tell this\n"
        "picture's own noise. --spp must be even. Paths from the eye do not find light of\n"
        "point, spot and directional lights that meets smooth glass or a mirror first;\n"
        "--light-paths traces it from the lights to the camera, in media too. Depth, normals\n"
        "and the mask of emitters are those of the surfaces behind a medium.",
};

static json_t *settings_object(const pm_scene *scene, const pm_reference_settings *settings)
{
    return json_pack(
        "{s:I,s:i,s:i,s:I,s:s,s:I,s:I}", "seed", (json_int_t)settings->seed, "width",
        scene->camera.width, "height", scene->camera.height, "spp", (json_int_t)settings->spp,
        "roulette", settings->roulette == PM_ROULETTE_MAX ? "max" : "average", "max_bounces",
        (json_int_t)settings->max_bounces, "light_paths", (json_int_t)settings->light_paths);
}

static json_t *whole_object(const pm_scene *scene, const pm_reference_settings *settings,
                            const pm_reference_report *report)
{
    json_t *error = isfinite(report->rel_error) ? json_real(report->rel_error) : json_null();
    json_t *object =
        json_pack("{s:s,s:I,s:f,s:o,s:s,s:I,s:I,s:I,s:b}", "scene", scene->path, "spp",
                  (json_int_t)settings->spp, "seconds", report->seconds, "rel_error", error,
                  "blind", report->blind, "cut", (json_int_t)report->cut, "light_paths",
                  (json_int_t)report->light_paths, "pixels_too_bright",
                  (json_int_t)report->too_bright, "black", report->black);
    object = pm_report_add(object, "settings", settings_object(scene, settings));
    return pm_report_add(object, "notes", pm_report_notes(scene));
}

static void print(const pm_reference_settings *settings, const pm_reference_report *report)
{
    printf("%u samples a pixel, %llu light paths: %.2f s, rel_rmse about %.3g\n", settings->spp,
           (unsigned long long)report->light_paths, report->seconds, report->rel_error);
    if (report->blind[0] != '\0') {
        puts(report->blind);
    }
    if (settings->light_paths > 0 && report->light_paths == 0) {
        puts("no light paths were traced: paths from the eye find all light of this scene");
    }
    if (report->cut > 0) {
        printf("%llu paths were cut after too many events\n", (unsigned long long)report->cut);
    }
    if (report->too_bright > 0) {
        printf("%llu pixels are too bright for a float and infinite in the picture\n",
               (unsigned long long)report->too_bright);
    }
    if (report->black) {
        puts("the picture is black: no light comes to the camera");
    }
}

static pm_status make(const pm_options *options, const pm_world *world, pm_image *image)
{
    pm_reference_settings settings = pm_reference_defaults();
    settings.seed = options->seed;
    settings.spp = options->spp;
    settings.max_bounces = options->max_bounces;
    settings.roulette = options->roulette;
    settings.light_paths = options->light_paths;
    pm_reference_report report;
    PM_TRY(pm_reference_image(&world->rays, &settings, image, &report));
    PM_TRY(pm_exr_write(options->output, image));
    if (options->png != NULL) {
        PM_TRY(pm_png_write(options->png, image, options->exposure));
    }
    if (!options->json) {
        print(&settings, &report);
    }
    return pm_report_end(options, whole_object(&world->scene, &settings, &report));
}

int main(int argc, char **argv)
{
    pm_options options;
    int code;
    if (!pm_program_start(argc, argv, &program, &options, &code)) {
        return code;
    }
    pm_world world = {0};
    pm_image image = {0};
    pm_status status = pm_world_open(&options, true, &world);
    if (status == PM_OK) {
        status = make(&options, &world, &image);
    }
    pm_image_free(&image);
    pm_world_close(&world);
    return pm_program_end(status);
}
