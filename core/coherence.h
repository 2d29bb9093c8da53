// Fault or noise? Noise differs from one part of a picture to the next by chance; a fault
// leans the same way over whole regions.
//
// The difference of two pictures is averaged over square tiles, and each tile multiplied with
// its neighbours one tile away, across and down. Where the tiles are independent and of mean
// zero, each product is zero on average, whatever the spread of each tile, and
//
//     z = sum of products / sqrt(sum of squared products)
//
// is a standard normal variable; a region that leans one way makes all its products positive.
// A picture that brings two independent halves shows its own noise, (half1 - half2) / 2, and
// the products of that are taken off, so that noise which neighbours share is no fault.
#ifndef PM_COHERENCE_H
#define PM_COHERENCE_H

#include "status.h"

#include <stdint.h>

/// Planes of width * height, rows from the top.
typedef struct {
    int width, height;
    const uint8_t *counted;   // 0: this pixel is left out
    const double *difference; // A - B
    const double *noise[2];   // of A and of B, from their halves; NULL when there are none
} pm_coherence_planes;

typedef struct {
    int pairs;       // of tiles
    double z;        // 0 without pairs or without any difference
    double coherent; // root of the mean product: the size of what neighbours share; 0 when
                     // that is negative
} pm_coherence;

/// @param out  [out]
/// @return PM_ENOMEM
pm_status pm_coherence_measure(const pm_coherence_planes *planes, pm_coherence *out);

#endif
