// A sentence from what lights, materials and media there are; geometry is not asked, so it may
// speak of light that does not reach the glass.
#include "reference_blind.h"

#include "light.h"
#include "light_tracer.h"
#include "material.h"

#include <stdio.h>
#include <string.h>

/// What of the scene's materials is worn by some shape.
static pm_material_traits worn_traits(const pm_scene *scene, bool *spreads)
{
    pm_material_traits all = {0};
    *spreads = false;
    for (int i = 0; i < scene->shape_count; i++) {
        for (int side = 0; side < 2; side++) {
            int worn = scene->shapes[i].material[side];
            if (worn == PM_NONE) {
                continue;
            }
            pm_material_traits traits = pm_material_traits_of(&scene->materials[worn]);
            all.delta = all.delta || traits.delta;
            *spreads = *spreads || traits.reflecting || (traits.specular && !traits.delta);
        }
    }
    return all;
}

/// "point and spot": the kinds of lights without extent that send power.
static void name_lights(const pm_scene *scene, char *names, size_t room)
{
    static const pm_light_type types[] = {PM_LIGHT_POINT, PM_LIGHT_SPOT, PM_LIGHT_DIRECTIONAL};
    names[0] = '\0';
    for (int t = 0; t < 3; t++) {
        for (int i = 0; i < scene->light_count; i++) {
            const pm_light *light = &scene->lights[i];
            if (light->type == types[t] && !pm_spectrum_is_black(light->flux)) {
                size_t used = strlen(names);
                snprintf(names + used, room - used, "%s%s", used > 0 ? " and " : "",
                         pm_light_name(light->type));
                break;
            }
        }
    }
}

static bool media_scatter(const pm_scene *scene)
{
    for (int i = 0; i < scene->medium_count; i++) {
        const pm_medium *medium = &scene->media[i];
        if (medium->sigma_t > 0.0 && !pm_spectrum_is_black(medium->albedo)) {
            return true;
        }
    }
    return false;
}

void pm_reference_blind(const pm_scene *scene, bool light_paths,
                        char sentence[PM_REFERENCE_BLIND_ROOM])
{
    bool spreads;
    pm_material_traits traits = worn_traits(scene, &spreads);
    bool fog = media_scatter(scene);
    char names[64];
    name_lights(scene, names, sizeof names);
    sentence[0] = '\0';
    if (names[0] == '\0' || !traits.delta || !(spreads || fog)) {
        return;
    }
    const char *where = fog ? ", in media too," : "";
    if (light_paths) {
        snprintf(
            sentence, PM_REFERENCE_BLIND_ROOM,
            "missing: what smooth glass and mirrors show of the caustics of %s lights%s and"
            " of the light these give",
            names, where);
    } else {
        snprintf(sentence, PM_REFERENCE_BLIND_ROOM,
                 "missing: caustics of %s lights by smooth glass and mirrors%s the indirect"
                 " light these give (--light-paths N traces both), and what glass and mirrors"
                 " show of them",
                 names, fog ? where : ",");
    }
}
