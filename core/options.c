// getopt_long finds the options; their values go through option.h in this order: preset, -n,
// everything else, so that the special overrides the general wherever it stands.
#include "options.h"

#include "option.h"
#include "word.h"

#include <getopt.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define TAKEN_MAX 80
#define SETTINGS_MAX 256
#define LONG_CODE 1000 // getopt's value of taken option 0

typedef struct {
    const pm_option *option;
    char *value; // NULL for flags
} setting;

typedef struct {
    const pm_options_program *program;
    const pm_option *taken[TAKEN_MAX];
    int taken_count;
    setting settings[SETTINGS_MAX];
    int setting_count;
    bool unknown; // an option was not understood: positionals may be its values
    char faults[4096];
} parser;

pm_options pm_options_defaults(void)
{
    return (pm_options){
        .photons = {200000, 200000, 100000},
        .roulette = PM_ROULETTE_MAX,
        .estimate = {.k = 100,
                     .radius = (double)INFINITY,
                     .shape = PM_GATHER_DISC,
                     .flatness = 0.1,
                     .filter = PM_FILTER_NONE,
                     .constants = PM_CONSTANTS_UNBIASED},
        .gather = 64,
        .spp = 4,
        .passes = 16,
        .only = -1,
        .by = -1,
        .frames = 60,
        .runs = 1,
        .depth = 5,
        .paths = 150,
        .seed = 1,
    };
}

#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static void
add_fault(parser *p, const char *format, ...)
{
    size_t used = strlen(p->faults);
    va_list arguments;
    va_start(arguments, format);
    used += (size_t)snprintf(p->faults + used, sizeof p->faults - used,
                             "%s%s: ", used > 0 ? "\n" : "", p->program->name);
    if (used < sizeof p->faults) {
        vsnprintf(p->faults + used, sizeof p->faults - used, format, arguments);
    }
    va_end(arguments);
}

static void take_options(parser *p)
{
    const pm_option *option;
    for (int i = 0; (option = pm_option_at(i)) != NULL && p->taken_count < TAKEN_MAX; i++) {
        if (pm_word_listed(option->key, PM_OPTIONS_COMMON, ' ') ||
            pm_word_listed(option->key, p->program->options, ' ')) {
            p->taken[p->taken_count++] = option;
        }
    }
}

static const setting *find_setting(const parser *p, const char *key)
{
    for (int i = 0; i < p->setting_count; i++) {
        if (strcmp(p->settings[i].option->key, key) == 0) {
            return &p->settings[i];
        }
    }
    return NULL;
}

static void add_setting(parser *p, setting given)
{
    const pm_option *option = given.option;
    char name[32];
    bool repeats = option->kind == PM_OPTION_DEFINE || option->kind == PM_OPTION_MAP ||
                   option->kind == PM_OPTION_FLAG;
    pm_option_spell(option, name, sizeof name);
    if (!repeats && find_setting(p, option->key) != NULL) {
        add_fault(p, "%s is given twice", name);
    } else if (p->setting_count == SETTINGS_MAX) {
        add_fault(p, "more than %d options", SETTINGS_MAX);
    } else {
        p->settings[p->setting_count++] = given;
    }
}

static void refuse_unknown(parser *p, const char *given)
{
    size_t length = strcspn(given, "=");
    char word[64];
    snprintf(word, sizeof word, "%.*s", (int)length, given);
    const pm_option *nearest = p->taken[0]; // --help, at least, is always taken
    int least = 1 << 20;
    for (int i = 0; i < p->taken_count; i++) {
        char name[32];
        pm_option_spell(p->taken[i], name, sizeof name);
        int distance = pm_word_distance(word, name);
        if (distance < least) {
            least = distance;
            nearest = p->taken[i];
        }
    }
    char name[32];
    pm_option_spell(nearest, name, sizeof name);
    add_fault(p, "unknown option %s; the nearest known one is %s (--help lists all)", word,
              name);
    p->unknown = true;
}

// getopt takes any unique beginning of a long name; here `--photon` must not mean --photons.
static bool is_abbreviated(char *const *argv, const pm_option *option)
{
    int back = optarg != NULL && optarg == argv[optind - 1] ? 2 : 1;
    const char *given = argv[optind - back];
    if (strncmp(given, "--", 2) != 0) {
        return false;
    }
    return strcspn(given + 2, "=") != strlen(option->name);
}

static void describe_to_getopt(const parser *p, char *shorts, struct option *longs)
{
    *shorts++ = ':'; // a missing value is told apart from an unknown option
    for (int i = 0; i < p->taken_count; i++) {
        const pm_option *option = p->taken[i];
        int has_value = option->kind == PM_OPTION_FLAG ? no_argument : required_argument;
        if (strlen(option->name) > 1) {
            *longs++ = (struct option){option->name, has_value, NULL, LONG_CODE + i};
            continue;
        }
        *shorts++ = option->name[0];
        if (has_value == required_argument) {
            *shorts++ = ':';
        }
    }
    *shorts = '\0';
    *longs = (struct option){NULL, 0, NULL, 0};
}

static const pm_option *find_taken(const parser *p, int code)
{
    if (code >= LONG_CODE) {
        return p->taken[code - LONG_CODE];
    }
    const char letter[2] = {(char)code, '\0'};
    for (int i = 0; i < p->taken_count; i++) {
        if (strcmp(p->taken[i]->name, letter) == 0) {
            return p->taken[i];
        }
    }
    return NULL;
}

static void refuse_word(parser *p, int code, char *const *argv)
{
    const pm_option *option = optopt != 0 ? find_taken(p, optopt) : NULL;
    char name[32];
    if (option != NULL) {
        pm_option_spell(option, name, sizeof name);
        add_fault(p, code == ':' ? "%s needs a value" : "%s takes no value", name);
    } else if (optopt != 0) {
        snprintf(name, sizeof name, "-%c", optopt);
        refuse_unknown(p, name);
    } else {
        refuse_unknown(p, argv[optind - 1]);
    }
}

static void read_words(int argc, char **argv, parser *p)
{
    char shorts[2 * TAKEN_MAX + 2];
    struct option longs[TAKEN_MAX + 1];
    describe_to_getopt(p, shorts, longs);
    optind = 0; // start afresh
    opterr = 0;
    int code;
    while ((code = getopt_long(argc, argv, shorts, longs, NULL)) != -1) {
        const pm_option *option = find_taken(p, code);
        if (option == NULL) { // '?' or ':'
            refuse_word(p, code, argv);
        } else if (code >= LONG_CODE && is_abbreviated(argv, option)) {
            refuse_unknown(p, argv[optind - (optarg == argv[optind - 1] ? 2 : 1)]);
        } else {
            add_setting(p, (setting){option, optarg});
        }
    }
}

static void apply_preset(pm_options *options)
{
    bool small = strcmp(options->preset, "lecture-10k") == 0;
    bool disc = strcmp(options->preset, "lecture-disc") == 0;
    options->stored = small ? 10000 : 500000;
    options->estimate.k = small ? 100 : 500;
    options->estimate.shape = disc ? PM_GATHER_DISC : PM_GATHER_SPHERE;
    options->estimate.constants = PM_CONSTANTS_LECTURE;
    options->k_given = true;
}

static void apply_setting(parser *p, const setting *s, pm_options *options)
{
    pm_status_clear();
    if (pm_option_set(s->option, s->value, options) != PM_OK) {
        add_fault(p, "%s", pm_status_message());
    } else if (strcmp(s->option->key, "preset") == 0) {
        apply_preset(options);
    } else if (strcmp(s->option->key, "n") == 0) {
        options->photons[1] = options->photons[0];
        options->photons[2] = options->photons[0];
    }
}

static bool is_general(const setting *s)
{
    return strcmp(s->option->key, "preset") == 0 || strcmp(s->option->key, "n") == 0;
}

static void apply_settings(parser *p, pm_options *options)
{
    for (int i = 0; i < p->setting_count; i++) {
        if (is_general(&p->settings[i])) {
            apply_setting(p, &p->settings[i], options);
        }
    }
    for (int i = 0; i < p->setting_count; i++) {
        if (!is_general(&p->settings[i])) {
            apply_setting(p, &p->settings[i], options);
        }
    }
    options->estimate.plain_k = options->estimate.constants == PM_CONSTANTS_LECTURE;
}

static void check_photon_counts(parser *p, pm_options *options)
{
    static const char *const keys[] = {"n", "global-photons", "caustic-photons",
                                       "volume-photons"};
    bool total = find_setting(p, "photons") != NULL;
    for (int i = 0; i < 4; i++) {
        if (find_setting(p, keys[i]) == NULL) {
            continue;
        }
        options->stored = 0;
        if (total) {
            add_fault(p, "--photons is split by the plan and cannot be given with %s%s",
                      i == 0 ? "-" : "--", keys[i]);
        }
    }
    if (total) {
        options->stored = 0;
    }
}

/// What has no meaning without --progressive, and what has none with it.
static void check_progressive(parser *p, const pm_options *options)
{
    static const char *const parts[] = {"passes", "checkpoint", "resume"};
    for (int i = 0; i < 3; i++) {
        if (!options->progressive && find_setting(p, parts[i]) != NULL) {
            add_fault(p, "--%s belongs to --progressive, which is not given", parts[i]);
        }
    }
    if (options->resume && options->checkpoint == NULL) {
        add_fault(p, "--resume needs --checkpoint FILE, to go on from");
    }
    if (options->progressive && options->map_count > 0 && find_setting(p, "map") != NULL) {
        add_fault(p, "--progressive traces new photons in each pass: --map cannot be given");
    }
    if (options->progressive && options->stored > 0) {
        add_fault(p,
                  "--progressive emits the same number in each pass, and --preset %s fills "
                  "maps: add -n N",
                  options->preset);
    }
    if (options->progressive && options->view_photons) {
        add_fault(p, "--progressive makes pictures, not dots: --view photons cannot be given");
    }
}

static void check_march(parser *p, const pm_options *options)
{
    if (!options->media_march && find_setting(p, "march-step") != NULL) {
        add_fault(p, "--march-step belongs to --media march, which is not given");
    }
}

static void check_needs(parser *p)
{
    for (int i = 0; i < p->taken_count; i++) {
        const char *key = p->taken[i]->key;
        char name[32];
        pm_option_spell(p->taken[i], name, sizeof name);
        if (p->program->needs != NULL && pm_word_listed(key, p->program->needs, ' ') &&
            find_setting(p, key) == NULL) {
            add_fault(p, "%s %s must be given (--help lists all options)", name,
                      p->taken[i]->words);
        }
    }
}

static void check_positionals(parser *p, const pm_options *options)
{
    int least = options->check_file != NULL ? 0 : p->program->positional_least;
    int most = options->check_file != NULL ? 0 : p->program->positional_most;
    if (options->positional_count < least) {
        add_fault(p, "%s is missing (usage: %s %s [options])", p->program->positional,
                  p->program->name, p->program->positional);
    } else if (options->positional_count > most && !p->unknown) {
        add_fault(p, "unexpected argument \"%s\" (usage: %s %s [options])",
                  options->positional[most], p->program->name, p->program->positional);
    }
}

pm_status pm_options_parse(int argc, char **argv, const pm_options_program *program,
                           pm_options *options)
{
    parser p = {.program = program};
    pm_options parsed = pm_options_defaults();
    take_options(&p);
    read_words(argc, argv, &p);
    parsed.positional = (const char *const *)(argv + optind);
    parsed.positional_count = argc - optind;
    apply_settings(&p, &parsed);
    if (!parsed.help) {
        check_photon_counts(&p, &parsed);
        check_progressive(&p, &parsed);
        check_march(&p, &parsed);
        check_needs(&p);
        check_positionals(&p, &parsed);
    }
    pm_status_clear();
    if (!parsed.help && p.faults[0] != '\0') {
        return pm_status_fail(PM_EINPUT, "%s", p.faults);
    }
    *options = parsed;
    return PM_OK;
}
