// What leaves the lights, as CSV: rays, and the cells of projection maps. What `view emission`,
// `view directions` and `view cells` draw and a student reads.
#ifndef PM_EMIT_DUMP_H
#define PM_EMIT_DUMP_H

#include "projection.h"

#include <stdio.h>

/// A photon on its way: start in the scene file's coordinates, unit direction, power [W] after
/// division by the photons emitted, index of the light.
#define PM_RAY_HEADER "ox,oy,oz,dx,dy,dz,r,g,b,light"

/// A cell of one light's projection for one map (global, caustic): it lies between two
/// distances from the light's axis and two azimuths about it [rad], counted from s to t in
/// pm_frame_around(axis); emit.h says which axis. Distances are angles [rad], but metres on the
/// start disc of a directional light (flat is 1). All cells of a light send the same power, or
/// would, if they are dark (lit is 0).
#define PM_CELL_HEADER "map,light,flat,row,column,near,far,azimuth,azimuth_end,lit"

/// One row of a ray file.
/// @param emitted  photons of all lights, > 0
void pm_emit_dump_ray(FILE *to, const pm_scene *scene, const pm_start *start, uint64_t emitted);

/// One row for every cell of every light that has a projection, row by row.
void pm_emit_dump_cells(FILE *to, const pm_scene *scene, const char *map,
                        const pm_projections *projections);

#endif
