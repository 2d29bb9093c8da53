// What can be put on a figure, one file each (draw_scene.cc, draw_photons.cc ...). Each draws
// its data and adds the legend or scale that belongs to it; titles are the caller's.
#ifndef PM_DRAW_H
#define PM_DRAW_H

#include "figure.h"
#include "figure_data.h"
#include "scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Shapes faintly, for orientation: edges, a breath of colour on the faces, and words on
/// lights, mirrors and glass.
pm_status pm_draw_scene(pm_figure *figure, const pm_scene *scene);

/// One dot a photon, in the colour of its power; full brightness stands for cloud->full_power.
/// Later clouds lie over earlier ones where they meet. The cloud must outlive the figure.
/// @param dot_size    in pixels of a picture 900 high
/// @param brightness  1 as they are; below 1 dimmed, as a backdrop
pm_status pm_draw_photons(pm_figure *figure, const pm_photon_cloud *cloud, double dot_size,
                          double brightness);

/// The scale that belongs to photons of this full power [W]; none when it is 0.
pm_status pm_draw_photon_scale(pm_figure *figure, const char *heading, double full_power);

/// `most` of the paths at even steps: each stretch in the colour of the event it starts from,
/// each event a dot.
/// @param drawn  [out] paths drawn
pm_status pm_draw_paths(pm_figure *figure, const pm_path_set *paths, uint64_t most,
                        uint64_t *drawn);

/// Split planes, translucent, coloured by axis, fainter with depth.
pm_status pm_draw_tree(pm_figure *figure, const pm_tree_split_set *tree);

/// A heat map of luminance on the grid's surface, with a logarithmic scale in W/m^2.
pm_status pm_draw_irradiance(pm_figure *figure, const pm_grid *grid);

#ifdef __cplusplus
}
#endif
#endif
