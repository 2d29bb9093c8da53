// The kinds of pictures, in the order of the stages that they show; each is a file view_*.c.
#ifndef PM_VIEW_KINDS_H
#define PM_VIEW_KINDS_H

#include "view.h"

// emission
extern const pm_view_kind pm_view_emission;
extern const pm_view_kind pm_view_directions;
extern const pm_view_kind pm_view_cells;
extern const pm_view_kind pm_view_shares;
// tracing
extern const pm_view_kind pm_view_paths;
extern const pm_view_kind pm_view_growth;
// storage
extern const pm_view_kind pm_view_photons;
extern const pm_view_kind pm_view_packing;
// balancing
extern const pm_view_kind pm_view_tree;
extern const pm_view_kind pm_view_trees;
extern const pm_view_kind pm_view_search;
// radiance
extern const pm_view_kind pm_view_gather;
extern const pm_view_kind pm_view_irradiance;
extern const pm_view_kind pm_view_bias;
// filtering
extern const pm_view_kind pm_view_kernels;
extern const pm_view_kind pm_view_weights;
extern const pm_view_kind pm_view_edge;
// rendering
extern const pm_view_kind pm_view_layers;
extern const pm_view_kind pm_view_error;
extern const pm_view_kind pm_view_effort;
// trade
extern const pm_view_kind pm_view_trade;
// sheets
extern const pm_view_kind pm_view_contact;

#endif
