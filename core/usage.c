// One line an option, its text broken at 96 columns.
#include "usage.h"

#include "option.h"
#include "word.h"
#include "wrap.h"

#include <inttypes.h>
#include <string.h>

#define INDENT 28

// The default value of an option as text; empty for options without one.
static void describe_default(const pm_option *option, const pm_options *defaults, char *text,
                             size_t room)
{
    const char *field = (const char *)defaults + option->at;
    uint64_t count = 0;
    uint32_t count32 = 0;
    double real = 0.0;
    text[0] = '\0';
    if (option->unset != NULL) {
        snprintf(text, room, "%s", option->unset);
        return;
    }
    switch (option->kind) {
    case PM_OPTION_COUNT:
        memcpy(&count, field, sizeof count);
        snprintf(text, room, "%" PRIu64, count);
        break;
    case PM_OPTION_COUNT32:
        memcpy(&count32, field, sizeof count32);
        snprintf(text, room, "%" PRIu32, count32);
        break;
    case PM_OPTION_REAL:
    case PM_OPTION_POSITIVE:
        memcpy(&real, field, sizeof real);
        snprintf(text, room, "%g", real);
        break;
    case PM_OPTION_CHOICE:
    case PM_OPTION_SWITCH: // defaults are the first word
        snprintf(text, room, "%.*s", (int)strcspn(option->words, "|"), option->words);
        break;
    default:
        break;
    }
}

static void print_option(const pm_option *option, bool needed, FILE *stream)
{
    char name[32];
    char head[96];
    char value[64];
    char text[512];
    pm_options defaults = pm_options_defaults();
    pm_option_spell(option, name, sizeof name);
    snprintf(head, sizeof head, "  %s %s", name, option->words);
    describe_default(option, &defaults, value, sizeof value);
    if (needed) {
        snprintf(text, sizeof text, "%s (must be given)", option->does);
    } else if (value[0] != '\0') {
        snprintf(text, sizeof text, "%s (default %s)", option->does, value);
    } else {
        snprintf(text, sizeof text, "%s", option->does);
    }
    fprintf(stream, "%-*s", INDENT - 1, head);
    fprintf(stream, strlen(head) > INDENT - 2 ? "\n%*s" : "%*s",
            strlen(head) > INDENT - 2 ? INDENT : 1, "");
    pm_wrap_print(text, INDENT, stream);
}

void pm_usage_print(const pm_options_program *program, FILE *stream)
{
    fprintf(stream, "usage: %s %s [options]\n%s\n\n", program->name, program->positional,
            program->does);
    const pm_option *option;
    for (int i = 0; (option = pm_option_at(i)) != NULL; i++) {
        bool common = pm_word_listed(option->key, PM_OPTIONS_COMMON, ' ');
        if (common || pm_word_listed(option->key, program->options, ' ')) {
            bool needed =
                program->needs != NULL && pm_word_listed(option->key, program->needs, ' ');
            print_option(option, needed, stream);
        }
    }
    if (program->notes != NULL) {
        fprintf(stream, "\n%s\n", program->notes);
    }
}
