// Contract in the header.
#include "nearest.h"

#include "word.h"

#include <limits.h>
#include <stddef.h>

const char *pm_nearest_word(const char *word, const char *const *words, int count)
{
    const char *nearest = NULL;
    int fewest = INT_MAX;
    for (int i = 0; i < count; i++) {
        int distance = pm_word_distance(word, words[i]);
        if (distance < fewest) {
            fewest = distance;
            nearest = words[i];
        }
    }
    return nearest;
}
