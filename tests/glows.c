// Contracts are in the header. Place 0 of a run shifts the lattice, place 1 is for the rest.
#include "glows.h"

#include "light.h"
#include "medium.h"
#include "test.h"

static const pm_rng_source source = {.seed = 12, .stream = PM_STREAM_TEST};

pm_spectrum pm_glows_run(const pm_scenes *s, const pm_ray *along, uint32_t samples, int number)
{
    pm_direct_query query = {.world = &s->world, .samples = samples, .step = 1};
    query.rng = pm_rng_at(&source, (uint64_t)number, 1);
    pm_rng rng = pm_rng_at(&source, (uint64_t)number, 0);
    query.shift[0] = pm_rng_draw(&rng);
    query.shift[1] = pm_rng_draw(&rng);
    return pm_single(&query, along);
}

pm_glows_answer pm_glows_ask(const pm_scenes *s, const pm_ray *along, uint32_t samples,
                             int runs)
{
    double sum = 0.0;
    double squares = 0.0;
    for (int i = 0; i < runs; i++) {
        double one = pm_glows_run(s, along, samples, i).c[1];
        sum += one;
        squares += one * one;
    }
    double mean = sum / runs;
    return (pm_glows_answer){mean,
                             sqrt(pm_most(0.0, squares / runs - mean * mean) / (runs - 1))};
}

void pm_glows_check(const pm_scenes *s, const pm_ray *along, double want, double sharp)
{
    pm_glows_answer one = pm_glows_ask(s, along, 1, 4000);
    pm_glows_answer many = pm_glows_ask(s, along, 16, 250);
    CHECK_NEAR(one.mean, want, 5.0 * one.sd + 1e-5 * want); // 1e-5: offsets
    CHECK_NEAR(many.mean, want, 5.0 * many.sd + 1e-5 * want);
    CHECK_THAT(many.sd <= sharp * want, "sd %g of %g", many.sd / want, sharp);
    CHECK(one.sd <= 4.0 * sharp * want);
}

pm_ray pm_glows_ray(pm_vec3 from, pm_vec3 direction, double t_max)
{
    return (pm_ray){from, pm_vec_normalize(direction), t_max, 0.0, 0};
}

void pm_glows_fog(pm_scenes *s, double sigma_t, double albedo, double g)
{
    pm_scenes_begin(s);
    pm_scenes_medium(s, sigma_t, pm_rgb(0.5 * albedo, albedo, 0.0), g);
}

double pm_glows_scattered(double t, void *context)
{
    const pm_glows_integrand *in = context;
    const pm_medium *fog = &in->s->media[0];
    pm_vec3 at = pm_vec_along(in->along.origin, in->along.direction, t);
    pm_light_sample light;
    if (!pm_light_sample_from(&in->s->scene, &in->s->lights[0], at, in->v, &light)) {
        return 0.0;
    }
    double way = pm_vec_length(pm_vec_sub(light.target, at));
    double phase = pm_medium_phase(fog, pm_vec_dot(light.direction, in->along.direction));
    return fog->sigma_t * fog->albedo.c[1] * exp(-fog->sigma_t * (t + way)) * phase *
           light.radiance.c[1];
}
