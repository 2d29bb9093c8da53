// One gather region and its photons as `radiance --gathered` writes them: the region's own row
// first, then a row a photon (core/gathered.h says what a field means).
#ifndef PM_GATHERED_FILE_H
#define PM_GATHERED_FILE_H

#include "figure_data.h"
#include "scene.h"
#include "status.h"

#define PM_GATHERED_HEADER "what,number,x,y,z,nx,ny,nz,dx,dy,dz,r,g,b,distance,weight"

/// Reads a dump. Refuses, with file:line, a word or a number that cannot be, a region that is
/// missing or comes twice, and another number of photons in it than it says (a file that was
/// cut).
/// @param scene     that the data came from
/// @param gathered  [out] untouched unless PM_OK; free with pm_gathered_file_free()
pm_status pm_gathered_file_read(const char *path, const pm_scene *scene, pm_gathered *gathered);

void pm_gathered_file_free(pm_gathered *gathered);

#endif
