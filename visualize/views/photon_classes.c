// On the dark ground the sequence of bounces goes from bright to dark: what comes straight from
// a light stands out, as it does in the scene. It ends before its colours sink into the ground.
#include "photon_classes.h"

#include "map_make.h"

#include <stdio.h>

#define BOUNCES 6 // 0, 1, 2, 3, 4, and all above
#define LIGHTS 7  // that have a colour of their own
#define BRIGHTEST 1.0
#define DARKEST 0.32

static void add(pm_photon_classes *classes, const char *text, pm_colour colour)
{
    pm_photon_class *class = &classes->list[classes->count++];
    snprintf(class->text, sizeof class->text, "%s", text);
    class->colour = colour;
}

static void add_maps(pm_photon_classes *classes)
{
    static const pm_colour_name colours[PM_MAP_COUNT] = {PM_COLOUR_SKY, PM_COLOUR_ORANGE,
                                                         PM_COLOUR_GREEN};
    for (pm_map_kind map = 0; map < PM_MAP_COUNT; map++) {
        add(classes, pm_map_name(map), pm_colour_named(colours[map]));
    }
}

static void add_bounces(pm_photon_classes *classes)
{
    static const char *const texts[BOUNCES] = {"none", "1", "2", "3", "4", "5 or more"};
    for (int i = 0; i < BOUNCES; i++) {
        double at = BRIGHTEST + (DARKEST - BRIGHTEST) * i / (BOUNCES - 1);
        add(classes, texts[i], pm_colour_inferno(at));
    }
}

static void add_lights(pm_photon_classes *classes, const pm_scene *scene)
{
    static const pm_colour_name colours[LIGHTS] = {
        PM_COLOUR_ORANGE, PM_COLOUR_SKY,        PM_COLOUR_GREEN, PM_COLOUR_YELLOW,
        PM_COLOUR_PURPLE, PM_COLOUR_VERMILLION, PM_COLOUR_BLUE};
    for (int i = 0; i < scene->light_count && i < LIGHTS; i++) {
        add(classes, scene->lights[i].id, pm_colour_named(colours[i]));
    }
    if (scene->light_count > LIGHTS) {
        char text[PM_PHOTON_CLASS_TEXT];
        snprintf(text, sizeof text, "%d more lights", scene->light_count - LIGHTS);
        add(classes, text, pm_colour_named(PM_COLOUR_GREY));
    }
}

pm_photon_classes pm_photon_classes_make(pm_by by, const pm_scene *scene)
{
    pm_photon_classes classes = {.by = by};
    if (by == PM_BY_MAP) {
        add_maps(&classes);
    } else if (by == PM_BY_BOUNCE) {
        add_bounces(&classes);
    } else {
        add_lights(&classes, scene);
    }
    return classes;
}

static uint32_t number_of(pm_by by, const pm_photon_cloud *cloud, uint32_t i)
{
    if (by == PM_BY_MAP) {
        return (uint32_t)cloud->map;
    }
    return by == PM_BY_BOUNCE ? cloud->bounce[i] : cloud->light[i];
}

void pm_photon_classes_paint(pm_photon_classes *classes, const pm_photon_cloud *cloud,
                             pm_colour *colours)
{
    uint32_t last = (uint32_t)classes->count - 1;
    for (uint32_t i = 0; i < cloud->count; i++) {
        uint32_t number = number_of(classes->by, cloud, i);
        pm_photon_class *class = &classes->list[number < last ? number : last];
        colours[i] = class->colour;
        class->count++;
    }
}
