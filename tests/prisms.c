// The prism in its own plane: faces at 60 degrees, light bent towards the base.
#include "prisms.h"

#include "shapes.h"
#include "test.h"

#define APEX (PM_PI / 3.0)

static const double reach = 5.0; // of the prism along its edges, to either side

const pm_glass pm_prisms_even = {"even", 1, {1.25}, {0.0}};

int pm_prisms_glass(pm_scenes *s, const pm_glass *glass)
{
    int material = pm_scenes_glass(s, 1.0);
    s->materials[material].glass = glass;
    return material;
}

void pm_prisms_slab(pm_scenes *s, double thick, int material)
{
    pm_scenes_wear(s, pm_scenes_square(100.0, 0.0, false), material);
    pm_scenes_wear(s, pm_scenes_square(100.0, -thick, true), material);
}

void pm_prisms_prism(pm_scenes *s, int material)
{
    pm_vec3 along = pm_vec(0.0, 2.0 * reach, 0.0);
    pm_vec3 left = pm_vec(-0.5, -reach, 0.0);
    pm_vec3 right = pm_vec(0.5, -reach, 0.0);
    pm_vec3 up_left = pm_vec(0.5, 0.0, sin(APEX));
    pm_vec3 up_right = pm_vec(-0.5, 0.0, sin(APEX));
    pm_scenes_wear(s, pm_shapes_rectangle(left, up_left, along), material);
    pm_scenes_wear(s, pm_shapes_rectangle(right, along, up_right), material);
    pm_scenes_wear(s, pm_shapes_rectangle(left, along, pm_vec(1.0, 0.0, 0.0)), material);
}

/// Unit, in the plane of the prism, `angle` above x.
static pm_vec3 slope(double angle)
{
    return pm_vec(cos(angle), 0.0, sin(angle));
}

static const pm_vec3 middle_left = {-0.25, 0.0, 0.43301270189221932};

pm_ray pm_prisms_beam(double incidence)
{
    pm_vec3 direction = slope(incidence - 0.5 * APEX);
    pm_vec3 origin = pm_vec_along(middle_left, direction, -2.0);
    return (pm_ray){origin, direction, HUGE_VAL, 0.0, PM_NONE};
}

/// Unpolarised share that a face passes, by the sines and cosines of both sides.
static double passed(double index, double cos_i, double cos_t)
{
    double s = (cos_i - index * cos_t) / (cos_i + index * cos_t);
    double p = (index * cos_i - cos_t) / (index * cos_i + cos_t);
    return 1.0 - 0.5 * (s * s + p * p);
}

pm_prisms_way pm_prisms_snell(double incidence, double index)
{
    double within = asin(sin(incidence) / index);
    double second = APEX - within;
    CHECK(index * sin(second) < 1.0);
    double out = asin(index * sin(second));
    // Straight on inside: the right face is x = 1/2 - z / tan(60 degrees).
    pm_vec3 inside = slope(within - 0.5 * APEX);
    double gap = 0.5 - middle_left.x - middle_left.z / tan(APEX);
    double length = gap / (inside.x + inside.z / tan(APEX));
    double deviation = incidence + out - APEX;
    return (pm_prisms_way){
        .from = pm_vec_along(middle_left, inside, length),
        .direction = slope(incidence - 0.5 * APEX - deviation),
        .deviation = deviation,
        .through = passed(index, cos(incidence), cos(within)) *
                   passed(1.0 / index, cos(second), cos(out)),
    };
}

double pm_prisms_least(double index)
{
    return asin(index * sin(0.5 * APEX));
}

double pm_prisms_wavelength(const pm_rng_source *source, uint64_t photon)
{
    return pm_wavelength_at(pm_wavelength_spread(source, photon));
}
