// strtod() does the arithmetic; what it takes beyond plain decimal numbers (hexadecimal, inf,
// nan, a tail that is no number) is refused here.
#include "number.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BLANKS " \t\r\n"

static const char *check(const char *text, const char *end, double number)
{
    if (!isfinite(number)) {
        return "is not a finite number";
    }
    if (end == text || memchr(text, 'x', (size_t)(end - text)) != NULL ||
        memchr(text, 'X', (size_t)(end - text)) != NULL) {
        return "is not a number";
    }
    if (end[strspn(end, BLANKS)] != '\0') {
        return "has something behind the number";
    }
    return number == 0.0 && errno == ERANGE ? "is too small for a double" : NULL;
}

const char *pm_number_read(const char *text, double *value)
{
    text += strspn(text, BLANKS);
    char *end;
    errno = 0;
    double number = strtod(text, &end);
    const char *wrong = check(text, end, number);
    if (wrong == NULL) {
        *value = number;
    }
    return wrong;
}

const char *pm_number_list(const char *text, double *values, int room, int *count)
{
    int found = 0;
    text += strspn(text, BLANKS);
    while (*text != '\0') {
        char token[64];
        size_t length = strcspn(text, BLANKS ",");
        if (length == 0 || length >= sizeof token) {
            return "is not a list of numbers";
        }
        memcpy(token, text, length);
        token[length] = '\0';
        double number;
        const char *wrong = pm_number_read(token, &number);
        if (wrong != NULL) {
            return wrong;
        }
        if (found < room) {
            values[found] = number;
        }
        found++;
        text += length;
        text += strspn(text, BLANKS);
        if (*text == ',') {
            text++;
            text += strspn(text, BLANKS);
        }
    }
    *count = found;
    return NULL;
}
