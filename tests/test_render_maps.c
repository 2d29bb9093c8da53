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

PM_TESTS({"render_maps.1", "a map that nothing needs, or that is switched off, is not traced",
          maps_that_nothing_needs_are_not_traced},
         {"render_maps.2", "one layer alone traces the maps that it asks, and no other",
          layers_trace_only_their_maps})
