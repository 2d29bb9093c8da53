// Several blanks count as one.
#include "wrap.h"

#include <string.h>

void pm_wrap_print(const char *text, int indent, FILE *stream)
{
    int column = indent;
    for (const char *at = text; *at != '\0';) {
        int span = (int)strcspn(at, " ");
        if (column > indent && column + 1 + span > PM_WRAP_COLUMNS) {
            fprintf(stream, "\n%*s", indent, "");
            column = indent;
        } else if (column > indent) {
            fputc(' ', stream);
            column++;
        }
        fprintf(stream, "%.*s", span, at);
        column += span;
        at += span;
        at += strspn(at, " ");
    }
    fputc('\n', stream);
}
