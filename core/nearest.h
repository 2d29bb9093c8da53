// The nearest known word, for messages about words that are not known.
#ifndef PM_NEAREST_H
#define PM_NEAREST_H

/// The word of the table that takes the fewest edits (pm_word_distance) to become `word`; the
/// first of several. NULL when `count` is 0.
const char *pm_nearest_word(const char *word, const char *const *words, int count);

#endif
