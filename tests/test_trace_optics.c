// Photons through glass and among mirrors, where geometry says where they must go.
#include "trace.h"

#include "chance.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"

#include <string.h>

static const pm_rng_source source = {.seed = 6, .stream = PM_STREAM_GLOBAL};

/// One photon's way.
typedef struct {
    char path[16]; // its first events
    uint64_t events, deposits, cut, escaped;
    pm_vec3 from, direction;  // of its last flight
    pm_spectrum power;        // that it carried there
    double longest, shortest; // of its directions' lengths
} journey;

static pm_status count_deposit(void *context, const pm_deposit *deposit)
{
    (void)deposit;
    ((journey *)context)->deposits++;
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
    j->events++;
    j->cut += event->kind == PM_EVENT_CUT;
    j->escaped += event->kind == PM_EVENT_ESCAPED;
    j->from = event->from;
    j->direction = event->direction;
    j->power = event->arriving;
    j->longest = fmax(j->longest, pm_vec_length(event->direction));
    j->shortest = fmin(j->shortest, pm_vec_length(event->direction));
}

/// Photon `index` of 1 W, from `origin` along `direction`, at most `most` events.
static journey travel(const pm_scenes *s, pm_vec3 origin, pm_vec3 direction, uint64_t index,
                      uint32_t most)
{
    journey j = {.shortest = HUGE_VAL};
    pm_tracing tracing = {.world = &s->world,
                          .source = source,
                          .max_bounces = most,
                          .max_specular = most,
                          .sink = {&j, count_deposit, note}};
    pm_start start = {.power = pm_gray(1.0), .photon = index};
    start.ray = (pm_ray){origin, pm_vec_normalize(direction), HUGE_VAL, 0.0, PM_NONE};
    CHECK_OK(pm_trace_photons(&tracing, &start, 1));
    return j;
}

/// The way of the first photon whose events are `path`.
static journey travel_by(const pm_scenes *s, pm_vec3 origin, pm_vec3 direction,
                         const char *path)
{
    journey j;
    uint64_t index = 0;
    do {
        CHECK_THAT(index < 10000, "none of 10000 photons goes by %s", path);
        j = travel(s, origin, direction, index++, 100);
    } while (strcmp(j.path, path) != 0);
    return j;
}

static void ball_focuses(void)
{
    // n R / (2 (n - 1)) from the centre, for light near the axis.
    static const double known[3][2] = {{1.5, 1.5}, {4.0 / 3.0, 2.0}, {1.8, 1.125}};
    for (int i = 0; i < 3; i++) {
        pm_scenes s;
        pm_scenes_begin(&s);
        pm_shape ball = pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 2.0);
        pm_scenes_wear(&s, ball, pm_scenes_glass(&s, known[i][0]));
        pm_scenes_ready(&s);
        for (double aside = 1e-3; aside < 0.05; aside *= 7.0) {
            journey j = travel_by(&s, pm_vec(-9.0, 0.6 * aside, 0.8 * aside),
                                  pm_vec(1.0, 0.0, 0.0), "SS");
            CHECK(j.escaped == 1 && j.deposits == 0);
            double t = -j.from.y / j.direction.y;
            // Offsets at the surfaces, and the aberration of light farther out.
            double tolerance = 2e-4 + aside * aside;
            CHECK_NEAR(j.from.z + t * j.direction.z, 0.0, 1e-6);
            CHECK_NEAR(j.from.x + t * j.direction.x, 2.0 * known[i][1], tolerance);
        }
        pm_scenes_free(&s);
    }
}

static void slab_shifts(void)
{
    const double ior = 1.5;
    const double thick = 0.5;
    pm_scenes s;
    pm_scenes_begin(&s);
    int glass = pm_scenes_glass(&s, ior);
    pm_scenes_wear(&s, pm_scenes_square(100.0, 0.0, false), glass);
    pm_scenes_wear(&s, pm_scenes_square(100.0, -thick, true), glass);
    pm_scenes_ready(&s);
    for (double degrees = 0.0; degrees < 86.0; degrees += 5.0) {
        double i = degrees * PM_PI / 180.0;
        pm_vec3 in = pm_vec(sin(i), 0.0, -cos(i));
        pm_vec3 origin = pm_vec_scale(in, -3.0);
        journey j = travel_by(&s, origin, in, "SS");
        CHECK_NEAR(pm_vec_length(pm_vec_sub(j.direction, in)), 0.0, 1e-14);
        // Distance of the way out from the way in.
        double shift = pm_vec_length(pm_vec_cross(pm_vec_sub(j.from, origin), in));
        double want = thick * sin(i) * (1.0 - cos(i) / sqrt(ior * ior - sin(i) * sin(i)));
        CHECK_NEAR(shift, want, 4.0 * 50.0 * PM_OFFSET);
        CHECK_NEAR(j.power.c[1], 1.0, 1e-14);
    }
    pm_scenes_free(&s);
}

static void slab_shares_by_fresnel(void)
{
    // Straight on, R = .04 a face; both ways of counting, no photon both or neither. Beyond the
    // slab arrive (1 - R) / (1 + R) of the photons, with all their power.
    enum { COUNT = 100000 };
    pm_scenes s;
    pm_scenes_begin(&s);
    int glass = pm_scenes_glass(&s, 1.5);
    pm_scenes_wear(&s, pm_scenes_square(10.0, 0.0, false), glass);
    pm_scenes_wear(&s, pm_scenes_square(10.0, -1.0, true), glass);
    pm_scenes_ready(&s);
    double first = 0.0;
    double beyond = 0.0;
    for (uint64_t i = 0; i < COUNT; i++) {
        journey j = travel(&s, pm_vec(0.1, 0.2, 5.0), pm_vec(0.0, 0.0, -1.0), i, 1000);
        CHECK(j.escaped == 1 && j.deposits == 0);
        CHECK_NEAR(j.power.c[0], 1.0, 1e-13);
        first += strcmp(j.path, "S") == 0;
        beyond += j.direction.z < 0.0;
    }
    double through = 0.96 / 1.04;
    CHECK_NEAR(first / COUNT, 0.04, pm_chance_bound(0.04 * 0.96, COUNT));
    CHECK_NEAR(beyond / COUNT, through, pm_chance_bound(through * (1.0 - through), COUNT));
    pm_scenes_free(&s);
}

static void total_reflection_keeps_all(void)
{
    // From inside glass, past 41.81 degrees: every photon is mirrored with all its power.
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_shape face = pm_scenes_square(1e4, 0.0, false);
    pm_scenes_wear(&s, face, pm_scenes_glass(&s, 1.5));
    pm_scenes_ready(&s);
    uint64_t index = 0;
    for (double degrees = 41.82; degrees < 89.9; degrees += 0.013) {
        double i = degrees * PM_PI / 180.0;
        journey j = travel(&s, pm_vec(0.0, 0.0, -1.0), pm_vec(sin(i), 0.0, cos(i)), index++, 9);
        CHECK_THAT(strcmp(j.path, "S") == 0 && j.escaped == 1, "at %g degrees", degrees);
        CHECK_NEAR(j.direction.x, sin(i), 1e-14);
        CHECK_NEAR(j.direction.z, -cos(i), 1e-14);
        CHECK_NEAR(j.power.c[2], 1.0, 0.0);
    }
    pm_scenes_free(&s);
}

static void ball_of_index_one_is_not_there(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_shape ball = pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 1.0);
    pm_scenes_wear(&s, ball, pm_scenes_glass(&s, 1.0));
    pm_scenes_ready(&s);
    for (uint64_t i = 0; i < 1000; i++) {
        double aside = 0.001 * (double)i;
        journey j = travel(&s, pm_vec(-3.0, aside, 0.0), pm_vec(1.0, 0.0, 0.0), i, 9);
        CHECK(strcmp(j.path, "SS") == 0 && j.escaped == 1);
        CHECK_NEAR(pm_vec_length(pm_vec_sub(j.direction, pm_vec(1.0, 0.0, 0.0))), 0.0, 1e-14);
        CHECK_NEAR(j.power.c[0], 1.0, 0.0);
    }
    pm_scenes_free(&s);
}

// --- mirrors

static void mirror_room(pm_scenes *s, double reflectance)
{
    pm_scenes_begin(s);
    pm_scenes_room(s, 1.0, pm_scenes_mirror(s, pm_gray(reflectance)));
    pm_shape ball = pm_shapes_sphere(pm_vec(0.2, -0.1, 0.1), 0.5);
    pm_scenes_wear(s, ball, 0);
    pm_scenes_ready(s);
}

static void mirrors_hold_nothing_and_end(void)
{
    pm_scenes s;
    mirror_room(&s, 1.0);
    for (uint64_t i = 0; i < 100; i++) {
        pm_rng rng = pm_shapes_rng(i, 0);
        journey j = travel(&s, pm_vec(-0.8, 0.7, -0.6), pm_shapes_direction(&rng), i, 1000);
        CHECK(j.deposits == 0 && j.escaped == 0 && j.cut == 1);
        CHECK(j.events == 1001);
        CHECK_NEAR(j.power.c[0], 1.0, 0.0);
    }
    pm_scenes_free(&s);
}

static void directions_stay_unit(void)
{
    // 10,000 mirrorings, of which the ball's would blow up any drift.
    pm_scenes s;
    mirror_room(&s, 1.0);
    for (uint64_t i = 0; i < 10; i++) {
        pm_rng rng = pm_shapes_rng(i, 1);
        journey j = travel(&s, pm_vec(-0.8, 0.7, -0.6), pm_shapes_direction(&rng), i, 10000);
        CHECK(j.events == 10001);
        CHECK_NEAR(j.longest, 1.0, 1e-15);
        CHECK_NEAR(j.shortest, 1.0, 1e-15);
    }
    pm_scenes_free(&s);
}

static void ring_mirror_focuses(void)
{
    // Parallel light near the axis of a hollow cylinder of radius R meets at R / 2 from it.
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_shape ring = pm_shapes_cylinder(pm_vec(0.0, 0.0, -1.0), pm_vec(0.0, 0.0, 1.0), 2.0, 3.0);
    pm_scenes_wear(&s, ring, pm_scenes_mirror(&s, pm_gray(1.0)));
    pm_scenes_ready(&s);
    for (double aside = 1e-3; aside < 0.1; aside *= 3.0) {
        journey j = travel(&s, pm_vec(0.0, aside, 0.0), pm_vec(1.0, 0.0, 0.1), 0, 1);
        CHECK(j.cut == 1 && strcmp(j.path, "S") == 0);
        double t = -j.from.y / j.direction.y;
        CHECK_NEAR(j.from.x + t * j.direction.x, 1.5, aside * aside + 1e-4);
    }
    pm_scenes_free(&s);
}

PM_TESTS({"trace.30", "a glass ball focuses at n R / (2 (n - 1))", ball_focuses},
         {"trace.31", "light leaves a slab parallel, shifted as Snell says", slab_shifts},
         {"trace.32", "a slab passes (1 - R) / (1 + R) of the photons, power undiminished",
          slab_shares_by_fresnel},
         {"trace.33", "past the critical angle every photon is mirrored whole",
          total_reflection_keeps_all},
         {"trace.34", "a ball of index 1 turns no photon", ball_of_index_one_is_not_there},
         {"trace.35", "a room of mirrors holds no photon and ends each at the specular cap",
          mirrors_hold_nothing_and_end},
         {"trace.36", "after ten thousand mirrors a direction is still of length 1",
          directions_stay_unit},
         {"trace.37", "a ring of mirror focuses halfway out", ring_mirror_focuses})
