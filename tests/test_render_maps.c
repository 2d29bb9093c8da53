// Which maps a picture traces: those that its scene and its layers need, unless switched off.
#include "pictures.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"

static void maps_that_nothing_needs_are_not_traced(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_room(&s, 1.0, pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 0.0), pm_gray(1.0));
    pm_scenes_ready(&s);
    pm_render_settings settings = pm_pictures_settings();
    pm_render_maps maps = {0};
    CHECK_OK(pm_render_make_maps(&s.world, &settings, &maps));
    CHECK(maps.has[PM_MAP_GLOBAL] && !maps.has[PM_MAP_CAUSTIC] && !maps.has[PM_MAP_VOLUME]);
    CHECK(maps.plan.item[PM_PLAN_INDIRECT].needed && !maps.plan.item[PM_PLAN_CAUSTIC].needed);
    pm_render_maps_free(&maps);

    s.materials[0].reflectance = pm_gray(0.0);
    CHECK_OK(pm_render_make_maps(&s.world, &settings, &maps));
    CHECK(!maps.has[PM_MAP_GLOBAL] && !maps.plan.item[PM_PLAN_INDIRECT].needed);
    pm_render_maps_free(&maps);

    s.materials[0].reflectance = pm_gray(0.5);
    settings.photons[PM_MAP_GLOBAL] = 0; // off by choice
    CHECK_OK(pm_render_make_maps(&s.world, &settings, &maps));
    CHECK(!maps.has[PM_MAP_GLOBAL] && maps.plan.item[PM_PLAN_INDIRECT].needed);
    CHECK(maps.plan.item[PM_PLAN_INDIRECT].missing);
    CHECK_CONTAINS(maps.plan.item[PM_PLAN_INDIRECT].left_out, "by choice");
    pm_render_maps_free(&maps);
    pm_scenes_free(&s);
}

static void layers_trace_only_their_maps(void)
{
    static const bool asks[PM_LAYER_COUNT][PM_MAP_COUNT] = {
        [PM_LAYER_SPECULAR] = {true, true, false},
        [PM_LAYER_CAUSTIC] = {false, true, false},
        [PM_LAYER_INDIRECT] = {true, false, false},
    };
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_room(&s, 1.0, pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(0.0, 0.0, -0.5), 0.25),
                   pm_scenes_mirror(&s, pm_gray(0.9)));
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 0.5), pm_gray(1.0));
    pm_scenes_ready(&s);
    pm_render_settings settings = pm_pictures_settings();
    for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
        pm_render_maps maps = {0};
        settings.only = layer;
        CHECK_OK(pm_render_make_maps(&s.world, &settings, &maps));
        for (int kind = 0; kind < PM_MAP_COUNT; kind++) {
            CHECK_THAT(maps.has[kind] == asks[layer][kind], "layer %d, map %d", layer, kind);
        }
        CHECK(!maps.plan.item[PM_PLAN_CAUSTIC].missing);
        pm_render_maps_free(&maps);
    }
    pm_scenes_free(&s);
}

/// A room with a mirror ball, 300 photons a map.
static pm_render_settings mirrored_room(pm_scenes *s)
{
    pm_scenes_begin(s);
    pm_scenes_room(s, 1.0, pm_scenes_diffuse(s, pm_gray(0.5)));
    pm_scenes_wear(s, pm_shapes_sphere(pm_vec(0.0, 0.0, -0.5), 0.25),
                   pm_scenes_mirror(s, pm_gray(0.9)));
    pm_scenes_point(s, pm_vec(0.0, 0.0, 0.5), pm_gray(1.0));
    pm_scenes_ready(s);
    pm_render_settings settings = pm_render_defaults();
    settings.photons[PM_MAP_GLOBAL] = 300;
    settings.photons[PM_MAP_CAUSTIC] = 300;
    settings.everywhere = true;
    return settings;
}

/// What a choice of settings makes of the maps.
typedef struct {
    int only;
    bool global, gathers; // --caustics global, --gather
    uint64_t total, global_photons, caustic_photons;
    uint64_t want[2];
    bool miss_caustic, miss_indirect;
} choice_case;

static const choice_case choices[] = {
    {.only = PM_NONE, .global_photons = 9, .caustic_photons = 8, .want = {9, 8}},
    {.only = PM_NONE, .total = 100, .want = {50, 50}},
    {.only = PM_NONE, .global = true, .total = 100, .want = {100, 0}},
    {.only = PM_NONE,
     .global = true,
     .global_photons = 9,
     .caustic_photons = 8,
     .want = {9, 0}},
    {.only = PM_NONE, .global_photons = 9, .want = {9, 0}, .miss_caustic = true},
    {.only = PM_NONE, .caustic_photons = 8, .want = {0, 8}, .miss_indirect = true},
    {.only = PM_NONE,
     .global = true,
     .caustic_photons = 8,
     .miss_caustic = true,
     .miss_indirect = true},
    {.only = PM_LAYER_CAUSTIC, .total = 100, .want = {0, 100}},
    {.only = PM_LAYER_CAUSTIC, .global = true, .total = 100, .want = {100, 0}},
    {.only = PM_LAYER_CAUSTIC, .global_photons = 9, .caustic_photons = 8, .want = {0, 8}},
    {.only = PM_LAYER_INDIRECT, .total = 100, .want = {100, 0}},
    {.only = PM_LAYER_INDIRECT, .gathers = true, .total = 100, .want = {100, 0}},
    {.only = PM_LAYER_SPECULAR, .total = 100, .want = {50, 50}},
    {.only = PM_LAYER_DIRECT, .total = 100},
    {.only = PM_LAYER_EMISSION, .total = 1},
};

static void settings_decide_what_is_traced(void)
{
    pm_scenes s;
    pm_render_settings settings = mirrored_room(&s);
    for (size_t i = 0; i < sizeof choices / sizeof choices[0]; i++) {
        const choice_case *c = &choices[i];
        settings.only = c->only;
        settings.light.caustics_global = c->global;
        settings.light.rays = c->gathers ? 4 : 0;
        settings.total = c->total;
        settings.photons[PM_MAP_GLOBAL] = c->global_photons;
        settings.photons[PM_MAP_CAUSTIC] = c->caustic_photons;
        pm_render_maps maps = {0};
        CHECK_OK(pm_render_plan(&s.scene, &settings, &maps));
        for (int kind = 0; kind < 2; kind++) {
            CHECK_THAT(maps.photons[kind] == c->want[kind], "case %zu, map %d: got %llu", i,
                       kind, (unsigned long long)maps.photons[kind]);
            CHECK(!maps.has[kind]);
        }
        CHECK_THAT(maps.plan.item[PM_PLAN_CAUSTIC].missing == c->miss_caustic, "case %zu", i);
        CHECK_THAT(maps.plan.item[PM_PLAN_INDIRECT].missing == c->miss_indirect, "case %zu", i);
        pm_render_maps_free(&maps);
    }
    pm_scenes_free(&s);
}

/// What a choice of settings makes of the volume map of a foggy room.
static void volume_map_is_traced_where_fog_is_asked(void)
{
    static const struct {
        int only;
        uint32_t rays;
        uint64_t given, want;
        bool missing;
    } cases[] = {
        {PM_NONE, 4, 7, 7, false},
        {PM_NONE, 0, 7, 7, false},
        {PM_NONE, 4, 0, 0, true},
        {PM_LAYER_VOLUME, 4, 7, 7, false},
        {PM_LAYER_SPECULAR, 0, 7, 7, false},
        {PM_LAYER_INDIRECT, 4, 7, 7, false}, // gather rays run through fog
        {PM_LAYER_INDIRECT, 0, 7, 0, false}, // the global map has what fog sent to surfaces
        {PM_LAYER_DIRECT, 4, 7, 0, false},
        {PM_LAYER_CAUSTIC, 4, 7, 0, false},
        {PM_LAYER_EMISSION, 4, 0, 0, false},
    };
    pm_medium fog = {.id = "fog", .sigma_t = 1.0, .albedo = pm_gray(0.5)};
    pm_scenes s;
    pm_render_settings settings = mirrored_room(&s);
    s.scene.media = &fog;
    s.scene.medium_count = 1;
    s.lights[0].medium = 0;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        settings.only = cases[i].only;
        settings.light.rays = cases[i].rays;
        settings.photons[PM_MAP_VOLUME] = cases[i].given;
        pm_render_maps maps = {0};
        CHECK_OK(pm_render_plan(&s.scene, &settings, &maps));
        CHECK_THAT(maps.photons[PM_MAP_VOLUME] == cases[i].want, "case %zu: %llu", i,
                   (unsigned long long)maps.photons[PM_MAP_VOLUME]);
        const pm_plan_item *item = &maps.plan.item[PM_PLAN_VOLUME];
        CHECK(item->needed && item->missing == cases[i].missing);
        if (cases[i].missing) {
            CHECK_CONTAINS(item->left_out, "paths L{S|D|V}+V, ");
            CHECK_CONTAINS(item->left_out, "but LV");
            CHECK_CONTAINS(item->left_out, "in indirect light too");
        }
        pm_render_maps_free(&maps);
    }
    settings.only = PM_NONE;
    settings.light.rays = 4;
    settings.total = 1000;
    pm_render_maps maps = {0};
    CHECK_OK(pm_render_plan(&s.scene, &settings, &maps));
    CHECK(maps.photons[PM_MAP_GLOBAL] == 400 && maps.photons[PM_MAP_VOLUME] == 200);
    pm_render_maps_free(&maps);
    pm_scenes_free(&s);
}

static void missing_maps_name_their_paths(void)
{
    pm_scenes s;
    pm_render_settings settings = mirrored_room(&s);
    settings.photons[PM_MAP_CAUSTIC] = 0;
    settings.photons[PM_MAP_GLOBAL] = 0;
    pm_render_maps maps = {0};
    CHECK_OK(pm_render_plan(&s.scene, &settings, &maps));
    CHECK_CONTAINS(maps.plan.item[PM_PLAN_CAUSTIC].left_out, "paths LS+D are missing");
    CHECK_CONTAINS(maps.plan.item[PM_PLAN_INDIRECT].left_out, "L{S|D}*D{S|D}*D");
    CHECK_CONTAINS(maps.plan.item[PM_PLAN_CAUSTIC].why, "a mirror");
    pm_render_maps_free(&maps);
    settings.light.caustics_global = true;
    CHECK_OK(pm_render_plan(&s.scene, &settings, &maps));
    CHECK_CONTAINS(maps.plan.item[PM_PLAN_CAUSTIC].left_out, "paths LS+D are missing");
    pm_render_maps_free(&maps);
    pm_scenes_free(&s);
}

static void shadow_photons_are_sent_where_direct_light_is_shown(void)
{
    static const struct {
        int only;
        bool view, asked;
        uint64_t total, global, want;
    } cases[] = {
        {PM_NONE, false, true, 0, 300, 300},
        {PM_NONE, false, false, 0, 300, 0},
        {PM_NONE, true, true, 0, 300, 0},
        {PM_LAYER_DIRECT, false, true, 0, 70, 70},
        {PM_LAYER_DIRECT, false, true, 50, 70, 50},
        {PM_LAYER_CAUSTIC, false, true, 0, 300, 0},
        {PM_LAYER_SPECULAR, false, true, 0, 40, 40},
        {PM_NONE, false, true, 100, 300, 50},
        {PM_NONE, false, true, 0, 0, 200000},
    };
    pm_scenes s;
    pm_render_settings settings = mirrored_room(&s);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        settings.only = cases[i].only;
        settings.view_photons = cases[i].view;
        settings.direct_photons = cases[i].asked;
        settings.total = cases[i].total;
        settings.photons[PM_MAP_GLOBAL] = cases[i].global;
        pm_render_maps maps = {0};
        CHECK_OK(pm_render_plan(&s.scene, &settings, &maps));
        CHECK_THAT(maps.shadow_photons == cases[i].want, "case %zu: %llu", i,
                   (unsigned long long)maps.shadow_photons);
        pm_render_maps_free(&maps);
    }
    pm_scenes_free(&s);
}

static void what_was_planned_is_made(void)
{
    pm_scenes s;
    pm_render_settings settings = mirrored_room(&s);
    settings.everywhere = false;
    settings.direct_photons = true;
    settings.precompute = true;
    pm_render_maps maps = {0};
    CHECK_OK(pm_render_make_maps(&s.world, &settings, &maps));
    CHECK(maps.pass[PM_MAP_GLOBAL].emitted == 300 && maps.pass[PM_MAP_CAUSTIC].emitted == 300);
    CHECK(maps.shadows.light_count == 1 && maps.irradiance.count > 0);
    // A small ball in a room: the caustic map is aimed at it, and less than all power is sent.
    CHECK(pm_projection_of(&maps.aim[PM_MAP_CAUSTIC]) != NULL);
    CHECK(maps.plan.item[PM_PLAN_PROJECTION].needed);
    double sent = pm_spectrum_mean(maps.pass[PM_MAP_CAUSTIC].audit.emitted);
    double dark = pm_spectrum_mean(maps.aim[PM_MAP_CAUSTIC].dark);
    double flux = pm_spectrum_mean(s.lights[0].flux);
    CHECK(sent < flux);
    CHECK_NEAR(sent + dark, flux, 1e-12 * flux);
    pm_render_maps_free(&maps);
    CHECK(maps.aim[PM_MAP_CAUSTIC].light == NULL && maps.irradiance.count == 0);

    settings.everywhere = true;
    settings.light.rays = 0; // nothing to precompute for
    CHECK_OK(pm_render_make_maps(&s.world, &settings, &maps));
    CHECK(pm_projection_of(&maps.aim[PM_MAP_CAUSTIC]) == NULL);
    CHECK_THAT(maps.plan.item[PM_PLAN_PROJECTION].needed, "a plan hides what was switched off");
    CHECK_NEAR(pm_spectrum_mean(maps.pass[PM_MAP_CAUSTIC].audit.emitted), flux, 1e-12 * flux);
    CHECK(maps.irradiance.count == 0);
    pm_render_maps_free(&maps);
    pm_scenes_free(&s);
}

PM_TESTS({"render_maps.1", "a map that nothing needs, or that is switched off, is not traced",
          maps_that_nothing_needs_are_not_traced},
         {"render_maps.3", "layers, sources and photons asked for decide what is traced",
          settings_decide_what_is_traced},
         {"render_maps.4", "a map that is off names the paths that are missing",
          missing_maps_name_their_paths},
         {"render_maps.7", "the volume map is traced where eye or gather rays pass a medium",
          volume_map_is_traced_where_fog_is_asked},
         {"render_maps.5", "shadow photons are sent where direct light is shown",
          shadow_photons_are_sent_where_direct_light_is_shown},
         {"render_maps.6", "what was planned is made: aimed photons, shadows, irradiance",
          what_was_planned_is_made},
         {"render_maps.2", "one layer alone traces the maps that it asks, and no other",
          layers_trace_only_their_maps})
