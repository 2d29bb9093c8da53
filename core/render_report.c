// Power is shown as the mean of the three channels; the JSON has all three.
#include "render_report.h"

#include "map_power.h"
#include "photon_map.h"
#include "report.h"

#include <stdio.h>
#include <sys/resource.h>

static const char *const map_name[PM_MAP_COUNT] = {"global", "caustic", "volume"};

static json_t *real_or_none(double value)
{
    return isfinite(value) ? json_real(value) : json_string("none");
}

static json_t *estimate_settings(const pm_estimate_settings *estimate)
{
    static const char *const filters[] = {"none", "cone", "gaussian", "epanechnikov"};
    json_t *object =
        json_pack("{s:I,s:s,s:f,s:s,s:s}", "k", (json_int_t)estimate->k, "shape",
                  estimate->shape == PM_GATHER_DISC ? "disc" : "sphere", "flatness",
                  estimate->flatness, "filter", filters[estimate->filter], "kernel_constants",
                  estimate->constants == PM_CONSTANTS_UNBIASED ? "unbiased" : "lecture");
    return pm_report_add(object, "r", real_or_none(estimate->radius));
}

static json_t *settings_object(const pm_scene *scene, const pm_render_settings *settings)
{
    json_t *photons = json_object();
    for (int kind = 0; kind < PM_MAP_COUNT; kind++) {
        json_t *count = json_integer((json_int_t)settings->photons[kind]);
        photons = pm_report_add(photons, map_name[kind], count);
    }
    json_t *object =
        json_pack("{s:I,s:i,s:i,s:I,s:I,s:I,s:s,s:b}", "seed", (json_int_t)settings->seed,
                  "width", scene->camera.width, "height", scene->camera.height, "spp",
                  (json_int_t)settings->light.spp, "gather", (json_int_t)settings->light.rays,
                  "stored", (json_int_t)settings->stored, "roulette",
                  settings->roulette == PM_ROULETTE_MAX ? "max" : "average", "packing",
                  !settings->unpacked);
    object = pm_report_add(object, "photons", photons);
    return pm_report_add(object, "estimate", estimate_settings(&settings->light.estimate));
}

static json_t *maps_object(const pm_render_maps *maps)
{
    json_t *object = json_object();
    for (int kind = 0; kind < PM_MAP_COUNT; kind++) {
        if (maps->has[kind]) {
            object = pm_report_add(object, map_name[kind], pm_report_map(&maps->map[kind]));
        }
    }
    return object;
}

static json_t *flux_object(const pm_render_maps *maps)
{
    json_t *object = json_object();
    for (int kind = 0; kind < PM_MAP_COUNT; kind++) {
        if (maps->pass[kind].emitted > 0) {
            object =
                pm_report_add(object, map_name[kind], pm_report_flux(&maps->pass[kind].audit));
        }
    }
    return object;
}

static json_t *seconds_object(const pm_render_maps *maps, const pm_eye_report *eye)
{
    double trace = 0.0;
    double balance = 0.0;
    for (int kind = 0; kind < PM_MAP_COUNT; kind++) {
        trace += maps->pass[kind].seconds;
        balance += maps->balance_seconds[kind];
    }
    return json_pack("{s:f,s:f,s:f,s:f}", "photons", trace, "balance", balance, "picture",
                     eye->seconds, "total", trace + balance + eye->seconds);
}

static json_int_t peak_bytes(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return (json_int_t)usage.ru_maxrss * 1024;
}

static json_t *whole_object(const pm_scene *scene, const pm_render_settings *settings,
                            const pm_render_maps *maps, const pm_eye_report *eye)
{
    json_t *object = json_pack("{s:s}", "scene", scene->path);
    object = pm_report_add(object, "plan", pm_report_plan(&maps->plan));
    object = pm_report_add(object, "settings", settings_object(scene, settings));
    object = pm_report_add(object, "maps", maps_object(maps));
    object = pm_report_add(object, "flux", flux_object(maps));
    object = pm_report_add(object, "eye_paths_cut", json_integer((json_int_t)eye->cut));
    object =
        pm_report_add(object, "pixels_too_bright", json_integer((json_int_t)eye->too_bright));
    object = pm_report_add(object, "black", json_boolean(eye->black));
    object = pm_report_add(object, "notes", pm_report_notes(scene));
    object = pm_report_add(object, "seconds", seconds_object(maps, eye));
    return pm_report_add(object, "peak_bytes", json_integer(peak_bytes()));
}

static void row(const char *stage, const char *map, double cpu, uint64_t photons,
                pm_spectrum power_in, pm_spectrum power_out)
{
    printf("%-10s %-8s %8.2f %12llu %14.6g %14.6g\n", stage, map, cpu,
           (unsigned long long)photons, pm_spectrum_mean(power_in),
           pm_spectrum_mean(power_out));
}

static void print_map(const pm_scene *scene, const pm_render_maps *maps, int kind)
{
    const pm_pass_report *pass = &maps->pass[kind];
    const pm_photon_map *map = &maps->map[kind];
    pm_spectrum power = pm_map_power(map);
    if (pass->emitted > 0) {
        pm_spectrum flux = pm_gray(0.0);
        for (int i = 0; i < scene->light_count; i++) {
            flux = pm_spectrum_add(flux, scene->lights[i].flux);
        }
        const pm_audit *audit = &pass->audit;
        pm_spectrum ended =
            pm_spectrum_add(audit->absorbed, pm_spectrum_add(audit->escaped, audit->lost));
        row("emission", map_name[kind], pass->emit_cpu, pass->emitted, flux, audit->emitted);
        row("tracing", map_name[kind], pass->trace_cpu, pass->emitted, audit->emitted, ended);
        row("storage", map_name[kind], pass->store_cpu, map->count, pass->deposited, power);
    }
    row("balancing", map_name[kind], maps->balance_seconds[kind], map->count, power, power);
}

static void remark_on_map(const pm_render_maps *maps, int kind)
{
    const pm_photon_map *map = &maps->map[kind];
    double lost = pm_spectrum_mean(maps->pass[kind].audit.lost);
    if (map->refused > 0) {
        printf("%s map: %llu photons without a finite value were refused\n", map_name[kind],
               (unsigned long long)map->refused);
    }
    if (map->clamped > 0 || map->vanished > 0) {
        printf("%s map: %llu photons are above and %llu below the powers that can be stored\n",
               map_name[kind], (unsigned long long)map->clamped,
               (unsigned long long)map->vanished);
    }
    if (lost > 0.0) {
        printf("%s map: %g W were lost with photons cut after too many events\n",
               map_name[kind], lost);
    }
}

/// What a picture does not show, or shows wrongly: nothing of that passes in silence.
static void print_remarks(const pm_render_maps *maps, const pm_eye_report *eye)
{
    for (int kind = 0; kind < PM_MAP_COUNT; kind++) {
        remark_on_map(maps, kind);
    }
    for (pm_plan_part part = 0; part < PM_PLAN_COUNT; part++) {
        if (maps->plan.item[part].missing) {
            puts(maps->plan.item[part].left_out);
        }
    }
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

static void print_table(const pm_scene *scene, const pm_render_maps *maps,
                        const pm_eye_report *eye)
{
    printf("%-10s %-8s %8s %12s %14s %14s\n", "stage", "map", "CPU s", "photons", "power in W",
           "power out W");
    for (int kind = 0; kind < PM_MAP_COUNT; kind++) {
        if (maps->has[kind]) {
            print_map(scene, maps, kind);
        }
    }
    printf("%-10s %-8s %8.2f %12llu estimates in the global map\n", "picture", "", eye->cpu,
           (unsigned long long)eye->lookups);
    puts("Tracing's power out is what was absorbed, escaped or was cut; storage's is every "
         "deposit,");
    puts("so light that bounces counts at each meeting. Power is the mean of three channels.");
}

pm_status pm_render_report(const pm_options *options, const pm_scene *scene,
                           const pm_render_settings *settings, const pm_render_maps *maps,
                           const pm_eye_report *eye)
{
    if (!options->json) {
        print_table(scene, maps, eye);
        print_remarks(maps, eye);
    }
    PM_TRY(pm_report_end(options, whole_object(scene, settings, maps, eye)));
    for (int kind = 0; kind < PM_MAP_COUNT; kind++) {
        if (maps->pass[kind].emitted > 0) {
            PM_TRY(pm_audit_check(&maps->pass[kind].audit));
        }
    }
    return PM_OK;
}

pm_status pm_render_report_plan(const pm_options *options, const pm_plan *plan)
{
    for (pm_plan_part part = 0; part < PM_PLAN_COUNT && !options->json; part++) {
        const pm_plan_item *item = &plan->item[part];
        printf("%-10s %-3s  %s\n", pm_plan_name(part), item->needed ? "yes" : "no", item->why);
    }
    return pm_report_end(options, pm_report_add(json_object(), "plan", pm_report_plan(plan)));
}

pm_status pm_render_report_check(const pm_options *options, const pm_scene *scene)
{
    if (!options->json) {
        printf("%s: fine: %d shapes, %d materials, %d lights\n", scene->path,
               scene->shape_count, scene->material_count, scene->light_count);
    }
    for (int i = 0; i < scene->note_count && !options->json; i++) {
        puts(scene->notes[i]);
    }
    json_t *object =
        json_pack("{s:s,s:i,s:i,s:i}", "scene", scene->path, "shapes", scene->shape_count,
                  "materials", scene->material_count, "lights", scene->light_count);
    object = pm_report_add(object, "lights_emitting", pm_report_lights(scene, NULL));
    return pm_report_end(options, pm_report_add(object, "notes", pm_report_notes(scene)));
}
