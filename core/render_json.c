// One object for programs: everything that the table for people says, and more.
#include "render_json.h"

#include "caps.h"
#include "explain.h"
#include "map_make.h"
#include "report.h"

#include <sys/resource.h>

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

/// Caps in force, null for none.
static json_t *caps_object(const pm_scene *scene, uint32_t asked)
{
    pm_caps caps = pm_caps_of(scene, asked);
    json_t *bounces =
        caps.bounces == UINT32_MAX ? json_null() : json_integer((json_int_t)caps.bounces);
    json_t *object = pm_report_add(json_object(), "bounces", bounces);
    return pm_report_add(object, "specular", json_integer((json_int_t)caps.specular));
}

/// Settings by their options' words.
static json_t *chosen_words(const pm_render_settings *settings)
{
    bool all = settings->only == PM_NONE;
    return json_pack("{s:s,s:s,s:s,s:s,s:s,s:s,s:s,s:s,s:b}", "only",
                     all ? "all" : pm_layer_name((pm_layer)settings->only), "view",
                     settings->view_photons ? "photons" : "full", "direct",
                     settings->direct_photons ? "photons" : "rays", "caustics",
                     settings->light.caustics_global ? "global" : "map", "media",
                     settings->light.media == PM_MEDIA_MARCH ? "march" : "beams", "precompute",
                     settings->precompute ? "on" : "off", "projection",
                     settings->everywhere ? "off" : "on", "roulette",
                     settings->roulette == PM_ROULETTE_MAX ? "max" : "average", "packing",
                     !settings->unpacked);
}

static json_t *settings_object(const pm_render_done *done)
{
    const pm_scene *scene = done->scene;
    const pm_render_settings *settings = done->settings;
    json_t *object =
        json_pack("{s:I,s:i,s:i,s:I,s:I,s:I,s:I,s:I,s:I}", "seed", (json_int_t)settings->seed,
                  "width", scene->camera.width, "height", scene->camera.height, "spp",
                  (json_int_t)settings->light.spp, "gather", (json_int_t)settings->light.rays,
                  "light_samples", (json_int_t)settings->light.light_samples, "photons_total",
                  (json_int_t)settings->total, "stored", (json_int_t)settings->stored,
                  "max_bounces", (json_int_t)settings->max_bounces);
    json_t *words = chosen_words(settings);
    if (object == NULL || words == NULL || json_object_update(object, words) != 0) {
        json_decref(object);
        object = NULL;
    }
    json_decref(words);
    object = pm_report_add(object, "caps", caps_object(scene, settings->max_bounces));
    if (done->progressive != NULL) {
        object = pm_report_add(object, "passes", json_integer((json_int_t)done->passes));
    }
    object = pm_report_add(object, "march_step", json_real(settings->light.step));
    object = pm_report_add(object, "photons", pm_report_photons(done->maps->photons));
    return pm_report_add(object, "estimate", estimate_settings(&settings->light.estimate));
}

pm_map_sum pm_render_sum(const pm_render_done *done, pm_map_kind kind)
{
    if (done->progressive == NULL) {
        return pm_map_sum_of(&done->maps->map[kind]);
    }
    pm_map_sum sum = done->progressive->map[kind].sum;
    sum.power = pm_spectrum_scale(sum.power, 1.0 / done->progressive->passes);
    return sum;
}

void pm_render_radii(const pm_render_done *done, pm_map_kind kind, double radius[2])
{
    int dimensions = pm_progressive_dimensions(done->settings, kind);
    radius[0] = done->progressive->map[kind].first;
    radius[1] = radius[0] * pm_progressive_radius(done->progressive->passes, dimensions);
}

static json_t *map_object(const pm_render_done *done, pm_map_kind kind)
{
    const pm_render_maps *maps = done->maps;
    pm_map_sum sum = pm_render_sum(done, kind);
    json_t *object = pm_report_map_sum(&sum);
    if (maps->pass[kind].emitted > 0) {
        json_t *aim = pm_report_projection(&maps->aim[kind], maps->pass[kind].emitted);
        object = pm_report_add(object, "projection", aim);
    }
    return object;
}

static json_t *maps_object(const pm_render_done *done)
{
    json_t *object = json_object();
    for (pm_map_kind kind = 0; kind < PM_MAP_COUNT; kind++) {
        if (done->maps->has[kind]) {
            object = pm_report_add(object, pm_map_name(kind), map_object(done, kind));
        }
    }
    return object;
}

static json_t *progressive_object(const pm_render_done *done)
{
    json_t *object = json_pack("{s:I,s:f}", "passes", (json_int_t)done->progressive->passes,
                               "alpha", PM_PROGRESSIVE_ALPHA);
    json_t *radii = json_object();
    for (pm_map_kind kind = 0; kind < PM_MAP_COUNT; kind++) {
        double radius[2];
        pm_render_radii(done, kind, radius);
        if (done->maps->has[kind]) {
            json_t *pair = json_pack("[f,f]", radius[0], radius[1]);
            radii = pm_report_add(radii, pm_map_name(kind), pair);
        }
    }
    return pm_report_add(object, "radius", radii);
}

static json_t *flux_object(const pm_render_maps *maps)
{
    json_t *object = json_object();
    for (pm_map_kind kind = 0; kind < PM_MAP_COUNT; kind++) {
        if (maps->pass[kind].emitted > 0) {
            object = pm_report_add(object, pm_map_name(kind),
                                   pm_report_flux(&maps->pass[kind].audit));
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
    double made =
        trace + balance + maps->shadow_seconds + maps->irradiance_seconds + maps->beams_seconds;
    return json_pack("{s:f,s:f,s:f,s:f,s:f,s:f,s:f}", "photons", trace, "balance", balance,
                     "shadows", maps->shadow_seconds, "irradiance", maps->irradiance_seconds,
                     "beams", maps->beams_seconds, "picture", eye->seconds, "total",
                     made + eye->seconds);
}

/// What the eye pass asked: shadow rays, the global map, places of known irradiance.
static json_t *asked_objects(json_t *object, const pm_render_done *done)
{
    const pm_render_maps *maps = done->maps;
    const pm_eye_report *eye = done->eye;
    uint64_t count =
        done->progressive != NULL ? done->progressive->places : maps->irradiance.count;
    json_t *direct = json_pack("{s:I,s:I,s:I}", "rays", (json_int_t)eye->shadow_rays, "spared",
                               (json_int_t)eye->shadow_spared, "shadow_photons",
                               (json_int_t)maps->shadow_photons);
    json_t *gather = json_pack("{s:I,s:I}", "lookups", (json_int_t)eye->lookups, "near",
                               (json_int_t)eye->near);
    json_t *places = json_pack("{s:I,s:f}", "places", (json_int_t)count, "seconds",
                               maps->irradiance_seconds);
    object = pm_report_add(object, "direct", direct);
    object = pm_report_add(object, "gather", gather);
    return pm_report_add(object, "precompute", places);
}

static json_int_t peak_bytes(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return (json_int_t)usage.ru_maxrss * 1024;
}

json_t *pm_render_json(const pm_render_done *done)
{
    const pm_render_maps *maps = done->maps;
    const pm_eye_report *eye = done->eye;
    json_t *object = json_pack("{s:s}", "scene", done->scene->path);
    object = pm_report_add(object, "plan", pm_report_plan(&maps->plan));
    object = pm_report_add(object, "settings", settings_object(done));
    if (done->progressive != NULL) {
        object = pm_report_add(object, "progressive", progressive_object(done));
    }
    object = pm_report_add(object, "maps", maps_object(done));
    object = pm_report_add(object, "flux", flux_object(maps));
    object = asked_objects(object, done);
    object = pm_report_add(object, "choices", pm_explain_choices(done->settings, maps));
    object = pm_report_add(object, "eye_paths_cut", json_integer((json_int_t)eye->cut));
    object =
        pm_report_add(object, "pixels_too_bright", json_integer((json_int_t)eye->too_bright));
    object = pm_report_add(object, "black", json_boolean(eye->black));
    object = pm_report_add(object, "notes", pm_report_notes(done->scene));
    object = pm_report_add(object, "seconds", seconds_object(maps, eye));
    return pm_report_add(object, "peak_bytes", json_integer(peak_bytes()));
}
