// From the text of one option to its value: the whole text must be the value, in range, finite.
#include "option.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

_Static_assert(offsetof(pm_options, height) == offsetof(pm_options, width) + sizeof(int),
               "a size is written as two ints");
_Static_assert(offsetof(pm_options, grid_h) == offsetof(pm_options, grid_w) + sizeof(int),
               "a size is written as two ints");

static pm_status refuse(const pm_option *option, const char *rule, const char *got)
{
    char name[32];
    pm_option_spell(option, name, sizeof name);
    return pm_status_fail(PM_EINPUT, "%s must be %s, got \"%s\"", name, rule, got);
}

static void put(const pm_option *option, pm_options *options, const void *value, size_t size)
{
    memcpy((char *)options + option->at, value, size);
}

// Digits only, so no sign, no blank, no rubbish behind.
static bool read_count(const char *text, const pm_option *option, uint64_t *count)
{
    size_t digits = strspn(text, "0123456789");
    if (digits == 0 || digits > 19 || text[digits] != '\0') {
        return false;
    }
    *count = strtoull(text, NULL, 10);
    // As integers: as doubles 2^53 + 1 would be 2^53.
    return *count >= (uint64_t)option->least && *count <= (uint64_t)option->most;
}

// A finite decimal number at the start of `text`; `end` is what follows it.
static bool read_real(const char *text, char **end, double *value)
{
    if (strchr("+-.0123456789", text[0]) == NULL || text[0] == '\0') {
        return false;
    }
    errno = 0;
    *value = strtod(text, end);
    bool lost = errno == ERANGE && *value == 0.0;
    return *end != text && isfinite(*value) && !lost;
}

static pm_status set_count(const pm_option *option, const char *text, pm_options *options)
{
    char rule[96];
    snprintf(rule, sizeof rule, "a whole number from %.0f to %.0f", option->least,
             option->most);
    uint64_t count;
    if (!read_count(text, option, &count)) {
        return refuse(option, rule, text);
    }
    uint32_t narrow = (uint32_t)count;
    bool wide = option->kind == PM_OPTION_COUNT;
    put(option, options, wide ? (void *)&count : (void *)&narrow,
        wide ? sizeof count : sizeof narrow);
    return PM_OK;
}

static void describe_real(const pm_option *option, char *rule, size_t room)
{
    bool positive = option->kind == PM_OPTION_POSITIVE;
    const char *from = positive ? "above" : "from";
    if (isinf(option->most)) {
        snprintf(rule, room, "a finite number %s %g%s", from, option->least,
                 positive ? ", or none" : " up");
    } else {
        snprintf(rule, room, "a number %s %g %s %g", from, option->least,
                 positive ? "and at most" : "to", option->most);
    }
}

static pm_status set_real(const pm_option *option, const char *text, pm_options *options)
{
    char rule[96];
    describe_real(option, rule, sizeof rule);
    bool positive = option->kind == PM_OPTION_POSITIVE;
    bool unbounded = positive && isinf(option->most);
    double value;
    char *end;
    if (unbounded && (strcmp(text, "none") == 0 || strcmp(text, "inf") == 0)) {
        value = option->most;
    } else if (!read_real(text, &end, &value) || *end != '\0' || value < option->least ||
               value > option->most || (positive && value == option->least)) {
        return refuse(option, rule, text);
    }
    put(option, options, &value, sizeof value);
    return PM_OK;
}

// Index of `text` in the words of a choice, or -1.
static int find_word(const char *words, const char *text)
{
    size_t length = strlen(text);
    int index = 0;
    for (const char *at = words;; index++) {
        size_t span = strcspn(at, "|");
        if (span == length && memcmp(at, text, length) == 0) {
            return index;
        }
        if (at[span] == '\0') {
            return -1;
        }
        at += span + 1;
    }
}

static pm_status set_choice(const pm_option *option, const char *text, pm_options *options)
{
    int index = find_word(option->words, text);
    if (index < 0) {
        return refuse(option, option->words, text);
    }
    bool second = index == 1;
    if (option->kind == PM_OPTION_SWITCH) {
        put(option, options, &second, sizeof second);
    } else if (option->kind == PM_OPTION_WORD) {
        put(option, options, &text, sizeof text);
    } else {
        put(option, options, &index, sizeof index);
    }
    return PM_OK;
}

/// `count` numbers with commas between them, and nothing else.
static bool read_numbers(const char *text, double *numbers, int count)
{
    const char *at = text;
    for (int i = 0; i < count; i++) {
        char *end;
        if (!read_real(at, &end, &numbers[i]) || *end != (i < count - 1 ? ',' : '\0')) {
            return false;
        }
        at = end + 1;
    }
    return true;
}

static pm_status set_vector(const pm_option *option, const char *text, pm_options *options)
{
    double parts[3];
    if (!read_numbers(text, parts, 3)) {
        return refuse(option, "three finite numbers x,y,z", text);
    }
    pm_vec3 vector = pm_vec(parts[0], parts[1], parts[2]);
    if (option->kind == PM_OPTION_DIRECTION) {
        double reach = pm_vec_reach(vector);
        if (reach == 0.0) {
            return refuse(option, "a direction x,y,z that is not zero", text);
        }
        // Dividing first keeps the squares of tiny and huge components in range.
        vector = pm_vec(vector.x / reach, vector.y / reach, vector.z / reach);
        vector = pm_vec_normalize(vector);
    }
    put(option, options, &vector, sizeof vector);
    return PM_OK;
}

static pm_status set_part(const pm_option *option, const char *text, pm_options *options)
{
    double part[4];
    bool fits = read_numbers(text, part, 4);
    for (int axis = 0; axis < 2 && fits; axis++) {
        fits = part[axis] >= option->least && part[axis] < part[axis + 2] &&
               part[axis + 2] <= option->most;
    }
    if (!fits) {
        return refuse(option, "U0,V0,U1,V1 from 0 to 1 with U0 < U1 and V0 < V1", text);
    }
    put(option, options, part, sizeof part);
    return PM_OK;
}

static pm_status set_size(const pm_option *option, const char *text, pm_options *options)
{
    char rule[64];
    snprintf(rule, sizeof rule, "WxH, both from %.0f to %.0f", option->least, option->most);
    char width[8] = "";
    size_t span = strcspn(text, "x");
    if (span >= sizeof width || text[span] != 'x') {
        return refuse(option, rule, text);
    }
    memcpy(width, text, span);
    uint64_t w;
    uint64_t h;
    if (!read_count(width, option, &w) || !read_count(text + span + 1, option, &h)) {
        return refuse(option, rule, text);
    }
    int size[2] = {(int)w, (int)h};
    put(option, options, size, sizeof size);
    return PM_OK;
}

static pm_status add_define(const pm_option *option, char *text, pm_options *options)
{
    char *equals = strchr(text, '=');
    if (equals == NULL || equals == text) {
        return refuse(option, "NAME=VALUE", text);
    }
    for (int i = 0; i < options->define_count; i++) {
        const char *name = options->define[i].name;
        if (strlen(name) == (size_t)(equals - text) && memcmp(name, text, strlen(name)) == 0) {
            return refuse(option, "given once for each name", text);
        }
    }
    if (options->define_count == PM_OPTIONS_REPEAT_MAX) {
        return refuse(option, "given at most 64 times", text);
    }
    *equals = '\0';
    options->define[options->define_count++] = (pm_define){text, equals + 1};
    return PM_OK;
}

static pm_status add_text(const pm_option *option, const char *text, pm_options *options)
{
    if (text[0] == '\0') {
        return refuse(option, "a text that is not empty", text);
    }
    if (option->kind == PM_OPTION_TEXT) {
        put(option, options, &text, sizeof text);
        return PM_OK;
    }
    if (options->map_count == PM_OPTIONS_REPEAT_MAX) {
        return refuse(option, "given at most 64 times", text);
    }
    options->map[options->map_count++] = text;
    return PM_OK;
}

static pm_status set_value(const pm_option *option, char *text, pm_options *options)
{
    bool yes = true;
    switch (option->kind) {
    case PM_OPTION_FLAG:
        put(option, options, &yes, sizeof yes);
        return PM_OK;
    case PM_OPTION_COUNT:
    case PM_OPTION_COUNT32:
        return set_count(option, text, options);
    case PM_OPTION_REAL:
    case PM_OPTION_POSITIVE:
        return set_real(option, text, options);
    case PM_OPTION_CHOICE:
    case PM_OPTION_SWITCH:
    case PM_OPTION_WORD:
        return set_choice(option, text, options);
    case PM_OPTION_POINT:
    case PM_OPTION_DIRECTION:
        return set_vector(option, text, options);
    case PM_OPTION_SIZE:
        return set_size(option, text, options);
    case PM_OPTION_PART:
        return set_part(option, text, options);
    case PM_OPTION_DEFINE:
        return add_define(option, text, options);
    case PM_OPTION_TEXT:
    case PM_OPTION_MAP:
        return add_text(option, text, options);
    }
    return PM_FAIL(PM_EINPUT, "unknown kind of option %d", (int)option->kind);
}

pm_status pm_option_set(const pm_option *option, char *text, pm_options *options)
{
    PM_TRY(set_value(option, text, options));
    if (option->given != 0) {
        memcpy((char *)options + option->given, &(bool){true}, sizeof(bool));
    }
    return PM_OK;
}
