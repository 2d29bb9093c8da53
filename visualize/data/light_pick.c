// The order of the colours follows how far apart they are on a dark ground.
#include "light_pick.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

static void list_ids(const pm_scene *scene, char *text, size_t room)
{
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; i < scene->light_count && used < room; i++) {
        int more =
            snprintf(text + used, room - used, "%s%s", i > 0 ? ", " : "", scene->lights[i].id);
        used += more > 0 ? (size_t)more : 0;
    }
}

pm_status pm_light_pick(const pm_scene *scene, const char *id, int *light)
{
    char ids[256];
    if (id == NULL) {
        *light = PM_NONE;
        return PM_OK;
    }
    for (int i = 0; i < scene->light_count; i++) {
        if (strcmp(scene->lights[i].id, id) == 0) {
            *light = i;
            return PM_OK;
        }
    }
    list_ids(scene, ids, sizeof ids);
    return pm_status_fail(PM_EINPUT,
                          "view: --light must be one of %s's lights (%s), got \"%s\"",
                          scene->path, ids, id);
}

pm_colour pm_light_colour(int light)
{
    static const pm_colour_name order[PM_LIGHT_COLOURS] = {
        PM_COLOUR_ORANGE, PM_COLOUR_SKY,        PM_COLOUR_GREEN, PM_COLOUR_YELLOW,
        PM_COLOUR_PURPLE, PM_COLOUR_VERMILLION, PM_COLOUR_BLUE,
    };
    return pm_colour_named(light < PM_LIGHT_COLOURS ? order[light] : PM_COLOUR_GREY);
}
