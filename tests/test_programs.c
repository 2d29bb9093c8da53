// The real programs with bad input: exit code 2, a line that says what is wrong, nothing on
// standard output, no file left behind. A table of lines and the words that must be said.
#include "command.h"
#include "test.h"

#include <errno.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>

static const char good_scene[] = "scenes/cornell-spheres.xml";

// Every program that reads a scene, in a short good form; all write the file {O}.
static const char *const scene_lines[] = {
    "emission {S} -n 2000 --dump {O}",
    "tracing {S} -n 2000 --dump {O}",
    "storage {S} -n 2000 -o {O}",
    "balancing {S} -n 2000 --json --report {O}",
    "radiance {S} -n 2000 --at 0,0,0 --normal 0,1,0 --json --report {O}",
    "render {S} --size 12x12 --photons 2000 --gather 2 --spp 1 -o {O}",
    "reference {S} --size 12x12 --spp 2 -o {O}",
};
enum { SCENE_LINES = sizeof scene_lines / sizeof scene_lines[0] };

typedef struct {
    const char *line, *words;
} refusal;

static void check_refused(const char *line, const char *scene, const char *words)
{
    int before = pm_command_count_files();
    pm_test_ran ran = pm_command_run(line, scene, pm_command_path("out"));
    pm_command_check_refusal(line, &ran, words);
    int left = pm_command_count_files() - before;
    CHECK_THAT(left == 0, "%s: leaves %d file(s) behind", line, left);
    pm_test_ran_free(&ran);
}

static void check_table(const refusal *table, size_t count)
{
    pm_test_folder();
    for (size_t i = 0; i < count; ++i) {
        check_refused(table[i].line, good_scene, table[i].words);
    }
}

#define CHECK_TABLE(table) check_table(table, sizeof(table) / sizeof(table)[0])

static void accept_good_lines(void)
{
    for (size_t i = 0; i < SCENE_LINES; ++i) {
        char name[16];
        snprintf(name, sizeof name, "out%zu", i);
        pm_test_ran ran = pm_command_run(scene_lines[i], good_scene, pm_command_path(name));
        CHECK_THAT(ran.exit_code == 0, "%s: exit code %d: %s", scene_lines[i], ran.exit_code,
                   ran.err);
        struct stat made;
        CHECK_THAT(stat(pm_command_path(name), &made) == 0 && made.st_size > 0,
                   "%s: writes no file", scene_lines[i]);
        pm_test_ran_free(&ran);
    }
}

static void refuse_bad_scenes(void)
{
    const char *missing = pm_command_path("missing.xml");
    const char *empty = pm_command_write("empty.xml", "");
    const char *cut = pm_command_write("cut.xml", "<scene version=\"3.0.0\">\n<shape");
    const char *text = pm_command_write("text.xml", "this is not XML\n");
    const char *other = pm_command_write("other.xml", "<svg/>\n");
    for (size_t i = 0; i < SCENE_LINES; ++i) {
        check_refused(scene_lines[i], missing, "missing.xml");
        check_refused(scene_lines[i], pm_test_folder(), pm_test_folder());
        check_refused(scene_lines[i], empty, "empty.xml");
        check_refused(scene_lines[i], cut, "cut.xml:2");
        check_refused(scene_lines[i], text, "text.xml:1");
        check_refused(scene_lines[i], other, "other.xml:1");
    }
}

// The next of the parts `a | b | c` of a line, without blanks around it; NULL behind the last.
static char *next_part(char **rest)
{
    if (!*rest) {
        return NULL;
    }
    char *part = *rest + strspn(*rest, " ");
    char *bar = strstr(part, " |");
    *rest = bar ? bar + 2 : NULL;
    if (bar) {
        *bar = '\0';
    }
    return part;
}

// A line of bad/expected.txt: who, file, and the parts of what must be said about it.
static void check_broken_scene(char *line, const char *program_line)
{
    char *rest = line;
    (void)next_part(&rest);
    char path[256];
    snprintf(path, sizeof path, "tests/bad/%s", next_part(&rest));
    pm_test_ran ran = pm_command_run(program_line, path, pm_command_path("out"));
    for (const char *part = NULL; (part = next_part(&rest)) != NULL;) {
        pm_command_check_refusal(path, &ran, part);
    }
    CHECK_THAT(pm_command_count_files() == 0, "%s: %s leaves a file", path, program_line);
    pm_test_ran_free(&ran);
}

static void refuse_broken_scenes(void)
{
    pm_test_folder();
    int lines = 0;
    char line[1024];
    FILE *list = fopen("tests/bad/expected.txt", "r");
    CHECK(list != NULL);
    while (fgets(line, sizeof line, list)) {
        line[strcspn(line, "\n")] = '\0';
        if (line[0] == '#' || line[0] == '\0') {
            continue;
        }
        const char *program_line = scene_lines[lines++ % (int)SCENE_LINES];
        bool picture = strncmp(line, "picture", 7) == 0;
        check_broken_scene(line, picture ? scene_lines[SCENE_LINES - 1] : program_line);
    }
    fclose(list);
    CHECK(lines > 100);
}

static const refusal any_number[] = {
    {"emission {S} -n 0", "-n"},
    {"tracing {S} -n 0", "-n"},
    {"storage {S} -n 0", "-n"},
    {"balancing {S} -n 0", "-n"},
    {"emission {S} -n -5", "-n"},
    {"emission {S} -n 12x", "12x"},
    {"emission {S} -n nan", "nan"},
    {"emission {S} -n 1e400", "1e400"},
    {"emission {S} -n 99999999999999999999", "99999999999999999999"},
    {"emission {S} -n", "-n needs a value"},
    {"tracing {S} --seed -1", "--seed"},
    {"tracing {S} --seed 4294967296", "--seed"},
    {"tracing {S} --threads 0", "--threads"},
    {"tracing {S} --max-bounces 0", "--max-bounces"},
    {"render {S} -o {O} -k 0", "-k"},
    {"render {S} -o {O} -k 5x", "5x"},
    {"render {S} -o {O} -r 0", "-r"},
    {"render {S} -o {O} -r -1", "-r"},
    {"render {S} -o {O} -r nan", "-r"},
    {"render {S} -o {O} --flatness 0", "--flatness"},
    {"render {S} -o {O} --flatness inf", "--flatness"},
    {"render {S} -o {O} --spp 0", "--spp"},
    {"render {S} -o {O} --gather -1", "--gather"},
    {"render {S} -o {O} --size 0x5", "--size"},
    {"render {S} -o {O} --size 12", "--size"},
    {"render {S} -o {O} --exposure nan", "--exposure"},
    {"radiance {S} --at 1,2 --normal 0,1,0", "--at"},
    {"radiance {S} --at 1,2,nan --normal 0,1,0", "--at"},
    {"radiance {S} --at 1,2,3 --normal 0,0,0", "--normal"},
    {"radiance {S} --at 1,2,3 --normal 0,1,0 -k 0", "-k"},
};

static void refuse_bad_numbers(void)
{
    CHECK_TABLE(any_number);
}

static const refusal words[] = {
    {"render {S} -o {O} --filter gauss", "gaussian"},
    {"render {S} -o {O} --shape disk", "disc"},
    {"render {S} -o {O} --preset lecture", "lecture-10k"},
    {"render {S} -o {O} --roulette mean", "average"},
    {"render {S} -o {O} --packing maybe", "off"},
    {"render {S} -o {O} --only diffuse", "direct"},
    {"render {S} -o {O} --direct shadows", "--direct must be rays|photons"},
    {"render {S} -o {O} --caustics none", "--caustics must be map|global"},
    {"render {S} -o {O} --precompute yes", "--precompute must be off|on"},
    {"render {S} -o {O} --projection yes", "--projection must be on|off"},
    {"render {S} -o {O} --photons 1", "--photons must leave a photon for each map"},
    {"render {S} --explain --photons 1", "--photons must leave a photon for each map"},
    {"render {S} -o {O} --gathr 5", "--gather"},
    {"render {S} -o {O} --photon 5", "--photon"},
    {"render {S} -o {O} -k 5 -k 6", "twice"},
    {"render {S}", "-o"},
    {"render", "SCENE"},
    {"emission", "SCENE"},
    {"tracing", "SCENE"},
    {"storage", "SCENE"},
    {"balancing", "SCENE"},
    {"radiance --at 0,0,0", "SCENE"},
    {"tracing {S} {S}", "SCENE"},
    {"tracing {S} -D size", "-D"},
    {"tracing {S} -D nosuch=1", "nosuch"},
    {"reference {S} -o {O}", "--spp"},
    {"reference {S} --spp 2", "-o"},
    {"reference {S} -o {O} --spp 3", "must be even"},
    {"compare {S}", "B.exr"},
};

static void refuse_bad_words(void)
{
    CHECK_TABLE(words);
}

static void refuse_unwritable_output(void)
{
    const char *nowhere = pm_command_path("no/such/folder/out");
    for (size_t i = 0; i < SCENE_LINES; ++i) {
        pm_test_ran ran = pm_command_run(scene_lines[i], good_scene, nowhere);
        pm_command_check_refusal(scene_lines[i], &ran, "no/such/folder/out");
        pm_test_ran_free(&ran);
        ran = pm_command_run(scene_lines[i], good_scene, pm_test_folder());
        pm_command_check_refusal(scene_lines[i], &ran, pm_test_folder());
        pm_test_ran_free(&ran);
    }
    CHECK(pm_command_count_files() == 0);
}

// No byte may be written, as on a full disk.
static void say_when_there_is_no_room(void)
{
    pm_test_folder();
    const struct rlimit none = {0, 0};
    CHECK(setrlimit(RLIMIT_FSIZE, &none) == 0);
    for (size_t i = 0; i < SCENE_LINES; ++i) {
        check_refused(scene_lines[i], good_scene, "out");
    }
}

// The file outgrows the room in the middle; an old file of that name must stay as it was.
static void keep_old_file_when_room_ends(void)
{
    const char *path = pm_command_write("out", "old");
    const struct rlimit little = {1500, 1500};
    CHECK(setrlimit(RLIMIT_FSIZE, &little) == 0);
    for (size_t i = 0; i < SCENE_LINES; ++i) {
        if (strstr(scene_lines[i], "--report")) {
            continue; // small enough to fit
        }
        pm_test_ran ran = pm_command_run(scene_lines[i], good_scene, path);
        pm_command_check_refusal(scene_lines[i], &ran, "out");
        pm_test_ran_free(&ran);
        struct stat now;
        CHECK(stat(path, &now) == 0 && now.st_size == 3);
        CHECK(pm_command_count_files() == 1);
    }
}

static void say_when_output_is_full(void)
{
    char script[1200];
    snprintf(script, sizeof script, "exec '%s' %s -n 500 --json >/dev/full",
             pm_test_program("tracing"), good_scene);
    const char *const argv[] = {"/bin/sh", "-c", script, NULL};
    pm_test_ran ran = pm_test_run(argv, 30.0);
    pm_command_check_refusal(script, &ran, "standard output");
    pm_test_ran_free(&ran);
}

// SIGINT after half a second of work that would take minutes.
static void stop_at_interrupt(void)
{
    static const char *const lines[] = {
        "emission {S} -n 200000000 --dump {O}",
        "tracing {S} -n 200000000 --report {O}",
        "storage {S} -n 20000000 -o {O}",
        "balancing {S} -n 20000000 --report {O}",
        "radiance {S} -n 1000000 --runs 1000 --at 0,0,0 --normal 0,1,0 --report {O}",
        "render {S} --size 2000x2000 --photons 20000 --gather 200 --spp 64 -o {O}",
        "render {S} --size 16x16 --photons 200000000 -o {O}",
    };
    pm_test_folder();
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; ++i) {
        pm_test_ran ran =
            pm_command_interrupt(lines[i], good_scene, pm_command_path("out"), 0.5);
        CHECK_THAT(ran.exit_code == 130, "%s: exit code %d, want 130; it said: %s", lines[i],
                   ran.exit_code, ran.err);
        CHECK_THAT(ran.out[0] == '\0', "%s: prints on standard output: %s", lines[i], ran.out);
        CHECK_THAT(pm_command_count_files() == 0, "%s: leaves a file behind", lines[i]);
        pm_test_ran_free(&ran);
    }
}

static void say_what_was_left_out(void)
{
    static const refusal lines[] = {
        {"render {S} --size 8x8 --photons 500 --gather 0 --spp 1 --precompute on -o {O}",
         "--precompute on: it has nothing to do"},
        {"render {S} --size 8x8 --global-photons 500 --caustic-photons 0 --spp 1 -o {O}",
         "paths LS+D are missing"},
        {"render {S} --size 8x8 --caustic-photons 500 --global-photons 0 --spp 1 -o {O}",
         "paths L{S|D}*D{S|D}*D"},
        {"render {S} --size 8x8 -n 500 --only direct --direct photons --spp 1 -o {O}",
         "500 shadow photons"},
        {"render {S} --explain", "shadow maps"},
        {"render {S} --check", "1 light\n"},
    };
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; ++i) {
        pm_test_ran ran = pm_command_run(lines[i].line, good_scene, pm_command_path("out"));
        CHECK_THAT(ran.exit_code == 0, "%s: exit code %d: %s", lines[i].line, ran.exit_code,
                   ran.err);
        CHECK_CONTAINS(ran.out, lines[i].words);
        pm_test_ran_free(&ran);
    }
}

static void refuse_bad_pictures(void)
{
    const char *text = pm_command_write("a.exr", "this is no picture");
    const char *empty = pm_command_write("b.exr", "");
    check_refused("compare {S} {S}", text, "a.exr");
    check_refused("compare {S} {S}", empty, "b.exr");
    check_refused("compare {S} {S}", pm_test_folder(), pm_test_folder());
    check_refused("compare {S} {S}", pm_command_path("no.exr"), "no.exr");
    check_refused("storage --check {S}", text, "a.exr");
    check_refused("storage --check {S}", empty, "b.exr");
    check_refused("storage --check {S}", pm_command_path("no.ply"), "no.ply");
    check_refused("render scenes/cornell-spheres.xml -o {O} --map {S}", text, "a.exr");
}

PM_TESTS({"programs.1", "good lines are accepted and leave their file", accept_good_lines},
         {"programs.2", "a scene that is missing, a folder, empty, cut or no scene is refused",
          refuse_bad_scenes},
         {"programs.3", "numbers out of range or with rubbish are refused by name",
          refuse_bad_numbers},
         {"programs.4", "unknown, doubled and missing words are refused with the nearest one",
          refuse_bad_words},
         {"programs.5", "output into a missing folder or over a folder is refused",
          refuse_unwritable_output},
         {"programs.6", "a full disk is told and leaves no file", say_when_there_is_no_room},
         {"programs.7", "an old file survives when the disk fills up",
          keep_old_file_when_room_ends},
         {"programs.8", "a full standard output is told", say_when_output_is_full},
         {"programs.9", "SIGINT ends with 130 and leaves no file", stop_at_interrupt},
         {"programs.10", "what is no picture and no photon map is refused",
          refuse_bad_pictures},
         {"programs.12", "render says what its settings leave out, and sets no plural for one",
          say_what_was_left_out},
         {"programs.11", "each broken scene of tests/bad is refused with its own words",
          refuse_broken_scenes})
