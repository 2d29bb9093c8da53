// The frame around main: the same first and last lines of every program.
#include "program.h"

#include "file.h"
#include "interrupt.h"
#include "outputs.h"
#include "usage.h"

#include <omp.h>
#include <signal.h>
#include <stdio.h>

bool pm_program_start(int argc, char **argv, const pm_options_program *program,
                      pm_options *options, int *code)
{
    pm_status status = pm_options_parse(argc, argv, program, options);
    if (status != PM_OK) {
        *code = pm_program_end(status);
        return false;
    }
    if (options->help) {
        pm_usage_print(program, stdout);
        *code = pm_program_end(PM_OK);
        return false;
    }
    if (options->threads > 0) {
        omp_set_num_threads(options->threads);
    }
    signal(SIGXFSZ, SIG_IGN);
    pm_interrupt_catch();
    status = pm_outputs_check(options, program->name);
    if (status != PM_OK) {
        *code = pm_program_end(status);
        return false;
    }
    return true;
}

int pm_program_end(pm_status status)
{
    if (status == PM_OK && (fflush(stdout) != 0 || ferror(stdout))) {
        status = pm_status_fail(PM_EIO, "standard output: cannot be written");
    }
    if (status != PM_OK) {
        const char *message = pm_status_message();
        fprintf(stderr, "%s\n", message[0] != '\0' ? message : "failed without a message");
    }
    pm_file_abandon_all();
    return pm_status_exit_code(status);
}
