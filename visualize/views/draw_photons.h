// Photons as dots.
#ifndef PM_DRAW_PHOTONS_H
#define PM_DRAW_PHOTONS_H

#include "figure.h"
#include "figure_data.h"

#ifdef __cplusplus
extern "C" {
#endif

/// One dot a photon, in the colour of its power; full brightness stands for cloud->full_power.
/// Later clouds lie over earlier ones where they meet. The cloud must outlive the figure. Its
/// numbers are kept as the data behind the picture.
/// @param dot_size    in pixels of a picture 900 high
/// @param brightness  1 as they are; below 1 dimmed, as a backdrop
pm_status pm_draw_photons(pm_figure *figure, const pm_photon_cloud *cloud, double dot_size,
                          double brightness);

/// The same with a colour for each of cloud->count photons, which are copied.
pm_status pm_draw_painted_photons(pm_figure *figure, const pm_photon_cloud *cloud,
                                  const pm_colour *colours, double dot_size);

/// The scale that belongs to photons of this full power [W]; none when it is 0.
pm_status pm_draw_photon_scale(pm_figure *figure, const char *heading, double full_power);

#ifdef __cplusplus
}
#endif
#endif
