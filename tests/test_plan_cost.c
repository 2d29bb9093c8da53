// A map that is not needed costs nothing: a small edition of the bench (tests/bench/plan).
#include "command.h"
#include "test.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#if defined(__SANITIZE_ADDRESS__)
#define SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SANITIZED 1
#endif
#endif

#ifndef SANITIZED // valgrind does not run sanitized programs
static bool has_valgrind(void)
{
    const char *const argv[] = {"/bin/sh", "-c", "command -v valgrind", NULL};
    pm_test_ran ran = pm_test_run(argv, 10.0);
    bool found = ran.exit_code == 0;
    pm_test_ran_free(&ran);
    return found;
}

static void diffuse_scenes_do_not_pay_for_caustics(void)
{
    if (!has_valgrind()) {
        pm_test_skip("valgrind counts the instructions", "valgrind");
    }
    CHECK_THAT(access(pm_test_program("render-without-caustics"), X_OK) == 0,
               "render-without-caustics was not built: `make bench ONLY=plan` says why");
    char bin[4096];
    snprintf(bin, sizeof bin, "%s", pm_test_program("render"));
    *strrchr(bin, '/') = '\0';
    const char *const argv[] = {
        "tests/bench/plan", pm_test_folder(), bin, "12x12", "500", "4", NULL};
    pm_test_ran ran = pm_test_run(argv, 55.0);
    CHECK_THAT(ran.exit_code == 0, "exit code %d: %s%s", ran.exit_code, ran.out, ran.err);
    CHECK_CONTAINS(ran.out, "kept");
    pm_test_ran_free(&ran);
}
#endif

static void an_edit_without_effect_is_an_error(void)
{
    const char *script = pm_command_write("s.sed", "# takes out b\n/b/d\n/not there/d\n");
    const char *from = pm_command_write("from.c", "a\nb\nc\n");
    const char *const argv[] = {"tests/bench/edit", script, from, pm_command_path("to.c"),
                                NULL};
    pm_test_ran ran = pm_test_run(argv, 10.0);
    CHECK(ran.exit_code == 1);
    CHECK_CONTAINS(ran.err, "changes nothing in");
    CHECK_CONTAINS(ran.err, "/not there/d");
    CHECK(access(pm_command_path("to.c"), F_OK) != 0);
    pm_test_ran_free(&ran);
}

#ifdef SANITIZED
PM_TESTS({"plan_cost.2", "an edit that changes nothing is an error",
          an_edit_without_effect_is_an_error})
#else
PM_TESTS({"plan_cost.1", "a scene without caustics does not pay for their code: below 1 %",
          diffuse_scenes_do_not_pay_for_caustics},
         {"plan_cost.2", "an edit that changes nothing is an error",
          an_edit_without_effect_is_an_error})
#endif
