// Only S events turn a path from the eye; what D lobes send to it is asked for where it meets
// them.
#include "eye_path.h"

#include "medium.h"
#include "wavelength.h"

pm_eye_path pm_eye_path_along(const pm_ray *ray)
{
    return (pm_eye_path){.ray = *ray, .weight = pm_gray(1.0), .from = ray->origin};
}

bool pm_eye_path_meet(const pm_intersector *world, const pm_eye_path *path, pm_vertex *at)
{
    if (!pm_closest(world, &path->ray, &at->hit)) {
        return false;
    }
    pm_material_lobes(world->scene, &at->hit, &path->ray, &at->lobes);
    at->from = path->from;
    at->pdf = path->pdf;
    return true;
}

void pm_eye_path_pass(pm_eye_path *path, const pm_vertex *at)
{
    path->ray = pm_hit_ray(&at->hit, path->ray.direction, path->ray.wavelength,
                           at->lobes.medium_beyond);
}

bool pm_eye_path_attenuate(const pm_scene *scene, pm_eye_path *path, bool met,
                           const pm_vertex *at, pm_stretch *through)
{
    if (path->ray.medium == PM_NONE) {
        return false;
    }
    *through = (pm_stretch){.ray = path->ray, .pixel = at->pixel, .sample = at->sample};
    through->ray.t_max = met ? at->hit.t : HUGE_VAL;
    double left = pm_medium_transmittance(&scene->media[path->ray.medium], through->ray.t_max);
    path->weight = pm_spectrum_scale(path->weight, left);
    return true;
}

void pm_eye_path_colour(const pm_scene *scene, double u, double share, pm_eye_path *path,
                        pm_vertex *at)
{
    path->ray.wavelength = pm_wavelength_at(u);
    pm_spectrum weight = pm_wavelength_weight(path->ray.wavelength);
    path->weight = pm_spectrum_scale(pm_spectrum_mul(path->weight, weight), share);
    pm_material_lobes(scene, &at->hit, &path->ray, &at->lobes);
}

/// The S lobes of a vertex, in the order of its lobes; writes their places there.
static int specular_lobes(const pm_lobes *lobes, pm_lobe *only, int *place)
{
    int count = 0;
    for (int i = 0; i < lobes->count; i++) {
        if (lobes->lobe[i].specular) {
            only[count] = lobes->lobe[i];
            place[count++] = i;
        }
    }
    return count;
}

bool pm_eye_path_may_turn(const pm_eye_path *path, const pm_vertex *at, uint32_t max_specular,
                          uint64_t *cut)
{
    pm_lobe lobes[PM_LOBES_MAX];
    int place[PM_LOBES_MAX];
    bool turns = specular_lobes(&at->lobes, lobes, place) > 0;
    bool capped = path->specular >= max_specular;
    *cut += turns && capped;
    return turns && !capped;
}

pm_eye_path pm_eye_path_turned(const pm_eye_path *path, const pm_vertex *at, int which,
                               pm_spectrum weight, pm_rng *rng)
{
    pm_scatter scatter;
    pm_material_sample(&at->lobes, which, rng, &scatter);
    weight = pm_spectrum_scale(pm_spectrum_mul(weight, scatter.weight), scatter.radiance);
    return (pm_eye_path){
        .ray = pm_hit_ray(&at->hit, scatter.wo, path->ray.wavelength, scatter.medium),
        .weight = weight,
        .specular = path->specular + 1,
        .from = at->hit.position,
        .pdf = scatter.pdf,
    };
}

pm_status pm_eye_path_choose(pm_eye_path *path, const pm_vertex *at, pm_roulette_rule rule,
                             pm_rng *rng, bool *goes_on)
{
    pm_lobe lobes[PM_LOBES_MAX];
    int place[PM_LOBES_MAX];
    int count = specular_lobes(&at->lobes, lobes, place);
    pm_roulette outcome;
    PM_TRY(pm_trace_roulette(path->weight, lobes, count, rule, rng, &outcome));
    *goes_on = outcome.lobe != PM_NONE;
    if (*goes_on) {
        *path = pm_eye_path_turned(path, at, place[outcome.lobe], outcome.power, rng);
    }
    return PM_OK;
}
