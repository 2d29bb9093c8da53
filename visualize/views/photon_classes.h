// Photons in classes, a colour each: by map, by how often they were scattered, or by light.
#ifndef PM_PHOTON_CLASSES_H
#define PM_PHOTON_CLASSES_H

#include "colours.h"
#include "figure_data.h"
#include "options.h"
#include "scene.h"

#include <stdint.h>

#define PM_PHOTON_CLASSES_MAX 8
#define PM_PHOTON_CLASS_TEXT 64

typedef struct {
    char text[PM_PHOTON_CLASS_TEXT]; // for the legend, without the count
    pm_colour colour;
    uint64_t count; // photons, as pm_photon_classes_paint() meets them
} pm_photon_class;

typedef struct {
    pm_by by;
    int count;
    pm_photon_class list[PM_PHOTON_CLASSES_MAX];
} pm_photon_classes;

/// The classes there are for PM_BY_MAP, PM_BY_BOUNCE or PM_BY_LIGHT; the last one of bounces
/// and of many lights takes all the rest.
pm_photon_classes pm_photon_classes_make(pm_by by, const pm_scene *scene);

/// Counts the photons of a cloud and gives each its colour. For bounces and lights the cloud
/// must have them.
/// @param colours  [out] cloud->count of them
void pm_photon_classes_paint(pm_photon_classes *classes, const pm_photon_cloud *cloud,
                             pm_colour *colours);

#endif
