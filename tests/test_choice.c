// What is said about settings that change which light is shown, or how well, and the page that
// --explain prints of it.
#include "choice.h"

#include "explain.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"

#include <stdlib.h>
#include <string.h>

/// A room with a glass ball, or without one.
static void build(pm_scenes *s, bool ball)
{
    pm_scenes_begin(s);
    pm_scenes_room(s, 1.0, pm_scenes_diffuse(s, pm_gray(0.5)));
    if (ball) {
        pm_scenes_wear(s, pm_shapes_sphere(pm_vec(0.0, 0.0, -0.5), 0.25),
                       pm_scenes_glass(s, 1.5));
    }
    pm_scenes_point(s, pm_vec(0.0, 0.0, 0.5), pm_gray(1.0));
    pm_scenes_ready(s);
}

/// Settings changed in one way, and what must be said of it.
typedef struct {
    void (*change)(pm_render_settings *settings);
    const char *option, *effect;
    bool missing, idle;
} said;

static void no_caustic_map(pm_render_settings *settings)
{
    settings->photons[PM_MAP_CAUSTIC] = 0;
}
static void no_global_map(pm_render_settings *settings)
{
    settings->photons[PM_MAP_GLOBAL] = 0;
}
static void only_caustic(pm_render_settings *settings)
{
    settings->only = PM_LAYER_CAUSTIC;
}
static void only_emission(pm_render_settings *settings)
{
    settings->only = PM_LAYER_EMISSION;
}
static void no_gather(pm_render_settings *settings)
{
    settings->light.rays = 0;
}
static void caustics_global(pm_render_settings *settings)
{
    settings->light.caustics_global = true;
}
static void direct_photons(pm_render_settings *settings)
{
    settings->direct_photons = true;
}
static void direct_photons_of_a_caustic(pm_render_settings *settings)
{
    settings->direct_photons = true;
    settings->only = PM_LAYER_CAUSTIC;
}
static void precompute(pm_render_settings *settings)
{
    settings->precompute = true;
}
static void precompute_for_nothing(pm_render_settings *settings)
{
    settings->precompute = true;
    settings->light.rays = 0;
}
static void everywhere(pm_render_settings *settings)
{
    settings->everywhere = true;
}
static void few_bounces(pm_render_settings *settings)
{
    settings->max_bounces = 3;
}
static void dots(pm_render_settings *settings)
{
    settings->view_photons = true;
}

static const said with_ball[] = {
    {no_caustic_map, "--caustic-photons 0", "paths LS+D are missing", true, false},
    {no_global_map, "--global-photons 0", "paths L{S|D}*D{S|D}*D", true, false},
    {only_caustic, "--only caustic", "paths L, LD, L{S|D}*S, L{S|D}*D{S|D}*D are left out",
     true, false},
    {only_emission, "--only emission", "paths LD, L{S|D}*S, LS+D, L{S|D}*D{S|D}*D are left out",
     true, false},
    {no_gather, "--gather 0", "the global map is seen directly", false, false},
    {caustics_global, "--caustics global", "paths LS+D come from", false, false},
    {direct_photons, "--direct photons", "of paths LD a shadow thinner", false, false},
    {direct_photons_of_a_caustic, "--direct photons", "no direct light is shown", false, true},
    {precompute, "--precompute on", "every 4th photon", false, false},
    {precompute_for_nothing, "--precompute on", "no gather ray looks", false, true},
    {everywhere, "--projection off", "no path is left out", false, false},
    {few_bounces, "--max-bounces 3", "end after 3 events: paths with longer parts", true,
     false},
    {dots, "--view photons", "dots", false, false},
};

static const said without_ball[] = {
    {caustics_global, "--caustics global", "the scene has no caustics", false, true},
    {everywhere, "--projection off", "no map's photons would be aimed", false, true},
    {only_caustic, "--only caustic", "paths L, LD, L{S|D}*D{S|D}*D are left out", true, false},
};

static void no_volume_map(pm_render_settings *settings)
{
    settings->photons[PM_MAP_VOLUME] = 0;
}
static void march(pm_render_settings *settings)
{
    settings->light.media = PM_MEDIA_MARCH;
}
static void march_without_a_map(pm_render_settings *settings)
{
    march(settings);
    no_volume_map(settings);
}
static void steps_without_a_march(pm_render_settings *settings)
{
    settings->light.step = 0.1;
}

static const said with_fog[] = {
    {no_volume_map, "--volume-photons 0", "paths L{S|D|V}+V, all that media scatter but LV",
     true, false},
    {no_global_map, "--global-photons 0", "paths L{S|D|V}*{D|V}{S|D|V}*D, all indirect", true,
     false},
    {only_caustic, "--only caustic",
     "paths L, LD, L{S|D|V}*S, L{S|D|V}*{D|V}{S|D|V}*D, L{S|D|V}*V are left out", true, false},
    {no_gather, "--gather 0", "paths L{S|D|V}*{D|V}{S|D|V}*D, is as blurred", false, false},
    {march, "--media march", "estimates at steps", false, false},
    {march_without_a_map, "--media march", "no volume map", false, true},
    {steps_without_a_march, "--march-step", "no ray marches", false, true},
};

static const said without_fog[] = {
    {march, "--media march", "no volume map", false, true},
};

static const pm_choice *find(const pm_choice *list, int count, const char *option)
{
    for (int i = 0; i < count; i++) {
        if (strcmp(list[i].option, option) == 0) {
            return &list[i];
        }
    }
    return NULL;
}

static void check_said(const pm_scenes *s, const said *want)
{
    pm_render_settings settings = pm_render_defaults();
    want->change(&settings);
    pm_render_maps maps = {0};
    CHECK_OK(pm_render_plan(&s->scene, &settings, &maps));
    pm_choice list[PM_CHOICES_MAX];
    int count = pm_choice_list(&settings, &maps, list);
    const pm_choice *got = find(list, count, want->option);
    CHECK_THAT(got != NULL, "nothing is said of %s", want->option);
    CHECK_CONTAINS(got->effect, want->effect);
    CHECK_THAT(got->missing == want->missing && got->idle == want->idle,
               "%s: missing %d idle %d", want->option, got->missing, got->idle);
    size_t length = strlen(got->effect);
    CHECK_THAT(length + 1 < sizeof got->effect && got->effect[length - 1] != '.', "cut: %s",
               got->effect);
    pm_render_maps_free(&maps);
}

static void each_setting_says_what_it_changes(void)
{
    pm_scenes s;
    build(&s, true);
    for (size_t i = 0; i < sizeof with_ball / sizeof with_ball[0]; i++) {
        check_said(&s, &with_ball[i]);
    }
    pm_scenes_free(&s);
    build(&s, false);
    for (size_t i = 0; i < sizeof without_ball / sizeof without_ball[0]; i++) {
        check_said(&s, &without_ball[i]);
    }
    pm_scenes_free(&s);
}

/// The room with a ball of glass, full of `fog`, which must outlive the scene.
static void build_foggy(pm_scenes *s, pm_medium *fog)
{
    build(s, true);
    *fog = (pm_medium){.id = "fog", .sigma_t = 1.0, .albedo = pm_gray(0.5)};
    s->scene.media = fog;
    s->scene.medium_count = 1;
    s->lights[0].medium = 0;
}

static void settings_of_media_say_what_they_change(void)
{
    pm_scenes s;
    pm_medium fog;
    build_foggy(&s, &fog);
    for (size_t i = 0; i < sizeof with_fog / sizeof with_fog[0]; i++) {
        check_said(&s, &with_fog[i]);
    }
    pm_scenes_free(&s);
    build(&s, true);
    for (size_t i = 0; i < sizeof without_fog / sizeof without_fog[0]; i++) {
        check_said(&s, &without_fog[i]);
    }
    pm_scenes_free(&s);
}

static void defaults_say_nothing(void)
{
    pm_scenes s;
    build(&s, true);
    pm_render_settings settings = pm_render_defaults();
    pm_render_maps maps = {0};
    CHECK_OK(pm_render_plan(&s.scene, &settings, &maps));
    pm_choice list[PM_CHOICES_MAX];
    CHECK_NEAR(pm_choice_list(&settings, &maps, list), 0, 0);
    pm_render_maps_free(&maps);
    pm_scenes_free(&s);
}

/// All at once fits the room of the list.
static void all_choices_fit(void)
{
    pm_scenes s;
    pm_medium fog;
    build_foggy(&s, &fog);
    pm_render_settings settings = pm_render_defaults();
    for (size_t i = 0; i < sizeof with_ball / sizeof with_ball[0]; i++) {
        with_ball[i].change(&settings);
    }
    for (size_t i = 0; i < sizeof with_fog / sizeof with_fog[0]; i++) {
        with_fog[i].change(&settings);
    }
    pm_render_maps maps = {0};
    CHECK_OK(pm_render_plan(&s.scene, &settings, &maps));
    pm_choice list[PM_CHOICES_MAX];
    int count = pm_choice_list(&settings, &maps, list);
    CHECK(count >= 7 && count <= PM_CHOICES_MAX);
    pm_render_maps_free(&maps);
    pm_scenes_free(&s);
}

static char *explain(const pm_scenes *s, const pm_render_settings *settings)
{
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    CHECK(stream != NULL);
    pm_render_maps maps = {0};
    CHECK_OK(pm_render_plan(&s->scene, settings, &maps));
    pm_explain_print(settings, &maps, stream);
    pm_render_maps_free(&maps);
    fclose(stream);
    return text;
}

/// Line breaks of the page as blanks.
static void flatten(char *text)
{
    char *out = text;
    for (const char *at = text; *at != '\0'; at++) {
        char letter = *at == '\n' ? ' ' : *at;
        if (letter != ' ' || out == text || out[-1] != ' ') {
            *out++ = letter;
        }
    }
    *out = '\0';
}

static void the_page_says_needs_costs_and_what_is_left_out(void)
{
    pm_scenes s;
    build(&s, true);
    pm_render_settings settings = pm_render_defaults();
    settings.photons[PM_MAP_CAUSTIC] = 0;
    char *text = explain(&s, &settings);
    for (const char *at = text; *at != '\0';
         at += strcspn(at, "\n") + (strchr(at, '\n') != NULL)) {
        CHECK_THAT(strcspn(at, "\n") <= 96, "a line is too long: %s", at);
    }
    flatten(text);
    CHECK_CONTAINS(text, "direct yes ");
    CHECK_CONTAINS(
        text, "paths LD: 16 shadow rays a pixel to each area light and the sky, 4 to others");
    CHECK_CONTAINS(text, "paths LS+D: caustic map, not traced");
    CHECK_CONTAINS(text, "global map, 200000 photons, and 64 gather rays a pixel");
    CHECK_CONTAINS(text, "volume no no medium");
    CHECK_CONTAINS(text, "dispersion no no glass that disperses");
    CHECK_CONTAINS(text,
                   "--caustic-photons 0: no caustic map by choice: paths LS+D are missing");
    CHECK_CONTAINS(text, "shadow maps: shadow rays are exact");
    free(text);
    settings.photons[PM_MAP_CAUSTIC] = 5;
    settings.light.caustics_global = true;
    settings.light.rays = 0;
    settings.total = 1234;
    text = explain(&s, &settings);
    flatten(text);
    CHECK_CONTAINS(text, "paths LS+D: global map, 1234 photons");
    CHECK_CONTAINS(text, "global map, 1234 photons, seen directly");
    CHECK_CONTAINS(text, "--photons 1234: split among the maps that are traced");
    free(text);
    settings = pm_render_defaults();
    settings.stored = 500;
    settings.light.spp = 32;
    settings.everywhere = true;
    text = explain(&s, &settings);
    flatten(text);
    CHECK_CONTAINS(text, "paths LS+D: caustic map, until 500 photons are stored");
    CHECK_CONTAINS(text, "projection yes off by choice; on, ");
    CHECK_CONTAINS(text, "32 shadow rays a pixel to each area light and the sky, 32 to others");
    free(text);
    pm_scenes_free(&s);
}

static void the_page_says_how_media_are_asked(void)
{
    pm_scenes s;
    pm_medium fog;
    build_foggy(&s, &fog);
    pm_render_settings settings = pm_render_defaults();
    char *text = explain(&s, &settings);
    flatten(text);
    CHECK_CONTAINS(text, "volume yes fog scatters light: that of point");
    CHECK_CONTAINS(text, "paths L{S|D|V}*V: LV by points along each ray that passes a medium, "
                         "16 a pixel for each light; the rest from the volume map, 100000 "
                         "photons, asked by beams");
    free(text);
    march_without_a_map(&settings);
    text = explain(&s, &settings);
    flatten(text);
    CHECK_CONTAINS(text, "the rest from the volume map, not traced, asked by marching");
    free(text);
    pm_scenes_free(&s);
}

static void json_says_the_same(void)
{
    pm_scenes s;
    build(&s, true);
    pm_render_settings settings = pm_render_defaults();
    settings.total = 100;
    settings.precompute = true;
    settings.light.rays = 0;
    pm_render_maps maps = {0};
    CHECK_OK(pm_render_plan(&s.scene, &settings, &maps));
    json_t *object = pm_explain_json(&settings, &maps);
    CHECK(object != NULL);
    json_t *photons = json_object_get(object, "photons");
    CHECK(json_integer_value(json_object_get(photons, "caustic")) == 50);
    json_t *choices = json_object_get(object, "choices");
    CHECK_NEAR((double)json_array_size(choices), 2, 0);
    json_t *second = json_array_get(choices, 1);
    CHECK(strcmp(json_string_value(json_object_get(second, "option")), "--precompute on") == 0);
    CHECK(json_is_true(json_object_get(second, "idle")));
    CHECK(json_is_false(json_object_get(second, "missing")));
    json_t *left_out = json_array_get(json_object_get(object, "not_offered"), 0);
    CHECK(strcmp(json_string_value(json_object_get(left_out, "what")), "shadow maps") == 0);
    CHECK(json_is_object(json_object_get(json_object_get(object, "plan"), "projection")));
    json_decref(object);
    pm_render_maps_free(&maps);
    pm_scenes_free(&s);
}

PM_TESTS({"choice.1", "each setting says which paths it leaves out or what it changes",
          each_setting_says_what_it_changes},
         {"choice.2", "the defaults leave nothing out", defaults_say_nothing},
         {"choice.3", "all choices at once fit", all_choices_fit},
         {"choice.4", "--explain says needs, paths, costs and what is left out, in 96 columns",
          the_page_says_needs_costs_and_what_is_left_out},
         {"choice.6", "settings of media say what they leave out or change",
          settings_of_media_say_what_they_change},
         {"choice.7", "--explain says how media are asked", the_page_says_how_media_are_asked},
         {"choice.5", "--explain --json says the same", json_says_the_same})
