// What the plan reads off scenes that have a thing, and off scenes that lack it.
#include "plan.h"

#include "scenes.h"
#include "shapes.h"
#include "test.h"

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

static void check_part(const pm_plan *plan, const expectation *e, pm_plan_part part, bool want)
{
    const pm_plan_item *item = &plan->item[part];
    CHECK_THAT(item->needed == want, "%s: %s is %sneeded (%s)", e->what, pm_plan_name(part),
               item->needed ? "" : "not ", item->why);
    size_t length = strlen(item->why);
    CHECK_THAT(length > 0 && item->why[length - 1] != '.', "%s: %s: why is \"%s\"", e->what,
               pm_plan_name(part), item->why);
}

static void scenes_ask_for_their_parts(void)
{
    for (int i = 0; i < EXPECTATIONS; i++) {
        const expectation *e = &expectations[i];
        pm_scenes s;
        build(&s, e);
        pm_plan plan = pm_plan_scene(&s.scene);
        check_part(&plan, e, PM_PLAN_DIRECT, e->direct);
        check_part(&plan, e, PM_PLAN_SPECULAR, e->specular);
        check_part(&plan, e, PM_PLAN_CAUSTIC, e->caustic);
        check_part(&plan, e, PM_PLAN_INDIRECT, e->indirect);
        check_part(&plan, e, PM_PLAN_VOLUME, false);
        check_part(&plan, e, PM_PLAN_DISPERSION, false);
        check_part(&plan, e, PM_PLAN_PROJECTION, false);
        CHECK(pm_plan_needs_map(&plan, PM_MAP_GLOBAL) == e->indirect);
        CHECK(pm_plan_needs_map(&plan, PM_MAP_CAUSTIC) == e->caustic);
        CHECK(!pm_plan_needs_map(&plan, PM_MAP_VOLUME));
        pm_scenes_free(&s);
    }
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
         {"plan.5", "parts are called as reports call them", parts_have_names})
