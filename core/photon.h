// The data that the stages hand to each other: deposits, stored photons, maps. No functions
// here, so that any one stage can be replaced while the others stay.
#ifndef PM_PHOTON_H
#define PM_PHOTON_H

#include "spectrum.h"
#include "vec.h"

#include <stdbool.h>
#include <stdint.h>

/// Which path classes a map holds, from the light: L light, S specular, D diffuse, V volume.
typedef enum {
    PM_MAP_GLOBAL,  // L{S|D|V}*D
    PM_MAP_CAUSTIC, // LS+D
    PM_MAP_VOLUME,  // L{S|D|V}*V
    PM_MAP_COUNT,
} pm_map_kind;

/// The most photons that one map can hold: tree links and counts stay inside 32-bit indices.
#define PM_MAP_MAX 2147483647u

/// One photon meeting one surface with a diffuse lobe, or one collision in a medium, before
/// packing. `power` is incident power [W] times the number of photons emitted; storing a map
/// ends with one division for all (pm_store_scale).
typedef struct {
    pm_vec3 position;
    pm_vec3 direction; // unit, the way the photon travelled
    pm_vec3 normal;    // unit geometric normal on the side it came from; zero in a medium
    pm_spectrum power;
    uint64_t photon; // index of the emitted photon
    uint32_t bounce; // events before this one
    uint32_t light;
    bool caustic; // at least one event since the light, and every one specular
    bool first;   // no event since the light
    bool in_medium;
} pm_deposit;

// Bits of pm_photon.flags.
#define PM_PHOTON_AXIS 0x0003u    // split axis of its tree node: 0 x, 1 y, 2 z
#define PM_PHOTON_CAUSTIC 0x0004u // see pm_deposit
#define PM_PHOTON_FIRST 0x0008u
#define PM_PHOTON_NORMAL_SHIFT 4 // the upper 12 bits: octahedral surface normal, 6 + 6 bits

/// The stored photon: 20 bytes.
typedef struct {
    float position[3];    // [m], centred world space
    uint8_t power[4];     // shared exponent: red, green, blue mantissa, exponent + 128
    uint8_t direction[2]; // polar angle theta from +z, azimuth phi
    uint16_t flags;
} pm_photon;

_Static_assert(sizeof(pm_photon) == 20, "a stored photon takes 20 bytes");

/// What packing rounds away, kept beside the photon of the same index when packing is off.
typedef struct {
    float power[3];
    float direction[3];
} pm_photon_exact;

/// All photons of one class. Zero-initialised with a kind it is valid and empty.
/// Owned by whoever filled it; freed by pm_photon_map_free().
typedef struct {
    pm_map_kind kind;
    bool unpacked;          // keep `exact`; set before the first photon
    bool scaled;            // pm_store_scale() has been called
    bool balanced;          // photons[] is a left-balanced tree in heap order
    pm_photon *photons;     // tree node i (root 1, children 2i and 2i + 1) is photons[i - 1]
    pm_photon_exact *exact; // same order; NULL when packing is on
    uint32_t count;
    uint32_t capacity;
    uint64_t emitted;  // photons emitted to fill it
    double scale;      // power of a stored photon = unpacked power * scale; 1 until scaled
    uint64_t refused;  // deposits with a value that is not finite or negative: not stored
    uint64_t clamped;  // powers above the packed range: stored at its top
    uint64_t vanished; // non-zero powers below the packed range: stored as 0
} pm_photon_map;

/// A stored photon, read back.
typedef struct {
    pm_vec3 position;
    pm_vec3 direction; // unit
    pm_vec3 normal;    // unit, coarse; zero in a medium
    pm_spectrum power; // [W], scaled
    bool caustic;
    bool first;
} pm_photon_view;

/// One photon that a search found.
typedef struct {
    double distance2; // squared, in the metric of the search
    uint32_t index;   // into photons[]
} pm_neighbour;

#endif
