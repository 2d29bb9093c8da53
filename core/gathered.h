// The photons that one estimate of irradiance is made of, as CSV, with those around them that
// it leaves out: so that one sees which light a ball or a disc takes, and from which wall.
#ifndef PM_GATHERED_H
#define PM_GATHERED_H

#include "estimate.h"

/// Photons that were left out are written as far away as this many radii.
#define PM_GATHERED_AROUND 2.5

/// Writes `what,number,x,y,z,nx,ny,nz,dx,dy,dz,r,g,b,distance,weight`, in the coordinates of
/// the scene file.
///
/// The first row is the region: what is sphere or disc, number how many photons were found,
/// x,y,z the point, nx,ny,nz the side looked at, dx,dy,dz 0, r,g,b the irradiance [W/m^2],
/// distance the radius [m] and weight the height over the radius (1 of a sphere). Then a row a
/// photon, in the order of the map: what is `counted`, `rim` (it sets the radius and is left
/// out), `near` (out of reach) or `behind` (it failed the side test); number its place in the
/// map, nx,ny,nz its surface's normal, dx,dy,dz the way it came, r,g,b its power [W], distance
/// [m] in the measure of the search (of one behind: as the crow flies) and weight the share of
/// its power that counts, so that their sum over pi radius^2 is the irradiance.
///
/// The search is asked once more, with pm_balance_nearest() and pm_estimate_accept().
///
/// @param map       that the estimate was made from
/// @param estimate  its answer
/// @param center    of the scene
/// @return PM_EIO, PM_ENOMEM, or what the stages return; then there is no file
pm_status pm_gathered_write(const char *path, const pm_photon_map *map,
                            const pm_estimate_settings *settings,
                            const pm_estimate_point *point, const pm_estimate *estimate,
                            pm_vec3 center);

#endif
