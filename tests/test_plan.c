// What the plan reads off scenes that have a thing, and off scenes that lack it.
#include "plan.h"

#include "plans.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"

#include <stdio.h>
#include <string.h>

/// Which parts a scene asks for.
typedef struct {
    const char *what;
    bool floor, mirror, glass, black, dark, unworn;
    bool direct, specular, caustic, indirect;
} expectation;

static const expectation expectations[] = {
    {.what = "a lit floor", .floor = true, .direct = true, .indirect = true},
    {.what = "a black floor", .floor = true, .black = true, .direct = true},
    {.what = "a floor and a mirror",
     .floor = true,
     .mirror = true,
     .direct = true,
     .specular = true,
     .caustic = true,
     .indirect = true},
    {.what = "a floor and glass",
     .floor = true,
     .glass = true,
     .direct = true,
     .specular = true,
     .caustic = true,
     .indirect = true},
    {.what = "a black floor and glass",
     .floor = true,
     .black = true,
     .glass = true,
     .direct = true,
     .specular = true,
     .caustic = true},
    {.what = "mirrors only", .mirror = true, .specular = true},
    {.what = "a floor under a light of 0 W", .floor = true, .mirror = true, .dark = true},
    {.what = "a floor, and glass that no shape wears",
     .floor = true,
     .unworn = true,
     .direct = true,
     .indirect = true},
    {.what = "nothing at all"},
};
enum { EXPECTATIONS = sizeof expectations / sizeof expectations[0] };

static void build(pm_scenes *s, const expectation *e)
{
    pm_scenes_begin(s);
    if (e->floor) {
        int wear = pm_scenes_diffuse(s, pm_gray(e->black ? 0.0 : 0.5));
        int floor = pm_scenes_add(s, pm_scenes_square(1.0, 0.0, false), wear, PM_NONE);
        s->shapes[floor].id = "floor";
    }
    pm_shape ball = pm_shapes_sphere(pm_vec(0.0, 0.0, 0.5), 0.2);
    ball.id = "ball";
    if (e->mirror) { // on the inside only: both sides count
        pm_scenes_add(s, ball, PM_NONE, pm_scenes_mirror(s, pm_gray(1.0)));
    }
    if (e->glass || e->unworn) {
        int glass = pm_scenes_glass(s, 1.5);
        if (e->glass) {
            pm_scenes_wear(s, ball, glass);
        }
    }
    pm_scenes_point(s, pm_vec(0.0, 0.0, 1.0), pm_gray(e->dark ? 0.0 : 1.0));
    pm_scenes_ready(s);
}

static void scenes_ask_for_their_parts(void)
{
    for (int i = 0; i < EXPECTATIONS; i++) {
        const expectation *e = &expectations[i];
        pm_scenes s;
        build(&s, e);
        pm_plan plan = pm_plan_scene(&s.scene);
        pm_plans_check(&plan, e->what, PM_PLAN_DIRECT, e->direct);
        pm_plans_check(&plan, e->what, PM_PLAN_SPECULAR, e->specular);
        pm_plans_check(&plan, e->what, PM_PLAN_CAUSTIC, e->caustic);
        pm_plans_check(&plan, e->what, PM_PLAN_INDIRECT, e->indirect);
        pm_plans_check(&plan, e->what, PM_PLAN_VOLUME, false);
        pm_plans_check(&plan, e->what, PM_PLAN_DISPERSION, false);
        pm_plans_check(&plan, e->what, PM_PLAN_PROJECTION, false);
        CHECK(pm_plan_needs_map(&plan, PM_MAP_GLOBAL) == e->indirect);
        CHECK(pm_plan_needs_map(&plan, PM_MAP_CAUSTIC) == e->caustic);
        CHECK(!pm_plan_needs_map(&plan, PM_MAP_VOLUME));
        pm_scenes_free(&s);
    }
}

/// What a ball can wear, and what its lobes are by the rule: S for smooth ones and microfacets
/// up to roughness 0.1, D for all others.
typedef struct {
    const char *what;
    bool specular, diffuse;
    const char *word; // by which the plan calls the S lobe
} worn;

static const worn wardrobe[] = {
    {"nothing", false, false, NULL},
    {"a null surface", false, false, NULL},
    {"a mirror", true, false, "a mirror"},
    {"glass", true, false, "glass"},
    {"a pane", true, false, "a pane"},
    {"gold", true, false, "a mirror"},
    {"metal of roughness 0.1", true, false, "polished metal"},
    {"metal of roughness 0.11", false, true, NULL},
    {"plastic", true, true, "a smooth coat"},
    {"plastic of roughness 0.1", true, true, "a smooth coat"},
    {"plastic of roughness 0.5", false, true, NULL},
};
enum { WARDROBE = sizeof wardrobe / sizeof wardrobe[0] };

static int tailor(pm_scenes *s, int which)
{
    switch (which) {
    case 1:
        return pm_scenes_null(s);
    case 2:
        return pm_scenes_mirror(s, pm_gray(1.0));
    case 3:
        return pm_scenes_glass(s, 1.5);
    case 4:
        return pm_scenes_pane(s, 1.5);
    case 5:
        return pm_scenes_metal(s, pm_gray(0.2), pm_gray(3.0));
    case 6:
        return pm_scenes_rough_mirror(s, PM_MICROFACET_GGX, 0.1);
    case 7:
        return pm_scenes_rough_mirror(s, PM_MICROFACET_BECKMANN, 0.11);
    case 8:
        return pm_scenes_plastic(s, pm_gray(0.5), 1.5);
    case 9:
        return pm_scenes_rough_plastic(s, pm_gray(0.5), 1.5, PM_MICROFACET_GGX, 0.1);
    default:
        return pm_scenes_rough_plastic(s, pm_gray(0.5), 1.5, PM_MICROFACET_GGX, 0.5);
    }
}

/// A ball in these clothes over no floor, a black one or a gray one, under no light, one of
/// 0 W, one, or one of each.
static void build_dressed(pm_scenes *s, int which, int floor, int lights)
{
    pm_scenes_begin(s);
    if (floor > 0) {
        int wear = pm_scenes_diffuse(s, pm_gray(floor == 1 ? 0.0 : 0.5));
        pm_scenes_add(s, pm_scenes_square(1.0, 0.0, false), wear, PM_NONE);
    }
    if (which > 0) {
        pm_scenes_wear(s, pm_shapes_sphere(pm_vec(0.0, 0.0, 0.5), 0.2), tailor(s, which));
    }
    for (int light = 1; light <= 2; light++) {
        if ((lights & light) != 0) {
            pm_scenes_point(s, pm_vec(0.0, 0.0, 1.0), pm_gray(light == 1 ? 0.0 : 1.0));
        }
    }
    pm_scenes_ready(s);
}

static void check_dressed(int which, int floor, int lights)
{
    const worn *w = &wardrobe[which];
    bool lit = (lights & 2) != 0;
    bool diffuse = floor > 0 || w->diffuse;
    char what[128];
    snprintf(what, sizeof what, "a ball in %s, floor %d, lights %d", w->what, floor, lights);
    pm_scenes s;
    build_dressed(&s, which, floor, lights);
    pm_plan plan = pm_plan_scene(&s.scene);
    pm_plans_check(&plan, what, PM_PLAN_DIRECT, lit && diffuse);
    pm_plans_check(&plan, what, PM_PLAN_SPECULAR, lit && w->specular);
    pm_plans_check(&plan, what, PM_PLAN_CAUSTIC, lit && diffuse && w->specular);
    pm_plans_check(&plan, what, PM_PLAN_INDIRECT, lit && (floor == 2 || w->diffuse));
    pm_plans_check(&plan, what, PM_PLAN_VOLUME, false);
    pm_plans_check(&plan, what, PM_PLAN_DISPERSION, false);
    if (lit && w->specular) {
        CHECK_CONTAINS(plan.item[PM_PLAN_SPECULAR].why, w->word);
    }
    pm_scenes_free(&s);
}

static void every_material_is_planned_for(void)
{
    for (int which = 0; which < WARDROBE; which++) {
        for (int floor = 0; floor < 3; floor++) {
            for (int lights = 0; lights < 4; lights++) {
                check_dressed(which, floor, lights);
            }
        }
    }
}

static void photons_are_split_by_need(void)
{
    static const struct {
        uint64_t total;
        bool traced[PM_MAP_COUNT];
        uint64_t want[PM_MAP_COUNT];
    } cases[] = {
        {1000, {true, true, true}, {400, 400, 200}},
        {1000, {true, true, false}, {500, 500, 0}},
        {1000, {true, false, true}, {666, 0, 334}},
        {1000, {false, true, false}, {0, 1000, 0}},
        {1000, {false, false, false}, {0, 0, 0}},
        {1, {true, false, false}, {1, 0, 0}},
        {9007199254740992u,
         {true, true, true},
         {3602879701896396u, 3602879701896397u, 1801439850948199u}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        uint64_t got[PM_MAP_COUNT] = {7, 7, 7};
        CHECK_OK(pm_plan_split(cases[i].total, cases[i].traced, got));
        for (int kind = 0; kind < PM_MAP_COUNT; kind++) {
            CHECK_THAT(got[kind] == cases[i].want[kind], "case %zu, map %d: got %llu", i, kind,
                       (unsigned long long)got[kind]);
        }
    }
}

static void too_few_photons_are_refused(void)
{
    const bool both[PM_MAP_COUNT] = {true, true, false};
    uint64_t photons[PM_MAP_COUNT] = {7, 7, 7};
    CHECK_FAILS(pm_plan_split(1, both, photons), PM_EINPUT,
                "--photons must leave a photon for each map that the scene needs, got 1");
    CHECK(photons[0] == 7 && photons[1] == 7 && photons[2] == 7);
    CHECK_OK(pm_plan_split(2, both, photons));
    CHECK(photons[0] == 1 && photons[1] == 1 && photons[2] == 0);
}

static void projection_is_planned_from_what_is_aimed(void)
{
    pm_projection light = {0};
    pm_projections aimed = {.light = &light, .sent = 0.25, .why = "aimed at ball"};
    pm_projections idle = {.sent = 1.0, .why = "not worth it"};
    pm_plan plan = {0};
    pm_plan_aim(&plan, (const pm_projections *[PM_MAP_COUNT]){&idle, NULL, NULL});
    CHECK(!plan.item[PM_PLAN_PROJECTION].needed);
    CHECK_CONTAINS(plan.item[PM_PLAN_PROJECTION].why, "global map: not worth it");
    pm_plan_aim(&plan, (const pm_projections *[PM_MAP_COUNT]){&idle, &aimed, NULL});
    CHECK(plan.item[PM_PLAN_PROJECTION].needed);
    CHECK_CONTAINS(plan.item[PM_PLAN_PROJECTION].why,
                   "global map: not worth it; caustic map: aimed at ball (75 % of the power is "
                   "never sent)");
}

static void no_emitter_needs_nothing(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_wear(&s, pm_scenes_square(1.0, 0.0, false), pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_ready(&s);
    pm_plan plan = pm_plan_scene(&s.scene);
    for (pm_plan_part part = PM_PLAN_DIRECT; part < PM_PLAN_COUNT; part++) {
        CHECK(!plan.item[part].needed);
    }
    CHECK_CONTAINS(plan.item[PM_PLAN_INDIRECT].why, "no light has any power");
    pm_scenes_free(&s);
}

static void reasons_name_what_is_there(void)
{
    pm_scenes s;
    build(&s, &expectations[3]);
    pm_plan plan = pm_plan_scene(&s.scene);
    CHECK_CONTAINS(plan.item[PM_PLAN_DIRECT].why, "point");
    CHECK_CONTAINS(plan.item[PM_PLAN_DIRECT].why, "floor");
    CHECK_CONTAINS(plan.item[PM_PLAN_SPECULAR].why, "ball");
    CHECK_CONTAINS(plan.item[PM_PLAN_CAUSTIC].why, "ball");
    CHECK_CONTAINS(plan.item[PM_PLAN_CAUSTIC].why, "floor");
    pm_scenes_free(&s);
    build(&s, &expectations[0]);
    plan = pm_plan_scene(&s.scene);
    CHECK_CONTAINS(plan.item[PM_PLAN_CAUSTIC].why, "no mirror, glass");
    pm_scenes_free(&s);
    build(&s, &expectations[1]);
    plan = pm_plan_scene(&s.scene);
    CHECK_CONTAINS(plan.item[PM_PLAN_INDIRECT].why, "no diffuse surface reflects");
    pm_scenes_free(&s);
}

static void indirect_names_what_reflects(void)
{
    // Not the black floor that comes first.
    pm_scenes s;
    build(&s, &expectations[1]);
    pm_scenes_free(&s);
    int gray = pm_scenes_diffuse(&s, pm_gray(0.5));
    int wall = pm_scenes_wear(&s, pm_scenes_square(1.0, 2.0, true), gray);
    s.shapes[wall].id = "wall";
    pm_scenes_ready(&s);
    pm_plan plan = pm_plan_scene(&s.scene);
    CHECK(plan.item[PM_PLAN_INDIRECT].needed);
    CHECK_CONTAINS(plan.item[PM_PLAN_INDIRECT].why, "wall");
    pm_scenes_free(&s);
}

static void long_names_are_cut_whole(void)
{
    char name[400];
    memset(name, 'x', sizeof name - 1);
    name[sizeof name - 1] = '\0';
    pm_scenes s;
    build(&s, &expectations[2]);
    s.shapes[0].id = name;
    s.shapes[1].id = name;
    pm_plan plan = pm_plan_scene(&s.scene);
    CHECK(plan.item[PM_PLAN_CAUSTIC].needed);
    CHECK(strlen(plan.item[PM_PLAN_CAUSTIC].why) == sizeof plan.item[0].why - 1);
    pm_scenes_free(&s);
}

static void parts_have_names(void)
{
    static const char *const names[PM_PLAN_COUNT] = {
        "direct", "specular", "caustic", "indirect", "volume", "dispersion", "projection"};
    for (pm_plan_part part = PM_PLAN_DIRECT; part < PM_PLAN_COUNT; part++) {
        CHECK(strcmp(pm_plan_name(part), names[part]) == 0);
    }
}

PM_TESTS({"plan.1", "each part of light transport is planned where the scene has it, else not",
          scenes_ask_for_their_parts},
         {"plan.2", "a scene without an emitter needs nothing", no_emitter_needs_nothing},
         {"plan.3", "reasons name the light and the shapes", reasons_name_what_is_there},
         {"plan.6", "the reason for indirect light names a surface that reflects",
          indirect_names_what_reflects},
         {"plan.4", "long names do not overrun a reason", long_names_are_cut_whole},
         {"plan.7", "every material, floor and light asks for the parts of its lobes",
          every_material_is_planned_for},
         {"plan.8", "photons are split among the maps that are traced, as 2 : 2 : 1",
          photons_are_split_by_need},
         {"plan.9", "too few photons for the maps that are needed are refused",
          too_few_photons_are_refused},
         {"plan.10", "projection is planned for where a map's photons are aimed",
          projection_is_planned_from_what_is_aimed},
         {"plan.5", "parts are called as reports call them", parts_have_names})
