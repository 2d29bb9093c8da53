// Power is shown as the mean of the three channels; the JSON has all three.
#include "render_report.h"

#include "choice.h"
#include "explain.h"
#include "map_make.h"
#include "report.h"

#include <stdio.h>

static void row(const char *stage, const char *map, double cpu, uint64_t photons,
                pm_spectrum power_in, pm_spectrum power_out)
{
    printf("%-10s %-8s %8.2f %12llu %14.6g %14.6g\n", stage, map, cpu,
           (unsigned long long)photons, pm_spectrum_mean(power_in),
           pm_spectrum_mean(power_out));
}

static void print_map(const pm_render_done *done, pm_map_kind kind)
{
    const pm_scene *scene = done->scene;
    const pm_render_maps *maps = done->maps;
    const pm_pass_report *pass = &maps->pass[kind];
    pm_map_sum map = pm_render_sum(done, kind);
    if (pass->emitted > 0) {
        pm_spectrum flux = pm_gray(0.0);
        for (int i = 0; i < scene->light_count; i++) {
            flux = pm_spectrum_add(flux, scene->lights[i].flux);
        }
        const pm_audit *audit = &pass->audit;
        pm_spectrum ended =
            pm_spectrum_add(audit->absorbed, pm_spectrum_add(audit->escaped, audit->lost));
        row("emission", pm_map_name(kind), pass->emit_cpu, pass->emitted, flux, audit->emitted);
        row("tracing", pm_map_name(kind), pass->trace_cpu, pass->emitted, audit->emitted,
            ended);
        row("storage", pm_map_name(kind), pass->store_cpu, map.stored, pass->deposited,
            map.power);
    }
    row("balancing", pm_map_name(kind), maps->balance_seconds[kind], map.stored, map.power,
        map.power);
}

/// A map with too few photons for its radius.
static void remark_on_count(const pm_render_done *done, pm_map_kind kind, uint64_t stored)
{
    uint32_t k = done->settings->light.estimate.k;
    double radius[2] = {1.0, 1.0};
    if (done->progressive != NULL) {
        pm_render_radii(done, kind, radius);
    } else if (stored < k) {
        printf("%s map: %llu photons, fewer than k = %u: each estimate takes them all, however "
               "far away; emit more\n",
               pm_map_name(kind), (unsigned long long)stored, k);
    }
    if (radius[0] == 0.0 && stored > 0) {
        printf("%s map: in no pass did two photons lie apart that count, so it has no radius; "
               "emit more, or give -r\n",
               pm_map_name(kind));
    }
}

static void remark_on_map(const pm_render_done *done, pm_map_kind kind)
{
    const pm_render_maps *maps = done->maps;
    if (!maps->has[kind]) {
        return;
    }
    pm_map_sum map = pm_render_sum(done, kind);
    remark_on_count(done, kind, map.stored);
    double lost = pm_spectrum_mean(maps->pass[kind].audit.lost);
    if (map.refused > 0) {
        printf("%s map: %llu photons without a finite value were refused\n", pm_map_name(kind),
               (unsigned long long)map.refused);
    }
    if (map.clamped > 0 || map.vanished > 0) {
        printf("%s map: %llu photons are above and %llu below the powers that can be stored\n",
               pm_map_name(kind), (unsigned long long)map.clamped,
               (unsigned long long)map.vanished);
    }
    if (lost > 0.0) {
        printf("%s map: %g W were lost with photons cut after too many events\n",
               pm_map_name(kind), lost);
    }
}

/// Paths that no map brings, and settings without effect.
static void remark_on_choices(const pm_render_settings *settings, const pm_render_maps *maps)
{
    pm_choice choices[PM_CHOICES_MAX];
    int count = pm_choice_list(settings, maps, choices);
    for (int i = 0; i < count; i++) {
        if (choices[i].missing || choices[i].idle) {
            printf("%s: %s\n", choices[i].option, choices[i].effect);
        }
    }
}

/// What a picture does not show, or shows wrongly: nothing of that passes in silence.
static void print_remarks(const pm_render_done *done)
{
    const pm_eye_report *eye = done->eye;
    for (pm_map_kind kind = 0; kind < PM_MAP_COUNT; kind++) {
        remark_on_map(done, kind);
    }
    remark_on_choices(done->settings, done->maps);
    if (eye->cut > 0) {
        printf("%llu eye paths and gather rays were cut after too many mirrors or glasses\n",
               (unsigned long long)eye->cut);
    }
    if (eye->too_bright > 0) {
        printf("%llu pixels are too bright for a float and infinite in the picture\n",
               (unsigned long long)eye->too_bright);
    }
    if (eye->black) {
        puts("the picture is black: no light comes to the camera");
    }
}

static void print_projection(const pm_render_maps *maps, pm_map_kind kind)
{
    const pm_projections *aim = &maps->aim[kind];
    if (pm_projection_of(aim) != NULL) {
        printf("%-10s %-8s %llu of %llu cells lit; %g W never sent; %llu photons saved\n",
               "projection", pm_map_name(kind), (unsigned long long)aim->active,
               (unsigned long long)aim->cells, pm_spectrum_mean(aim->dark),
               (unsigned long long)pm_projection_saved(aim, maps->pass[kind].emitted));
    }
}

static void print_eye(const pm_render_done *done)
{
    const pm_render_maps *maps = done->maps;
    const pm_eye_report *eye = done->eye;
    uint64_t places =
        done->progressive != NULL ? done->progressive->places : maps->irradiance.count;
    if (places > 0) {
        printf("%-10s %-8s %8.2f %12llu places of known irradiance (seconds on the wall)\n",
               "precompute", "", maps->irradiance_seconds, (unsigned long long)places);
    }
    printf("%-10s %-8s %8.2f %12llu estimates in the global map\n", "picture", "", eye->cpu,
           (unsigned long long)eye->lookups);
    if (maps->shadow_photons > 0) {
        double all = (double)eye->shadow_rays + (double)eye->shadow_spared;
        printf("%-10s %-8s %llu shadow rays, %llu spared (%.1f %%) by %llu shadow photons\n",
               "direct", "", (unsigned long long)eye->shadow_rays,
               (unsigned long long)eye->shadow_spared,
               all > 0.0 ? 100.0 * (double)eye->shadow_spared / all : 0.0,
               (unsigned long long)maps->shadow_photons);
    }
}

static void print_radii(const pm_render_done *done, pm_map_kind kind)
{
    if (done->progressive != NULL) {
        double radius[2];
        pm_render_radii(done, kind, radius);
        printf("%-10s %-8s radius %g m in the first pass, %g m in the last\n", "passes",
               pm_map_name(kind), radius[0], radius[1]);
    }
}

static void print_table(const pm_render_done *done)
{
    if (done->progressive != NULL) {
        printf("%u of %u passes, all of them together; power is their mean:\n",
               done->progressive->passes, done->passes);
    }
    printf("%-10s %-8s %8s %12s %14s %14s\n", "stage", "map", "CPU s", "photons", "power in W",
           "power out W");
    for (pm_map_kind kind = 0; kind < PM_MAP_COUNT; kind++) {
        if (done->maps->has[kind]) {
            print_map(done, kind);
            print_projection(done->maps, kind);
            print_radii(done, kind);
        }
    }
    print_eye(done);
    puts("Tracing's power out is what was absorbed, escaped or was cut; storage's is every "
         "deposit,");
    puts("so light that bounces counts at each meeting. Power is the mean of three channels.");
}

pm_status pm_render_report(const pm_options *options, const pm_render_done *done)
{
    if (!options->json) {
        print_table(done);
        print_remarks(done);
    }
    PM_TRY(pm_report_end(options, pm_render_json(done)));
    for (pm_map_kind kind = 0; kind < PM_MAP_COUNT; kind++) {
        if (done->maps->pass[kind].emitted > 0) {
            PM_TRY(pm_audit_check(&done->maps->pass[kind].audit));
        }
    }
    return PM_OK;
}

pm_status pm_render_report_plan(const pm_options *options, const pm_render_settings *settings,
                                const pm_render_maps *maps)
{
    if (!options->json) {
        pm_explain_print(settings, maps, stdout);
    }
    return pm_report_end(options, pm_explain_json(settings, maps));
}

static const char *plural(int count)
{
    return count == 1 ? "" : "s";
}

pm_status pm_render_report_check(const pm_options *options, const pm_scene *scene)
{
    if (!options->json) {
        printf("%s: fine: %d shape%s, %d material%s, %d light%s", scene->path,
               scene->shape_count, plural(scene->shape_count), scene->material_count,
               plural(scene->material_count), scene->light_count, plural(scene->light_count));
        if (scene->medium_count > 0) {
            printf(", %d %s", scene->medium_count,
                   scene->medium_count == 1 ? "medium" : "media");
        }
        puts("");
    }
    for (int i = 0; i < scene->note_count && !options->json; i++) {
        puts(scene->notes[i]);
    }
    json_t *object = json_pack("{s:s,s:i,s:i,s:i,s:i}", "scene", scene->path, "shapes",
                               scene->shape_count, "materials", scene->material_count, "lights",
                               scene->light_count, "media", scene->medium_count);
    object = pm_report_add(object, "lights_emitting", pm_report_lights(scene, NULL));
    return pm_report_end(options, pm_report_add(object, "notes", pm_report_notes(scene)));
}
