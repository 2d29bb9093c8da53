// What the plan reads off media and off glass that disperses.
#include "plan.h"

#include "plans.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"

#include <stdio.h>
#include <string.h>

/// A medium in a ball above a lit floor, and what the plan says of it.
typedef struct {
    const char *what;
    double sigma_t;
    pm_spectrum albedo;
    int skin;         // of the ball: 0 null, 1 glass, 2 gray, 3 black
    bool before;      // the medium is outside the ball, not in it
    bool lamp_inside; // a light in the medium
    bool floor;
    bool needed;
    const char *why;
} haze;

static const haze hazes[] = {
    {"fog in a null ball",
     2.0,
     {{0.5, 0.5, 0.5}},
     .floor = true,
     .needed = true,
     .why = "fog scatters light: that of point"},
    {"fog that scatters blue only", 2.0, {{0.0, 0.0, 0.1}}, .needed = true, .why = "fog"},
    {"fog in glass",
     2.0,
     {{0.5, 0.5, 0.5}},
     .skin = 1,
     .floor = true,
     .needed = true,
     .why = "fog"},
    {"fog in a gray ball",
     2.0,
     {{0.5, 0.5, 0.5}},
     .skin = 2,
     .floor = true,
     .why = "no light gets into fog"},
    {"fog in a gray ball with a lamp",
     2.0,
     {{0.5, 0.5, 0.5}},
     .skin = 2,
     .lamp_inside = true,
     .needed = true,
     .why = "fog"},
    {"fog around a gray ball",
     2.0,
     {{0.5, 0.5, 0.5}},
     .skin = 2,
     .before = true,
     .needed = true,
     .why = "fog"},
    {"fog around a black ball alone",
     2.0,
     {{0.5, 0.5, 0.5}},
     .skin = 3,
     .before = true,
     .why = "no light gets into fog"},
    {"ink",
     2.0,
     {{0.0, 0.0, 0.0}},
     .floor = true,
     .why = "fog takes light on its way and scatters none: its albedo is 0"},
    {"nothing", 0.0, {{0.9, 0.9, 0.9}}, .floor = true, .why = "its extinction is 0"},
};
enum { HAZES = sizeof hazes / sizeof hazes[0] };

static int skin_of(pm_scenes *s, int skin)
{
    switch (skin) {
    case 0:
        return pm_scenes_null(s);
    case 1:
        return pm_scenes_glass(s, 1.5);
    default:
        return pm_scenes_diffuse(s, pm_gray(skin == 2 ? 0.5 : 0.0));
    }
}

/// `fog` must outlive the scene.
static void build_haze(pm_scenes *s, const haze *h, pm_medium *fog)
{
    *fog = (pm_medium){.id = "fog", .sigma_t = h->sigma_t, .albedo = h->albedo};
    pm_scenes_begin(s);
    if (h->floor) {
        int gray = pm_scenes_diffuse(s, pm_gray(0.5));
        pm_scenes_add(s, pm_scenes_square(1.0, 0.0, false), gray, PM_NONE);
    }
    int skin = skin_of(s, h->skin);
    pm_shape sphere = pm_shapes_sphere(pm_vec(0.0, 0.0, 0.5), 0.2);
    int ball = pm_scenes_add(s, sphere, skin, h->skin < 2 ? skin : PM_NONE);
    s->shapes[ball].boundary = true;
    s->shapes[ball].interior = h->before ? PM_NONE : 0;
    s->shapes[ball].exterior = h->before ? 0 : PM_NONE;
    int lamp = pm_scenes_point(s, pm_vec(0.0, 0.0, 1.0), pm_gray(1.0));
    s->lights[lamp].medium = h->lamp_inside ? 0 : PM_NONE;
    pm_scenes_ready(s);
    s->scene.media = fog;
    s->scene.medium_count = 1;
}

static void media_are_planned_where_light_is_scattered(void)
{
    for (int i = 0; i < HAZES; i++) {
        const haze *h = &hazes[i];
        pm_scenes s;
        pm_medium fog;
        build_haze(&s, h, &fog);
        pm_plan plan = pm_plan_scene(&s.scene);
        pm_plans_check(&plan, h->what, PM_PLAN_VOLUME, h->needed);
        pm_plans_check(&plan, h->what, PM_PLAN_INDIRECT, h->floor || h->skin == 2);
        CHECK_CONTAINS(plan.item[PM_PLAN_VOLUME].why, h->why);
        CHECK(pm_plan_needs_map(&plan, PM_MAP_VOLUME) == h->needed);
        bool hazy = strchr(pm_plan_paths(&plan, PM_PLAN_INDIRECT), 'V') != NULL;
        CHECK_THAT(hazy == h->needed, "%s: paths %s", h->what,
                   pm_plan_paths(&plan, PM_PLAN_INDIRECT));
        pm_scenes_free(&s);
    }
}

static void indirect_light_comes_from_media_too(void)
{
    pm_scenes s;
    pm_medium fog;
    build_haze(&s, &hazes[0], &fog);
    pm_plan plan = pm_plan_scene(&s.scene);
    CHECK_CONTAINS(plan.item[PM_PLAN_INDIRECT].why, "fog scatters light onto them");
    s.lights[0].flux = pm_gray(0.0);
    plan = pm_plan_scene(&s.scene);
    CHECK(!plan.item[PM_PLAN_VOLUME].needed);
    CHECK_CONTAINS(plan.item[PM_PLAN_VOLUME].why, "no light has any power");
    pm_scenes_free(&s);
}

static void dispersion_is_planned_where_a_shape_wears_such_glass(void)
{
    for (int dressed = 0; dressed < 2; dressed++) {
        pm_scenes s;
        pm_scenes_begin(&s);
        int plain = pm_scenes_glass(&s, 1.5);
        int flint = pm_scenes_glass(&s, 1.5);
        s.materials[flint].glass = pm_glass_named("sf11");
        pm_shape sphere = pm_shapes_sphere(pm_vec(0.0, 0.0, 0.5), 0.2);
        int ball = pm_scenes_wear(&s, sphere, dressed ? flint : plain);
        s.shapes[ball].id = "ball";
        pm_scenes_point(&s, pm_vec(0.0, 0.0, 1.0), pm_gray(1.0));
        pm_scenes_ready(&s);
        pm_plan plan = pm_plan_scene(&s.scene);
        const char *what = dressed ? "flint" : "crown";
        pm_plans_check(&plan, what, PM_PLAN_DISPERSION, dressed != 0);
        CHECK_CONTAINS(plan.item[PM_PLAN_DISPERSION].why,
                       dressed ? "ball is of sf11" : "no glass that disperses");
        pm_scenes_free(&s);
    }
}

PM_TESTS({"plan_media.1",
          "a volume map is planned where light gets into a medium that scatters it",
          media_are_planned_where_light_is_scattered},
         {"plan_media.2", "indirect light names the medium that scatters it",
          indirect_light_comes_from_media_too},
         {"plan_media.3", "dispersion is planned where a shape wears glass that disperses",
          dispersion_is_planned_where_a_shape_wears_such_glass})
