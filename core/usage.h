// --help, made from the table of options, so that it cannot differ from what is parsed.
#ifndef PM_USAGE_H
#define PM_USAGE_H

#include "options.h"

#include <stdio.h>

/// Prints what `program` does, its arguments, and every option with its unit and default.
void pm_usage_print(const pm_options_program *program, FILE *stream);

#endif
