// What surfaces scatter and what lights send decides it; only materials that a shape wears
// count.
#include "plan.h"

#include <stdarg.h>
#include <stdio.h>

/// What the scene has, by the first example of each.
typedef struct {
    const char *diffuse;    // shape that scatters diffusely, a black one too
    const char *reflecting; // diffuse shape of an albedo above 0
    const char *specular;   // shape with a mirror or glass on it
    const char *light;      // light with power
    int powered;
} pm_contents;

static void look_at_side(const pm_scene *scene, const pm_shape *shape, int side,
                         pm_contents *contents)
{
    int index = shape->material[side];
    if (index == PM_NONE) {
        return;
    }
    const pm_material *material = &scene->materials[index];
    bool diffuse = material->type == PM_BSDF_DIFFUSE;
    bool specular = material->type == PM_BSDF_DIELECTRIC || material->type == PM_BSDF_CONDUCTOR;
    if (diffuse && contents->diffuse == NULL) {
        contents->diffuse = shape->id;
    }
    if (specular && contents->specular == NULL) {
        contents->specular = shape->id;
    }
    bool reflecting = diffuse && !pm_spectrum_is_black(material->reflectance);
    if (reflecting && contents->reflecting == NULL) {
        contents->reflecting = shape->id;
    }
}

static pm_contents look_around(const pm_scene *scene)
{
    pm_contents contents = {0};
    for (int i = 0; i < scene->shape_count; i++) {
        look_at_side(scene, &scene->shapes[i], 0, &contents);
        look_at_side(scene, &scene->shapes[i], 1, &contents);
    }
    for (int i = 0; i < scene->light_count; i++) {
        if (!pm_spectrum_is_black(scene->lights[i].flux)) {
            contents.light = scene->lights[i].id;
            contents.powered++;
        }
    }
    return contents;
}

#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
static void
decide(pm_plan *plan, pm_plan_part part, bool needed, const char *format, ...)
{
    pm_plan_item *item = &plan->item[part];
    item->needed = needed;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(item->why, sizeof item->why, format, arguments);
    va_end(arguments);
}

static void plan_surfaces(pm_plan *plan, const pm_contents *has)
{
    if (has->diffuse != NULL) {
        decide(plan, PM_PLAN_DIRECT, true, "%s lights diffuse surfaces such as %s", has->light,
               has->diffuse);
    } else {
        decide(plan, PM_PLAN_DIRECT, false, "no surface scatters diffusely");
    }
    if (has->specular != NULL) {
        decide(plan, PM_PLAN_SPECULAR, true, "%s mirrors or refracts what is seen",
               has->specular);
    } else {
        decide(plan, PM_PLAN_SPECULAR, false, "no mirror and no glass");
    }
    if (has->specular != NULL && has->diffuse != NULL) {
        decide(plan, PM_PLAN_CAUSTIC, true, "%s can throw light onto diffuse %s", has->specular,
               has->diffuse);
    } else {
        decide(plan, PM_PLAN_CAUSTIC, false, "%s",
               has->specular == NULL ? "no mirror and no glass"
                                     : "nothing diffuse to catch it");
    }
    if (has->reflecting != NULL) {
        decide(plan, PM_PLAN_INDIRECT, true, "diffuse surfaces such as %s pass light on",
               has->reflecting);
    } else {
        decide(plan, PM_PLAN_INDIRECT, false, "no diffuse surface reflects");
    }
}

pm_plan pm_plan_scene(const pm_scene *scene)
{
    pm_plan plan = {0};
    pm_contents has = look_around(scene);
    decide(&plan, PM_PLAN_VOLUME, false, "no medium");
    decide(&plan, PM_PLAN_DISPERSION, false, "no glass that disperses");
    decide(&plan, PM_PLAN_PROJECTION, false, "photons are sent everywhere");
    if (has.powered > 0) {
        plan_surfaces(&plan, &has);
        return plan;
    }
    for (pm_plan_part part = PM_PLAN_DIRECT; part <= PM_PLAN_INDIRECT; part++) {
        decide(&plan, part, false, "no light has any power");
    }
    return plan;
}

bool pm_plan_needs_map(const pm_plan *plan, pm_map_kind kind)
{
    static const pm_plan_part part[PM_MAP_COUNT] = {
        [PM_MAP_GLOBAL] = PM_PLAN_INDIRECT,
        [PM_MAP_CAUSTIC] = PM_PLAN_CAUSTIC,
        [PM_MAP_VOLUME] = PM_PLAN_VOLUME,
    };
    return plan->item[part[kind]].needed;
}

void pm_plan_miss(pm_plan *plan, pm_plan_part part, const char *what)
{
    decide(plan, part, true, "%s", what);
    plan->item[part].missing = true;
}

const char *pm_plan_name(pm_plan_part part)
{
    static const char *const names[PM_PLAN_COUNT] = {
        "direct", "specular", "caustic", "indirect", "volume", "dispersion", "projection"};
    return names[part];
}
