// An output is tried by beginning and abandoning it, so what is refused here is just what would
// be refused at the end.
#include "outputs.h"

#include "file.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

typedef struct {
    const char *name; // of the option
    const char *path; // NULL: not given
} output;

enum { OUTPUTS = 10 };

typedef struct {
    const pm_options *options;
    const char *program;
    output outputs[OUTPUTS];
    char faults[2048];
} check;

static bool same_file(const char *a, const char *b)
{
    struct stat status_a;
    struct stat status_b;
    if (strcmp(a, b) == 0) {
        return true;
    }
    return stat(a, &status_a) == 0 && stat(b, &status_b) == 0 &&
           status_a.st_dev == status_b.st_dev && status_a.st_ino == status_b.st_ino;
}

static bool is_read(const pm_options *options, const char *path)
{
    bool read = (options->points != NULL && same_file(path, options->points)) ||
                (options->scene != NULL && same_file(path, options->scene));
    for (int i = 0; i < options->positional_count; i++) {
        read |= same_file(path, options->positional[i]);
    }
    for (int i = 0; i < options->map_count; i++) {
        read |= same_file(path, options->map[i]);
    }
    return read;
}

static const output *find_twin(const check *c, const output *one)
{
    for (const output *other = c->outputs; other < one; other++) {
        if (other->path != NULL && same_file(one->path, other->path)) {
            return other;
        }
    }
    return NULL;
}

static pm_status check_output(const check *c, const output *one)
{
    const output *twin = find_twin(c, one);
    if (is_read(c->options, one->path)) {
        return pm_status_fail(PM_EINPUT, "%s: %s %s would overwrite what is read; name another",
                              c->program, one->name, one->path);
    }
    if (twin != NULL) {
        return pm_status_fail(PM_EINPUT,
                              "%s: %s %s would overwrite what %s writes; name another",
                              c->program, one->name, one->path, twin->name);
    }
    pm_file file;
    PM_TRY(pm_file_begin(one->path, &file));
    pm_file_abandon(&file);
    return PM_OK;
}

/// What was begun is gone on with, not begun anew; and what goes on must be there.
static pm_status check_checkpoint(const check *c)
{
    const char *path = c->options->checkpoint;
    struct stat status;
    bool there = path != NULL && stat(path, &status) == 0;
    if (path == NULL || there == c->options->resume) {
        return PM_OK;
    }
    if (there) {
        return pm_status_fail(PM_EINPUT,
                              "%s: --checkpoint %s is there already: --resume goes on from it, "
                              "or name another",
                              c->program, path);
    }
    return pm_status_fail(PM_EINPUT,
                          "%s: --checkpoint %s is not there to resume from: leave out --resume "
                          "to begin it",
                          c->program, path);
}

static void add_fault(check *c)
{
    size_t used = strlen(c->faults);
    snprintf(c->faults + used, sizeof c->faults - used, "%s%s", used > 0 ? "\n" : "",
             pm_status_message());
    pm_status_clear();
}

pm_status pm_outputs_check(const pm_options *options, const char *program)
{
    check c = {.options = options,
               .program = program,
               .outputs = {{"--checkpoint", options->checkpoint},
                           {"-o", options->output},
                           {"--png", options->png},
                           {"--map", options->difference},
                           {"--dump", options->dump},
                           {"--cells", options->cells},
                           {"--visits", options->visits},
                           {"--gathered", options->gathered},
                           {"--curves", options->curves},
                           {"--report", options->report}}};
    pm_status status = check_checkpoint(&c);
    if (status != PM_OK) {
        add_fault(&c);
    }
    for (int i = 0; i < OUTPUTS; i++) {
        if (c.outputs[i].path != NULL) {
            pm_status one = check_output(&c, &c.outputs[i]);
            if (one != PM_OK) {
                add_fault(&c);
                status = one;
            }
        }
    }
    return status == PM_OK ? PM_OK : pm_status_fail(status, "%s", c.faults);
}
