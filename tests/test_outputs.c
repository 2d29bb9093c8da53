// Outputs are tried before the work: a folder that is missing, two options for one file, and an
// output that would overwrite what is read.
#include "command.h"
#include "outputs.h"
#include "test.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

static pm_options good_options(void)
{
    pm_options options = pm_options_defaults();
    static const char *const words[] = {"scenes/furnace.xml"};
    options.positional = words;
    options.positional_count = 1;
    return options;
}

static void accept_and_leave_nothing(void)
{
    pm_options options = good_options();
    CHECK_OK(pm_outputs_check(&options, "demo"));
    options.output = pm_command_write("old.exr", "old");
    char png[512];
    snprintf(png, sizeof png, "%s", pm_command_path("new.png"));
    options.png = png;
    CHECK_OK(pm_outputs_check(&options, "demo"));
    struct stat old;
    CHECK(stat(options.output, &old) == 0 && old.st_size == 3);
    CHECK(pm_command_count_files() == 1);
}

static void refuse_a_missing_folder(void)
{
    pm_options options = good_options();
    options.dump = "no/such/folder/a.csv";
    options.report = "no/such/folder/b.json";
    CHECK_FAILS(pm_outputs_check(&options, "demo"), PM_EIO,
                "no/such/folder/a.csv: cannot be written: No such file or directory\n"
                "no/such/folder/b.json: cannot be written: No such file or directory");
}

static void refuse_twins(void)
{
    char path[512];
    char detour[1024];
    snprintf(path, sizeof path, "%s", pm_command_path("a.exr"));
    snprintf(detour, sizeof detour, "%s/./a.exr", pm_test_folder());
    pm_options options = good_options();
    options.output = path;
    options.png = path;
    CHECK_FAILS(pm_outputs_check(&options, "demo"), PM_EINPUT,
                "would overwrite what -o writes");
    options.png = detour; // the same file by another name, known once it is there
    CHECK_OK(pm_outputs_check(&options, "demo"));
    pm_command_write("a.exr", "old");
    CHECK_FAILS(pm_outputs_check(&options, "demo"), PM_EINPUT,
                "would overwrite what -o writes");
}

static void refuse_what_is_read(void)
{
    pm_options options = good_options();
    options.report = "scenes/../scenes/furnace.xml";
    CHECK_FAILS(pm_outputs_check(&options, "demo"), PM_EINPUT,
                "demo: --report scenes/../scenes/furnace.xml would overwrite what is read");
    options.report = NULL;
    options.map[0] = pm_command_write("map.ply", "photons");
    options.map_count = 1;
    options.output = options.map[0];
    CHECK_FAILS(pm_outputs_check(&options, "demo"), PM_EINPUT, "-o");
}

static void a_checkpoint_is_begun_or_gone_on_with(void)
{
    pm_options options = good_options();
    char path[512];
    snprintf(path, sizeof path, "%s", pm_command_path("a.checkpoint"));
    options.checkpoint = path;
    CHECK_OK(pm_outputs_check(&options, "demo"));
    options.resume = true;
    CHECK_FAILS(pm_outputs_check(&options, "demo"), PM_EINPUT,
                "is not there to resume from: leave out --resume to begin it");
    pm_command_write("a.checkpoint", "sums");
    CHECK_OK(pm_outputs_check(&options, "demo"));
    options.resume = false;
    CHECK_FAILS(pm_outputs_check(&options, "demo"), PM_EINPUT,
                "is there already: --resume goes on from it, or name another");
    options.resume = true;
    options.output = path;
    CHECK_FAILS(pm_outputs_check(&options, "demo"), PM_EINPUT,
                "would overwrite what --checkpoint writes");
    options.output = NULL;
    options.checkpoint = "scenes/furnace.xml";
    CHECK_FAILS(pm_outputs_check(&options, "demo"), PM_EINPUT, "would overwrite what is read");
}

// The picture would take hours: the refusal must come before it.
static void refuse_before_the_work(void)
{
    pm_test_ran ran =
        pm_command_run("render {S} --size 9999x9999 --spp 999 -o {O}",
                       "scenes/cornell-spheres.xml", pm_command_path("no/such/folder/out"));
    pm_command_check_refusal("render into a missing folder", &ran, "no/such/folder/out");
    pm_test_ran_free(&ran);
}

PM_TESTS({"outputs.1", "what can be written is accepted, and nothing is left or touched",
          accept_and_leave_nothing},
         {"outputs.2", "each output in a missing folder is told on its own line",
          refuse_a_missing_folder},
         {"outputs.3", "two options for one file are refused", refuse_twins},
         {"outputs.4", "an output that would overwrite an input is refused",
          refuse_what_is_read},
         {"outputs.5", "a picture of hours into a missing folder is refused at once",
          refuse_before_the_work},
         {"outputs.6", "a checkpoint is begun where none is, and gone on with where one is",
          a_checkpoint_is_begun_or_gone_on_with})
