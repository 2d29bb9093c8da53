// Colours that everybody can tell apart: the Okabe-Ito set for kinds of things, two sequential
// maps for amounts, one for what is too little or too much. All are 8-bit sRGB.
// @source Okabe and Ito, "Color Universal Design", 2008; matplotlib's inferno and viridis
#ifndef PM_COLOURS_H
#define PM_COLOURS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    uint8_t r, g, b;
} pm_colour;

typedef enum {
    PM_COLOUR_ORANGE,
    PM_COLOUR_SKY,
    PM_COLOUR_GREEN,
    PM_COLOUR_YELLOW,
    PM_COLOUR_BLUE,
    PM_COLOUR_VERMILLION,
    PM_COLOUR_PURPLE,
    PM_COLOUR_WHITE,
    PM_COLOUR_GREY,
} pm_colour_name;

pm_colour pm_colour_named(pm_colour_name name);

/// The colour at `t` of a sequential map, dark at 0, bright at 1; beyond the ends the end's
/// own.
pm_colour pm_colour_inferno(double t);
pm_colour pm_colour_viridis(double t);

/// Blue at 0, white at 0.5, orange at 1: too little, right, too much. Beyond the ends as above.
pm_colour pm_colour_diverging(double t);

/// Linear red, green, blue in [0, 1] (more is full) with gamma 2.2.
pm_colour pm_colour_linear(double r, double g, double b);

/// `colour` times `f` in [0, 1], without a care for gamma.
pm_colour pm_colour_dim(pm_colour colour, double f);

#ifdef __cplusplus
}
#endif
#endif
