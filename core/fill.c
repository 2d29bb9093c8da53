// For positions (x, y) even over the unit disc: var x = var y = 1/4, var (x^2 - y^2) = var 2xy
// = 1/6, var (x^2 + y^2) = 1/12.
#include "fill.h"

#define LEAST 0.09       // what no number of photons makes a fault
#define CHI_SQUARE 11.07 // five degrees of freedom, one in twenty

/// Sums over positions in the unit disc.
typedef struct {
    double x, y, square, across, aslant;
} moments;

static void add(moments *sum, double x, double y)
{
    sum->x += x;
    sum->y += y;
    sum->square += x * x + y * y - 0.5;
    sum->across += x * x - y * y;
    sum->aslant += 2.0 * x * y;
}

double pm_fill_unevenness(const pm_photon_map *map, const pm_neighbour *nearest,
                          const pm_estimate *found, const pm_estimate_point *point)
{
    if (found->found == 0) {
        return 0.0;
    }
    pm_frame frame = pm_frame_around(point->normal);
    moments sum = {0};
    for (uint32_t i = 0; i < found->found; i++) {
        const float *at = map->photons[nearest[i].index].position;
        pm_vec3 position = pm_vec((double)at[0], (double)at[1], (double)at[2]);
        pm_vec3 away = pm_vec_sub(position, point->at);
        add(&sum, pm_vec_dot(away, frame.s) / found->radius,
            pm_vec_dot(away, frame.t) / found->radius);
    }
    double squares = 4.0 * (sum.x * sum.x + sum.y * sum.y) +
                     6.0 * (sum.across * sum.across + sum.aslant * sum.aslant) +
                     12.0 * sum.square * sum.square;
    return squares / ((double)found->found * found->found);
}

bool pm_fill_is_uneven(double unevenness, uint32_t found)
{
    return unevenness > LEAST && unevenness * found > CHI_SQUARE;
}
