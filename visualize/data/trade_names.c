// Values are compared as texts: what is written alike is the same setting.
#include "trade_names.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const missing = "not set";

static const char *value_at(const pm_trade *trade, int point, const char *option)
{
    const char *value = pm_trade_setting_of(&trade->point[point], option);
    return value != NULL ? value : missing;
}

/// Puts a value into its place among those there are, unless it is there.
/// @return false when there is no room for it
static bool add_value(pm_trade_groups *groups, const char *value)
{
    int at = groups->count;
    for (int g = 0; g < groups->count; g++) {
        if (strcmp(groups->value[g], value) == 0) {
            return true;
        }
    }
    if (groups->count == PM_TRADE_GROUPS_MAX) {
        return false;
    }
    for (; at > 0 && strtod(groups->value[at - 1], NULL) > strtod(value, NULL); at--) {
        memcpy(groups->value[at], groups->value[at - 1], PM_TRADE_WORD);
    }
    snprintf(groups->value[at], PM_TRADE_WORD, "%s", value);
    groups->count++;
    return true;
}

/// All values of an option; `count` stays 0 when there are too many.
static pm_trade_groups values_of(const pm_trade *trade, const char *option)
{
    pm_trade_groups groups = {.option = option};
    for (int i = 0; i < trade->point_count; i++) {
        if (!add_value(&groups, value_at(trade, i, option))) {
            groups.count = 0;
            return groups;
        }
    }
    return groups;
}

/// The better of what there is and of the options of one point.
static void choose(const pm_trade *trade, const pm_trade_point *point, pm_trade_groups *best)
{
    for (int s = 0; s < point->setting_count; s++) {
        pm_trade_groups some = values_of(trade, point->setting[s].option);
        if (some.count > 1 && (best->option == NULL || some.count < best->count)) {
            *best = some;
        }
    }
}

pm_status pm_trade_group(const pm_trade *trade, pm_trade_groups *groups)
{
    pm_trade_groups best = {.count = 1};
    for (int i = 0; i < trade->point_count; i++) {
        choose(trade, &trade->point[i], &best);
    }
    best.group = calloc((size_t)trade->point_count, sizeof *best.group);
    if (best.group == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %d points", trade->point_count);
    }
    for (int i = 0; i < trade->point_count && best.option != NULL; i++) {
        const char *value = value_at(trade, i, best.option);
        while (strcmp(best.value[best.group[i]], value) != 0) {
            best.group[i]++;
        }
    }
    *groups = best;
    return PM_OK;
}

void pm_trade_groups_free(pm_trade_groups *groups)
{
    free(groups->group);
    *groups = (pm_trade_groups){0};
}

static bool differs(const pm_trade *trade, const char *option)
{
    for (int i = 1; i < trade->pareto_count; i++) {
        if (strcmp(value_at(trade, trade->pareto[i], option),
                   value_at(trade, trade->pareto[0], option)) != 0) {
            return true;
        }
    }
    return false;
}

/// 200000 as 200k.
static void shorten(const char *value, char *text, size_t room)
{
    size_t length = strlen(value);
    bool thousands = length > 4 && strspn(value, "0123456789") == length &&
                     strcmp(value + length - 3, "000") == 0;
    snprintf(text, room, "%.*s%s", (int)(thousands ? length - 3 : length), value,
             thousands ? "k" : "");
}

/// Adds a part after a comma; false when it does not fit.
static bool add_part(char *text, size_t room, const char *option, const char *value)
{
    char part[2 * PM_TRADE_WORD + 8];
    char shortened[PM_TRADE_WORD];
    size_t used = strlen(text);
    shorten(value, shortened, sizeof shortened);
    snprintf(part, sizeof part, "%s%s %s", used > 0 ? ", " : "", option, shortened);
    if (used + strlen(part) + sizeof "..." > room) {
        snprintf(text + used, room - used, "...");
        return false;
    }
    snprintf(text + used, room - used, "%s", part);
    return true;
}

void pm_trade_name(const pm_trade *trade, int point, char *text, size_t room)
{
    const pm_trade_point *p = &trade->point[point];
    snprintf(text, room, "%s", p->name);
    bool fits = p->name[0] == '\0';
    for (int s = 0; s < p->setting_count && fits; s++) {
        if (differs(trade, p->setting[s].option)) {
            fits = add_part(text, room, p->setting[s].option, p->setting[s].value);
        }
    }
    if (text[0] == '\0') {
        snprintf(text, room, "all settings alike");
    }
}
