// Lights as a surface sees them: a direction in which light may come, how much would come if
// nothing were between, and with what density such a direction is drawn. Shared by the shadow
// rays of pictures and by the reference.
#ifndef PM_LIGHT_H
#define PM_LIGHT_H

#include "intersect.h"

/// One draw of light that arrives at a point.
typedef struct {
    pm_vec3 direction;    // unit, from the point to the light
    pm_vec3 target;       // where a shadow ray ends, off the light's own surface
    bool endless;         // from outside the scene: no target
    pm_spectrum radiance; // arriving unshadowed over the density: weigh it by f |cos| and add.
                          // Points, spots, directional: their irradiance on a plane facing them
    double pdf; // [1/sr] of the direction; 0 where no ray would ever meet the light by
                // chance
} pm_light_sample;

/// Draws a point of `light` with two uniform numbers, as seen from `from`.
///
/// Area lights are drawn uniformly over their surface. The constant light is not drawn at all:
/// directions that a surface's own lobes draw find it better, everywhere.
/// @return false when nothing can come that way (its back, outside the spot, constant)
bool pm_light_sample_from(const pm_scene *scene, const pm_light *light, pm_vec3 from,
                          const double u[2], pm_light_sample *sample);

/// Where the point lies that these two numbers draw, from wherever it is seen.
/// @param place  [out] [m]; untouched when the light has none: directional, constant
bool pm_light_place(const pm_scene *scene, const pm_light *light, const double u[2],
                    pm_vec3 *place);

/// Share of the light drawn that gets to `from`: 0 where a surface other than null stands
/// between, else what media on the way let through; 1 in clear air.
///
/// @param from    where the shadow ray starts: a point in a medium, or pm_hit_leave() of a hit
/// @param medium  that it starts in
double pm_light_clear(const pm_intersector *world, pm_vec3 from, int medium,
                      const pm_light_sample *sample);

/// Density [1/sr] with which pm_light_sample_from() draws the point `hit` of an area light, as
/// seen from `from` along the unit `direction`; 0 from behind.
double pm_light_pdf(const pm_scene *scene, const pm_hit *hit, pm_vec3 from, pm_vec3 direction);

/// Radiance that the surface at `hit` emits towards the unit `wo`; 0 where it is no light.
pm_spectrum pm_light_emitted(const pm_scene *scene, const pm_hit *hit, pm_vec3 wo);

/// Radiance of all constant lights, which a ray that meets nothing sees.
pm_spectrum pm_light_sky(const pm_scene *scene);

/// Share of a spot's intensity at a cosine to its axis: 1 in the beam, 0 from the cutoff on.
double pm_light_falloff(const pm_light *light, double cosine);

/// A spot's flux over the intensity of its beam [sr]: the integral of that share over all
/// directions.
double pm_light_cone(const pm_light *light);

/// Its name in a scene file: "point" ...
const char *pm_light_name(pm_light_type type);

#endif
