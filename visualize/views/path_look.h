// How paths look: a colour for each thing that can happen to a photon, and one for each number
// of bounces. Tables alone, no VTK.
#ifndef PM_PATH_LOOK_H
#define PM_PATH_LOOK_H

#include "colours.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define PM_PATH_EVENTS 8
#define PM_PATH_BOUNCES 6 // colours: 0 to 4 bounces, and 5 or more

/// One kind of event: its letter in a dump, its colour, its words in a legend.
typedef struct {
    char event;
    pm_colour_name colour;
    const char *text;
} pm_path_look;

/// Look number `index`, below PM_PATH_EVENTS, in the order of legends.
const pm_path_look *pm_path_look_at(int index);

/// The number of this event's look.
/// @param event  one of L D S T V A E C
int pm_path_look_of(char event);

/// The colour of a stretch after `bounces` events: bright by the light, darker from bounce to
/// bounce.
pm_colour pm_path_bounce_colour(uint64_t bounces);

/// The number of the colour for `bounces` events, below PM_PATH_BOUNCES.
int pm_path_bounce_class(uint64_t bounces);

#ifdef __cplusplus
}
#endif
#endif
