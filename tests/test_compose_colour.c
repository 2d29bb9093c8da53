// Eye paths and gather rays in glass that disperses: which wavelengths they take, how often,
// and that light keeps its mean.
#include "compose.h"

#include "chance.h"
#include "lattice.h"
#include "prisms.h"
#include "shapes.h"
#include "test.h"

enum { MOST = 4096 };

/// Wavelengths [nm] of all rays that left for the sky, in the order that they did.
typedef struct {
    double wavelength[MOST];
    int count;
} seen;

static pm_status note_sky(void *context, const pm_ray *ray, pm_spectrum *radiance)
{
    seen *s = context;
    CHECK(s->count < MOST);
    s->wavelength[s->count++] = ray->wavelength;
    *radiance = pm_gray(1.0);
    return PM_OK;
}

static pm_status glow(void *context, const pm_vertex *at, pm_rng *rng, pm_spectrum *radiance)
{
    (void)context;
    (void)at;
    (void)rng;
    *radiance = pm_gray(1.0);
    return PM_OK;
}

/// All layers, under a bright sky.
static pm_compose compose_of(const pm_scenes *s, seen *into, uint32_t colours, uint32_t samples)
{
    pm_compose compose = {.world = &s->world,
                          .source = {.seed = 4, .stream = PM_STREAM_CAMERA},
                          .max_specular = 1000,
                          .splits = 2,
                          .colours = colours,
                          .samples = samples};
    for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
        compose.wanted[layer] = true;
    }
    compose.ask.context = into;
    compose.ask.sky = note_sky;
    compose.ask.global = glow;
    return compose;
}

/// A single face of glass; what lies below it is endless.
static void face_begin(pm_scenes *s, const pm_glass *glass)
{
    pm_scenes_begin(s);
    pm_scenes_wear(s, pm_scenes_square(100.0, 0.0, false), pm_prisms_glass(s, glass));
    pm_scenes_ready(s);
}

static const pm_ray slanting = {{0.0, 0.0, 1.0}, {0.6, 0.0, -0.8}, HUGE_VAL, 0.0, PM_NONE};

/// What the samples of one pixel see.
static pm_spectrum look(const pm_compose *compose, uint64_t pixel)
{
    pm_spectrum sum = pm_gray(0.0);
    for (uint32_t s = 0; s < compose->samples; s++) {
        pm_eye eye = {0};
        uint64_t index = pixel * compose->samples + s;
        CHECK_OK(pm_compose_eye(compose, &slanting, pixel, s, index, &eye));
        sum = pm_spectrum_add(sum, eye.layer[PM_LAYER_SPECULAR]);
    }
    return pm_spectrum_scale(sum, 1.0 / compose->samples);
}

/// Which of `cells` even shares of the range a wavelength is in.
static uint32_t share_of(double wavelength, uint32_t cells)
{
    double range = PM_WAVELENGTH_MOST - PM_WAVELENGTH_LEAST;
    return (uint32_t)((wavelength - PM_WAVELENGTH_LEAST) / range * cells);
}

static void samples_share_the_range_out(void)
{
    static const uint32_t known[][2] = {{1, 16}, {4, 4}, {16, 1}, {6, 3}, {24, 1}};
    pm_scenes s;
    face_begin(&s, pm_glass_named("sf11"));
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        uint32_t cells = known[i][0] * known[i][1];
        for (uint64_t pixel = 0; pixel < 20; pixel++) {
            seen rays = {.count = 0};
            pm_compose compose = compose_of(&s, &rays, known[i][1], known[i][0]);
            look(&compose, pixel);
            // Mirrored and refracted by each: twice every share.
            uint32_t held[32] = {0};
            CHECK(rays.count == (int)(2 * cells));
            for (int r = 0; r < rays.count; r++) {
                held[share_of(rays.wavelength[r], cells)]++;
            }
            for (uint32_t c = 0; c < cells; c++) {
                CHECK_THAT(held[c] == 2, "%u of %u colours: share %u was seen %u times",
                           known[i][0], known[i][1], c, held[c]);
            }
        }
    }
    pm_scenes_free(&s);
}

static void pixels_begin_anywhere(void)
{
    // The place within its share, over pixels and over passes.
    enum { CELLS = 16, COUNT = 4000 };
    pm_scenes s;
    face_begin(&s, pm_glass_named("sf11"));
    uint64_t over_pixels[CELLS] = {0};
    uint64_t over_passes[CELLS] = {0};
    for (uint32_t i = 0; i < COUNT; i++) {
        seen rays = {.count = 0};
        pm_compose compose = compose_of(&s, &rays, 1, 1);
        look(&compose, i);
        compose.source.pass = i;
        look(&compose, 7);
        over_pixels[share_of(rays.wavelength[0], CELLS)]++;
        over_passes[share_of(rays.wavelength[2], CELLS)]++;
    }
    CHECK_EVEN(over_pixels, CELLS);
    CHECK_EVEN(over_passes, CELLS);
    pm_scenes_free(&s);
}

static void a_path_splits_once(void)
{
    // A slab, in which paths meet glass over and over.
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_prisms_slab(&s, 0.3, pm_prisms_glass(&s, pm_glass_named("diamond")));
    pm_scenes_ready(&s);
    for (uint64_t pixel = 0; pixel < 100; pixel++) {
        seen rays = {.count = 0};
        pm_compose compose = compose_of(&s, &rays, 4, 1);
        look(&compose, pixel);
        // Mirrored, straight through, or by roulette from there on: three rays a colour.
        CHECK(rays.count == 12);
        for (int r = 0; r < 12; r++) {
            CHECK_NEAR(rays.wavelength[r], rays.wavelength[r / 3 * 3], 0.0);
            CHECK(share_of(rays.wavelength[r], 4) == (uint32_t)(r / 3));
        }
    }
    pm_scenes_free(&s);
}

static void a_white_sky_stays_white(void)
{
    // A slab mirrors or passes all of it. Sixteen wavelengths a pixel, evenly spaced, tell each
    // mean to some thousandths.
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_prisms_slab(&s, 0.3, pm_prisms_glass(&s, pm_glass_named("sf11")));
    pm_scenes_ready(&s);
    seen rays;
    pm_compose compose = compose_of(&s, &rays, 4, 4);
    for (uint64_t pixel = 0; pixel < 50; pixel++) {
        rays.count = 0;
        pm_spectrum mean = look(&compose, pixel);
        for (int c = 0; c < 3; c++) {
            CHECK_NEAR(mean.c[c], 1.0, 0.015);
        }
    }
    pm_scenes_free(&s);
}

static void gather_rays_keep_their_mean(void)
{
    // Down through a slab to a floor that glows: one wavelength a ray, and white on average.
    enum { COUNT = 4000 };
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_prisms_slab(&s, 0.3, pm_prisms_glass(&s, pm_glass_named("sf11")));
    pm_scenes_wear(&s, pm_scenes_square(100.0, -1.0, false),
                   pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_wear(&s, pm_scenes_square(100.0, 2.0, true), pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_ready(&s);
    seen unread = {.count = 0};
    pm_compose compose = compose_of(&s, &unread, 16, 1);
    double sum[3] = {0};
    double squares[3] = {0};
    for (uint64_t i = 0; i < COUNT; i++) {
        pm_vertex at = {.pixel = i};
        pm_rng rng = pm_shapes_rng(i, 1);
        pm_spectrum radiance;
        uint64_t cut = 0;
        CHECK_OK(pm_compose_gather(&compose, &slanting, &at, &rng, &radiance, &cut));
        for (int c = 0; c < 3; c++) {
            sum[c] += radiance.c[c] / COUNT;
            squares[c] += radiance.c[c] * radiance.c[c] / COUNT;
        }
    }
    for (int c = 0; c < 3; c++) {
        double variance = squares[c] - sum[c] * sum[c];
        CHECK_NEAR(sum[c], 1.0, pm_chance_bound(variance, COUNT));
        CHECK(variance > 0.5);
    }
    pm_scenes_free(&s);
}

static void third_coordinates_are_even(void)
{
    for (uint32_t count = 1; count <= 100; count++) {
        uint32_t held[100] = {0};
        for (uint32_t i = 0; i < count; i++) {
            double u = pm_lattice_apart(0.3 / count, i, count);
            CHECK(u >= 0.0 && u < 1.0);
            held[(int)(u * count)]++;
        }
        for (uint32_t i = 0; i < count; i++) {
            CHECK_THAT(held[i] == 1, "%u points: %u in share %u", count, held[i], i);
        }
        CHECK_NEAR(pm_lattice_apart(0.75, 0, count), 0.75, 0.0);
    }
}

PM_TESTS({"compose.30", "the samples of a pixel share the wavelengths out evenly",
          samples_share_the_range_out},
         {"compose.31", "over pixels and over passes a wavelength is uniform",
          pixels_begin_anywhere},
         {"compose.32", "an eye path splits into colours once, and keeps them through glass",
          a_path_splits_once},
         {"compose.33", "a white sky through a slab that disperses stays white",
          a_white_sky_stays_white},
         {"compose.34", "gather rays take a wavelength, and bring the same light on average",
          gather_rays_keep_their_mean},
         {"compose.35", "the third coordinate of any number of points is even",
          third_coordinates_are_even})
