// Bands have the same power, so that all counts are about equally sure.
#include "ray_tally.h"

#define PHOTONS_A_BAND 25 // at least; then an empty band is no accident
#define WITHIN 1e-6       // [rad] what the digits of a file make of an angle

static int band_of(const pm_ray_tally *tally, double angle)
{
    int band = 0;
    while (band + 1 < tally->bands && angle >= tally->border[band + 1]) {
        band++;
    }
    return band;
}

bool pm_ray_tally_is_stray(const pm_light_law *law, pm_vec3 local)
{
    double most = law->single ? 0.0 : law->reach;
    return pm_light_law_angle(local) > most + WITHIN;
}

static uint64_t count_photons(const pm_ray_set *rays, int light)
{
    uint64_t count = 0;
    for (uint64_t i = 0; i < rays->count; i++) {
        count += rays->rays[i].light == (uint32_t)light;
    }
    return count;
}

static void cut_bands(const pm_light_law *law, int bands_most, pm_ray_tally *tally)
{
    uint64_t most = tally->count / PHOTONS_A_BAND;
    tally->bands = most < 1 ? 1 : most > (uint64_t)bands_most ? bands_most : (int)most;
    pm_light_law_bands(law, tally->bands, tally->border);
    tally->border[tally->bands + 1] = PM_PI;
}

/// Sums of the photons of a band become its density.
static void settle_band(pm_ray_tally *tally, int band, double sum, double sum2)
{
    double solid = pm_light_law_solid(tally->border[band], tally->border[band + 1]);
    double elsewhere = 1.0 - (double)tally->photons[band] / (double)tally->count;
    tally->density[band] = solid > 0.0 ? sum / solid : 0.0;
    tally->error[band] = solid > 0.0 ? sqrt(sum2 * elsewhere) / solid : 0.0;
}

pm_ray_tally pm_ray_tally_make(const pm_ray_set *rays, const pm_light_law *law, int light,
                               int bands_most)
{
    pm_ray_tally tally = {.count = count_photons(rays, light)};
    double flux = pm_spectrum_mean(law->light->flux);
    double sum[PM_RAY_BANDS_MAX + 1] = {0};
    double sum2[PM_RAY_BANDS_MAX + 1] = {0};
    if (!law->single) {
        cut_bands(law, bands_most, &tally);
    }
    for (uint64_t i = 0; i < rays->count; i++) {
        const pm_ray_start *ray = &rays->rays[i];
        if (ray->light != (uint32_t)light) {
            continue;
        }
        pm_vec3 local = pm_light_law_local(law, ray);
        bool stray = pm_ray_tally_is_stray(law, local);
        int band = stray ? tally.bands : band_of(&tally, pm_light_law_angle(local));
        double share = flux > 0.0 ? pm_spectrum_mean(ray->power) / flux : 0.0;
        tally.photons[band]++;
        sum[band] += share;
        sum2[band] += share * share;
        tally.strays += stray;
        tally.sent += share;
    }
    for (int band = 0; band <= tally.bands && tally.bands > 0; band++) {
        settle_band(&tally, band, sum[band], sum2[band]);
    }
    return tally;
}
