// Optimal string alignment distance, three rows at a time.
#include "word.h"

#include <string.h>

#define LONGEST 63

static int least(int a, int b)
{
    return a < b ? a : b;
}

int pm_word_distance(const char *a, const char *b)
{
    size_t rows = strlen(a);
    size_t columns = strlen(b);
    if (rows > LONGEST || columns > LONGEST) {
        return strcmp(a, b) == 0 ? 0 : (int)(rows > columns ? rows : columns);
    }
    int line[3][LONGEST + 1];
    for (size_t j = 0; j <= columns; j++) {
        line[0][j] = (int)j;
    }
    for (size_t i = 1; i <= rows; i++) {
        int *now = line[i % 3];
        const int *up = line[(i + 2) % 3];
        const int *above = line[(i + 1) % 3];
        now[0] = (int)i;
        for (size_t j = 1; j <= columns; j++) {
            int replaced = up[j - 1] + (a[i - 1] != b[j - 1]);
            now[j] = least(replaced, least(up[j], now[j - 1]) + 1);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                now[j] = least(now[j], above[j - 2] + 1);
            }
        }
    }
    return line[rows % 3][columns];
}

bool pm_word_listed(const char *word, const char *list, char separator)
{
    size_t length = strlen(word);
    const char *at = list;
    while (at != NULL) {
        const char *end = strchr(at, separator);
        size_t span = end == NULL ? strlen(at) : (size_t)(end - at);
        if (span == length && memcmp(at, word, length) == 0) {
            return true;
        }
        at = end == NULL ? NULL : end + 1;
    }
    return false;
}
