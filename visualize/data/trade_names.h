// Words for the settings of a trade: only what differs is worth saying.
#ifndef PM_TRADE_NAMES_H
#define PM_TRADE_NAMES_H

#include "trade_file.h"

#include <stddef.h>

#define PM_TRADE_GROUPS_MAX 7 // colours that are told apart

/// Points by the value of one option: group[i] < count is point i's. Free with
/// pm_trade_groups_free().
typedef struct {
    const char *option; // the trade's; NULL: all points are one group
    int count;
    char value[PM_TRADE_GROUPS_MAX][PM_TRADE_WORD]; // ascending where they are numbers
    int *group;
} pm_trade_groups;

/// Groups the points by the option that has the fewest values but more than one, the first of
/// several; by none where each option has one value, or too many.
/// @param groups  [out] untouched unless PM_OK
pm_status pm_trade_group(const pm_trade *trade, pm_trade_groups *groups);
void pm_trade_groups_free(pm_trade_groups *groups);

/// "photons 10k, gather 0": the options in which Pareto points differ, at one of them; its own
/// name, where it has one; "all settings alike" where nothing differs.
/// @param text  [out] at most `room` bytes; what does not fit ends in "..."
void pm_trade_name(const pm_trade *trade, int point, char *text, size_t room);

#endif
