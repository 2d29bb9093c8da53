// Warm for light that surfaces scatter, cool for light that goes where a mirror or a glass
// sends it.
#include "path_look.h"

static const pm_path_look looks[PM_PATH_EVENTS] = {
    {'L', PM_COLOUR_YELLOW, "leaves the light"}, {'D', PM_COLOUR_ORANGE, "diffuse bounce"},
    {'S', PM_COLOUR_SKY, "specular: mirrored"},  {'T', PM_COLOUR_GREEN, "transmitted: glass"},
    {'V', PM_COLOUR_BLUE, "medium: scattered"},  {'A', PM_COLOUR_PURPLE, "absorbed"},
    {'E', PM_COLOUR_GREY, "escaped (fades)"},    {'C', PM_COLOUR_VERMILLION, "cut by the cap"},
};

const pm_path_look *pm_path_look_at(int index)
{
    return &looks[index];
}

int pm_path_look_of(char event)
{
    int i = 0;
    while (i + 1 < PM_PATH_EVENTS && looks[i].event != event) {
        i++;
    }
    return i;
}

int pm_path_bounce_class(uint64_t bounces)
{
    return bounces < PM_PATH_BOUNCES ? (int)bounces : PM_PATH_BOUNCES - 1;
}

pm_colour pm_path_bounce_colour(uint64_t bounces)
{
    // Steps that look alike; what lies lower is lost on the dark ground.
    static const double stops[PM_PATH_BOUNCES] = {1.0, 0.84, 0.73, 0.62, 0.51, 0.38};
    return pm_colour_inferno(stops[pm_path_bounce_class(bounces)]);
}
