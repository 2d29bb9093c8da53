// One function a setting; each adds a line, or none.
#include "choice.h"

#include "irradiance.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/// What is said, and about what.
typedef struct {
    const pm_render_settings *settings;
    const pm_render_maps *maps;
    pm_choice *list;
    int count;
} pm_talk;

#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
static pm_choice *
say(pm_talk *talk, const char *option, const char *format, ...)
{
    pm_choice *choice = &talk->list[talk->count++];
    *choice = (pm_choice){0};
    snprintf(choice->option, sizeof choice->option, "%s", option);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(choice->effect, sizeof choice->effect, format, arguments);
    va_end(arguments);
    return choice;
}

static void say_idle(pm_talk *talk, const char *option, const char *why)
{
    say(talk, option, "it has nothing to do: %s", why)->idle = true;
}

/// Whether light of a part is in this picture.
static bool shown(const pm_talk *talk, pm_plan_part part, pm_layer layer)
{
    const pm_plan_item *item = &talk->maps->plan.item[part];
    return item->needed && !item->missing && pm_render_shows(talk->settings, layer);
}

static void add_word(char *text, size_t room, const char *word)
{
    size_t used = strlen(text);
    snprintf(text + used, room - used, "%s%s", used > 0 ? ", " : "", word);
}

/// A layer alone: the classes of all others are gone, unless mirrors show them.
static void tell_only(pm_talk *talk)
{
    static const pm_layer layer[] = {PM_LAYER_DIRECT, PM_LAYER_SPECULAR, PM_LAYER_CAUSTIC,
                                     PM_LAYER_INDIRECT, PM_LAYER_VOLUME};
    int only = talk->settings->only;
    if (only == PM_NONE) {
        return;
    }
    char gone[128] = "";
    if (only != PM_LAYER_EMISSION) {
        add_word(gone, sizeof gone, "L");
    }
    for (pm_plan_part part = PM_PLAN_DIRECT; part <= PM_PLAN_VOLUME; part++) {
        if (talk->maps->plan.item[part].needed && only != (int)layer[part]) {
            add_word(gone, sizeof gone, pm_plan_paths(&talk->maps->plan, part));
        }
    }
    char option[32];
    snprintf(option, sizeof option, "--only %s", pm_layer_name((pm_layer)only));
    say(talk, option, "paths %s are left out", gone)->missing = gone[0] != '\0';
}

/// The option by which the map of a part was switched off.
static const char *map_option(const pm_talk *talk, pm_plan_part part)
{
    if (part == PM_PLAN_VOLUME) {
        return "--volume-photons 0";
    }
    bool own = part == PM_PLAN_CAUSTIC && !talk->settings->light.caustics_global;
    return own ? "--caustic-photons 0" : "--global-photons 0";
}

static void tell_missing_maps(pm_talk *talk)
{
    for (pm_plan_part part = PM_PLAN_DIRECT; part < PM_PLAN_COUNT; part++) {
        const pm_plan_item *item = &talk->maps->plan.item[part];
        if (item->missing) {
            say(talk, map_option(talk, part), "%s", item->left_out)->missing = true;
        }
    }
}

static void tell_cap(pm_talk *talk)
{
    uint32_t most = talk->settings->max_bounces;
    if (most == 0) {
        return;
    }
    char option[32];
    snprintf(option, sizeof option, "--max-bounces %u", most);
    say(talk, option,
        "photons, and eye paths in mirrors and glass, end after %u events: paths with longer "
        "parts are left out; the power of cut photons counts as lost",
        most)
        ->missing = true;
}

static void tell_gather(pm_talk *talk)
{
    if (talk->settings->light.rays == 0 && shown(talk, PM_PLAN_INDIRECT, PM_LAYER_INDIRECT)) {
        say(talk, "--gather 0",
            "no path is left out; the global map is seen directly, so indirect light, paths "
            "%s, is as blurred and as blotched as its estimates",
            pm_plan_paths(&talk->maps->plan, PM_PLAN_INDIRECT));
    }
}

/// Media are asked by beams unless told otherwise.
static void tell_media(pm_talk *talk)
{
    const pm_gather_settings *light = &talk->settings->light;
    const pm_render_maps *maps = talk->maps;
    bool map = maps->has[PM_MAP_VOLUME] || maps->photons[PM_MAP_VOLUME] > 0;
    bool march = light->media == PM_MEDIA_MARCH;
    if (march && !map) {
        say_idle(talk, "--media march", "no volume map is traced");
    } else if (march) {
        say(talk, "--media march",
            "no path is left out; paths L{S|D|V}+V come from estimates at steps along each "
            "ray, "
            "which are many for what one beam does");
    }
    if (light->step > 0.0 && !(march && map)) {
        say_idle(talk, "--march-step", "no ray marches through a volume map");
    }
}

static void tell_caustics(pm_talk *talk)
{
    if (!talk->settings->light.caustics_global) {
        return;
    }
    if (!talk->maps->plan.item[PM_PLAN_CAUSTIC].needed) {
        say_idle(talk, "--caustics global", "the scene has no caustics");
    } else if (shown(talk, PM_PLAN_CAUSTIC, PM_LAYER_CAUSTIC)) {
        say(talk, "--caustics global",
            "no path is left out; paths LS+D come from those photons of the global map that "
            "are marked as caustic, which are few, so caustics are blurred more");
    }
}

static void tell_direct(pm_talk *talk)
{
    if (!talk->settings->direct_photons) {
        return;
    }
    if (talk->maps->shadow_photons == 0) {
        say_idle(talk, "--direct photons", "no direct light is shown");
        return;
    }
    say(talk, "--direct photons",
        "no path is left out; where %llu shadow photons, sent besides, agree that a light is "
        "seen or hidden no shadow ray is shot, so that of paths LD a shadow thinner than their "
        "spacing can be lost",
        (unsigned long long)talk->maps->shadow_photons);
}

static void tell_precompute(pm_talk *talk)
{
    if (!talk->settings->precompute) {
        return;
    }
    if (!pm_render_precomputes(talk->settings, talk->maps)) {
        say_idle(talk, "--precompute on", "no gather ray looks at a global map");
        return;
    }
    say(talk, "--precompute on",
        "no path is left out; gather rays take the irradiance of the nearest of every %dth "
        "photon of the global map in place of an estimate of their own",
        PM_IRRADIANCE_SPACING);
}

static void tell_projection(pm_talk *talk)
{
    if (!talk->settings->everywhere) {
        return;
    }
    if (!talk->maps->plan.item[PM_PLAN_PROJECTION].needed) {
        say_idle(talk, "--projection off", "no map's photons would be aimed");
        return;
    }
    say(talk, "--projection off",
        "no path is left out; photons are also sent where their map has no use for them");
}

static void tell_view(pm_talk *talk)
{
    if (talk->settings->view_photons) {
        say(talk, "--view photons",
            "photons are drawn as dots in place of the light that they would make");
    }
}

int pm_choice_list(const pm_render_settings *settings, const pm_render_maps *maps,
                   pm_choice choices[PM_CHOICES_MAX])
{
    pm_talk talk = {.settings = settings, .maps = maps, .list = choices};
    tell_only(&talk);
    tell_missing_maps(&talk);
    tell_cap(&talk);
    tell_gather(&talk);
    tell_media(&talk);
    tell_caustics(&talk);
    tell_direct(&talk);
    tell_precompute(&talk);
    tell_projection(&talk);
    tell_view(&talk);
    return talk.count;
}
