// Photons in media: how far they get, what is deposited with which marks, what is passed. Beams
// are made by hand, all photons along one line.
#include "trace.h"

#include "chance.h"
#include "ledger.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"

#include <stdlib.h>
#include <string.h>

enum { COUNT = 20000 };

/// A sheet that parts media: `above` on the side of z+, `below` on the other.
static void sheet(pm_scenes *s, double z, int above, int below)
{
    pm_scenes_bound(s, pm_scenes_square(100.0, z, false), below, above);
}

/// A beam of COUNT photons of 1 W each from (0, 0, 1) down into the scene, in `medium`.
static void shoot(const pm_scenes *s, const pm_tracing *tracing, double cosine, int medium)
{
    pm_vec3 way = pm_vec(sqrt(1.0 - cosine * cosine), 0.0, -cosine);
    pm_start *starts = calloc(COUNT, sizeof *starts);
    CHECK(starts != NULL && s->scene.light_count > 0);
    for (uint64_t i = 0; i < COUNT; i++) {
        starts[i] = (pm_start){
            .ray = {pm_vec(0.0, 0.0, 1.0), way, HUGE_VAL, 0.0, medium},
            .power = pm_gray(1.0),
            .photon = i,
        };
    }
    CHECK_OK(pm_trace_photons(tracing, starts, COUNT));
    free(starts);
}

/// Begins a scene with a light that is not used: beams are made by hand.
static void begin(pm_scenes *s)
{
    pm_scenes_begin(s);
    pm_scenes_point(s, pm_vec(0.0, 0.0, 1.0), pm_gray(1.0));
}

/// Ends the test unless the share exp(-depth) of the beam collides nowhere. Frees the scene.
static void check_survivors(pm_scenes *s, double cosine, int medium, double depth)
{
    pm_ledger l;
    pm_scenes_ready(s);
    pm_tracing tracing = pm_ledger_open(s, &l);
    tracing.map = PM_MAP_VOLUME;
    l.check_path = true;
    shoot(s, &tracing, cosine, medium);
    double share = exp(-depth);
    double got = 1.0 - (double)(l.first + l.caustic) / COUNT; // glass of ior 1 is an event
    CHECK_NEAR(got, share, pm_chance_bound(share * (1.0 - share), COUNT) + 1e-15);
    CHECK(l.deposits == l.in_medium && l.absorbed + l.escaped == COUNT);
    pm_scenes_free(s);
}

static void slabs_let_through_what_they_should(void)
{
    static const double albedos[3] = {0.0, 0.2, 0.8};
    for (int i = 0; i < 3; i++) {
        pm_scenes s;
        begin(&s);
        int fog = pm_scenes_medium(&s, 1.5, pm_gray(albedos[i]), 0.4);
        sheet(&s, 0.0, PM_NONE, fog);
        sheet(&s, -0.5, fog, PM_NONE);
        check_survivors(&s, 0.6, PM_NONE, 1.5 * 0.5 / 0.6);
    }
}

static void depths_of_media_in_a_row_add_up(void)
{
    pm_scenes s;
    begin(&s);
    int fog = pm_scenes_medium(&s, 1.5, pm_gray(0.0), 0.0);
    int smoke = pm_scenes_medium(&s, 0.7, pm_gray(0.0), 0.0);
    sheet(&s, 0.0, PM_NONE, fog);
    sheet(&s, -0.5, fog, smoke);
    sheet(&s, -1.0, smoke, PM_NONE);
    sheet(&s, -3.0, PM_NONE, smoke);
    sheet(&s, -3.2, smoke, PM_NONE);
    check_survivors(&s, 0.8, PM_NONE, (1.5 * 0.5 + 0.7 * (0.5 + 0.2)) / 0.8);
}

static void what_parts_no_media_leaves_the_ray_in_its_own(void)
{
    // Fog above 0; in it a null sheet and a ball of ior 1, which have fog inside.
    pm_scenes s;
    begin(&s);
    int fog = pm_scenes_medium(&s, 0.9, pm_gray(0.0), 0.0);
    pm_scenes_wear(&s, pm_scenes_square(100.0, 0.9, false), pm_scenes_null(&s));
    pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(0.0, 0.0, 0.5), 0.2), pm_scenes_glass(&s, 1.0));
    sheet(&s, 0.0, fog, PM_NONE);
    check_survivors(&s, 1.0, fog, 0.9);
}

static void a_black_floor_is_dimmed_once(void)
{
    // The photons that reach it come with all their power: fewer come, and that is all.
    pm_scenes s;
    pm_ledger l;
    begin(&s);
    int fog = pm_scenes_medium(&s, 1.2, pm_gray(0.0), 0.0);
    sheet(&s, 0.0, PM_NONE, fog);
    pm_scenes_wear(&s, pm_scenes_square(100.0, -1.0, false),
                   pm_scenes_diffuse(&s, pm_gray(0.0)));
    pm_scenes_ready(&s);
    pm_tracing tracing = pm_ledger_open(&s, &l);
    l.check_path = true;
    shoot(&s, &tracing, 1.0, PM_NONE);
    double share = exp(-1.2);
    CHECK(l.first == l.deposits && l.in_medium == 0);
    CHECK_NEAR(l.direct.c[1], (double)l.first, 0.0);
    CHECK_NEAR(l.direct.c[1] / COUNT, share, pm_chance_bound(share * (1.0 - share), COUNT));
    pm_scenes_free(&s);
}

static void no_extinction_stops_nothing(void)
{
    pm_scenes s;
    begin(&s);
    int clear = pm_scenes_medium(&s, 0.0, pm_gray(0.5), 0.0);
    sheet(&s, -1e6, clear, clear);
    check_survivors(&s, 0.3, clear, 0.0);
}

/// How deep a beam gets into soot.
static pm_status note_depth(void *context, const pm_deposit *d)
{
    double *deepest = context;
    CHECK(d->position.z < 0.0 && d->in_medium);
    *deepest = fmax(*deepest, -d->position.z);
    return PM_OK;
}

static void soot_takes_all_within_its_skin(void)
{
    double deepest = 0.0;
    pm_scenes s;
    pm_ledger l;
    begin(&s);
    int soot = pm_scenes_medium(&s, 1e6, pm_gray(0.5), 0.0);
    sheet(&s, 0.0, PM_NONE, soot);
    sheet(&s, -1.0, soot, PM_NONE);
    pm_scenes_ready(&s);
    pm_tracing tracing = pm_ledger_open(&s, &l);
    tracing.map = PM_MAP_VOLUME;
    tracing.sink = (pm_trace_sink){&deepest, note_depth, NULL};
    shoot(&s, &tracing, 1.0, PM_NONE);
    CHECK_THAT(deepest > 1e-6 && deepest < 1e-4 + 50.0 * PM_OFFSET, "%g m deep", deepest);
    pm_scenes_free(&s);
}

// --- a medium without end

/// What becomes of photons from a point in fog that is everywhere.
typedef struct {
    pm_vec3 from;
    double sigma_t;
    uint64_t shells[10]; // first collisions, in shells that are all equally likely
    uint64_t octants[8];
    uint64_t collisions;
} haze;

static pm_status note_collision(void *context, const pm_deposit *d)
{
    haze *h = context;
    h->collisions++;
    if (d->first) {
        pm_vec3 way = pm_vec_sub(d->position, h->from);
        double below = 1.0 - exp(-h->sigma_t * pm_vec_length(way));
        h->shells[(int)(10.0 * below)]++;
        h->octants[(way.x > 0.0) + 2 * (way.y > 0.0) + 4 * (way.z > 0.0)]++;
    }
    return PM_OK;
}

static void fog_without_end(void)
{
    static const double albedos[2] = {0.2, 0.8};
    for (int i = 0; i < 2; i++) {
        double albedo = albedos[i];
        pm_scenes s;
        pm_ledger l;
        begin(&s);
        haze h = {.from = s.lights[0].position, .sigma_t = 0.3};
        s.lights[0].medium = pm_scenes_medium(&s, h.sigma_t, pm_gray(albedo), 0.5);
        pm_scenes_wear(&s, pm_scenes_square(1.0, 0.0, false), pm_scenes_null(&s));
        pm_scenes_ready(&s);
        pm_tracing tracing = pm_ledger_open(&s, &l);
        tracing.map = PM_MAP_VOLUME;
        tracing.sink = (pm_trace_sink){&h, note_collision, NULL};
        pm_ledger_trace(&s, &tracing, COUNT);
        CHECK_EVEN(h.shells, 10);
        CHECK_EVEN(h.octants, 8);
        double rest = 1.0 - albedo;
        CHECK_NEAR((double)h.collisions / COUNT, 1.0 / rest,
                   pm_chance_bound(albedo / (rest * rest), COUNT));
        pm_scenes_free(&s);
    }
}

// --- roulette

/// What collisions carried on.
typedef struct {
    pm_spectrum sum, squares; // over the power that entered, channel by channel
    uint64_t count, dead;
} carried;

static void note_carried(void *context, const pm_start *start, const pm_event *event)
{
    carried *sum = context;
    (void)start;
    if (event->kind != PM_EVENT_MEDIUM) {
        return;
    }
    CHECK(event->lobes == NULL && event->hit == NULL && event->medium == 0);
    CHECK((event->scatter == 'V') == !pm_spectrum_is_black(event->carried));
    sum->count++;
    sum->dead += event->scatter == 0;
    for (int c = 0; c < 3; c++) {
        double share = event->carried.c[c] / event->arriving.c[c];
        sum->sum.c[c] += share;
        sum->squares.c[c] += share * share;
    }
}

static pm_status pass_by(void *context, const pm_deposit *d)
{
    (void)context;
    (void)d;
    return PM_OK;
}

static void coloured_fog_keeps_its_albedo(void)
{
    for (pm_roulette_rule rule = PM_ROULETTE_MAX; rule <= PM_ROULETTE_AVERAGE; rule++) {
        pm_spectrum albedo = pm_rgb(0.9, 0.5, 0.1);
        carried sum = {0};
        pm_scenes s;
        pm_ledger l;
        begin(&s);
        s.lights[0].medium = pm_scenes_medium(&s, 2.0, albedo, 0.0);
        pm_scenes_wear(&s, pm_scenes_square(1.0, 0.0, false), pm_scenes_null(&s));
        pm_scenes_ready(&s);
        pm_tracing tracing = pm_ledger_open(&s, &l);
        tracing.rule = rule;
        tracing.max_bounces = 3;
        tracing.sink = (pm_trace_sink){&sum, pass_by, note_carried};
        pm_ledger_trace(&s, &tracing, COUNT);
        CHECK(sum.dead > COUNT / 20);
        double n = (double)sum.count;
        for (int c = 0; c < 3; c++) {
            double mean = sum.sum.c[c] / n;
            CHECK_NEAR(mean, albedo.c[c],
                       pm_chance_bound(sum.squares.c[c] / n - mean * mean, n));
        }
        pm_scenes_free(&s);
    }
}

// --- directions

/// Cosines between the ways before and after collisions.
typedef struct {
    pm_vec3 before;
    bool turned; // by the last event of this photon
    double sum;
    uint64_t count;
} turns;

static void note_turn(void *context, const pm_start *start, const pm_event *event)
{
    turns *t = context;
    (void)start;
    if (event->bounce > 0 && t->turned) {
        t->sum += pm_vec_dot(t->before, event->direction);
        t->count++;
    }
    t->before = event->direction;
    t->turned = event->scatter == 'V';
}

static void collisions_turn_photons_by_g(void)
{
    static const double gs[3] = {-0.6, 0.0, 0.8};
    for (int i = 0; i < 3; i++) {
        turns t = {0};
        pm_scenes s;
        pm_ledger l;
        begin(&s);
        s.lights[0].medium = pm_scenes_medium(&s, 2.0, pm_gray(0.7), gs[i]);
        pm_scenes_wear(&s, pm_scenes_square(1.0, 0.0, false), pm_scenes_null(&s));
        pm_scenes_ready(&s);
        pm_tracing tracing = pm_ledger_open(&s, &l);
        tracing.sink = (pm_trace_sink){&t, pass_by, note_turn};
        pm_ledger_trace(&s, &tracing, COUNT);
        double n = (double)t.count;
        CHECK(t.count > COUNT);
        CHECK_NEAR(t.sum / n, gs[i],
                   pm_chance_bound((1.0 + 2.0 * gs[i] * gs[i]) / 3.0 - gs[i] * gs[i], n));
        pm_scenes_free(&s);
    }
}

PM_TESTS({"trace_media.1", "a slab lets exp(-depth) through, whatever it scatters",
          slabs_let_through_what_they_should},
         {"trace_media.2", "depths of media in a row add up", depths_of_media_in_a_row_add_up},
         {"trace_media.3", "what parts no media leaves the ray in its own",
          what_parts_no_media_leaves_the_ray_in_its_own},
         {"trace_media.4", "fog dims a floor by number of photons, not by their power too",
          a_black_floor_is_dimmed_once},
         {"trace_media.5", "a medium of no extinction stops nothing, however long the way",
          no_extinction_stops_nothing},
         {"trace_media.6", "soot takes all light within its skin",
          soot_takes_all_within_its_skin},
         {"trace_media.7", "fog without end: density and number of collisions",
          fog_without_end},
         {"trace_media.8", "coloured fog keeps its albedo by either roulette rule",
          coloured_fog_keeps_its_albedo},
         {"trace_media.9", "collisions turn photons by g, on from the way they came",
          collisions_turn_photons_by_g})
