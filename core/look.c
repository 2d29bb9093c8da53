// cos / density is pi for draws by the cosine; a lobe's own draws bring it in their weight.
#include "look.h"

double pm_look_albedo(const pm_lobes *lobes)
{
    double sum = 0.0;
    for (int i = 0; i < lobes->count; i++) {
        sum += lobes->lobe[i].specular ? 0.0 : pm_spectrum_mean(lobes->lobe[i].albedo);
    }
    return sum;
}

/// The D lobe that `share`, in [0, sum of their mean albedos), falls into.
static int diffuse_lobe(const pm_lobes *lobes, double share)
{
    int last = 0;
    for (int i = 0; i < lobes->count; i++) {
        double albedo = pm_spectrum_mean(lobes->lobe[i].albedo);
        if (lobes->lobe[i].specular || albedo == 0.0) {
            continue;
        }
        last = i;
        if (share < albedo) {
            break;
        }
        share -= albedo;
    }
    return last;
}

pm_look pm_look_by_lobe(const pm_lobes *lobes, pm_rng *rng)
{
    double sum = pm_look_albedo(lobes);
    double share = sum * pm_rng_draw(rng);
    int which = diffuse_lobe(lobes, share);
    pm_spectrum albedo = lobes->lobe[which].albedo;
    pm_scatter scatter;
    pm_material_sample(lobes, which, rng, &scatter);
    pm_spectrum response = pm_spectrum_scale(albedo, sum / pm_spectrum_mean(albedo));
    return (pm_look){scatter.wo, pm_spectrum_mul(response, scatter.weight)};
}

pm_look pm_look_by_cosine(const pm_lobes *lobes, const double u[2])
{
    pm_frame frame = pm_frame_around(lobes->normal);
    pm_vec3 wo = pm_frame_cosine(&frame, u);
    return (pm_look){wo, pm_spectrum_scale(pm_material_evaluate(lobes, wo), PM_PI)};
}
