// Near misses between words.
#include "test.h"
#include "word.h"

static void edits_are_counted(void)
{
    CHECK(pm_word_distance("gather", "gather") == 0);
    CHECK(pm_word_distance("gahter", "gather") == 1); // a swap is one edit
    CHECK(pm_word_distance("", "abc") == 3 && pm_word_distance("abc", "") == 3);
    CHECK(pm_word_distance("kitten", "sitting") == 3);
    CHECK(pm_word_distance("spher", "sphere") == 1);
    CHECK(pm_word_listed("k", "n k r", ' ') && !pm_word_listed("k", "kk rk", ' '));
}

PM_TESTS({"word.1", "distances between words count single edits", edits_are_counted})
