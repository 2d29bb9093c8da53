// Photons through glass that disperses: one wavelength from the first such surface to the next
// D event, and the power of each channel kept.
#include "prisms.h"

#include "chance.h"
#include "ledger.h"
#include "shapes.h"
#include "test.h"

#include <string.h>

static const pm_rng_source source = {.seed = 9, .stream = PM_STREAM_GLOBAL};

/// One photon's way.
typedef struct {
    char path[16]; // its first events
    pm_vec3 from, direction;
    pm_spectrum power;  // at its end
    uint64_t recolours; // events at which its power changed before the roulette
    pm_spectrum second; // power after the second of these
} journey;

static pm_status overlook(void *context, const pm_deposit *deposit)
{
    (void)context;
    (void)deposit;
    return PM_OK;
}

static void note(void *context, const pm_start *start, const pm_event *event)
{
    (void)start;
    journey *j = context;
    size_t length = strlen(j->path);
    if (length + 1 < sizeof j->path) {
        j->path[length] = event->scatter;
    }
    j->from = event->from;
    j->direction = event->direction;
    j->power = event->arriving;
    if (memcmp(&event->arriving, &event->entering, sizeof event->entering) != 0) {
        j->recolours++;
        j->second = j->recolours == 2 ? event->entering : j->second;
    }
}

/// Photon `index` of 1 W along a ray.
static journey travel(const pm_scenes *s, const pm_ray *ray, uint64_t index)
{
    journey j = {.recolours = 0};
    pm_tracing tracing = {.world = &s->world,
                          .source = source,
                          .max_bounces = 1000,
                          .max_specular = 1000,
                          .sink = {&j, overlook, note}};
    pm_start start = {.ray = *ray, .power = pm_gray(1.0), .photon = index};
    CHECK_OK(pm_trace_photons(&tracing, &start, 1));
    return j;
}

static bool is_one_of(double value, const double *known, int count)
{
    for (int i = 0; i < count; i++) {
        if (fabs(value - known[i]) < 1e-12) {
            return true;
        }
    }
    return false;
}

// --- a slab

static void slab_begin(pm_scenes *s, double thick)
{
    pm_scenes_begin(s);
    pm_prisms_slab(s, thick, pm_prisms_glass(s, pm_glass_named("sf11")));
    pm_scenes_ready(s);
}

static void every_wavelength_leaves_a_slab_parallel(void)
{
    // Straight through, or with mirrorings inside: on, or back as from a mirror.
    pm_scenes s;
    slab_begin(&s, 0.5);
    double incidence = 1.0;
    pm_vec3 in = pm_vec(sin(incidence), 0.0, -cos(incidence));
    pm_ray ray = {pm_vec_scale(in, -3.0), in, HUGE_VAL, 0.0, PM_NONE};
    const double upright[] = {in.z, -in.z};
    uint64_t within = 0;
    for (uint64_t i = 0; i < 4000; i++) {
        journey j = travel(&s, &ray, i);
        CHECK(strspn(j.path, "S") == strlen(j.path));
        CHECK_NEAR(j.direction.x, in.x, 1e-13);
        CHECK(is_one_of(j.direction.z, upright, 2));
        within += strlen(j.path) > 2;
    }
    CHECK(within > 100);
    pm_scenes_free(&s);
}

static void one_wavelength_is_kept_inside(void)
{
    // The power changes once, to the weight of the wavelength that the photon's number gives,
    // and the way out is shifted by as much as that wavelength's index says.
    const double thick = 0.5;
    pm_scenes s;
    slab_begin(&s, thick);
    double incidence = 1.0;
    pm_vec3 in = pm_vec(sin(incidence), 0.0, -cos(incidence));
    pm_ray ray = {pm_vec_scale(in, -3.0), in, HUGE_VAL, 0.0, PM_NONE};
    for (uint64_t i = 0; i < 2000; i++) {
        journey j = travel(&s, &ray, i);
        double nm = pm_prisms_wavelength(&source, i);
        pm_spectrum weight = pm_wavelength_weight(nm);
        CHECK(j.recolours == 1);
        for (int c = 0; c < 3; c++) {
            CHECK_NEAR(j.power.c[c], weight.c[c], 1e-12);
        }
        if (strcmp(j.path, "SS") != 0) {
            continue;
        }
        double n = pm_glass_index(pm_glass_named("sf11"), nm);
        double sine = sin(incidence);
        double want = thick * sine * (1.0 - cos(incidence) / sqrt(n * n - sine * sine));
        double shift = pm_vec_length(pm_vec_cross(pm_vec_sub(j.from, ray.origin), in));
        CHECK_NEAR(shift, want, 4.0 * 50.0 * PM_OFFSET);
    }
    pm_scenes_free(&s);
}

// --- power

/// A dark room around a ball of glass; photons of unlike channels sent at the ball.
static void room_keeps_power(const char *glass)
{
    enum { COUNT = 20000 };
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_room(&s, 2.0, pm_scenes_diffuse(&s, pm_gray(0.0)));
    int material = pm_prisms_glass(&s, pm_glass_named(glass));
    pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 1.0), material);
    pm_scenes_ready(&s);
    pm_ledger ledger;
    pm_tracing tracing = pm_ledger_open(&s, &ledger);
    pm_spectrum sent = pm_rgb(1.0, 2.0, 0.25);
    for (uint64_t i = 0; i < COUNT; i++) {
        pm_rng rng = pm_shapes_rng(i, 0);
        pm_vec3 from = pm_vec_scale(pm_shapes_direction(&rng), 1.9);
        pm_vec3 to = pm_vec_sub(pm_shapes_inside(&rng, 0.5), from);
        pm_start start = {.power = sent, .photon = i};
        start.ray = (pm_ray){from, pm_vec_normalize(to), HUGE_VAL, 0.0, PM_NONE};
        CHECK_OK(pm_trace_photons(&tracing, &start, 1));
    }
    CHECK(ledger.deposits == COUNT && ledger.caustic == COUNT && ledger.escaped == 0);
    for (int c = 0; c < 3; c++) {
        // Wavelengths of one pass are spread more evenly than chance would.
        double mean = ledger.indirect.c[c] / COUNT / sent.c[c];
        CHECK_NEAR(mean, 1.0, 2e-3);
    }
    pm_scenes_free(&s);
}

static void power_is_kept_channel_by_channel(void)
{
    room_keeps_power("sf11");
    room_keeps_power("diamond");
}

/// Sums over runs of their share of the mean; afterwards `squares` is that mean's variance.
typedef struct {
    double sum[3], squares[3];
} runs;

static void add_run(runs *sums, pm_spectrum value)
{
    for (int c = 0; c < 3; c++) {
        sums->sum[c] += value.c[c];
        sums->squares[c] += value.c[c] * value.c[c];
    }
}

/// A coloured room with a ball of glass, which disperses where `glass` is given, a mirror ball
/// and a light; not ready yet.
static void coloured_room(pm_scenes *s, const pm_glass *glass)
{
    pm_scenes_begin(s);
    pm_scenes_room(s, 1.0, pm_scenes_diffuse(s, pm_rgb(0.7, 0.4, 0.5)));
    int material = pm_scenes_glass(s, 1.5);
    s->materials[material].glass = glass;
    pm_scenes_wear(s, pm_shapes_sphere(pm_vec(0.1, 0.2, -0.1), 0.6), material);
    pm_scenes_wear(s, pm_shapes_sphere(pm_vec(-0.6, -0.6, -0.6), 0.3),
                   pm_scenes_mirror(s, pm_rgb(0.9, 0.8, 0.7)));
    pm_scenes_point(s, pm_vec(0.2, -0.1, 0.8), pm_rgb(2.0, 1.0, 0.5));
}

/// Power that falls on the walls other than directly, over runs of different seeds.
static runs fall(const pm_glass *glass)
{
    enum { RUNS = 16, COUNT = 2500 };
    pm_scenes s;
    coloured_room(&s, glass);
    pm_scenes_ready(&s);
    runs sums = {{0}, {0}};
    for (uint32_t seed = 1; seed <= RUNS; seed++) {
        pm_ledger ledger;
        pm_tracing tracing = pm_ledger_open(&s, &ledger);
        tracing.source.seed = seed;
        pm_ledger_trace(&s, &tracing, COUNT);
        add_run(&sums, pm_spectrum_scale(ledger.indirect, 1.0 / COUNT / RUNS));
    }
    pm_scenes_free(&s);
    for (int c = 0; c < 3; c++) {
        sums.squares[c] -= sums.sum[c] * sums.sum[c] / RUNS;
        sums.squares[c] *= (double)RUNS / (RUNS - 1);
    }
    return sums;
}

static void glass_without_dispersion_is_glass(void)
{
    runs plain = fall(NULL);
    runs even = fall(&pm_prisms_even);
    for (int c = 0; c < 3; c++) {
        double bound = 5.0 * sqrt(plain.squares[c] + even.squares[c]);
        CHECK_NEAR(even.sum[c], plain.sum[c], bound);
        CHECK_THAT(bound < 0.15 * plain.sum[c], "bound %g", bound / plain.sum[c]);
    }
}

/// Caustic photons in the order that they fall.
typedef struct {
    pm_deposit deposit[1000];
    int count;
} caustics;

static pm_status keep(void *context, const pm_deposit *deposit)
{
    caustics *kept = context;
    CHECK(kept->count < 1000);
    kept->deposit[kept->count++] = *deposit;
    return PM_OK;
}

static void trace_caustics(const pm_glass *glass, caustics *kept)
{
    pm_scenes s;
    coloured_room(&s, glass);
    s.materials[s.scene.material_count - 1] = s.materials[0]; // no other mirror
    pm_scenes_ready(&s);
    kept->count = 0;
    pm_ledger unread;
    pm_tracing tracing = pm_ledger_open(&s, &unread);
    tracing.source = source;
    tracing.map = PM_MAP_CAUSTIC;
    tracing.sink = (pm_trace_sink){kept, keep, NULL};
    pm_ledger_trace(&s, &tracing, 4000);
    pm_scenes_free(&s);
}

static void caustic_photons_differ_by_their_weight_alone(void)
{
    // The wavelength is no draw of the path's own, so the ways are the same.
    static caustics plain;
    static caustics even;
    trace_caustics(NULL, &plain);
    trace_caustics(&pm_prisms_even, &even);
    CHECK_THAT(plain.count > 300 && plain.count == even.count, "%d and %d", plain.count,
               even.count);
    for (int i = 0; i < plain.count; i++) {
        const pm_deposit *one = &plain.deposit[i];
        const pm_deposit *two = &even.deposit[i];
        CHECK(one->photon == two->photon && one->bounce == two->bounce && two->caustic);
        CHECK_NEAR(pm_vec_length(pm_vec_sub(one->position, two->position)), 0.0, 1e-12);
        pm_spectrum weight = pm_wavelength_weight(pm_prisms_wavelength(&source, one->photon));
        for (int c = 0; c < 3; c++) {
            double want = one->power.c[c] * weight.c[c];
            CHECK_NEAR(two->power.c[c], want, 1e-12 * want);
        }
    }
}

// --- after a D event

static void a_second_glass_draws_anew(void)
{
    // Down through a slab onto a white floor, and up to the slab again: with wavelengths drawn
    // independently the mean of w(a) w(b) is 1, with one and the same some 2 to 4. Often the
    // two have no channel in common, and the photon ends.
    enum { COUNT = 20000 };
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_prisms_slab(&s, 0.2, pm_prisms_glass(&s, &pm_prisms_even));
    int white = pm_scenes_diffuse(&s, pm_gray(1.0));
    pm_scenes_wear(&s, pm_scenes_square(100.0, -1.0, false), white);
    pm_scenes_ready(&s);
    double sum[3] = {0};
    double squares[3] = {0};
    double count = 0.0;
    pm_ray down = {pm_vec(0.0, 0.0, 1.0), pm_vec(0.0, 0.0, -1.0), HUGE_VAL, 0.0, PM_NONE};
    for (uint64_t i = 0; i < COUNT; i++) {
        journey j = travel(&s, &down, i);
        if (j.recolours < 2) {
            continue; // mirrored by the slab, or past its rim
        }
        count += 1.0;
        for (int c = 0; c < 3; c++) {
            sum[c] += j.second.c[c];
            squares[c] += j.second.c[c] * j.second.c[c];
        }
    }
    CHECK(count > 0.8 * COUNT);
    for (int c = 0; c < 3; c++) {
        double mean = sum[c] / count;
        double variance = squares[c] / count - mean * mean;
        CHECK_NEAR(mean, 1.0, pm_chance_bound(variance, count));
    }
    pm_scenes_free(&s);
}

static void coloured_light_takes_no_other(void)
{
    pm_scenes s;
    slab_begin(&s, 0.2);
    pm_ray ray = {pm_vec(0.0, 0.0, 1.0), pm_vec(0.0, 0.0, -1.0), HUGE_VAL, 530.0, PM_NONE};
    for (uint64_t i = 0; i < 200; i++) {
        journey j = travel(&s, &ray, i);
        CHECK(j.recolours == 0);
    }
    pm_scenes_free(&s);
}

PM_TESTS({"dispersion.1", "every wavelength leaves a slab parallel to how it came",
          every_wavelength_leaves_a_slab_parallel},
         {"dispersion.2", "inside a slab one wavelength is kept, and shifts by its own index",
          one_wavelength_is_kept_inside},
         {"dispersion.3", "glass that disperses keeps the power of each channel",
          power_is_kept_channel_by_channel},
         {"dispersion.4", "photons through glass of one index for all are those of plain glass",
          glass_without_dispersion_is_glass},
         {"dispersion.5", "caustic photons through such glass differ by their weights alone",
          caustic_photons_differ_by_their_weight_alone},
         {"dispersion.6", "past a wall the next glass draws a wavelength of its own",
          a_second_glass_draws_anew},
         {"dispersion.7", "light that has a wavelength takes no other in glass",
          coloured_light_takes_no_other})
