// The program's passes: refused lines, SIGINT and kill at any time, and the same bytes in the
// end.
#include "bytes.h"
#include "command.h"
#include "test.h"

#include <jansson.h>

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { TRIES = 8 };

static const char scene[] = "scenes/cornell-spheres.xml";

static bool is_there(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0;
}

static void check_same_file(const char *a, const char *b)
{
    size_t count_a;
    size_t count_b;
    uint8_t *bytes_a = pm_bytes_read(a, &count_a);
    uint8_t *bytes_b = pm_bytes_read(b, &count_b);
    CHECK_THAT(count_a == count_b && memcmp(bytes_a, bytes_b, count_a) == 0, "%s is not %s", a,
               b);
    free(bytes_a);
    free(bytes_b);
}

static void copy_file(const char *from, const char *to)
{
    size_t count;
    uint8_t *bytes = pm_bytes_read(from, &count);
    pm_bytes_write(to, bytes, count);
    free(bytes);
}

/// Without seconds and memory.
static json_t *load_timeless(const char *path)
{
    json_t *object = json_load_file(path, 0, NULL);
    CHECK_THAT(object != NULL, "%s is no JSON", path);
    json_object_del(object, "seconds");
    json_object_del(object, "peak_bytes");
    json_object_del(json_object_get(object, "precompute"), "seconds");
    return object;
}

static void check_same_report(const char *a, const char *b)
{
    json_t *one = load_timeless(a);
    json_t *other = load_timeless(b);
    CHECK_THAT(json_equal(one, other), "%s is not %s, seconds and memory apart", a, b);
    json_decref(one);
    json_decref(other);
}

/// Where one piece of work keeps its files.
typedef struct {
    const char *output, *report, *checkpoint;
} place;

static place place_of(const char *name)
{
    char file[64];
    place at;
    snprintf(file, sizeof file, "%s.exr", name);
    at.output = pm_command_path(file);
    snprintf(file, sizeof file, "%s.json", name);
    at.report = pm_command_path(file);
    snprintf(file, sizeof file, "%s.checkpoint", name);
    at.checkpoint = pm_command_path(file);
    return at;
}

/// Goes on with the work up to so many passes; with a signal, stopped by it after `seconds`.
static pm_test_ran go_on(const place *at, json_int_t passes, int threads, const char *signal,
                         double seconds)
{
    char sent[16];
    char delay[32];
    char line[4096];
    snprintf(sent, sizeof sent, "-s%s", signal);
    snprintf(delay, sizeof delay, "%g", seconds);
    snprintf(line, sizeof line,
             "exec '%s' %s --size 8x8 -n 1000 -k 30 --progressive --passes %lld -o '%s' "
             "--threads %d --report '%s' --checkpoint '%s' %s",
             pm_test_program("render"), scene, (long long)passes, at->output, threads,
             at->report, at->checkpoint, is_there(at->checkpoint) ? "--resume" : "");
    const char *const argv[] = {"/usr/bin/timeout",
                                "--foreground",
                                "--preserve-status",
                                sent,
                                delay,
                                "/bin/sh",
                                "-c",
                                line,
                                NULL};
    return pm_test_run(argv, 50.0);
}

static void finish(const place *at, json_int_t passes, int threads)
{
    pm_test_ran ran = go_on(at, passes, threads, "KILL", 50.0);
    CHECK_THAT(ran.exit_code == 0, "exit code %d: %s", ran.exit_code, ran.err);
    pm_test_ran_free(&ran);
}

static json_int_t passes_in(const place *at)
{
    json_t *object = load_timeless(at->report);
    json_t *progressive = json_object_get(object, "progressive");
    json_int_t passes = json_integer_value(json_object_get(progressive, "passes"));
    json_decref(object);
    return passes;
}

/// Stops endless work; tries again for longer until a pass more was whole. Returns how many
/// there are.
static json_int_t stop_in_the_middle(const place *at, int threads, const char *signal)
{
    json_int_t before = is_there(at->report) ? passes_in(at) : 0;
    double seconds = 0.1;
    for (int i = 0; i < TRIES; i++) {
        pm_test_ran ran = go_on(at, 100000000, threads, signal, seconds);
        bool asleep = ran.err[0] == '\0'; // the signal came before main()
        CHECK_THAT(asleep || ran.exit_code == 130, "exit code %d: %s", ran.exit_code, ran.err);
        CHECK(ran.exit_code > 128);
        char words[100] = "nothing was written";
        if (is_there(at->report)) {
            json_int_t passes = passes_in(at);
            snprintf(words, sizeof words,
                     "stopped after %lld of 100000000 passes: the picture is of %s %lld",
                     (long long)passes, passes == 1 ? "this" : "these", (long long)passes);
        }
        CHECK_CONTAINS(ran.err, asleep ? "" : words);
        pm_test_ran_free(&ran);
        if (is_there(at->report) && passes_in(at) > before) {
            return passes_in(at);
        }
        seconds *= 2.0;
    }
    CHECK_THAT(false, "no pass came to its end in %g s", seconds);
    return 0;
}

/// The same passes from the checkpoint in `whole`, or without one from the first.
static void check_same_work(const place *parts, const place *whole, json_int_t passes,
                            int threads)
{
    finish(whole, passes, threads);
    check_same_file(parts->output, whole->output);
    check_same_report(parts->report, whole->report);
}

static void interrupted_work_comes_to_the_same_bytes(void)
{
    place parts = place_of("parts");
    place whole = place_of("whole");
    stop_in_the_middle(&parts, 1, "INT");
    stop_in_the_middle(&parts, 7, "TERM");
    json_int_t passes = stop_in_the_middle(&parts, 2, "INT") + 2;
    finish(&parts, passes, 7);
    check_same_work(&parts, &whole, passes, 2);
    finish(&parts, passes, 1); // nothing is left to do
    check_same_work(&parts, &whole, passes, 7);
}

/// Long enough for a checkpoint on the way, then killed again and again.
static void killed_work_comes_to_the_same_bytes(void)
{
    place parts = place_of("parts");
    double seconds = 1.3;
    for (int i = 0; i < TRIES && !is_there(parts.checkpoint); i++) {
        pm_test_ran ran = go_on(&parts, 100000000, 1, "KILL", seconds);
        CHECK_THAT(ran.exit_code == 137, "exit code %d: %s", ran.exit_code, ran.err);
        pm_test_ran_free(&ran);
        seconds *= 1.5;
    }
    CHECK_THAT(is_there(parts.checkpoint), "no checkpoint was written on the way");
    CHECK(is_there(parts.output) && !is_there(parts.report));
    place whole = place_of("whole");
    copy_file(parts.checkpoint, whole.checkpoint);
    for (int i = 1; i < 4; i++) {
        pm_test_ran ran = go_on(&parts, 100000000, 2, "KILL", 0.04 * i);
        CHECK(ran.exit_code == 137);
        pm_test_ran_free(&ran);
    }
    json_int_t passes = stop_in_the_middle(&parts, 2, "INT") + 1;
    finish(&parts, passes, 7);
    check_same_work(&parts, &whole, passes, 2);
}

static void nothing_whole_is_nothing_written(void)
{
    pm_test_folder();
    char line[1200];
    snprintf(line, sizeof line,
             "render {S} --size 16x16 -n 200000000 --progressive -o {O} --checkpoint %s",
             pm_command_path("b.checkpoint"));
    pm_test_ran ran = pm_command_interrupt(line, scene, pm_command_path("out"), 0.3);
    CHECK(ran.exit_code == 130 && ran.out[0] == '\0');
    CHECK_CONTAINS(ran.err, "stopped in the first of 16 passes: there is no picture yet");
    CHECK(pm_command_count_files() == 0);
    pm_test_ran_free(&ran);
}

static void the_report_tells_of_the_passes(void)
{
    place at = place_of("a");
    finish(&at, 12, 2);
    json_t *object = json_load_file(at.report, 0, NULL);
    json_t *progressive = json_object_get(object, "progressive");
    json_t *radius = json_object_get(progressive, "radius");
    CHECK(json_integer_value(json_object_get(progressive, "passes")) == 12);
    CHECK_NEAR(json_real_value(json_object_get(progressive, "alpha")), 2.0 / 3.0, 1e-15);
    static const char *const maps[] = {"global", "caustic"};
    double shrunk = 1.0;
    for (int i = 1; i < 12; i++) {
        shrunk *= (i + 2.0 / 3.0) / (i + 1.0);
    }
    for (int i = 0; i < 2; i++) {
        json_t *pair = json_object_get(radius, maps[i]);
        double first = json_real_value(json_array_get(pair, 0));
        CHECK(first > 0.0);
        CHECK_NEAR(json_real_value(json_array_get(pair, 1)) / first, sqrt(shrunk), 1e-12);
        json_t *map = json_object_get(json_object_get(object, "maps"), maps[i]);
        CHECK(json_integer_value(json_object_get(map, "emitted")) == 12 * 1000);
    }
    CHECK(json_object_get(radius, "volume") == NULL);
    json_t *settings = json_object_get(object, "settings");
    CHECK(json_integer_value(json_object_get(settings, "gather")) == 0);
    CHECK(json_integer_value(json_object_get(settings, "spp")) == 1);
    CHECK(json_integer_value(json_object_get(settings, "passes")) == 12);
    json_decref(object);
}

static json_int_t peak_of(const char *passes)
{
    // Where addresses are watched, memory is not kept back from its next use.
    setenv("ASAN_OPTIONS", "quarantine_size_mb=0:thread_local_quarantine_size_kb=0", 1);
    char line[300];
    snprintf(line, sizeof line,
             "render {S} --size 8x8 -n 5000 --packing off --only indirect --progressive "
             "--passes %s -o {O} --json --threads 2",
             passes);
    pm_test_ran ran = pm_command_run(line, scene, pm_command_path("out"));
    json_t *object = json_loads(ran.out, 0, NULL);
    json_int_t peak = json_integer_value(json_object_get(object, "peak_bytes"));
    json_decref(object);
    pm_test_ran_free(&ran);
    return peak;
}

static void memory_is_that_of_one_pass(void)
{
    json_int_t few = peak_of("2");
    json_int_t many = peak_of("20");
    CHECK(few > 0);
    CHECK_THAT((double)many <= 1.2 * (double)few, "%lld bytes after 20 passes, %lld after 2",
               (long long)many, (long long)few);
}

/// Files may be so long that the picture fits and the checkpoint does not.
static void where_no_checkpoint_fits_the_picture_is_kept(void)
{
    const char *output = pm_command_path("a.exr");
    char line[4096];
    snprintf(line, sizeof line,
             "trap '' XFSZ; ulimit -f 16; exec '%s' %s --size 8x8 -n 500 --progressive "
             "--passes 2 -o '%s' --checkpoint '%s'",
             pm_test_program("render"), scene, output, pm_command_path("a.checkpoint"));
    const char *const argv[] = {"/bin/sh", "-c", line, NULL};
    pm_test_ran ran = pm_test_run(argv, 50.0);
    CHECK_THAT(ran.exit_code == 2, "exit code %d: %s", ran.exit_code, ran.err);
    CHECK_CONTAINS(ran.err, "a.checkpoint: cannot be written: ");
    CHECK(strchr(ran.err, '\n') == ran.err + strlen(ran.err) - 1);
    CHECK(is_there(output) && pm_command_count_files() == 1);
    pm_test_ran_free(&ran);
}

typedef struct {
    const char *more, *words;
} refusal;

// {C} stands for a checkpoint that is there, {N} for one that is not.
static const refusal wrong_lines[] = {
    {"--passes 5", "--passes belongs to --progressive"},
    {"--checkpoint {C}", "--checkpoint belongs to --progressive"},
    {"--progressive --resume", "--resume needs --checkpoint FILE"},
    {"--progressive --passes 0", "--passes must be a whole number from 1 to 268435455"},
    {"--progressive --preset lecture-10k", "--preset lecture-10k fills maps: add -n N"},
    {"--progressive --view photons", "--view photons cannot be given"},
    {"--progressive --map x.ply", "--map cannot be given"},
    {"--progressive --checkpoint {C}", "is there already: --resume goes on from it"},
    {"--progressive --checkpoint {N} --resume", "is not there to resume from"},
    {"-n 500 --progressive --checkpoint {C} --resume --passes 1",
     "holds 2 passes, more than --passes 1: ask for 2 or more"},
    {"-n 500 --progressive --checkpoint {C} --resume --passes 4 --seed 8",
     "its passes were made with seed 1, this is 8"},
    {"-n 500 --progressive --checkpoint {C} --resume --passes 4 -k 9",
     "its passes were made with k 100, this is 9"},
    {"--progressive --checkpoint {O}", "would overwrite what --checkpoint writes"},
};

/// The line with the path of its checkpoint.
static void spell_checkpoint(char *line, size_t room)
{
    char *mark = strstr(line, "{C}");
    const char *path = pm_command_path(mark != NULL ? "c.checkpoint" : "no.checkpoint");
    mark = mark == NULL ? strstr(line, "{N}") : mark;
    if (mark != NULL) {
        char rest[1024];
        snprintf(rest, sizeof rest, "%s", mark + 3);
        snprintf(mark, room - (size_t)(mark - line), "%s%s", path, rest);
    }
}

static void wrong_lines_are_refused(void)
{
    const char *checkpoint = pm_command_path("c.checkpoint");
    char line[4096];
    snprintf(line, sizeof line,
             "render {S} --size 8x8 -n 500 --progressive --passes 2 -o {O} --checkpoint %s",
             checkpoint);
    pm_test_ran first = pm_command_run(line, scene, pm_command_path("first"));
    CHECK(first.exit_code == 0 && is_there(checkpoint));
    pm_test_ran_free(&first);
    int before = pm_command_count_files();
    for (size_t i = 0; i < sizeof wrong_lines / sizeof wrong_lines[0]; i++) {
        snprintf(line, sizeof line, "render {S} --size 8x8 -o {O} %s", wrong_lines[i].more);
        spell_checkpoint(line, sizeof line);
        pm_test_ran ran = pm_command_run(line, scene, pm_command_path("out"));
        pm_command_check_refusal(line, &ran, wrong_lines[i].words);
        CHECK_THAT(pm_command_count_files() == before, "%s: leaves a file behind", line);
        pm_test_ran_free(&ran);
    }
}

PM_TESTS({"passes.1", "interrupted at any time, by any number of threads, work ends the same",
          interrupted_work_comes_to_the_same_bytes},
         {"passes.2", "killed and resumed, work ends the same",
          killed_work_comes_to_the_same_bytes},
         {"passes.3", "stopped in its first pass, render writes nothing and says so",
          nothing_whole_is_nothing_written},
         {"passes.4", "the report tells passes, radii, and photons of all passes",
          the_report_tells_of_the_passes},
         {"passes.5", "20 passes take the memory of 2", memory_is_that_of_one_pass},
         {"passes.6", "lines that make no passes are refused with a reason",
          wrong_lines_are_refused},
         {"passes.7", "where a checkpoint cannot be written, the picture still is",
          where_no_checkpoint_fits_the_picture_is_kept})
