// Text on a terminal, broken between words.
#ifndef PM_WRAP_H
#define PM_WRAP_H

#include <stdio.h>

#define PM_WRAP_COLUMNS 96

/// Prints words and a line end, breaking lines so that all stand right of column `indent`,
/// where the first is to begin; a word too long for a line has one of its own.
void pm_wrap_print(const char *text, int indent, FILE *stream);

#endif
