// Near misses: which known word somebody meant.
#ifndef PM_WORD_H
#define PM_WORD_H

#include <stdbool.h>

/// Edits (insert, delete, replace, swap of neighbours) that turn `a` into `b`; words of more
/// than 63 letters count as all different.
int pm_word_distance(const char *a, const char *b);

/// Whether `word` is one of those in `list`, which are separated by `separator`.
bool pm_word_listed(const char *word, const char *list, char separator);

#endif
