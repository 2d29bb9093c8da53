// Two passes of light paths tell a mean and its noise.
#include "films.h"

#include "test.h"

#include <omp.h>
#include <stdlib.h>

pm_light_tracing pm_films_tracing(const pm_scenes *s, uint64_t count, bool everything)
{
    return (pm_light_tracing){
        .world = &s->world,
        .source = {.seed = 1, .stream = PM_STREAM_LIGHT_PATHS},
        .count = count,
        .caps = pm_caps_of(&s->scene, 0),
        .everything = everything,
    };
}

/// A film of one pass.
static pm_spectrum *film_of(const pm_scenes *s, pm_light_tracing tracing, uint32_t pass)
{
    size_t pixels = (size_t)s->scene.camera.width * (size_t)s->scene.camera.height;
    pm_spectrum *film = calloc(pixels * PM_LAYER_COUNT, sizeof *film);
    CHECK(film != NULL);
    uint64_t cut = 0;
    tracing.source.pass = pass;
    CHECK_OK(pm_light_tracer_run(&tracing, film, &cut));
    CHECK(cut == 0);
    return film;
}

pm_film_pair pm_films_of(const pm_scenes *s, uint64_t count, bool everything)
{
    omp_set_num_threads(1); // the runner keeps the other cores busy
    pm_film_pair made = {.pixels = s->scene.camera.width * s->scene.camera.height};
    for (uint32_t half = 0; half < 2; half++) {
        made.half[half] = film_of(s, pm_films_tracing(s, count, everything), half);
    }
    return made;
}

void pm_films_free(pm_film_pair *films)
{
    free(films->half[0]);
    free(films->half[1]);
}

pm_pictures_means pm_films_means(const pm_film_pair *films, const int *marks, int mark)
{
    pm_pictures_means means = {0};
    double count = 0.0;
    for (int i = 0; i < films->pixels; i++) {
        if (marks != NULL && marks[i] != mark) {
            continue;
        }
        count++;
        for (int l = 0; l < PM_LAYER_COUNT; l++) {
            pm_spectrum one = films->half[0][i * PM_LAYER_COUNT + l];
            pm_spectrum two = films->half[1][i * PM_LAYER_COUNT + l];
            pm_spectrum half = pm_spectrum_scale(pm_spectrum_sub(one, two), 0.5);
            means.mean[l] = pm_spectrum_add(means.mean[l],
                                            pm_spectrum_scale(pm_spectrum_add(one, two), 0.5));
            means.variance[l] = pm_spectrum_add(means.variance[l], pm_spectrum_mul(half, half));
        }
    }
    for (int l = 0; l < PM_LAYER_COUNT; l++) {
        means.mean[l] = pm_spectrum_scale(means.mean[l], 1.0 / count);
        means.variance[l] = pm_spectrum_scale(means.variance[l], 1.0 / count / count);
    }
    return means;
}

pm_pictures_means pm_films_repeat(const pm_scenes *s, uint64_t count, uint32_t runs)
{
    omp_set_num_threads(1); // the runner keeps the other cores busy
    int pixels = s->scene.camera.width * s->scene.camera.height;
    pm_pictures_means means = {0};
    for (uint32_t pass = 0; pass < runs; pass++) {
        pm_spectrum *film = film_of(s, pm_films_tracing(s, count, true), pass);
        pm_spectrum layer[PM_LAYER_COUNT] = {0};
        for (int i = 0; i < pixels * PM_LAYER_COUNT; i++) {
            pm_spectrum *sum = &layer[i % PM_LAYER_COUNT];
            *sum = pm_spectrum_add(*sum, pm_spectrum_scale(film[i], 1.0 / pixels));
        }
        pm_pictures_add(&means, layer);
        free(film);
    }
    pm_pictures_finish(&means, runs);
    return means;
}
