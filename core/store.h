// Lab 3. Photons are kept: packed into 20 bytes, pushed onto a map that grows, scaled once.
#ifndef PM_STORE_H
#define PM_STORE_H

#include "photon.h"
#include "status.h"

/// Packs a deposit: power as shared exponent (RGBE), direction as two angles, flags and the
/// coarse normal.
///
/// byte_c = floor(256 c m / v) for the largest channel v = m 2^e, m in [0.5, 1). Powers above
/// the range are stored at its top with their hue, powers below as 0; the result says so. The
/// range is [2^-128, 2^127) for the largest channel. theta = acos(z) and phi in [0, 2 pi) are
/// cut into 256 bins each.
///
/// @param photon      [out] untouched unless PM_OK
/// @param power_fits  [out] 0 when the power was in range, +1 above, -1 below
/// @return PM_EINPUT when a position (as float, too), direction, normal or power is not finite,
///         or a power is negative
/// @source Ward, "Real Pixels", Graphics Gems II, 1991
pm_status pm_store_pack(const pm_deposit *deposit, pm_photon *photon, int *power_fits);

/// Photon `index` of `map` (below map->count), from the exact values where they are kept.
/// A packed byte decodes to the middle of its bin, a power byte of 0 to 0.
pm_photon_view pm_store_unpack(const pm_photon_map *map, uint32_t index);

/// The power of that photon alone [W], scaled.
pm_spectrum pm_store_power(const pm_photon_map *map, uint32_t index);

/// Appends a deposit, growing the map by a quarter when it is full. A deposit that
/// pm_store_pack() refuses is counted in map->refused and not stored.
///
/// @return PM_ELIMIT at PM_MAP_MAX photons; PM_ENOMEM; PM_EINPUT when the map is scaled; the
///         map is unchanged then
pm_status pm_store_push(pm_photon_map *map, const pm_deposit *deposit);

/// Declares the map complete: `emitted` photons were sent to fill it, so each carries 1/emitted
/// of its pushed power.
///
/// @return PM_EINPUT when emitted is 0 or the map is scaled already
pm_status pm_store_scale(pm_photon_map *map, uint64_t emitted);

#endif
