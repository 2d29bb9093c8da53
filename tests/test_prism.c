// White light through a prism: every wavelength goes where Snell's law sends it, and the band
// that they make on a screen is whole, in order, and has all the power.
#include "prisms.h"

#include "chance.h"
#include "shapes.h"
#include "test.h"
#include "trace.h"

static const double degree = PM_PI / 180.0;

/// A prism alone, of a glass from the catalogue.
static void prism_begin(pm_scenes *s, const char *glass)
{
    pm_scenes_begin(s);
    pm_prisms_prism(s, pm_prisms_glass(s, pm_glass_named(glass)));
}

/// The ray beyond one face, refracted there.
static pm_ray through_face(const pm_scenes *s, const pm_ray *ray)
{
    pm_hit hit;
    pm_lobes lobes;
    pm_scatter onward;
    pm_rng rng = pm_shapes_rng(0, 0);
    CHECK(pm_closest(&s->world, ray, &hit));
    pm_material_lobes(&s->scene, &hit, ray, &lobes);
    CHECK(lobes.count == 2 && lobes.lobe[1].type == PM_LOBE_TRANSMIT && !lobes.disperses);
    pm_material_sample(&lobes, 1, &rng, &onward);
    return pm_hit_ray(&hit, onward.wo, ray->wavelength, onward.medium);
}

static double deviation_of(const pm_scenes *s, double incidence, double wavelength)
{
    pm_ray ray = pm_prisms_beam(incidence);
    pm_vec3 before = ray.direction;
    ray.wavelength = wavelength;
    ray = through_face(s, &ray);
    ray = through_face(s, &ray);
    CHECK_NEAR(ray.wavelength, wavelength, 0.0);
    return acos(pm_vec_dot(before, ray.direction));
}

static void prisms_deviate_as_snell_says(void)
{
    static const char *const glasses[] = {"bk7", "sf11"};
    static const double incidences[2][3] = {{40.0, 49.0, 60.0}, {60.0, 65.0, 72.0}};
    static const double wavelengths[] = {450.0, 550.0, 650.0};
    for (int g = 0; g < 2; g++) {
        pm_scenes s;
        prism_begin(&s, glasses[g]);
        pm_scenes_ready(&s);
        for (int i = 0; i < 9; i++) {
            double incidence = incidences[g][i / 3] * degree;
            double nm = wavelengths[i % 3];
            double index = pm_glass_index(pm_glass_named(glasses[g]), nm);
            double want = pm_prisms_snell(incidence, index).deviation;
            CHECK_NEAR(deviation_of(&s, incidence, nm) / degree, want / degree, 1e-6);
        }
        pm_scenes_free(&s);
    }
}

static void least_deviation_has_its_closed_form(void)
{
    // By hand, from the catalogue's index at the d line: 38.65 and 66.34 degrees for BK7 and
    // N-SF11; 400 and 700 nm at that incidence beside it.
    static const struct {
        const char *glass;
        double incidence, d, blue, red;
    } known[] = {{"bk7", 49.323, 38.647, 39.896, 38.319},
                 {"n-sf11", 63.171, 66.343, 75.485, 64.738}};
    for (int i = 0; i < 2; i++) {
        pm_scenes s;
        prism_begin(&s, known[i].glass);
        pm_scenes_ready(&s);
        double incidence = known[i].incidence * degree;
        double index = pm_glass_index(pm_glass_named(known[i].glass), PM_GLASS_D_LINE);
        double least = 2.0 * asin(0.5 * index) - 60.0 * degree;
        CHECK_NEAR(deviation_of(&s, incidence, PM_GLASS_D_LINE) / degree, least / degree, 1e-5);
        CHECK_NEAR(least / degree, known[i].d, 0.01);
        CHECK_NEAR(deviation_of(&s, incidence, 400.0) / degree, known[i].blue, 0.01);
        CHECK_NEAR(deviation_of(&s, incidence, 700.0) / degree, known[i].red, 0.01);
        // To either side the light is bent more.
        CHECK(deviation_of(&s, incidence - 0.05, PM_GLASS_D_LINE) > least);
        CHECK(deviation_of(&s, incidence + 0.05, PM_GLASS_D_LINE) > least);
        pm_scenes_free(&s);
    }
}

// --- on a screen

enum { PHOTONS = 20000, BINS = 48 };

static const double screen_x = 4.0;

/// What fell on the screen straight through the prism.
typedef struct {
    pm_rng_source source;
    const pm_glass *glass;
    double incidence;
    double worst;    // [m] from where Snell sends that photon's wavelength
    double power[3]; // summed; and with the height that it fell at
    double height[3];
    uint64_t cells[BINS]; // by height between those of 720 and 380 nm
    double low, high;     // [m]
    uint64_t count;
} screen;

/// Height on the screen of a wavelength, and the share of it that comes through.
static double landing(const screen *on, double nm, double *through)
{
    pm_prisms_way way = pm_prisms_snell(on->incidence, pm_glass_index(on->glass, nm));
    double t = (screen_x - way.from.x) / way.direction.x;
    *through = way.through;
    return way.from.z + t * way.direction.z;
}

static int cell_of(const screen *on, double height)
{
    int cell = (int)((height - on->low) / (on->high - on->low) * BINS);
    return cell < 0 ? 0 : cell < BINS ? cell : BINS - 1;
}

static pm_status fall_on(void *context, const pm_deposit *deposit)
{
    screen *on = context;
    if (deposit->bounce != 2 || deposit->position.x < screen_x - 1e-9) {
        return PM_OK;
    }
    double through;
    double nm = pm_prisms_wavelength(&on->source, deposit->photon);
    double height = landing(on, nm, &through);
    on->worst = fmax(on->worst, fabs(deposit->position.z - height));
    for (int c = 0; c < 3; c++) {
        on->power[c] += deposit->power.c[c];
        on->height[c] += deposit->power.c[c] * deposit->position.z;
    }
    on->cells[cell_of(on, deposit->position.z)]++;
    on->count++;
    return PM_OK;
}

/// A beam of gray photons of 1 W, at the d line's least deviation, and a black screen.
static screen shine(const char *glass)
{
    pm_scenes s;
    prism_begin(&s, glass);
    pm_shape wall = pm_shapes_rectangle(pm_vec(screen_x, -50.0, -50.0), pm_vec(0.0, 0.0, 100.0),
                                        pm_vec(0.0, 100.0, 0.0));
    pm_scenes_add(&s, wall, pm_scenes_diffuse(&s, pm_gray(0.0)), PM_NONE);
    pm_scenes_ready(&s);
    screen on = {.source = {.seed = 8, .stream = PM_STREAM_CAUSTIC},
                 .glass = pm_glass_named(glass)};
    on.incidence = pm_prisms_least(pm_glass_index(on.glass, PM_GLASS_D_LINE));
    double unread;
    on.low = landing(&on, PM_WAVELENGTH_LEAST, &unread);
    on.high = landing(&on, PM_WAVELENGTH_MOST, &unread);
    pm_tracing tracing = {.world = &s.world,
                          .source = on.source,
                          .max_bounces = 1000,
                          .max_specular = 1000,
                          .map = PM_MAP_CAUSTIC,
                          .sink = {&on, fall_on, NULL}};
    for (uint64_t i = 0; i < PHOTONS; i++) {
        pm_start start = {.power = pm_gray(1.0), .photon = i};
        start.ray = pm_prisms_beam(on.incidence);
        CHECK_OK(pm_trace_photons(&tracing, &start, 1));
    }
    pm_scenes_free(&s);
    return on;
}

static void each_photon_lands_where_its_wavelength_does(void)
{
    static const char *const glasses[] = {"bk7", "sf11"};
    static const double widths[] = {0.09, 1.1}; // [m] of the bands, at the least
    for (int g = 0; g < 2; g++) {
        screen on = shine(glasses[g]);
        CHECK(on.count > PHOTONS / 2);
        CHECK_THAT(on.high - on.low > widths[g], "%s: %g m", glasses[g], on.high - on.low);
        // Offsets at the two faces, of 2^-19 of coordinates up to 5, lengthened on the way.
        CHECK_NEAR(on.worst, 0.0, 2e-4);
    }
}

static void red_is_bent_least_and_blue_most(void)
{
    // All are bent downwards, to the base.
    screen on = shine("sf11");
    double middle[3];
    for (int c = 0; c < 3; c++) {
        middle[c] = on.height[c] / on.power[c];
    }
    double width = on.high - on.low;
    CHECK_THAT(middle[0] > middle[1] + 0.02 * width, "red %g, green %g", middle[0], middle[1]);
    CHECK_THAT(middle[1] > middle[2] + 0.1 * width, "green %g, blue %g", middle[1], middle[2]);
}

static void the_band_has_no_gap(void)
{
    screen on = shine("sf11");
    double expected[BINS] = {0};
    enum { STEPS = 50000 };
    for (int i = 0; i < STEPS; i++) {
        double through;
        double height = landing(&on, pm_wavelength_at((i + 0.5) / STEPS), &through);
        expected[cell_of(&on, height)] += through * PHOTONS / STEPS;
    }
    for (int b = 0; b < BINS; b++) {
        double off = (double)on.cells[b] - expected[b];
        CHECK_THAT(on.cells[b] > 0 && fabs(off) <= 5.0 * sqrt(expected[b]) + 1.0,
                   "strip %d of %d: %d photons, want %g", b, BINS, (int)on.cells[b],
                   expected[b]);
    }
}

static void the_screen_gets_the_power_channel_by_channel(void)
{
    // Mean over the wavelengths of w_c times the share that comes through.
    screen on = shine("sf11");
    enum { STEPS = 20000 };
    for (int c = 0; c < 3; c++) {
        double mean = 0.0;
        double square = 0.0;
        for (int i = 0; i < STEPS; i++) {
            double through;
            double nm = pm_wavelength_at((i + 0.5) / STEPS);
            landing(&on, nm, &through);
            double weight = pm_wavelength_weight(nm).c[c];
            mean += weight * through / STEPS;
            square += weight * weight * through / STEPS;
        }
        CHECK_NEAR(on.power[c] / PHOTONS, mean, pm_chance_bound(square - mean * mean, PHOTONS));
    }
}

PM_TESTS({"prism.1", "a 60 degree prism deviates 450, 550 and 650 nm as Snell says",
          prisms_deviate_as_snell_says},
         {"prism.2", "at least deviation light leaves a prism by the closed form",
          least_deviation_has_its_closed_form},
         {"prism.3", "each photon falls where Snell sends its wavelength",
          each_photon_lands_where_its_wavelength_does},
         {"prism.4", "red is bent least and blue most", red_is_bent_least_and_blue_most},
         {"prism.5", "the band on the screen has no gap", the_band_has_no_gap},
         {"prism.6", "the screen gets each channel's power, of all wavelengths together",
          the_screen_gets_the_power_channel_by_channel})
