// Below an albedo of 0.9999 roulette ends paths soon enough by itself.
#include "caps.h"

#include "material.h"

#define DIFFUSE_CAP 10000u
#define DIFFUSE_CAP_ABOVE 0.9999
#define SPECULAR_CAP 1000u

static bool needs_cap(const pm_scene *scene)
{
    for (int i = 0; i < scene->material_count; i++) {
        if (pm_material_traits_of(&scene->materials[i]).albedo > DIFFUSE_CAP_ABOVE) {
            return true;
        }
    }
    for (int i = 0; i < scene->medium_count; i++) {
        if (pm_spectrum_max(scene->media[i].albedo) > DIFFUSE_CAP_ABOVE) {
            return true;
        }
    }
    return false;
}

pm_caps pm_caps_of(const pm_scene *scene, uint32_t asked)
{
    if (asked != 0) {
        return (pm_caps){asked, asked};
    }
    return (pm_caps){needs_cap(scene) ? DIFFUSE_CAP : UINT32_MAX, SPECULAR_CAP};
}
