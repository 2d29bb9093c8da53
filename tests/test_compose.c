// Composing alone: sources that answer with constants show who was asked, for which layer and
// with what weight.
#include "chance.h"
#include "desk.h"
#include "shapes.h"
#include "test.h"

static pm_status say_broken(void *context, const pm_vertex *at, pm_spectrum *radiance)
{
    (void)context;
    (void)at;
    *radiance = pm_gray(1.0);
    return PM_FAIL(PM_ENOMEM, "%s", "the lookup broke");
}

static pm_status say_broken_too(void *context, const pm_vertex *at, pm_rng *rng,
                                pm_spectrum *radiance)
{
    (void)rng;
    return say_broken(context, at, radiance);
}

static void check_layers(const pm_eye *eye, double emission, double direct, double caustic,
                         double indirect, double specular)
{
    CHECK_NEAR(eye->layer[PM_LAYER_EMISSION].c[0], emission, 1e-9);
    CHECK_NEAR(eye->layer[PM_LAYER_DIRECT].c[1], direct, 1e-9);
    CHECK_NEAR(eye->layer[PM_LAYER_CAUSTIC].c[2], caustic, 1e-9);
    CHECK_NEAR(eye->layer[PM_LAYER_INDIRECT].c[0], indirect, 1e-9);
    CHECK_NEAR(eye->layer[PM_LAYER_SPECULAR].c[1], specular, 1e-9);
    CHECK_NEAR(eye->layer[PM_LAYER_VOLUME].c[0], 0.0, 0.0);
}

static const pm_vec3 middle = {0.0, 0.0, 0.0};
static const pm_vec3 down = {0.0, 0.0, -1.0}; // a point straight below the middle

/// A lamp that is diffuse, too, fills z = -1, facing up.
static void add_lamp(pm_desk *d, int material)
{
    int lamp = pm_scenes_wear(&d->s, pm_scenes_square(4.0, -1.0, false), material);
    pm_scenes_lamp(&d->s, lamp, pm_gray(1.0));
}

static void diffuse_lamp_fills_each_layer_once(void)
{
    pm_desk d = {0};
    pm_scenes_begin(&d.s);
    add_lamp(&d, pm_scenes_diffuse(&d.s, pm_gray(0.5)));
    pm_desk_ready(&d);
    pm_eye eye = pm_desk_look(&d, middle, down, 0);
    check_layers(&eye, PM_DESK_EMITTED, PM_DESK_DIRECT, PM_DESK_CAUSTIC, PM_DESK_INDIRECT, 0.0);
    CHECK(eye.hit && eye.emitter && eye.vertices == 1 && eye.cut == 0);
    CHECK(d.direct == 1 && d.caustic == 1 && d.indirect == 1 && d.global == 0);
    CHECK(d.last.pixel == 3 && d.last.sample == 2 && d.last.vertex == 1);
    CHECK_NEAR(eye.depth, 1.0, 1e-12);
    CHECK_NEAR(eye.normal.z, 1.0, 0.0);

    pm_eye nothing = pm_desk_look(&d, middle, pm_vec(0.0, 0.0, 1.0), 0);
    check_layers(&nothing, 0.0, 0.0, 0.0, 0.0, 0.0);
    CHECK(!nothing.hit && !nothing.emitter && nothing.vertices == 0);

    pm_eye behind = pm_desk_look(&d, pm_vec(0.0, 0.0, -2.0), down, 0);
    CHECK(behind.hit && !behind.emitter);
    CHECK_NEAR(behind.normal.z, -1.0, 0.0);
    pm_scenes_free(&d.s);
}

static void mirrors_bring_everything_into_specular(void)
{
    pm_desk d = {0};
    pm_scenes_begin(&d.s);
    add_lamp(&d, pm_scenes_diffuse(&d.s, pm_gray(0.5)));
    pm_scenes_wear(&d.s, pm_scenes_square(4.0, 1.0, true),
                   pm_scenes_mirror(&d.s, pm_rgb(0.75, 0.5, 0.25)));
    pm_desk_ready(&d);
    pm_eye eye = pm_desk_look(&d, middle, pm_vec(0.0, 0.0, 1.0), 0);
    check_layers(&eye, 0.0, 0.0, 0.0, 0.0, 0.5 * PM_DESK_ALL);
    CHECK_NEAR(eye.layer[PM_LAYER_SPECULAR].c[0], 0.75 * PM_DESK_ALL, 1e-9);
    CHECK(eye.emitter && eye.vertices == 2 && d.last.vertex == 2);
    CHECK_NEAR(eye.depth, 1.0, 1e-12);
    CHECK_NEAR(eye.normal.z, -1.0, 0.0);
    pm_scenes_free(&d.s);
}

static void glass_in_a_uniform_room_is_invisible(void)
{
    const uint32_t splits[] = {0, 1, 2, 5};
    const pm_roulette_rule rules[] = {PM_ROULETTE_MAX, PM_ROULETTE_AVERAGE};
    pm_desk d = {0};
    pm_scenes_begin(&d.s);
    int glass = pm_scenes_glass(&d.s, 1.5);
    int room = pm_scenes_room(&d.s, 2.0, pm_scenes_diffuse(&d.s, pm_gray(0.5)));
    for (int wall = room; wall < room + 6; wall++) {
        pm_scenes_lamp(&d.s, wall, pm_gray(1.0));
    }
    pm_scenes_wear(&d.s, pm_shapes_sphere(middle, 1.0), glass);
    pm_desk_ready(&d);
    for (uint64_t i = 0; i < 400; i++) {
        pm_rng rng = pm_shapes_rng(i, 1);
        d.compose.splits = splits[i % 4];
        d.compose.rule = rules[i / 4 % 2];
        pm_eye eye = pm_desk_look(&d, pm_vec(1.5, 1.2, -0.9), pm_shapes_inside(&rng, 0.5), i);
        check_layers(&eye, 0.0, 0.0, 0.0, 0.0, PM_DESK_ALL);
        CHECK(eye.cut == 0);
    }
    pm_scenes_free(&d.s);
}

// Seen straight on from air, 4 % are mirrored; what stands in the glass sends radiance through
// that is n^2 times less outside.
static void glass_thins_radiance_that_leaves_it(void)
{
    pm_desk d = {0};
    pm_scenes_begin(&d.s);
    int diffuse = pm_scenes_diffuse(&d.s, pm_gray(0.5));
    int glass = pm_scenes_glass(&d.s, 1.5);
    pm_scenes_wear(&d.s, pm_shapes_sphere(middle, 1.0), glass);
    pm_scenes_wear(&d.s, pm_shapes_sphere(middle, 0.5), diffuse);
    pm_desk_ready(&d);
    double answer = PM_DESK_DIRECT + PM_DESK_CAUSTIC + PM_DESK_INDIRECT;
    d.compose.splits = 1; // the mirrored part of the second crossing plays roulette and escapes
    pm_eye eye = pm_desk_look(&d, pm_vec(3.0, 0.0, 0.0), middle, 0);
    check_layers(&eye, 0.0, 0.0, 0.0, 0.0, 0.96 / 2.25 * answer);
    pm_scenes_free(&d.s);
}

static void null_surfaces_are_no_event(void)
{
    pm_desk d = {0};
    pm_scenes_begin(&d.s);
    add_lamp(&d, pm_scenes_diffuse(&d.s, pm_gray(0.5)));
    int null = pm_scenes_null(&d.s);
    pm_scenes_wear(&d.s, pm_scenes_square(4.0, -0.25, false), null);
    pm_scenes_wear(&d.s, pm_scenes_square(4.0, -0.5, true), null);
    pm_desk_ready(&d);
    pm_eye eye = pm_desk_look(&d, middle, down, 0);
    check_layers(&eye, PM_DESK_EMITTED, PM_DESK_DIRECT, PM_DESK_CAUSTIC, PM_DESK_INDIRECT, 0.0);
    CHECK(eye.vertices == 1);
    CHECK_NEAR(eye.depth, 1.0, 1e-12); // from the eye, not from the last pane
    CHECK_NEAR(pm_desk_gather(&d, middle, down, 0), PM_DESK_GLOBAL, 1e-9);
    pm_scenes_free(&d.s);
}

// Its photons and shadow rays leave it, so the eye must see it, too; from the front only.
static void null_lamps_shine_and_let_pass(void)
{
    pm_desk d = {0};
    pm_scenes_begin(&d.s);
    pm_scenes_wear(&d.s, pm_scenes_square(4.0, -1.0, false),
                   pm_scenes_diffuse(&d.s, pm_gray(0.5)));
    int null = pm_scenes_null(&d.s);
    int front = pm_scenes_wear(&d.s, pm_scenes_square(4.0, -0.25, false), null);
    int back = pm_scenes_wear(&d.s, pm_scenes_square(4.0, -0.5, true), null);
    pm_scenes_lamp(&d.s, front, pm_gray(1.0));
    pm_scenes_lamp(&d.s, back, pm_gray(1.0));
    pm_desk_ready(&d);
    pm_eye eye = pm_desk_look(&d, middle, down, 0);
    check_layers(&eye, PM_DESK_EMITTED, PM_DESK_DIRECT, PM_DESK_CAUSTIC, PM_DESK_INDIRECT, 0.0);
    CHECK(eye.emitter && eye.vertices == 1);
    CHECK_NEAR(eye.depth, 1.0, 1e-12);
    CHECK_NEAR(pm_desk_gather(&d, middle, down, 0), PM_DESK_GLOBAL, 1e-9);
    pm_scenes_free(&d.s);
}

static void back_of_a_one_sided_surface_is_black(void)
{
    pm_desk d = {0};
    pm_scenes_begin(&d.s);
    int diffuse = pm_scenes_diffuse(&d.s, pm_gray(0.5));
    pm_scenes_add(&d.s, pm_scenes_square(4.0, -1.0, true), diffuse, PM_NONE);
    pm_scenes_wear(&d.s, pm_scenes_square(4.0, 1.0, false), diffuse);
    pm_desk_ready(&d);
    pm_eye back = pm_desk_look(&d, middle, down, 0);
    check_layers(&back, 0.0, 0.0, 0.0, 0.0, 0.0);
    CHECK(back.hit && back.vertices == 1 && d.direct == 0);
    CHECK_NEAR(pm_desk_gather(&d, middle, down, 0), 0.0, 0.0);

    pm_eye twosided = pm_desk_look(&d, middle, pm_vec(0.0, 0.0, 1.0), 0);
    check_layers(&twosided, 0.0, PM_DESK_DIRECT, PM_DESK_CAUSTIC, PM_DESK_INDIRECT, 0.0);
    pm_scenes_free(&d.s);
}

static void unwanted_layers_are_not_asked_for(void)
{
    pm_desk d = {0};
    pm_scenes_begin(&d.s);
    add_lamp(&d, pm_scenes_diffuse(&d.s, pm_gray(0.5)));
    pm_scenes_wear(&d.s, pm_scenes_square(4.0, 1.0, true),
                   pm_scenes_mirror(&d.s, pm_gray(1.0)));
    pm_desk_ready(&d);
    for (int wanted = 0; wanted < PM_LAYER_COUNT; wanted++) {
        for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
            d.compose.wanted[layer] = layer == wanted;
        }
        d.direct = d.caustic = d.indirect = 0;
        pm_eye eye = pm_desk_look(&d, middle, down, 0);
        check_layers(&eye, wanted == PM_LAYER_EMISSION ? PM_DESK_EMITTED : 0.0,
                     wanted == PM_LAYER_DIRECT ? PM_DESK_DIRECT : 0.0,
                     wanted == PM_LAYER_CAUSTIC ? PM_DESK_CAUSTIC : 0.0,
                     wanted == PM_LAYER_INDIRECT ? PM_DESK_INDIRECT : 0.0, 0.0);
        CHECK(d.direct == (wanted == PM_LAYER_DIRECT));
        CHECK(d.caustic == (wanted == PM_LAYER_CAUSTIC));
        CHECK(d.indirect == (wanted == PM_LAYER_INDIRECT));
        eye = pm_desk_look(&d, middle, pm_vec(0.0, 0.0, 1.0), 0);
        check_layers(&eye, 0.0, 0.0, 0.0, 0.0, wanted == PM_LAYER_SPECULAR ? PM_DESK_ALL : 0.0);
    }
    pm_scenes_free(&d.s);
}

static void missing_sources_are_black(void)
{
    pm_desk d = {0};
    pm_scenes_begin(&d.s);
    add_lamp(&d, pm_scenes_diffuse(&d.s, pm_gray(0.5)));
    pm_desk_ready(&d);
    d.compose.ask.caustic = NULL;
    d.compose.ask.indirect = NULL;
    d.compose.ask.global = NULL;
    pm_eye eye = pm_desk_look(&d, middle, down, 0);
    check_layers(&eye, PM_DESK_EMITTED, PM_DESK_DIRECT, 0.0, 0.0, 0.0);
    CHECK_NEAR(pm_desk_gather(&d, middle, down, 0), 0.0, 0.0);
    pm_scenes_free(&d.s);
}

static void failures_of_a_source_come_back(void)
{
    pm_desk d = {0};
    pm_scenes_begin(&d.s);
    add_lamp(&d, pm_scenes_diffuse(&d.s, pm_gray(0.5)));
    pm_desk_ready(&d);
    d.compose.ask.caustic = say_broken;
    d.compose.ask.global = say_broken_too;
    pm_ray ray = {middle, down, HUGE_VAL, 0.0, PM_NONE};
    pm_eye eye = {0};
    CHECK_FAILS(pm_compose_eye(&d.compose, &ray, 0, 0, 0, &eye), PM_ENOMEM, "lookup broke");
    pm_vertex at = {.vertex = 1};
    pm_rng rng = pm_shapes_rng(0, 0);
    pm_spectrum radiance;
    CHECK_FAILS(pm_compose_gather(&d.compose, &ray, &at, &rng, &radiance, &d.cut), PM_ENOMEM,
                "lookup broke");
    pm_scenes_free(&d.s);
}

static void endless_mirrors_are_cut_and_counted(void)
{
    pm_desk d = {0};
    pm_scenes_begin(&d.s);
    int mirror = pm_scenes_mirror(&d.s, pm_gray(1.0));
    pm_scenes_wear(&d.s, pm_scenes_square(4.0, 1.0, true), mirror);
    int floor = pm_scenes_wear(&d.s, pm_scenes_square(4.0, -1.0, false), mirror);
    pm_desk_ready(&d);
    d.compose.max_specular = 10;
    pm_eye eye = pm_desk_look(&d, middle, down, 0);
    CHECK(eye.cut == 1 && eye.vertices == 11 && !eye.emitter);
    CHECK_NEAR(pm_desk_gather(&d, middle, down, 0), 0.0, 0.0);
    CHECK(d.cut == 1);

    // A path whose last allowed event takes it to a wall is whole.
    int diffuse = pm_scenes_diffuse(&d.s, pm_gray(0.5));
    d.s.shapes[floor].material[0] = d.s.shapes[floor].material[1] = diffuse;
    d.compose.max_specular = 1;
    eye = pm_desk_look(&d, middle, pm_vec(0.0, 0.0, 1.0), 0);
    check_layers(&eye, 0.0, 0.0, 0.0, 0.0, PM_DESK_DIRECT + PM_DESK_CAUSTIC + PM_DESK_INDIRECT);
    CHECK(eye.cut == 0);
    CHECK_NEAR(pm_desk_gather(&d, middle, pm_vec(0.0, 0.0, 1.0), 0), PM_DESK_GLOBAL, 1e-9);
    CHECK(d.cut == 1);
    pm_scenes_free(&d.s);
}

/// Mean and variance of the specular layer of 4000 looks at a point.
static void many_looks(const pm_desk *d, pm_vec3 from, pm_vec3 to, double *mean,
                       double *variance)
{
    enum { LOOKS = 4000 };
    double sum = 0.0;
    double square = 0.0;
    for (uint64_t i = 0; i < LOOKS; i++) {
        double x = pm_desk_look(d, from, to, i).layer[PM_LAYER_SPECULAR].c[0];
        sum += x;
        square += x * x;
    }
    *mean = sum / LOOKS;
    *variance = fmax(0.0, square / LOOKS - *mean * *mean) / LOOKS;
}

// A black room but for one wall behind the ball, so that lobes bring different light.
static void splitting_and_roulette_have_one_mean(void)
{
    pm_desk d = {0};
    pm_scenes_begin(&d.s);
    add_lamp(&d, pm_scenes_diffuse(&d.s, pm_gray(0.5)));
    pm_scenes_wear(&d.s, pm_shapes_sphere(middle, 0.5), pm_scenes_glass(&d.s, 1.5));
    pm_desk_ready(&d);
    pm_vec3 from = pm_vec(0.3, 0.2, 2.0);
    pm_vec3 to = pm_vec(0.2, 0.25, 0.0);
    double want;
    double unused;
    d.compose.splits = 12;
    many_looks(&d, from, to, &want, &unused);
    for (int rule = 0; rule < 2; rule++) {
        for (uint32_t splits = 0; splits < 3; splits++) {
            double mean;
            double variance;
            d.compose.splits = splits;
            d.compose.rule = (pm_roulette_rule)rule;
            many_looks(&d, from, to, &mean, &variance);
            CHECK_NEAR(mean, want, pm_chance_bound(variance, 1.0) + 1e-9 * want);
        }
    }
    pm_scenes_free(&d.s);
}

static void gather_rays_see_no_lamps(void)
{
    pm_desk d = {0};
    pm_scenes_begin(&d.s);
    add_lamp(&d, PM_NONE); // black but for what it emits
    pm_scenes_wear(&d.s, pm_scenes_square(4.0, 1.0, true),
                   pm_scenes_mirror(&d.s, pm_gray(1.0)));
    pm_scenes_wear(&d.s, pm_shapes_sphere(pm_vec(5.0, 0.0, 0.0), 0.5),
                   pm_scenes_glass(&d.s, 1.5));
    pm_desk_ready(&d);
    pm_vec3 up = pm_vec(0.1, 0.0, 1.0);
    CHECK_NEAR(pm_desk_gather(&d, middle, down, 0), 0.0, 0.0);
    CHECK_NEAR(pm_desk_gather(&d, middle, up, 0), 0.0, 0.0);
    for (uint64_t i = 0; i < 100; i++) { // through the ball, to the lamp or nowhere
        CHECK_NEAR(pm_desk_gather(&d, pm_vec(10.0, 0.0, 0.3), pm_vec(5.0, 0.0, 0.1), i), 0.0,
                   0.0);
    }
    CHECK(d.direct + d.caustic + d.indirect + d.global == 0);
    pm_scenes_free(&d.s);
}

static void gather_rays_find_the_global_map_everywhere(void)
{
    pm_desk d = {0};
    pm_scenes_begin(&d.s);
    int diffuse = pm_scenes_diffuse(&d.s, pm_gray(0.5));
    add_lamp(&d, diffuse); // a lamp that reflects holds photons like any wall
    pm_scenes_wear(&d.s, pm_scenes_square(4.0, 1.0, true),
                   pm_scenes_mirror(&d.s, pm_gray(0.25)));
    pm_desk_ready(&d);
    CHECK_NEAR(pm_desk_gather(&d, middle, down, 0), PM_DESK_GLOBAL, 0.0);
    CHECK(d.global == 1 && d.last.pixel == 3 && d.last.sample == 2);

    double sum = 0.0;
    enum { RAYS = 4000 };
    for (uint64_t i = 0; i < RAYS; i++) {
        sum += pm_desk_gather(&d, middle, pm_vec(0.1, 0.0, 1.0), i);
    }
    // The mirror's quarter by roulette: all of the light, a quarter of the time.
    double bound = pm_chance_bound(0.25 * 0.75 * PM_DESK_GLOBAL * (double)PM_DESK_GLOBAL, RAYS);
    CHECK_NEAR(sum / RAYS, 0.25 * PM_DESK_GLOBAL, bound);
    CHECK(d.direct + d.caustic + d.indirect == 0);
    CHECK_NEAR(pm_desk_gather(&d, middle, pm_vec(5.0, 0.0, 0.0), 0), 0.0, 0.0);
    pm_scenes_free(&d.s);
}

PM_TESTS({"compose.1", "a diffuse lamp adds to emission, direct, caustic and indirect once",
          diffuse_lamp_fills_each_layer_once},
         {"compose.2", "what a mirror shows is all specular, tinted, lamps included",
          mirrors_bring_everything_into_specular},
         {"compose.3", "a glass ball in a uniform room is invisible, however lobes are chosen",
          glass_in_a_uniform_room_is_invisible},
         {"compose.4", "radiance that leaves glass is thinned by the square of its index",
          glass_thins_radiance_that_leaves_it},
         {"compose.5", "null surfaces change neither layers nor depth",
          null_surfaces_are_no_event},
         {"compose.6", "the back of a one-sided surface is black",
          back_of_a_one_sided_surface_is_black},
         {"compose.7", "a layer that is not wanted is neither filled nor asked for",
          unwanted_layers_are_not_asked_for},
         {"compose.8", "a source that does not exist is black", missing_sources_are_black},
         {"compose.9", "a source that fails ends the path with its message",
          failures_of_a_source_come_back},
         {"compose.10", "paths cut after too many specular events are counted, others are not",
          endless_mirrors_are_cut_and_counted},
         {"compose.11", "following all lobes and playing roulette have the same mean",
          splitting_and_roulette_have_one_mean},
         {"compose.12",
          "gather rays add nothing from lamps, met directly, mirrored or refracted",
          gather_rays_see_no_lamps},
         {"compose.13", "gather rays add the global map, also where mirrors lead them",
          gather_rays_find_the_global_map_everywhere},
         {"compose.14", "a lamp on a null surface shines from its front and lets light pass",
          null_lamps_shine_and_let_pass})
