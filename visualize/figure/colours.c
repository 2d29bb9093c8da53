// Tables of colours, typed in, so that they do not depend on what a library happens to ship.
#include "colours.h"

#include <math.h>

#define STOPS 11

static const pm_colour inferno[STOPS] = {
    {0, 0, 4},      {22, 11, 57},   {66, 10, 104},   {106, 23, 110},
    {147, 38, 103}, {188, 55, 84},  {221, 81, 58},   {243, 120, 25},
    {252, 165, 10}, {246, 215, 70}, {252, 255, 164},
};

static const pm_colour viridis[STOPS] = {
    {68, 1, 84},    {72, 36, 117},  {65, 68, 135},  {53, 95, 141},
    {42, 120, 142}, {33, 145, 140}, {34, 168, 132}, {68, 191, 112},
    {122, 209, 81}, {189, 223, 38}, {253, 231, 37},
};

// As dark at one end as at the other, so that neither sign looks the stronger.
static const pm_colour blue_orange[STOPS] = {
    {0, 70, 138},    {30, 108, 176},  {88, 150, 204},  {148, 190, 224},
    {204, 222, 237}, {245, 245, 245}, {252, 220, 184}, {247, 187, 116},
    {237, 147, 54},  {208, 106, 14},  {152, 70, 0},
};

pm_colour pm_colour_named(pm_colour_name name)
{
    static const pm_colour named[] = {
        [PM_COLOUR_ORANGE] = {230, 159, 0},   [PM_COLOUR_SKY] = {86, 180, 233},
        [PM_COLOUR_GREEN] = {0, 158, 115},    [PM_COLOUR_YELLOW] = {240, 228, 66},
        [PM_COLOUR_BLUE] = {0, 114, 178},     [PM_COLOUR_VERMILLION] = {213, 94, 0},
        [PM_COLOUR_PURPLE] = {204, 121, 167}, [PM_COLOUR_WHITE] = {245, 245, 245},
        [PM_COLOUR_GREY] = {150, 154, 165},
    };
    return named[name];
}

static uint8_t byte_of(double v)
{
    return (uint8_t)lrint(255.0 * fmin(fmax(v, 0.0), 1.0));
}

static pm_colour blend(pm_colour a, pm_colour b, double t)
{
    return (pm_colour){byte_of((a.r + (b.r - a.r) * t) / 255.0),
                       byte_of((a.g + (b.g - a.g) * t) / 255.0),
                       byte_of((a.b + (b.b - a.b) * t) / 255.0)};
}

static pm_colour look_up(const pm_colour *stops, double t)
{
    double at = fmin(fmax(t, 0.0), 1.0) * (STOPS - 1);
    int below = at < STOPS - 1 ? (int)at : STOPS - 2;
    return blend(stops[below], stops[below + 1], at - below);
}

pm_colour pm_colour_inferno(double t)
{
    return look_up(inferno, t);
}

pm_colour pm_colour_viridis(double t)
{
    return look_up(viridis, t);
}

pm_colour pm_colour_diverging(double t)
{
    return look_up(blue_orange, t);
}

pm_colour pm_colour_linear(double r, double g, double b)
{
    return (pm_colour){byte_of(pow(fmax(r, 0.0), 1.0 / 2.2)),
                       byte_of(pow(fmax(g, 0.0), 1.0 / 2.2)),
                       byte_of(pow(fmax(b, 0.0), 1.0 / 2.2))};
}

pm_colour pm_colour_dim(pm_colour colour, double f)
{
    return blend((pm_colour){0, 0, 0}, colour, f);
}
