// One option: its name, its range, what it means, and where its value goes. The table of all of
// them is the only list there is: parsing, refusals and --help are made from it.
#ifndef PM_OPTION_H
#define PM_OPTION_H

#include "options.h"

#include <stddef.h>

typedef enum {
    PM_OPTION_FLAG,      // bool
    PM_OPTION_COUNT,     // uint64_t in [least, most]
    PM_OPTION_COUNT32,   // uint32_t in [least, most]
    PM_OPTION_REAL,      // double in [least, most]; finite unless most is INFINITY
    PM_OPTION_POSITIVE,  // as REAL, but above least; "none" is `most` when that is INFINITY
    PM_OPTION_CHOICE,    // int: index into the words
    PM_OPTION_SWITCH,    // bool: the second word is true
    PM_OPTION_WORD,      // const char *: one of the words
    PM_OPTION_TEXT,      // const char *, not empty
    PM_OPTION_POINT,     // pm_vec3
    PM_OPTION_DIRECTION, // pm_vec3, made unit
    PM_OPTION_SIZE,      // int, int: WxH
    PM_OPTION_PART,      // double[4] in [0, 1]: U0,V0,U1,V1, both ascending
    PM_OPTION_DEFINE,    // one more of options->define
    PM_OPTION_MAP,       // one more of options->map
} pm_option_kind;

typedef struct {
    const char *key;  // what programs call it: the name, or a longer one where two share it
    const char *name; // without dashes; one letter: a short option
    pm_option_kind kind;
    size_t at;          // offset in pm_options
    size_t given;       // offset of a bool that says that it was given; 0: none
    double least, most; // of a number
    const char *words; // of a choice: "disc|sphere"; else how the value is written: "N", "FILE"
    const char *does;  // for --help: meaning and unit
    const char *unset; // for --help: the default in words; NULL: its value
} pm_option;

/// The option of this key, or NULL.
const pm_option *pm_option_find(const char *key);

/// Option number `index`, or NULL behind the last.
const pm_option *pm_option_at(int index);

/// Writes the name with its dashes: "-n", "--gather".
void pm_option_spell(const pm_option *option, char *text, size_t room);

/// Reads `text` as the option's value into `options`.
/// @return PM_EINPUT with a line as `--gather must be a whole number from 0 to 1000000, got
/// "x"`
pm_status pm_option_set(const pm_option *option, char *text, pm_options *options);

#endif
