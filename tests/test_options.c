// Command lines: what is understood, what is refused and with which line, and that --help knows
// every option.
#include "option.h"
#include "options.h"
#include "test.h"
#include "usage.h"
#include "word.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define WORDS_MAX 48

static const pm_options_program render = {
    .name = "render",
    .does = "Renders.",
    .positional = "SCENE",
    .positional_least = 1,
    .positional_most = 1,
    .options = "n photons global-photons caustic-photons k r shape filter kernel-constants "
               "flatness gather spp exposure packing max-bounces part at normal size preset "
               "direct caustics precompute projection "
               "media march-step progressive passes checkpoint resume "
               "only o map check report max-rel-mse",
    .needs = "o",
};

static const pm_options_program storage = {
    .name = "storage",
    .does = "Stores.",
    .positional = "SCENE",
    .positional_least = 1,
    .positional_most = 1,
    .options = "n o check-file photon spp",
};

// A command line being parsed: argv must stay as long as the options.
typedef struct {
    char text[1024];
    char *argv[WORDS_MAX + 1];
    int argc;
    pm_options options;
} command;

static pm_status parse(const pm_options_program *program, const char *line, command *c)
{
    memset(c, 0, sizeof *c);
    snprintf(c->text, sizeof c->text, "%s %s", program->name, line);
    for (char *at = c->text; *at != '\0' && c->argc < WORDS_MAX;) {
        size_t span = strcspn(at, " ");
        char *next = at + span + (at[span] != '\0');
        at[span] = '\0';
        c->argv[c->argc++] = at;
        at = next;
    }
    return pm_options_parse(c->argc, c->argv, program, &c->options);
}

static void refuse(const pm_options_program *program, const char *line, const char *message)
{
    command c;
    CHECK_FAILS(parse(program, line, &c), PM_EINPUT, message);
}

static void defaults_are_those_of_the_design(void)
{
    command c;
    CHECK_OK(parse(&render, "scene.xml -o out.exr", &c));
    const pm_options *o = &c.options;
    CHECK(o->positional_count == 1 && strcmp(o->positional[0], "scene.xml") == 0);
    CHECK(o->photons[PM_MAP_GLOBAL] == 200000 && o->photons[PM_MAP_CAUSTIC] == 200000);
    CHECK(o->photons[PM_MAP_VOLUME] == 100000 && o->photons_total == 0 && o->stored == 0);
    CHECK(o->estimate.k == 100 && isinf(o->estimate.radius) && !o->k_given);
    CHECK(o->estimate.shape == PM_GATHER_DISC && o->estimate.filter == PM_FILTER_NONE);
    CHECK(o->estimate.constants == PM_CONSTANTS_UNBIASED && !o->estimate.plain_k);
    CHECK_NEAR(o->estimate.flatness, 0.1, 0.0);
    CHECK(o->gather == 64 && o->spp == 4 && o->seed == 1 && o->threads == 0 && o->runs == 1);
    CHECK(!o->unpacked && !o->view_photons);
    CHECK(!o->direct_photons && !o->caustics_global && !o->precompute && !o->everywhere);
    CHECK(o->roulette == PM_ROULETTE_MAX && o->max_bounces == 0 && o->only == -1);
    CHECK(!o->json && !o->has_at && !o->has_normal && !o->has_max_rel_mse);
}

static void every_kind_of_value_arrives(void)
{
    command c;
    CHECK_OK(parse(&render,
                   "-n 9007199254740992 -k 7 -r 0.5 --shape sphere --filter=gaussian "
                   "--kernel-constants lecture --packing off s.xml "
                   "--exposure -1.5 --at -1,2e1,.5 --normal 0,0,-4 --size 640x480 "
                   "--direct photons --caustics global --precompute on --projection off "
                   "--only indirect --seed 4294967295 -oout.exr --json --max-bounces 3",
                   &c));
    const pm_options *o = &c.options;
    CHECK(o->photons[0] == 9007199254740992u && o->photons[2] == o->photons[0]);
    CHECK(o->estimate.k == 7 && o->k_given && o->estimate.radius == 0.5);
    CHECK(o->estimate.shape == PM_GATHER_SPHERE && o->estimate.filter == PM_FILTER_GAUSSIAN);
    CHECK(o->estimate.constants == PM_CONSTANTS_LECTURE && o->estimate.plain_k);
    CHECK(o->unpacked && o->json && o->max_bounces == 3);
    CHECK(o->direct_photons && o->caustics_global && o->precompute && o->everywhere);
    CHECK(o->exposure == -1.5 && o->seed == 4294967295u && o->only == PM_LAYER_INDIRECT);
    CHECK(o->has_at && o->at.x == -1.0 && o->at.y == 20.0 && o->at.z == 0.5);
    CHECK(o->has_normal && o->normal.z == -1.0 && o->normal.x == 0.0);
    CHECK(o->width == 640 && o->height == 480);
    CHECK(strcmp(o->output, "out.exr") == 0 && strcmp(o->positional[0], "s.xml") == 0);
}

static void directions_of_any_length_become_unit(void)
{
    command c;
    CHECK_OK(parse(&render, "s.xml -o o --normal 3e-200,0,4e-200", &c));
    CHECK_NEAR(c.options.normal.x, 0.6, 1e-15);
    CHECK_OK(parse(&render, "s.xml -o o --normal 3e200,0,4e200", &c));
    CHECK_NEAR(c.options.normal.z, 0.8, 1e-15);
}

static void the_special_overrides_the_general_in_any_order(void)
{
    command c;
    CHECK_OK(parse(&render, "s.xml -o o --caustic-photons 5 -n 9", &c));
    CHECK(c.options.photons[PM_MAP_CAUSTIC] == 5 && c.options.photons[PM_MAP_GLOBAL] == 9);
    CHECK_OK(parse(&render, "s.xml -o o -k 50 --preset lecture-disc", &c));
    CHECK(c.options.estimate.k == 50 && c.options.stored == 500000);
    CHECK(c.options.estimate.shape == PM_GATHER_DISC);
}

static void presets_hold_the_settings_of_the_lecture(void)
{
    command c;
    CHECK_OK(parse(&render, "s.xml -o o --preset lecture-10k", &c));
    CHECK(c.options.stored == 10000 && c.options.estimate.k == 100 && c.options.k_given);
    CHECK(c.options.estimate.shape == PM_GATHER_SPHERE && c.options.estimate.plain_k);
    CHECK(c.options.estimate.constants == PM_CONSTANTS_LECTURE);
    CHECK_OK(parse(&render, "s.xml -o o --preset lecture-500k -n 1000", &c));
    CHECK(c.options.estimate.k == 500 && c.options.photons[0] == 1000);
    CHECK_THAT(c.options.stored == 0, "an explicit number of photons overrides the preset's");
    CHECK_OK(parse(&render, "s.xml -o o --preset lecture-10k --kernel-constants unbiased", &c));
    CHECK(!c.options.estimate.plain_k);
}

static void numbers_are_refused_unless_whole_and_in_range(void)
{
    static const struct {
        const char *line, *message;
    } cases[] = {
        {"-n 0", "-n must be a whole number from 1 to 9007199254740992, got \"0\""},
        {"-n -5", "got \"-5\""},
        {"-n 1e6", "got \"1e6\""},
        {"-n 12x", "got \"12x\""},
        {"-n 9007199254740993", "got \"9007199254740993\""},
        {"-n 18446744073709551617", "got \"18446744073709551617\""},
        {"-k 0", "-k must be a whole number from 1 to 2147483647, got \"0\""},
        {"-k 2147483648", "got \"2147483648\""},
        {"-k 1.5", "got \"1.5\""},
        {"-r 0", "-r must be a finite number above 1e-30, or none, got \"0\""},
        {"-r 1e-30", "got \"1e-30\""},
        {"-r nan", "got \"nan\""},
        {"-r 1e999", "got \"1e999\""},
        {"-r 1e-999", "got \"1e-999\""},
        {"-r 0.5m", "got \"0.5m\""},
        {"--flatness 1.5", "--flatness must be a number above 0 and at most 1, got \"1.5\""},
        {"--gather 1000001", "--gather must be a whole number from 0 to 1000000"},
        {"--spp 0", "--spp must be a whole number from 1"},
        {"--seed 4294967296", "--seed must be a whole number from 0 to 4294967295"},
        {"--threads 0", "--threads must be a whole number from 1"},
        {"--exposure inf", "--exposure must be a number from -100 to 100, got \"inf\""},
        {"--max-rel-mse -1", "--max-rel-mse must be a finite number from 0 up, got \"-1\""},
        {"--max-rel-mse nan", "got \"nan\""},
        {"--shape cube", "--shape must be disc|sphere, got \"cube\""},
        {"--shape dis", "got \"dis\""},
        {"--direct both", "--direct must be rays|photons, got \"both\""},
        {"--caustics both", "--caustics must be map|global, got \"both\""},
        {"--precompute 1", "--precompute must be off|on, got \"1\""},
        {"--projection 1", "--projection must be on|off, got \"1\""},
        {"--preset lecture", "--preset must be lecture-10k|lecture-500k|lecture-disc"},
        {"--at 1,2", "--at must be three finite numbers x,y,z, got \"1,2\""},
        {"--at 1,2,3,4", "got \"1,2,3,4\""},
        {"--at 1,nan,3", "got \"1,nan,3\""},
        {"--normal 0,0,0", "--normal must be a direction x,y,z that is not zero"},
        {"--size 640", "--size must be WxH, both from 1 to 65536, got \"640\""},
        {"--size 0x5", "got \"0x5\""},
        {"--size 5x65537", "got \"5x65537\""},
        {"--size 1x2x3", "got \"1x2x3\""},
        {"--part 0,0,1", "--part must be U0,V0,U1,V1 from 0 to 1 with U0 < U1 and V0 < V1"},
        {"--part 0,0,1,1.1", "got \"0,0,1,1.1\""},
        {"--part -0.1,0,1,1", "got \"-0.1,0,1,1\""},
        {"--part 0.5,0,0.5,1", "got \"0.5,0,0.5,1\""},
        {"--part 0,0.6,1,0.5", "got \"0,0.6,1,0.5\""},
        {"-D sigma", "-D must be NAME=VALUE, got \"sigma\""},
        {"-D =1", "-D must be NAME=VALUE, got \"=1\""},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char line[256];
        snprintf(line, sizeof line, "s.xml -o o %s", cases[i].line);
        refuse(&render, line, cases[i].message);
    }
}

static void unknown_options_name_the_nearest(void)
{
    refuse(&render, "s.xml -o o --gahter 5",
           "render: unknown option --gahter; the nearest known one is --gather");
    refuse(&render, "s.xml -o o --filtre=cone", "the nearest known one is --filter");
    refuse(&render, "s.xml -o o -x", "unknown option -x");
    refuse(&storage, "s.xml --gather 5", "storage: unknown option --gather");
    refuse(&storage, "s.xml --progressive", "unknown option --progressive");
}

static void passes_belong_to_progressive_pictures(void)
{
    command c;
    CHECK_OK(parse(&render, "s.xml -o o --media march --march-step 0.5", &c));
    CHECK(c.options.media_march && !c.options.progressive && c.options.passes == 16);
    CHECK(!c.options.gather_given && !c.options.spp_given);
    CHECK_NEAR(c.options.march_step, 0.5, 0.0);
    CHECK_OK(parse(&render,
                   "s.xml -o o --progressive --passes 268435455 --checkpoint c --resume "
                   "--gather 64 --spp 4 --preset lecture-10k -n 5",
                   &c));
    CHECK(c.options.progressive && c.options.passes == 268435455 && c.options.resume);
    CHECK(strcmp(c.options.checkpoint, "c") == 0);
    CHECK(c.options.gather_given && c.options.spp_given);
    refuse(&render, "s.xml -o o --passes 3 --checkpoint c --resume",
           "render: --passes belongs to --progressive, which is not given\n"
           "render: --checkpoint belongs to --progressive, which is not given\n"
           "render: --resume belongs to --progressive, which is not given");
    refuse(&render, "s.xml -o o --progressive --passes 268435456", "from 1 to 268435455");
    refuse(&render, "s.xml -o o --progressive --resume", "--resume needs --checkpoint FILE");
    refuse(&render, "s.xml -o o --progressive --map m.ply", "--map cannot be given");
    refuse(&render, "s.xml -o o --progressive --preset lecture-10k", "add -n N");
    refuse(&render, "s.xml -o o --march-step 1", "--march-step belongs to --media march");
    refuse(&render, "s.xml -o o --media march --march-step 0", "a number above 0");
    refuse(&render, "s.xml -o o --media march --march-step nan", "a number above 0");
}

static void abbreviations_are_not_guessed(void)
{
    // render takes --photons but not --photon, which replays one photon elsewhere.
    refuse(&render, "s.xml -o o --photon 5", "unknown option --photon; the nearest");
    refuse(&render, "s.xml -o o --photon=5", "unknown option --photon; the nearest");
    refuse(&render, "s.xml -o o --js", "unknown option --js");
    command c;
    CHECK_OK(parse(&storage, "s.xml --photon 0", &c));
    CHECK(c.options.has_photon && c.options.photon == 0);
}

static void all_faults_are_told_a_line_each(void)
{
    command c;
    CHECK(parse(&render, "-k 0 -r x --bogus", &c) == PM_EINPUT);
    const char *message = pm_status_message();
    CHECK_CONTAINS(message, "render: -k must be");
    CHECK_CONTAINS(message, "\nrender: -r must be");
    CHECK_CONTAINS(message, "unknown option --bogus");
    CHECK_CONTAINS(message, "\nrender: -o FILE must be given");
    CHECK_CONTAINS(message, "\nrender: SCENE is missing");
    int lines = 1;
    for (const char *at = message; *at != '\0'; at++) {
        lines += *at == '\n';
    }
    CHECK_NEAR(lines, 5, 0);
}

static void misuse_is_refused(void)
{
    refuse(&render, "s.xml -o", "-o needs a value");
    refuse(&render, "s.xml -o o --gather", "--gather needs a value");
    refuse(&render, "s.xml -o o --json=1", "--json takes no value");
    refuse(&render, "s.xml -o o -k 5 -k 6", "-k is given twice");
    refuse(&render, "s.xml t.xml -o o", "unexpected argument \"t.xml\"");
    refuse(&render, "s.xml -o o --photons 5 -n 5", "--photons is split by the plan");
    refuse(&render, "s.xml -o o --photons 5 --caustic-photons 5", "with --caustic-photons");
    refuse(&render, "s.xml -o o -D a=1 -D a=2", "-D must be given once for each name");
    refuse(&render, "s.xml -o o --report=", "--report must be a text that is not empty");
}

static void untouched_when_refused(void)
{
    pm_options options = {.seed = 77};
    char name[] = "render";
    char bad[] = "--bogus";
    char *argv[] = {name, bad, NULL};
    CHECK_FAILS(pm_options_parse(2, argv, &render, &options), PM_EINPUT, "--bogus");
    CHECK(options.seed == 77 && options.spp == 0);
}

static void repeated_options_gather(void)
{
    command c;
    CHECK_OK(parse(&render, "s.xml -o o -D a=1 -Db=x=y --map g.ply --map c.ply", &c));
    CHECK(c.options.define_count == 2 && c.options.map_count == 2);
    CHECK(strcmp(c.options.define[0].name, "a") == 0);
    CHECK(strcmp(c.options.define[1].value, "x=y") == 0);
    CHECK(strcmp(c.options.map[1], "c.ply") == 0);
}

static void check_means_a_file_where_one_is_checked(void)
{
    command c;
    CHECK_OK(parse(&storage, "--check map.ply", &c));
    CHECK(strcmp(c.options.check_file, "map.ply") == 0 && c.options.positional_count == 0);
    refuse(&storage, "s.xml --check map.ply", "unexpected argument \"s.xml\"");
    CHECK_OK(parse(&render, "s.xml -o o --check", &c));
    CHECK(c.options.check_scene && c.options.check_file == NULL);
}

static char *usage_of(const pm_options_program *program)
{
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    CHECK(stream != NULL);
    pm_usage_print(program, stream);
    fclose(stream);
    return text;
}

static void help_wins_over_faults_and_lists_all(void)
{
    command c;
    CHECK_OK(parse(&render, "--bogus -k 0 --help", &c));
    CHECK(c.options.help);
    char *text = usage_of(&render);
    CHECK_CONTAINS(text, "usage: render SCENE [options]");
    CHECK_CONTAINS(text, "(must be given)");
    CHECK_CONTAINS(text, "(default 64)");
    CHECK_CONTAINS(text, "reach of an estimate [m]");
    for (int i = 0; pm_option_at(i) != NULL; i++) {
        const pm_option *option = pm_option_at(i);
        char line[64];
        snprintf(line, sizeof line, "\n  %s%s ", strlen(option->name) == 1 ? "-" : "--",
                 option->name);
        bool taken = pm_word_listed(option->key, render.options, ' ') ||
                     pm_word_listed(option->key, PM_OPTIONS_COMMON, ' ');
        bool shared = strcmp(option->key, option->name) != 0; // another key has this name
        CHECK_THAT(shared || (strstr(text, line) != NULL) == taken, "--help and %s disagree",
                   option->key);
    }
    for (const char *at = text; *at != '\0'; at += strcspn(at, "\n") + 1) {
        CHECK_THAT(strcspn(at, "\n") <= 96, "a line of --help is too long: %s", at);
    }
    free(text);
    text = usage_of(&storage); // of what it does not take there is no word
    CHECK(strstr(text, "--spp N") != NULL && strstr(text, "--progressive") == NULL);
    free(text);
}

static void keys_are_unique_and_groups_exist(void)
{
    for (int i = 0; pm_option_at(i) != NULL; i++) {
        CHECK_THAT(pm_option_find(pm_option_at(i)->key) == pm_option_at(i), "%s is there twice",
                   pm_option_at(i)->key);
    }
    char groups[512];
    snprintf(groups, sizeof groups, "%s %s", PM_OPTIONS_ESTIMATE, PM_OPTIONS_COMMON);
    for (char *key = strtok(groups, " "); key != NULL; key = strtok(NULL, " ")) {
        CHECK_THAT(pm_option_find(key) != NULL, "no option has the key %s", key);
    }
}

PM_TESTS({"options.1", "without options the settings are those of the design",
          defaults_are_those_of_the_design},
         {"options.2", "values of every kind arrive where they belong",
          every_kind_of_value_arrives},
         {"options.3", "a direction is made unit, however short or long",
          directions_of_any_length_become_unit},
         {"options.4", "the special option overrides the general one in any order",
          the_special_overrides_the_general_in_any_order},
         {"options.5", "presets hold the lecture's settings and yield to explicit options",
          presets_hold_the_settings_of_the_lecture},
         {"options.6", "a value out of range, not finite or with rubbish behind it is refused",
          numbers_are_refused_unless_whole_and_in_range},
         {"options.7", "an unknown option names the nearest that the program takes",
          unknown_options_name_the_nearest},
         {"options.8", "a beginning of an option's name is not taken for it",
          abbreviations_are_not_guessed},
         {"options.9", "every fault of a command line gets a line",
          all_faults_are_told_a_line_each},
         {"options.10", "missing, doubled, contradicting and surplus words are refused",
          misuse_is_refused},
         {"options.11", "a refused command line leaves the options untouched",
          untouched_when_refused},
         {"options.12", "-D and --map may be repeated", repeated_options_gather},
         {"options.13", "--check takes a file in storage and none in render",
          check_means_a_file_where_one_is_checked},
         {"options.14", "--help lists exactly what the program takes, in 96 columns",
          help_wins_over_faults_and_lists_all},
         {"options.15", "keys are unique and every group names options that exist",
          keys_are_unique_and_groups_exist},
         {"options.16", "what belongs to progressive pictures or to a march is refused without",
          passes_belong_to_progressive_pictures})
