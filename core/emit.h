// Lab 1. Photons leave the lights: how many from each, from where, where to, with what power.
//
// Invariant: with n photons emitted, the power handed out is the flux of all lights times n,
// light by light and channel by channel; pm_store_scale() divides by n at the end.
#ifndef PM_EMIT_H
#define PM_EMIT_H

#include "intersect.h"
#include "rng.h"

/// The most photons that one pass can emit.
#define PM_EMIT_MAX 4294967295u

/// Where a light's photons are worth sending. The unit square that a light's direction (for a
/// directional light: its start) is made from is cut into rows x columns cells of equal power;
/// only the lit ones are used. Cells are conservative: no dark cell reaches anything that
/// counts. Zero-initialised: the light sends everywhere.
typedef struct {
    uint32_t rows, columns; // 0: everywhere
    const uint32_t *lit;    // row * columns + column of each lit cell, ascending
    uint32_t lit_count;     // 0: nothing that counts is in reach, so the light sends nothing
} pm_projection;

/// What one pass emits.
typedef struct {
    const pm_scene *scene;
    pm_rng_source source;
    uint64_t count;                   // photons in all, 1..PM_EMIT_MAX
    const uint64_t *share;            // photons per light, from pm_emit_share()
    const pm_projection *projections; // one a light; NULL: all send everywhere
} pm_emission;

/// A photon on its way.
typedef struct {
    pm_ray ray;
    pm_spectrum power; // [W] times the number of photons emitted
    uint64_t photon;
    uint32_t light;
} pm_start;

/// Shares `count` photons among the lights by the power that they send (mean of the three
/// channels, times the lit share of their projection).
///
/// A light that sends nothing gets none, every other light at least one; the shares add up to
/// `count`, or to 0 when no light sends any power.
///
/// @param projections  one a light, or NULL
/// @param share        [out] scene->light_count numbers
/// @return PM_EINPUT when `count` is below the number of lights that send power
pm_status pm_emit_share(const pm_scene *scene, const pm_projection *projections, uint64_t count,
                        uint64_t *share);

/// Two uniform numbers in [0,1)^2 inside a lit cell, every lit cell equally likely; plain
/// uniform numbers when `projection` is NULL or has no rows.
///
/// @param u  [out]
/// @return PM_EINPUT when no cell is lit
pm_status pm_emit_cell(const pm_projection *projection, pm_rng *rng, double u[2]);

/// One photon's ray from `light`, distributed as the light's power is.
///
/// Point: isotropic. Spot: by its intensity. Area: uniform over the surface, cosine about its
/// normal, started off the surface by the offset rule. Directional: uniform over the disc of
/// the scene's bounding sphere that faces the light, before everything. Constant: like a
/// directional light from a direction uniform on the sphere. `projection` (or NULL) picks the
/// cell of the direction; for a directional light, of the start; for a constant one, nothing.
///
/// What the cell's two numbers u mean is fixed, because projection.h cuts the same square. The
/// second one is the azimuth, 2 pi u[1] from s to t in pm_frame_around(axis). The first one is
/// the share of power nearer to the axis:
///     point        axis +z;                cos theta = 1 - 2 u[0]
///     area         axis the start's normal; sin theta = sqrt(u[0])
///     spot         axis its direction;     theta = pm_spot_angle(light, u[0])
///     directional  axis its direction;     distance from the scene's centre R sqrt(u[0])
///
/// @param ray  [out] unit direction, t_max infinite, wavelength 0, medium the light's
pm_status pm_emit_ray(const pm_scene *scene, const pm_light *light,
                      const pm_projection *projection, pm_rng *rng, pm_ray *ray);

/// Photons `first` .. `first + count - 1` of the pass.
///
/// The lights take turns in proportion to their shares, so every prefix of a pass holds all of
/// them. A projection map scales power by its lit share of all cells.
///
/// @param starts  [out] room for `count`
pm_status pm_emit_photons(const pm_emission *emission, uint64_t first, uint32_t count,
                          pm_start *starts);

#endif
