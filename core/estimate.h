// Lab 5. From photons to radiance: the density of the nearest photons, times what the surface
// does.
//
// With k photons found, the farthest sets the radius and is left out; its area is pi r_k^2, of
// a disc with r_k in its plane, so that curved surfaces are as bright as flat ones. With a
// finite reach and fewer found, all count and the area is that of the reach. Either way the
// mean is right for a uniform field when k >= 2. k = 1 gives 0. Without a reach, what was found
// stands for k.
#ifndef PM_ESTIMATE_H
#define PM_ESTIMATE_H

#include "balance.h"
#include "filter.h"
#include "material.h"
#include "rim.h"

typedef enum {
    PM_GATHER_DISC, // flattened along the normal
    PM_GATHER_SPHERE,
} pm_gather_shape;

typedef struct {
    uint32_t k;
    double radius; // reach [m], > 0; INFINITY: none
    pm_gather_shape shape;
    double flatness; // disc: height over radius
    pm_filter_kind filter;
    pm_filter_constants constants;
    bool plain_k;  // the lecture's form: k photons over pi r_k^2
    uint16_t skip; // photons with one of these flag bits are left out (PM_PHOTON_FIRST ...)
    uint16_t only; // photons without one of these are left out; 0: none is
} pm_estimate_settings;

/// k 100, no reach, disc of flatness 0.1, no filter, unbiased.
pm_estimate_settings pm_estimate_defaults(void);

/// Where an estimate is asked for.
typedef struct {
    pm_vec3 at;
    pm_vec3 normal; // unit, on the side that is looked at
} pm_estimate_point;

typedef struct {
    pm_spectrum value; // irradiance [W/m^2], radiance, or in-scattered radiance per length
    double radius;     // [m] that was used; 0 when nothing was found
    uint32_t found;    // photons in reach, at most k
    bool floored;      // the radius was below the spacing of float positions and raised to it
} pm_estimate;

/// Whether a photon counts at a point, and how far it is: the side test and the disc.
///
/// A photon whose surface faces away from `normal` is left out; one of a wall at right angles
/// is not. The stored surface normal decides: near grazing the packed direction of 3.6 % of the
/// photons points to the wrong side. Sphere: Euclidean distance. Disc: in-plane^2 + (height /
/// flatness)^2. Has the form of pm_accept_fn; `context` is a pm_estimate_query.
typedef struct {
    pm_estimate_point point;
    pm_gather_shape shape;
    double flatness;
    uint16_t skip, only; // as in the settings
} pm_estimate_query;
bool pm_estimate_accept(const void *context, const pm_photon *photon, double *distance2);

/// Irradiance [W/m^2] at a point.
///
/// @param map      balanced and scaled; read only, may be shared by threads
/// @param scratch  room for k, owned by the caller
/// @param out      [out] untouched unless PM_OK; value 0 when no photon is in reach
/// @return PM_EINPUT when the map is not balanced or not scaled, k is 0, the radius is not
///         positive or the flatness not in (0, 1]
/// @source Jensen 2001, ch. 7; the (k-1) form: Garcia et al., CGF 31(1), 2012
pm_status pm_estimate_irradiance(const pm_photon_map *map, const pm_estimate_settings *settings,
                                 const pm_estimate_point *point, pm_neighbour *scratch,
                                 pm_estimate *out);

/// Radiance [W/(m^2 sr)] that leaves `point` towards lobes->wi by the D lobes.
pm_status pm_estimate_radiance(const pm_photon_map *map, const pm_estimate_settings *settings,
                               const pm_estimate_point *point, const pm_lobes *lobes,
                               pm_neighbour *scratch, pm_estimate *out);

/// Radiance scattered towards `wo` per length [W/(m^3 sr)] in `medium`, from a volume map; the
/// sphere's (4/3) pi r^3 in place of the disc's area. Without a medium: fluence [W/m^2] times
/// the extinction, that is the density of power colliding [W/m^3]. Shape and filter of the
/// settings are those of surfaces: here a plain ball with a constant kernel always gathers.
pm_status pm_estimate_volume(const pm_photon_map *map, const pm_estimate_settings *settings,
                             pm_vec3 at, const pm_medium *medium, pm_vec3 wo,
                             pm_neighbour *scratch, pm_estimate *out);

/// The same where the medium ends beside `at`: of the ball only the part before `rim` [m]
/// counts, its photons and its volume.
pm_status pm_estimate_beside(const pm_photon_map *map, const pm_estimate_settings *settings,
                             pm_vec3 at, const pm_rim *rim, const pm_medium *medium, pm_vec3 wo,
                             pm_neighbour *scratch, pm_estimate *out);

#endif
