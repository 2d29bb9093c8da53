// What every `main` does around its work: options, help, threads, SIGINT, the message and the
// exit code.
//
//     int main(int argc, char **argv)
//     {
//         pm_options options;
//         int code;
//         if (!pm_program_start(argc, argv, &program, &options, &code)) {
//             return code;
//         }
//         return pm_program_end(run(&options));
//     }
#ifndef PM_PROGRAM_H
#define PM_PROGRAM_H

#include "options.h"

/// Parses the command line, sets the number of threads, catches SIGINT (interrupt.h), makes a
/// full disk an error instead of a signal, and checks that outputs can be written (outputs.h).
///
/// @param options  [out] valid when true
/// @param code     [out] what main returns when false: --help was printed (0), or the faults
///                 are on standard error (2)
bool pm_program_start(int argc, char **argv, const pm_options_program *program,
                      pm_options *options, int *code);

/// Prints the message of a failed `status` on standard error, removes unfinished files and
/// gives main's exit code. Output that standard output could not take is a failure too.
int pm_program_end(pm_status status);

#endif
