// The books of media, and of wavelengths that paths take, fed with events made by hand.
#include "audit.h"

#include "test.h"

static const pm_rng_source source = {.seed = 7, .stream = PM_STREAM_TEST};
static const pm_spectrum white = {{1.0, 1.0, 1.0}};
static const pm_spectrum black = {{0.0, 0.0, 0.0}};
static const pm_spectrum half = {{0.5, 0.5, 0.5}};
static const pm_spectrum tinted = {{1.0, 0.5, 0.25}};

static pm_medium media[2] = {{.albedo = {{0.5, 0.25, 0.0}}}, {.albedo = {{1.0, 1.0, 1.0}}}};
static const pm_scene scene = {.shape_count = 2, .media = media, .medium_count = 2};

static void open_books(pm_audit *audit)
{
    CHECK_OK(pm_audit_make(&scene, audit));
}

static void send(pm_audit *audit, pm_spectrum power)
{
    pm_start start = {.power = power};
    pm_audit_emit(audit, &start, 1);
}

static void escape(pm_audit *audit, pm_spectrum arriving)
{
    pm_event event = {.kind = PM_EVENT_ESCAPED,
                      .bounce = 1,
                      .medium = PM_NONE,
                      .arriving = arriving,
                      .entering = arriving};
    pm_audit_event(audit, NULL, &event);
}

static void check_spectrum(pm_spectrum got, double r, double g, double b)
{
    CHECK_NEAR(got.c[0], r, 1e-15);
    CHECK_NEAR(got.c[1], g, 1e-15);
    CHECK_NEAR(got.c[2], b, 1e-15);
}

/// A collision in medium 0 or 1.
static void collide(pm_audit *audit, int medium, pm_spectrum arriving, pm_spectrum chosen)
{
    pm_event event = {.kind = PM_EVENT_MEDIUM,
                      .scatter = pm_spectrum_is_black(chosen) ? 0 : 'V',
                      .medium = medium,
                      .arriving = arriving,
                      .entering = arriving,
                      .chosen = chosen,
                      .carried = chosen};
    pm_audit_event(audit, NULL, &event);
}

static void media_have_books(void)
{
    pm_audit sum;
    pm_audit part;
    open_books(&sum);
    open_books(&part);
    send(&part, white);
    collide(&part, 0, white, tinted);
    collide(&part, 1, tinted, tinted);
    collide(&part, 0, tinted, black);
    pm_audit_add(&sum, &part);
    pm_audit_add(&sum, &part);
    CHECK(sum.events == 6 && sum.media[0].collisions == 4 && sum.media[1].collisions == 2);
    pm_audit_scale(&sum, 0.5);
    check_spectrum(sum.media[0].incident, 2.0, 1.5, 1.25);
    check_spectrum(sum.media[0].absorbed, 1.0, 1.0, 1.0);
    check_spectrum(sum.media[1].incident, 1.0, 0.5, 0.25);
    check_spectrum(sum.media[1].absorbed, 0.0, 0.0, 0.0);
    // Promised by 0.5 0.25 0: 0.5 0.25 0 and 0.5 0.125 0.
    check_spectrum(sum.roulette, 0.0, 0.125, 0.25);
    CHECK_OK(pm_audit_check(&sum));
    pm_audit_clear(&sum);
    CHECK(sum.media[0].collisions == 0 && sum.media[1].incident.c[0] == 0.0);
    pm_audit_free(&sum);
    pm_audit_free(&part);
}

static void wrong_roulettes_in_media_are_caught(void)
{
    pm_audit audit;
    open_books(&audit);
    for (int i = 0; i < 2000; i++) {
        send(&audit, white);
        collide(&audit, 0, white, half); // undivided: green has more than the albedo 0.25
        escape(&audit, half);
    }
    CHECK_FAILS(pm_audit_check(&audit), PM_ELIMIT, "of green beyond the albedos' promise");
    pm_audit_free(&audit);
}

/// Books photons that each take a wavelength, whose weight is `most` with the chance 1 / `most`
/// times `factor`, else 0.
static pm_status disperse(double most, double factor, uint64_t count, uint64_t run)
{
    pm_audit audit;
    open_books(&audit);
    for (uint64_t i = 0; i < count; i++) {
        pm_rng rng = pm_rng_at(&source, run * count + i, 1);
        pm_spectrum weighed = pm_gray(pm_rng_draw(&rng) < 1.0 / most ? most * factor : 0.0);
        pm_hit hit = {.shape = 1};
        pm_lobes lobes = {.lobe = {{PM_LOBE_TRANSMIT, true, white}}, .count = 1};
        pm_event event = {.kind = PM_EVENT_SURFACE,
                          .scatter = 'S',
                          .hit = &hit,
                          .lobes = &lobes,
                          .arriving = white,
                          .entering = weighed,
                          .chosen = weighed,
                          .carried = weighed};
        send(&audit, white);
        pm_audit_event(&audit, NULL, &event);
        escape(&audit, weighed);
    }
    CHECK_NEAR(audit.dispersion.c[1], audit.escaped.c[1] - audit.emitted.c[1],
               1e-12 * (double)count);
    CHECK(pm_spectrum_is_black(audit.roulette));
    pm_status status = pm_audit_check(&audit);
    pm_audit_free(&audit);
    return status;
}

static void wavelengths_are_judged(void)
{
    static const uint64_t counts[5] = {1, 20, 60, 300, 5000};
    CHECK_FAILS(disperse(4.0, 1.1, 20000, 0), PM_ELIMIT, "audit: wavelengths add +");
    CHECK_FAILS(disperse(4.0, 0.9, 20000, 0), PM_ELIMIT, "of red where their weights");
    for (int n = 0; n < 5; n++) {
        for (uint64_t run = 0; run < 200; run++) {
            CHECK_OK(disperse(4.0, 1.0, counts[n], run));
        }
    }
}

PM_TESTS({"audit.8", "media have books of their own", media_have_books},
         {"audit.9", "a roulette that does not divide in a medium is caught",
          wrong_roulettes_in_media_are_caught},
         {"audit.10", "wavelengths that add power are caught, honest ones pass",
          wavelengths_are_judged})
