// What surfaces and media scatter and what lights send decides it; only materials that a shape
// wears count, and only media that light can get into.
#include "plan.h"

#include "map_make.h"
#include "material.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/// What the scene has, by the first example of each.
typedef struct {
    const char *diffuse;    // shape that scatters diffusely, a black one too
    const char *reflecting; // shape of which some diffuse light comes back
    const char *specular;   // shape with an S lobe
    const char *surface;    // what that S lobe belongs to
    const char *dispersing; // shape of a glass that disperses, and its name
    const char *glass;
    const char *light; // light with power
    int powered;
    const pm_medium *hazy;    // medium that scatters
    const pm_medium *dimming; // that takes light, and scatters none
    const pm_medium *thin;    // that does nothing
    const pm_medium *sealed;  // that no light can get into
} pm_contents;

static const char *surface_word(pm_bsdf_type type)
{
    switch (type) {
    case PM_BSDF_DIELECTRIC:
        return "glass";
    case PM_BSDF_THIN_DIELECTRIC:
        return "a pane";
    case PM_BSDF_ROUGH_CONDUCTOR:
        return "polished metal";
    case PM_BSDF_PLASTIC:
    case PM_BSDF_ROUGH_PLASTIC:
        return "a smooth coat";
    default:
        return "a mirror";
    }
}

static void look_at_side(const pm_scene *scene, const pm_shape *shape, int side,
                         pm_contents *contents)
{
    int index = shape->material[side];
    if (index == PM_NONE) {
        return;
    }
    const pm_material *material = &scene->materials[index];
    pm_material_traits traits = pm_material_traits_of(material);
    if (traits.diffuse && contents->diffuse == NULL) {
        contents->diffuse = shape->id;
    }
    if (traits.reflecting && contents->reflecting == NULL) {
        contents->reflecting = shape->id;
    }
    if (traits.specular && contents->specular == NULL) {
        contents->specular = shape->id;
        contents->surface = surface_word(material->type);
    }
    if (material->glass != NULL && contents->dispersing == NULL) {
        contents->dispersing = shape->id;
        contents->glass = material->glass->name;
    }
}

/// Whether some light can leave a shape on this side of it: through it, or thrown back.
static bool sends_on(const pm_scene *scene, const pm_shape *shape, int side)
{
    if (shape->material[side] == PM_NONE) {
        return false; // absorbs; and nothing passes the material on the other side alone
    }
    const pm_material *material = &scene->materials[shape->material[side]];
    return material->type != PM_BSDF_DIFFUSE || !pm_spectrum_is_black(material->reflectance);
}

/// Whether light can get into a medium: it leaves a shape into it, or starts in it. The
/// camera's does not count: what no light is in, no eye sees.
static bool is_open(const pm_scene *scene, int medium)
{
    for (int i = 0; i < scene->shape_count; i++) {
        const pm_shape *shape = &scene->shapes[i];
        bool before = shape->exterior == medium && sends_on(scene, shape, 0);
        bool behind = shape->interior == medium && sends_on(scene, shape, 1);
        if (shape->boundary && (before || behind)) {
            return true;
        }
    }
    for (int i = 0; i < scene->light_count; i++) {
        const pm_light *light = &scene->lights[i];
        if (light->medium == medium && !pm_spectrum_is_black(light->flux)) {
            return true;
        }
    }
    return false;
}

static void look_at_medium(const pm_scene *scene, int index, pm_contents *contents)
{
    const pm_medium *medium = &scene->media[index];
    const pm_medium **first = &contents->hazy;
    if (!is_open(scene, index)) {
        first = &contents->sealed;
    } else if (medium->sigma_t == 0.0) {
        first = &contents->thin;
    } else if (pm_spectrum_is_black(medium->albedo)) {
        first = &contents->dimming;
    }
    if (*first == NULL) {
        *first = medium;
    }
}

static pm_contents look_around(const pm_scene *scene)
{
    pm_contents contents = {0};
    for (int i = 0; i < scene->shape_count; i++) {
        look_at_side(scene, &scene->shapes[i], 0, &contents);
        look_at_side(scene, &scene->shapes[i], 1, &contents);
    }
    for (int i = 0; i < scene->medium_count; i++) {
        look_at_medium(scene, i, &contents);
    }
    for (int i = 0; i < scene->light_count; i++) {
        if (pm_spectrum_is_black(scene->lights[i].flux)) {
            continue;
        }
        if (contents.powered++ == 0) {
            contents.light = scene->lights[i].id;
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

static void plan_direct(pm_plan *plan, const pm_contents *has)
{
    if (has->diffuse == NULL) {
        decide(plan, PM_PLAN_DIRECT, false, "no surface scatters diffusely");
    } else if (has->powered == 1) {
        decide(plan, PM_PLAN_DIRECT, true, "%s lights diffuse surfaces such as %s", has->light,
               has->diffuse);
    } else {
        decide(plan, PM_PLAN_DIRECT, true, "%s and %d more light diffuse surfaces such as %s",
               has->light, has->powered - 1, has->diffuse);
    }
}

static void plan_specular(pm_plan *plan, const pm_contents *has)
{
    static const char none[] = "no mirror, glass, pane, polished metal or smooth coat";
    if (has->specular == NULL) {
        decide(plan, PM_PLAN_SPECULAR, false, "%s", none);
        decide(plan, PM_PLAN_CAUSTIC, false, "%s", none);
        return;
    }
    decide(plan, PM_PLAN_SPECULAR, true, "%s has %s, in which other things are seen",
           has->specular, has->surface);
    if (has->diffuse == NULL) {
        decide(plan, PM_PLAN_CAUSTIC, false, "nothing diffuse to catch it");
    } else {
        decide(plan, PM_PLAN_CAUSTIC, true,
               "%s has %s, which can throw light onto diffuse surfaces such as %s",
               has->specular, has->surface, has->diffuse);
    }
}

static void plan_indirect(pm_plan *plan, const pm_contents *has)
{
    if (has->reflecting == NULL) {
        decide(plan, PM_PLAN_INDIRECT, false, "no diffuse surface reflects");
    } else if (has->hazy != NULL) {
        decide(plan, PM_PLAN_INDIRECT, true,
               "diffuse surfaces such as %s pass light on, and %s scatters light onto them",
               has->reflecting, has->hazy->id);
    } else {
        decide(plan, PM_PLAN_INDIRECT, true, "diffuse surfaces such as %s pass light on",
               has->reflecting);
    }
}

static void plan_volume(pm_plan *plan, const pm_contents *has)
{
    if (has->hazy != NULL) {
        decide(plan, PM_PLAN_VOLUME, true,
               "%s scatters light: that of %s, and what comes back from elsewhere",
               has->hazy->id, has->light);
    } else if (has->dimming != NULL) {
        decide(plan, PM_PLAN_VOLUME, false,
               "%s takes light on its way and scatters none: its albedo is 0",
               has->dimming->id);
    } else if (has->thin != NULL) {
        decide(plan, PM_PLAN_VOLUME, false, "%s lets all light pass: its extinction is 0",
               has->thin->id);
    } else if (has->sealed != NULL) {
        decide(plan, PM_PLAN_VOLUME, false, "no light gets into %s", has->sealed->id);
    } else {
        decide(plan, PM_PLAN_VOLUME, false, "no medium");
    }
}

static void plan_dispersion(pm_plan *plan, const pm_contents *has)
{
    if (has->dispersing == NULL) {
        decide(plan, PM_PLAN_DISPERSION, false, "no glass that disperses");
    } else {
        decide(plan, PM_PLAN_DISPERSION, true,
               "%s is of %s, which bends blue light more than red: a path through it has one "
               "wavelength",
               has->dispersing, has->glass);
    }
}

pm_plan pm_plan_scene(const pm_scene *scene)
{
    pm_plan plan = {0};
    pm_contents has = look_around(scene);
    decide(&plan, PM_PLAN_PROJECTION, false, "no photon map is traced");
    if (has.powered > 0) {
        plan_direct(&plan, &has);
        plan_specular(&plan, &has);
        plan_indirect(&plan, &has);
        plan_volume(&plan, &has);
        plan_dispersion(&plan, &has);
        return plan;
    }
    for (pm_plan_part part = PM_PLAN_DIRECT; part <= PM_PLAN_DISPERSION; part++) {
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

void pm_plan_aim(pm_plan *plan, const pm_projections *const aim[PM_MAP_COUNT])
{
    char said[sizeof plan->item[0].why] = "";
    bool needed = false;
    for (pm_map_kind kind = 0; kind < PM_MAP_COUNT; kind++) {
        if (aim[kind] == NULL) {
            continue;
        }
        size_t used = strlen(said);
        const char *between = used > 0 ? "; " : "";
        snprintf(said + used, sizeof said - used, "%s%s map: %s", between, pm_map_name(kind),
                 aim[kind]->why);
        if (pm_projection_of(aim[kind]) != NULL) {
            needed = true;
            used = strlen(said);
            snprintf(said + used, sizeof said - used, " (%.3g %% of the power is never sent)",
                     100.0 * (1.0 - aim[kind]->sent));
        }
    }
    if (said[0] != '\0') {
        decide(plan, PM_PLAN_PROJECTION, needed, "%s", said);
    }
}

void pm_plan_miss(pm_plan *plan, pm_plan_part part, const char *what)
{
    pm_plan_item *item = &plan->item[part];
    item->missing = true;
    snprintf(item->left_out, sizeof item->left_out, "%s", what);
}

pm_status pm_plan_split(uint64_t total, const bool traced[PM_MAP_COUNT],
                        uint64_t photons[PM_MAP_COUNT])
{
    static const uint64_t weight[PM_MAP_COUNT] = {2, 2, 1};
    uint64_t weights = 0;
    for (int kind = 0; kind < PM_MAP_COUNT; kind++) {
        weights += traced[kind] ? weight[kind] : 0;
    }
    uint64_t split[PM_MAP_COUNT] = {0};
    uint64_t left = total;
    for (int kind = 0; kind < PM_MAP_COUNT; kind++) {
        if (!traced[kind]) {
            continue;
        }
        split[kind] = left / weights * weight[kind] + left % weights * weight[kind] / weights;
        left -= split[kind];
        weights -= weight[kind];
        if (split[kind] == 0) {
            return pm_status_fail(
                PM_EINPUT,
                "render: --photons must leave a photon for each map that the scene "
                "needs, got %llu",
                (unsigned long long)total);
        }
    }
    memcpy(photons, split, sizeof split);
    return PM_OK;
}

const char *pm_plan_name(pm_plan_part part)
{
    static const char *const names[PM_PLAN_COUNT] = {
        "direct", "specular", "caustic", "indirect", "volume", "dispersion", "projection"};
    return names[part];
}

const char *pm_plan_paths(const pm_plan *plan, pm_plan_part part)
{
    static const char *const clear[PM_PLAN_COUNT] = {
        "LD", "L{S|D}*S", "LS+D", "L{S|D}*D{S|D}*D", "", "", ""};
    static const char *const hazy[PM_PLAN_COUNT] = {
        "LD", "L{S|D|V}*S", "LS+D", "L{S|D|V}*{D|V}{S|D|V}*D", "L{S|D|V}*V", "", ""};
    return plan->item[PM_PLAN_VOLUME].needed ? hazy[part] : clear[part];
}
