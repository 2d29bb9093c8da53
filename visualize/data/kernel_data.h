// What the pictures of filtering are made of: kernels by distance, the photons of an estimate
// with their weights, and a grid of irradiance under each kernel. No functions here; readers
// fill it (kernel_file, weight_file, edge_file).
#ifndef PM_KERNEL_DATA_H
#define PM_KERNEL_DATA_H

#include "vec.h"

#include <stdint.h>

#define PM_KERNEL_NAME_MAX 32 // with its end
#define PM_KERNEL_CURVES_MAX 16
#define PM_KERNEL_POINTS_MAX 1024

/// How much a photon counts against the plain average, by its distance over the radius.
typedef struct {
    char name[PM_KERNEL_NAME_MAX];
    int count;                             // points, at least 2
    double distance[PM_KERNEL_POINTS_MAX]; // rising from 0 to 1
    double weight[PM_KERNEL_POINTS_MAX];
    double inside[PM_KERNEL_POINTS_MAX]; // part of a flat field's power that is counted nearer
} pm_kernel_curve;

/// Freed by pm_kernel_file_free().
typedef struct {
    pm_kernel_curve *curves;
    int count;
} pm_kernel_set;

// Kernels of pm_weighed_photon, in the order of its columns.
#define PM_WEIGHT_KERNELS 4

typedef struct {
    pm_vec3 position;
    double power[3];                  // [W]
    double distance;                  // [m] as the search measures it
    double weight[PM_WEIGHT_KERNELS]; // against the plain average
} pm_weighed_photon;

/// What a kernel came to in a report.
typedef struct {
    double mean, rms; // irradiance [W/m^2], mean of the channels; rms about it
} pm_kernel_result;

/// The photons of one estimate. Freed by pm_weight_file_free().
typedef struct {
    pm_weighed_photon *photons;
    uint32_t count;
    pm_vec3 at, normal; // centred, unit
    double radius;      // [m]
    double samples;     // estimates that the results are of
    pm_kernel_result result[PM_WEIGHT_KERNELS];
} pm_weighed_set;

// Columns of irradiance in the grid's file.
#define PM_EDGE_KERNELS 9

typedef struct {
    pm_vec3 position;
    double irradiance[PM_EDGE_KERNELS]; // luminance [W/m^2] under each kernel
} pm_edge_point;

/// Point (i, j) is points[j * columns + i]. Freed by pm_edge_file_free().
typedef struct {
    pm_edge_point *points;
    uint64_t columns, rows; // at least 2
} pm_edge_grid;

#endif
