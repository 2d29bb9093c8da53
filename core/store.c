// A photon in 20 bytes. Power: three mantissa bytes share one exponent byte; direction: one
// byte for each of two angles.
//
// Invariant: decoding answers the middle of the interval that was cut off to one byte, so that
// nothing drifts when many photons are added; only a byte of 0 stands for exactly 0, so that
// pure colours stay pure.
// @source Ward, "Real Pixels", Graphics Gems II, 1991; Jensen 2001, ch. 6
#include "store.h"

#include "coarse_normal.h"
#include "photon_map.h"

#include <stddef.h>

#define BINS 256
#define EXPONENT_BIAS 128
#define EXPONENT_MAX 127    // stored as 255
#define EXPONENT_MIN (-127) // stored as 1; 0 is kept for black

// --- power ----------------------------------------------------------------------------------

static int pack_power(pm_spectrum power, uint8_t bytes[4])
{
    int exponent;
    double largest = pm_spectrum_max(power);
    (void)frexp(largest, &exponent);
    bytes[0] = bytes[1] = bytes[2] = bytes[3] = 0;
    if (largest == 0.0 || exponent < EXPONENT_MIN) {
        return largest == 0.0 ? 0 : -1;
    }
    int fits = exponent > EXPONENT_MAX ? 1 : 0;
    for (int c = 0; c < 3; c++) {
        // Above the range the hue is kept and the largest channel put at the top.
        double part = fits ? power.c[c] / largest * (BINS - 1)
                           : ldexp(power.c[c], 8 - exponent); // exact: a power of two
        bytes[c] = (uint8_t)part;
    }
    bytes[3] = (uint8_t)((fits ? EXPONENT_MAX : exponent) + EXPONENT_BIAS);
    return fits;
}

static pm_spectrum unpack_power(const uint8_t bytes[4])
{
    pm_spectrum power = pm_gray(0.0);
    double unit = ldexp(1.0, bytes[3] - EXPONENT_BIAS - 8);
    for (int c = 0; c < 3; c++) {
        power.c[c] = bytes[c] == 0 ? 0.0 : (bytes[c] + 0.5) * unit;
    }
    return power;
}

// --- direction ------------------------------------------------------------------------------

/// The bin of `angle` in [0, range], the last one for its end.
static uint8_t bin_of(double angle, double range)
{
    return (uint8_t)fmin(angle / range * BINS, BINS - 1);
}

static void pack_direction(pm_vec3 direction, uint8_t bytes[2])
{
    // Rounding leaves unit vectors with |z| above 1 now and then, where acos is not a number.
    double theta = acos(fmax(-1.0, fmin(direction.z, 1.0)));
    double phi = atan2(direction.y, direction.x);
    bytes[0] = bin_of(theta, PM_PI);
    bytes[1] = bin_of(phi < 0.0 ? phi + 2.0 * PM_PI : phi, 2.0 * PM_PI);
}

static pm_vec3 unpack_direction(const uint8_t bytes[2])
{
    double theta = (bytes[0] + 0.5) * (PM_PI / BINS);
    double phi = (bytes[1] + 0.5) * (2.0 * PM_PI / BINS);
    return pm_vec(sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta));
}

// --- whole photons --------------------------------------------------------------------------

static bool is_finite(pm_vec3 v)
{
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

/// What is wrong with a deposit, or NULL.
static const char *fault_of(const pm_deposit *deposit)
{
    pm_spectrum power = deposit->power;
    if (!is_finite(deposit->position) || !isfinite((float)pm_vec_reach(deposit->position))) {
        return "position must be finite, in float too";
    }
    if (!is_finite(deposit->direction) || !is_finite(deposit->normal)) {
        return "direction and normal must be finite";
    }
    if (!pm_spectrum_is_finite(power)) {
        return "power must be finite";
    }
    if (power.c[0] < 0.0 || power.c[1] < 0.0 || power.c[2] < 0.0) {
        return "power must not be negative";
    }
    return NULL;
}

static uint16_t flags_of(const pm_deposit *deposit)
{
    pm_vec3 normal = deposit->in_medium ? pm_vec(0.0, 0.0, 0.0) : deposit->normal;
    unsigned flags = (unsigned)pm_normal_encode(normal) << PM_PHOTON_NORMAL_SHIFT;
    flags |= deposit->caustic ? PM_PHOTON_CAUSTIC : 0;
    flags |= deposit->first ? PM_PHOTON_FIRST : 0;
    return (uint16_t)flags;
}

pm_status pm_store_pack(const pm_deposit *deposit, pm_photon *photon, int *power_fits)
{
    const char *fault = fault_of(deposit);
    if (fault != NULL) {
        return PM_FAIL(PM_EINPUT, "a photon's %s; photon %llu, bounce %u", fault,
                       (unsigned long long)deposit->photon, deposit->bounce);
    }
    photon->position[0] = (float)deposit->position.x;
    photon->position[1] = (float)deposit->position.y;
    photon->position[2] = (float)deposit->position.z;
    photon->flags = flags_of(deposit);
    pack_direction(deposit->direction, photon->direction);
    *power_fits = pack_power(deposit->power, photon->power);
    return PM_OK;
}

static pm_vec3 vec_of(const float v[3])
{
    return pm_vec((double)v[0], (double)v[1], (double)v[2]);
}

static pm_vec3 direction_of(const pm_photon_map *map, uint32_t index)
{
    return map->exact != NULL ? vec_of(map->exact[index].direction)
                              : unpack_direction(map->photons[index].direction);
}

pm_spectrum pm_store_power(const pm_photon_map *map, uint32_t index)
{
    double scale = map->scaled ? map->scale : 1.0;
    if (map->exact == NULL) {
        return pm_spectrum_scale(unpack_power(map->photons[index].power), scale);
    }
    const float *power = map->exact[index].power;
    return pm_rgb((double)power[0] * scale, (double)power[1] * scale, (double)power[2] * scale);
}

pm_photon_view pm_store_unpack(const pm_photon_map *map, uint32_t index)
{
    const pm_photon *photon = &map->photons[index];
    return (pm_photon_view){
        .position = vec_of(photon->position),
        .direction = direction_of(map, index),
        .normal = pm_normal_decode(photon->flags >> PM_PHOTON_NORMAL_SHIFT),
        .power = pm_store_power(map, index),
        .caustic = (photon->flags & PM_PHOTON_CAUSTIC) != 0,
        .first = (photon->flags & PM_PHOTON_FIRST) != 0,
    };
}

/// What `photon` rounded away. Powers out of the packed range are out of this one, too: the
/// same photons vanish or are clamped, whether a map is packed or not.
static pm_photon_exact exact_of(const pm_deposit *deposit, const pm_photon *photon, int fits)
{
    pm_spectrum power = fits == 0 ? deposit->power : unpack_power(photon->power);
    pm_vec3 direction = deposit->direction;
    return (pm_photon_exact){
        .power = {(float)power.c[0], (float)power.c[1], (float)power.c[2]},
        .direction = {(float)direction.x, (float)direction.y, (float)direction.z},
    };
}

static pm_status make_room(pm_photon_map *map)
{
    if (map->count < map->capacity) {
        return PM_OK;
    }
    return pm_photon_map_reserve(map, pm_photon_map_growth(map, (uint64_t)map->count + 1));
}

pm_status pm_store_push(pm_photon_map *map, const pm_deposit *deposit)
{
    if (map->scaled) {
        return PM_FAIL(PM_EINPUT, "%s",
                       "a scaled map is complete: push photons before scaling");
    }
    if (fault_of(deposit) != NULL) {
        map->refused++;
        return PM_OK;
    }
    int fits;
    pm_photon photon;
    PM_TRY(pm_store_pack(deposit, &photon, &fits));
    PM_TRY(make_room(map));
    if (map->unpacked) {
        map->exact[map->count] = exact_of(deposit, &photon, fits);
    }
    map->photons[map->count] = photon;
    map->count++;
    map->clamped += fits > 0 ? 1 : 0;
    map->vanished += fits < 0 ? 1 : 0;
    map->balanced = false;
    return PM_OK;
}

pm_status pm_store_scale(pm_photon_map *map, uint64_t emitted)
{
    if (emitted == 0) {
        return PM_FAIL(PM_EINPUT, "%s", "a map is scaled by the photons emitted, got 0");
    }
    if (map->scaled) {
        return PM_FAIL(PM_EINPUT, "a map is scaled once; it is by 1/%llu already",
                       (unsigned long long)map->emitted);
    }
    map->emitted = emitted;
    map->scale = 1.0 / (double)emitted;
    map->scaled = true;
    return PM_OK;
}
