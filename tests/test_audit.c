// The books of a pass, fed with events made by hand: they close, add up by shape, and refuse a
// roulette that does not keep the albedos' promise.
#include "audit.h"

#include "test.h"

#include <string.h>

static const pm_rng_source source = {.seed = 7, .stream = PM_STREAM_TEST};

static const pm_scene scene = {.shape_count = 3};

static pm_lobes lobes_of(pm_spectrum albedo)
{
    return (pm_lobes){.lobe = {{PM_LOBE_DIFFUSE, false, albedo}}, .count = 1, .diffuse = true};
}

static void open_books(pm_audit *audit)
{
    CHECK_OK(pm_audit_make(&scene, audit));
}

static void send(pm_audit *audit, pm_spectrum power)
{
    pm_start start = {.power = power};
    pm_audit_emit(audit, &start, 1);
}

/// A meeting with `shape`; `scatter` 0 ends the photon.
static void meet(pm_audit *audit, int shape, pm_spectrum albedo, char scatter, uint32_t bounce,
                 pm_spectrum arriving, pm_spectrum chosen)
{
    pm_hit hit = {.shape = shape};
    pm_lobes lobes = lobes_of(albedo);
    pm_event event = {.kind = PM_EVENT_SURFACE,
                      .scatter = scatter,
                      .bounce = bounce,
                      .hit = &hit,
                      .lobes = &lobes,
                      .arriving = arriving,
                      .entering = arriving,
                      .chosen = chosen,
                      .carried = chosen};
    pm_audit_event(audit, NULL, &event);
}

static void end(pm_audit *audit, pm_event_kind kind, uint32_t bounce, pm_spectrum arriving)
{
    pm_hit hit = {.shape = 2};
    pm_lobes lobes = lobes_of(pm_gray(0.5));
    pm_event event = {
        .kind = kind, .bounce = bounce, .arriving = arriving, .entering = arriving};
    if (kind != PM_EVENT_ESCAPED) {
        event.hit = &hit;
        event.lobes = &lobes;
    }
    pm_audit_event(audit, NULL, &event);
}

static void check_spectrum(pm_spectrum got, double r, double g, double b)
{
    CHECK_NEAR(got.c[0], r, 1e-15);
    CHECK_NEAR(got.c[1], g, 1e-15);
    CHECK_NEAR(got.c[2], b, 1e-15);
}

static const pm_spectrum white = {{1.0, 1.0, 1.0}};
static const pm_spectrum black = {{0.0, 0.0, 0.0}};
static const pm_spectrum half = {{0.5, 0.5, 0.5}};
static const pm_spectrum tinted = {{1.0, 0.5, 0.25}};

/// Three photons of 1 W: one bounces off 0 and escapes, one is absorbed by 1, one is cut at 2.
static void three_photons(pm_audit *audit)
{
    open_books(audit);
    for (int i = 0; i < 3; i++) {
        send(audit, white);
    }
    meet(audit, 0, half, 'D', 0, white, tinted);
    end(audit, PM_EVENT_ESCAPED, 1, tinted);
    meet(audit, 1, half, 0, 0, white, black);
    end(audit, PM_EVENT_CUT, 0, white);
}

static void three_photons_by_hand(void)
{
    pm_audit audit;
    three_photons(&audit);
    CHECK(audit.photons == 3 && audit.events == 3);
    CHECK(audit.ended_absorbed == 1 && audit.ended_escaped == 1 && audit.ended_lost == 1);
    CHECK(audit.bounces[0] == 2 && audit.bounces[1] == 1);
    check_spectrum(audit.emitted, 3.0, 3.0, 3.0);
    check_spectrum(audit.absorbed, 1.0, 1.5, 1.75); // signed: arriving minus carried on
    check_spectrum(audit.escaped, 1.0, 0.5, 0.25);
    check_spectrum(audit.lost, 1.0, 1.0, 1.0);
    check_spectrum(audit.roulette, 0.0, -0.5, -0.75); // chosen minus promised .5, twice
    check_spectrum(audit.roulette_variance, 0.5, 0.25, 0.25 * 0.25 + 0.25);
    CHECK_NEAR(audit.largest, 1.0, 0.0);
    check_spectrum(audit.shapes[0].incident, 1.0, 1.0, 1.0);
    check_spectrum(audit.shapes[0].absorbed, 0.0, 0.5, 0.75);
    check_spectrum(audit.shapes[1].absorbed, 1.0, 1.0, 1.0);
    check_spectrum(audit.shapes[2].incident, 1.0, 1.0, 1.0);
    check_spectrum(audit.shapes[2].absorbed, 0.0, 0.0, 0.0);
    CHECK_OK(pm_audit_check(&audit));
    pm_audit_free(&audit);
}

static void books_add_and_scale(void)
{
    pm_audit sum;
    pm_audit part;
    three_photons(&sum);
    three_photons(&part);
    pm_audit_add(&sum, &part);
    CHECK(sum.photons == 6 && sum.events == 6 && sum.ended_lost == 2 && sum.bounces[0] == 4);
    CHECK(sum.ended_absorbed == 2 && sum.ended_escaped == 2);
    pm_audit_scale(&sum, 1.0 / 6.0);
    check_spectrum(sum.emitted, 1.0, 1.0, 1.0);
    check_spectrum(sum.absorbed, 2.0 / 6.0, 0.5, 3.5 / 6.0);
    check_spectrum(sum.escaped, 2.0 / 6.0, 1.0 / 6.0, 0.5 / 6.0);
    check_spectrum(sum.lost, 2.0 / 6.0, 2.0 / 6.0, 2.0 / 6.0);
    check_spectrum(sum.roulette, 0.0, -1.0 / 6.0, -1.5 / 6.0);
    check_spectrum(sum.roulette_variance, 1.0 / 36.0, 0.5 / 36.0, 0.625 / 36.0);
    CHECK_NEAR(sum.largest, 1.0 / 6.0, 1e-16);
    check_spectrum(sum.shapes[0].incident, 2.0 / 6.0, 2.0 / 6.0, 2.0 / 6.0);
    check_spectrum(sum.shapes[1].absorbed, 2.0 / 6.0, 2.0 / 6.0, 2.0 / 6.0);
    CHECK_OK(pm_audit_check(&sum));
    pm_audit_clear(&part);
    CHECK(part.photons == 0 && part.events == 0 && part.bounces[0] == 0);
    CHECK(part.scene == &scene && part.shapes[0].incident.c[0] == 0.0);
    CHECK_OK(pm_audit_check(&part));
    pm_audit_free(&sum);
    pm_audit_free(&part);
}

static void long_paths_share_the_last_bin(void)
{
    pm_audit audit;
    open_books(&audit);
    for (uint32_t bounce = 30; bounce < 40; bounce++) {
        send(&audit, white);
        end(&audit, PM_EVENT_ESCAPED, bounce, white);
    }
    CHECK(audit.bounces[30] == 1 && audit.bounces[PM_AUDIT_BOUNCES - 1] == 9);
    pm_audit_free(&audit);
}

static void gaps_are_told(void)
{
    pm_audit audit;
    three_photons(&audit);
    send(&audit, black); // a photon that never ends
    CHECK_FAILS(pm_audit_check(&audit), PM_ELIMIT, "4 photons emitted, 3 ended");
    pm_audit_clear(&audit);

    send(&audit, white);
    end(&audit, PM_EVENT_ESCAPED, 0, pm_rgb(1.0, 1.0 - 1e-11, 1.0));
    CHECK_FAILS(pm_audit_check(&audit), PM_ELIMIT, "green power does not close");
    pm_audit_clear(&audit);

    send(&audit, white);
    end(&audit, PM_EVENT_ESCAPED, 0, pm_rgb(1.0 + 1e-13, 1.0 - 1e-13, 1.0));
    CHECK_OK(pm_audit_check(&audit)); // rounding may
    pm_audit_clear(&audit);

    send(&audit, white);
    end(&audit, PM_EVENT_ESCAPED, 0, pm_rgb(1.0, 1.0, nan("")));
    CHECK_FAILS(pm_audit_check(&audit), PM_ELIMIT, "blue power does not close");
    pm_audit_free(&audit);
}

static void forty_million_photons_close(void)
{
    // Chunks as a pass makes them, of powers that binary fractions cannot hold.
    enum { CHUNK = 1000, CHUNKS = 40000 };
    pm_spectrum power = pm_rgb(0.1, 1e-5, 1.0 / 3.0);
    pm_audit sum;
    pm_audit part;
    open_books(&sum);
    open_books(&part);
    for (int i = 0; i < CHUNK; i++) {
        send(&part, power);
        if (i % 3 == 0) {
            end(&part, PM_EVENT_ESCAPED, 0, power);
        } else {
            meet(&part, 0, black, 0, 0, power, black);
        }
    }
    for (int i = 0; i < CHUNKS; i++) {
        pm_audit_add(&sum, &part);
    }
    CHECK(sum.photons == 40000000ull);
    double tolerance = 1e-12;
    CHECK_NEAR(sum.emitted.c[0] / 4e6, 1.0, tolerance);
    CHECK_NEAR(sum.emitted.c[1] / 400.0, 1.0, tolerance);
    CHECK_OK(pm_audit_check(&sum));
    pm_audit_free(&sum);
    pm_audit_free(&part);
}

// --- wrong roulettes

/// What a survivor of probability `chance` carries, given its power and albedo in a channel.
typedef double (*carry_rule)(double power, double albedo, double chance);

static double carry_right(double power, double albedo, double chance)
{
    return power * albedo / chance;
}

static double carry_undivided(double power, double albedo, double chance)
{
    (void)chance;
    return power * albedo;
}

static double carry_untinted(double power, double albedo, double chance)
{
    (void)albedo;
    (void)chance;
    return power;
}

static double carry_nearly(double power, double albedo, double chance)
{
    return power * albedo / chance * (0.99 / 0.999);
}

/// Books `count` photons of `power` that each meet one surface, under a rule.
static pm_status judge(carry_rule rule, pm_spectrum power, pm_spectrum albedo, uint64_t count,
                       uint64_t run)
{
    pm_audit audit;
    open_books(&audit);
    double chance = pm_spectrum_max(pm_spectrum_mul(power, albedo)) / pm_spectrum_max(power);
    for (uint64_t i = 0; i < count; i++) {
        pm_rng rng = pm_rng_at(&source, run * count + i, 0);
        pm_spectrum carried = black;
        if (pm_rng_draw(&rng) < chance) {
            for (int c = 0; c < 3; c++) {
                carried.c[c] = rule(power.c[c], albedo.c[c], chance);
            }
        }
        send(&audit, power);
        bool alive = !pm_spectrum_is_black(carried);
        meet(&audit, 0, albedo, alive ? 'D' : 0, 0, power, carried);
        if (alive) {
            end(&audit, PM_EVENT_ESCAPED, 1, carried);
        }
    }
    pm_status status = pm_audit_check(&audit);
    pm_audit_free(&audit);
    return status;
}

static void wrong_roulettes_are_caught(void)
{
    const pm_spectrum red = {{0.63, 0.065, 0.05}};
    CHECK_FAILS(judge(carry_undivided, white, red, 2000, 0), PM_ELIMIT,
                "roulette carries on -");
    CHECK_FAILS(judge(carry_untinted, white, red, 2000, 0), PM_ELIMIT, "roulette carries on +");
    // .9 % amiss at an albedo of .99: 0.0089 against a deviation of .1 a photon.
    CHECK_FAILS(judge(carry_nearly, white, pm_gray(0.99), 20000, 0), PM_ELIMIT,
                "roulette carries on -");
    CHECK_OK(judge(carry_right, white, red, 2000, 0));
    CHECK_OK(judge(carry_right, white, pm_gray(0.99), 20000, 0));
}

static void right_roulettes_pass_always(void)
{
    // Dark and bright, few photons and many; where hardly any survives chance alone is far from
    // the deviation seen, and must still pass.
    static const double albedos[6] = {1e-6, 1e-3, 0.02, 0.3, 0.9, 0.9999};
    static const uint64_t counts[4] = {1, 20, 300, 5000};
    for (int a = 0; a < 6; a++) {
        for (int n = 0; n < 4; n++) {
            for (uint64_t run = 0; run < 100; run++) {
                pm_spectrum albedo = pm_rgb(albedos[a], 0.5 * albedos[a], 0.0);
                pm_status status =
                    judge(carry_right, pm_rgb(2.0, 1.0, 3.0), albedo, counts[n], run);
                CHECK_THAT(status == PM_OK, "albedo %g, %llu photons, run %llu: %s", albedos[a],
                           (unsigned long long)counts[n], (unsigned long long)run,
                           pm_status_message());
            }
        }
    }
}

PM_TESTS({"audit.1", "three photons' books, by hand", three_photons_by_hand},
         {"audit.2", "books add up, shrink and are wiped", books_add_and_scale},
         {"audit.3", "paths beyond the last bin are counted in it",
          long_paths_share_the_last_bin},
         {"audit.4", "a photon or a channel that does not close is named", gaps_are_told},
         {"audit.5", "the books of forty million photons close to 1e-12",
          forty_million_photons_close},
         {"audit.6", "a roulette that does not divide, or tint, or divides by .999 is caught",
          wrong_roulettes_are_caught},
         {"audit.7", "an honest roulette passes, also where hardly a photon survives",
          right_roulettes_pass_always})
