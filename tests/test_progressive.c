// Progressive pictures: passes that are independent and whole, means that stay what they are.
#include "interrupt.h"
#include "pictures.h"
#include "progressive.h"
#include "shapes.h"
#include "test.h"

#include <omp.h>
#include <signal.h>
#include <string.h>

enum { SIDE = 6 };

/// A room with a mirror ball and a lamp under the ceiling, seen from a corner.
static void begin(pm_scenes *s)
{
    pm_scenes_begin(s);
    pm_scenes_room(s, 1.0, pm_scenes_diffuse(s, pm_rgb(0.6, 0.5, 0.4)));
    pm_scenes_wear(s, pm_shapes_sphere(pm_vec(0.2, 0.1, -0.5), 0.3),
                   pm_scenes_mirror(s, pm_gray(0.9)));
    pm_scenes_point(s, pm_vec(-0.2, 0.0, 0.6), pm_gray(1.0));
    pm_scenes_ready(s);
    pm_pictures_look(s, pm_vec(-0.9, -0.9, 0.2), pm_vec(0.2, 0.1, -0.6), 0.8, SIDE);
}

static pm_render_settings quick(void)
{
    pm_render_settings settings = pm_pictures_settings();
    settings.photons[PM_MAP_GLOBAL] = settings.photons[PM_MAP_CAUSTIC] = 600;
    settings.light.spp = 1;
    settings.light.light_samples = 2;
    settings.light.estimate.k = 20;
    return settings;
}

static void do_pass(const pm_scenes *s, const pm_render_settings *settings, pm_progressive *to)
{
    pm_render_maps maps = {0};
    CHECK_OK(pm_progressive_pass(&s->world, settings, to, &maps));
    pm_render_maps_free(&maps);
}

static pm_image take(const pm_progressive *progressive)
{
    pm_image image;
    pm_eye_report report;
    CHECK_OK(pm_progressive_image(progressive, &image, &report));
    return image;
}

static void check_same_sums(const pm_progressive *a, const pm_progressive *b)
{
    size_t count = (size_t)a->width * (size_t)a->height * (size_t)PM_SUM_PLANES;
    CHECK(a->passes == b->passes && a->width == b->width && a->height == b->height);
    CHECK(memcmp(a->sum, b->sum, count * sizeof *a->sum) == 0);
    for (int kind = 0; kind < PM_MAP_COUNT; kind++) {
        CHECK_NEAR(a->map[kind].first, b->map[kind].first, 0.0);
        CHECK(memcmp(&a->map[kind].sum, &b->map[kind].sum, sizeof(pm_map_sum)) == 0);
    }
}

// --- passes ----------------------------------------------------------------------------------

static void a_map_without_photons_waits_for_its_radius(void)
{
    pm_scenes s;
    begin(&s);
    pm_render_settings settings = quick();
    settings.photons[PM_MAP_CAUSTIC] = 1; // now and then one comes by the ball
    pm_progressive done = {0};
    for (int pass = 0; pass < 4; pass++) {
        do_pass(&s, &settings, &done);
    }
    CHECK(done.map[PM_MAP_CAUSTIC].sum.emitted == 4);
    CHECK_NEAR(done.map[PM_MAP_CAUSTIC].first, 0.0, 0.0);
    CHECK(done.map[PM_MAP_GLOBAL].first > 0.0);
    pm_progressive_free(&done);
    pm_scenes_free(&s);
}

static void the_first_pass_is_an_ordinary_picture(void)
{
    pm_scenes s;
    begin(&s);
    pm_render_settings settings = quick();
    settings.light.estimate.radius = 0.25;
    settings.light.estimate.k = 2; // does not count where there is a radius
    pm_progressive done = {0};
    do_pass(&s, &settings, &done);
    pm_image got = take(&done);
    settings.light.estimate.k = 100000; // all in reach
    pm_image want = pm_pictures_take(&s, &settings);
    CHECK_PICTURE(&got, &want, 1.0, NULL);
    CHECK(done.eye.lookups > 0 && done.map[PM_MAP_GLOBAL].sum.emitted == 600);
    pm_image_free(&got);
    pm_image_free(&want);
    pm_progressive_free(&done);
    pm_scenes_free(&s);
}

/// Pass by pass as ordinary pictures of their own numbers and radii.
static void the_picture_is_the_mean_of_its_passes(void)
{
    enum { PASSES = 5 };
    pm_scenes s;
    begin(&s);
    pm_render_settings settings = quick();
    settings.light.estimate.radius = 0.3;
    pm_progressive done = {0};
    double sum[3] = {0.0};
    double seen[PASSES];
    static const char *const channel[3] = {"direct.G", "indirect.R", "caustic.B"};
    for (int pass = 0; pass < PASSES; pass++) {
        do_pass(&s, &settings, &done);
        pm_render_settings own = settings;
        own.pass = (uint32_t)pass;
        own.light.estimate.k = 100000;
        own.light.estimate.radius *= pm_progressive_radius((uint64_t)pass + 1, 2);
        pm_image one = pm_pictures_take(&s, &own);
        for (int c = 0; c < 3; c++) {
            sum[c] += pm_pictures_mean(&one, channel[c]);
        }
        seen[pass] = pm_pictures_mean(&one, channel[1]);
        pm_image_free(&one);
    }
    pm_image mean = take(&done);
    for (int c = 0; c < 3; c++) {
        CHECK(sum[c] > 0.0);
        CHECK_NEAR(pm_pictures_mean(&mean, channel[c]) * PASSES / sum[c], 1.0, 1e-6);
    }
    for (int pass = 1; pass < PASSES; pass++) {
        CHECK_THAT(seen[pass] != seen[0], "pass %d repeats the numbers of the first", pass);
    }
    pm_image_free(&mean);
    pm_progressive_free(&done);
    pm_scenes_free(&s);
}

static void direct_light_keeps_its_mean(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_wear(&s, pm_scenes_square(4.0, 0.0, false), pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 1.0), pm_gray(4.0 * PM_PI));
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, 0.0, 0.5), pm_vec(0.0, 0.0, 0.0), 0.01, SIDE);
    pm_render_settings settings = quick();
    pm_progressive done = {0};
    for (int pass = 0; pass < 30; pass++) {
        do_pass(&s, &settings, &done);
        pm_image image = take(&done);
        // 1 W/sr from 1 m straight above, over a hundredth of a metre.
        CHECK_NEAR(pm_pictures_mean(&image, "R") * PM_PI / 0.5, 1.0, 1e-4);
        CHECK_NEAR(pm_pictures_mean(&image, "direct.R") * PM_PI / 0.5, 1.0, 1e-4);
        pm_image_free(&image);
    }
    pm_progressive_free(&done);
    pm_scenes_free(&s);
}

/// In a globe lit from its centre indirect light is the same everywhere, and a chord r cuts off
/// just pi r^2. Scatter between passes tells the deviation of the mean.
static void a_flat_field_stays_flat_as_radii_shrink(void)
{
    enum { PASSES = 60 };
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_globe(&s, 1.0, pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 0.0), pm_gray(4.0 * PM_PI));
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, 0.0, 0.1), pm_vec(0.0, 0.0, -1.0), 1.5, SIDE);
    pm_render_settings settings = quick();
    settings.light.estimate.shape = PM_GATHER_SPHERE;
    settings.light.estimate.radius = 0.4;
    pm_progressive done = {0};
    double before = 0.0;
    double squares = 0.0;
    for (int pass = 1; pass <= PASSES; pass++) {
        do_pass(&s, &settings, &done);
        pm_image image = take(&done);
        double sum = pass * pm_pictures_mean(&image, "indirect.R");
        squares += (sum - before) * (sum - before);
        before = sum;
        pm_image_free(&image);
    }
    double mean = before / PASSES;
    double variance = (squares / PASSES - mean * mean) / PASSES;
    // Each bounce leaves half: irradiance 1 directly, 1/2 + 1/4 + .. = 1 indirectly.
    CHECK(variance > 0.0 && sqrt(variance) < 0.02 / PM_PI);
    CHECK_NEAR(mean * PM_PI / 0.5, 1.0, 5.0 * sqrt(variance) * PM_PI / 0.5);
    pm_progressive_free(&done);
    pm_scenes_free(&s);
}

static void depth_and_normal_are_of_what_was_met(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_shape half = pm_scenes_square(2.0, 0.0, false);
    half.corner.x = 0.0; // it ends in the middle of the picture
    pm_scenes_wear(&s, half, pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 1.0), pm_gray(1.0));
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, 0.0, 1.0), pm_vec(0.0, 0.0, 0.0), 0.001, 1);
    pm_render_settings settings = quick();
    pm_progressive done = {0};
    for (int pass = 0; pass < 16; pass++) {
        do_pass(&s, &settings, &done);
    }
    pm_image image = take(&done);
    double hits = done.sum[PM_SUM_HITS];
    CHECK_THAT(hits > 0.0 && hits < 16.0, "%g passes of 16 met the edge", hits);
    CHECK_NEAR(pm_pictures_at(&image, "depth.Z", 0, 0), 1.0, 1e-5);
    CHECK_NEAR(pm_pictures_at(&image, "normal.Z", 0, 0), 1.0, 1e-6);
    CHECK_NEAR(pm_pictures_at(&image, "direct.R", 0, 0) * 8.0 * PM_PI * PM_PI, hits / 16.0,
               1e-4);
    pm_image_free(&image);
    pm_progressive_free(&done);
    pm_scenes_free(&s);
}

static void every_way_to_ask_gives_the_same_bytes(void)
{
    static const int threads[3] = {1, 2, 7};
    pm_scenes s;
    begin(&s);
    for (int way = 0; way < 3; way++) {
        pm_render_settings settings = quick();
        settings.light.rays = way == 0 ? 0 : 4;
        settings.precompute = way == 2;
        settings.direct_photons = way == 2;
        settings.light.caustics_global = way == 1;
        pm_progressive done[3] = {{0}};
        for (int i = 0; i < 3; i++) {
            omp_set_num_threads(threads[i]);
            for (int pass = 0; pass < 3; pass++) {
                do_pass(&s, &settings, &done[i]);
            }
            check_same_sums(&done[0], &done[i]);
        }
        CHECK((done[0].places > 0) == (way == 2) && (done[0].eye.near > 0) == (way > 0));
        for (int i = 0; i < 3; i++) {
            pm_progressive_free(&done[i]);
        }
    }
    pm_scenes_free(&s);
}

static void fog_has_a_radius_of_its_own(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    int fog = pm_scenes_medium(&s, 1.0, pm_gray(0.8), 0.0);
    pm_scenes_bound(&s, pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 1.0), fog, PM_NONE);
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 3.0), pm_gray(1.0));
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, -3.0, 0.0), pm_vec(0.0, 0.0, 0.0), 0.4, SIDE);
    pm_render_settings settings = quick();
    settings.photons[PM_MAP_VOLUME] = 3000;
    double mean[2];
    for (int march = 0; march < 2; march++) {
        settings.light.media = march == 1 ? PM_MEDIA_MARCH : PM_MEDIA_BEAMS;
        pm_progressive done = {0};
        for (int pass = 0; pass < 8; pass++) {
            do_pass(&s, &settings, &done);
        }
        CHECK(done.map[PM_MAP_VOLUME].first > 0.0 && done.map[PM_MAP_VOLUME].first < 1.0);
        CHECK_NEAR(done.map[PM_MAP_GLOBAL].first, 0.0, 0.0);
        pm_image image = take(&done);
        mean[march] = pm_pictures_mean(&image, "volume.G");
        pm_image_free(&image);
        pm_progressive_free(&done);
    }
    CHECK_NEAR(mean[1] / mean[0], 1.0, 0.1);
    pm_scenes_free(&s);
}

static void books_are_those_of_all_passes(void)
{
    pm_scenes s;
    begin(&s);
    pm_render_settings settings = quick();
    pm_progressive done = {0};
    for (int pass = 0; pass < 3; pass++) {
        do_pass(&s, &settings, &done);
    }
    pm_render_maps maps = {0};
    CHECK_OK(pm_progressive_books(&s.scene, &settings, &done, &maps));
    const pm_audit *audit = &maps.pass[PM_MAP_GLOBAL].audit;
    CHECK(maps.photons[PM_MAP_GLOBAL] == 600 && maps.pass[PM_MAP_GLOBAL].emitted == 1800);
    CHECK(audit->photons == 1800);
    CHECK_NEAR(audit->emitted.c[1], 1.0, 1e-12); // the light's 1 W
    CHECK_OK(pm_audit_check(audit));
    CHECK(maps.has[PM_MAP_GLOBAL] && maps.map[PM_MAP_GLOBAL].count == 0);
    pm_render_maps_free(&maps);
    pm_progressive_free(&done);
    pm_scenes_free(&s);
}

// --- refusals --------------------------------------------------------------------------------

static void an_interrupted_pass_changes_nothing(void)
{
    pm_scenes s;
    begin(&s);
    pm_render_settings settings = quick();
    pm_progressive done = {0};
    pm_progressive same = {0};
    do_pass(&s, &settings, &done);
    do_pass(&s, &settings, &same);
    pm_interrupt_catch();
    raise(SIGINT);
    pm_render_maps maps = {0};
    CHECK_FAILS(pm_progressive_pass(&s.world, &settings, &done, &maps), PM_ESTOPPED, "");
    pm_render_maps_free(&maps);
    check_same_sums(&done, &same);
    pm_progressive_free(&done);
    pm_progressive_free(&same);
    pm_scenes_free(&s);
}

static void what_makes_no_passes_is_refused(void)
{
    pm_scenes s;
    begin(&s);
    pm_progressive done = {0};
    pm_render_maps maps = {0};
    pm_image image;
    pm_eye_report report;
    CHECK_FAILS(pm_progressive_image(&done, &image, &report), PM_EINPUT,
                "before the first pass");
    pm_render_settings settings = quick();
    settings.stored = 100;
    CHECK_FAILS(pm_progressive_pass(&s.world, &settings, &done, &maps), PM_EINPUT,
                "stored number");
    settings = quick();
    settings.view_photons = true;
    CHECK_FAILS(pm_progressive_pass(&s.world, &settings, &done, &maps), PM_EINPUT, "dots");
    settings = quick();
    do_pass(&s, &settings, &done);
    s.scene.camera.width = SIDE + 1;
    CHECK_FAILS(pm_progressive_pass(&s.world, &settings, &done, &maps), PM_EINPUT,
                "one size, got 7x6 after 6x6");
    s.scene.camera.width = SIDE;
    done.passes = PM_PROGRESSIVE_MOST;
    CHECK_FAILS(pm_progressive_pass(&s.world, &settings, &done, &maps), PM_EINPUT,
                "268435455 passes");
    pm_progressive_free(&done);
    pm_scenes_free(&s);
}

PM_TESTS({"progressive.1", "a map of lone photons has no radius yet",
          a_map_without_photons_waits_for_its_radius},
         {"progressive.2", "the first pass is the ordinary picture, bit for bit",
          the_first_pass_is_an_ordinary_picture},
         {"progressive.3", "the picture is the mean of its passes, each of its own numbers",
          the_picture_is_the_mean_of_its_passes},
         {"progressive.4", "direct light neither fades nor brightens with the passes",
          direct_light_keeps_its_mean},
         {"progressive.5", "a flat field stays what it is while radii shrink",
          a_flat_field_stays_flat_as_radii_shrink},
         {"progressive.6", "depth and normal are those of the surface, however seldom met",
          depth_and_normal_are_of_what_was_met},
         {"progressive.7", "1, 2 and 7 threads sum the same bits, however the maps are asked",
          every_way_to_ask_gives_the_same_bytes},
         {"progressive.8", "fog has a radius of its own, for beams and for a march",
          fog_has_a_radius_of_its_own},
         {"progressive.9", "books are of all passes, power is their mean",
          books_are_those_of_all_passes},
         {"progressive.10", "an interrupted pass leaves the sums as they were",
          an_interrupted_pass_changes_nothing},
         {"progressive.11", "what makes no passes is refused with a line",
          what_makes_no_passes_is_refused})
