// The test runner's face: a test is a function, its checks end it at the first failure.
//
//     static void halves(void) { CHECK_NEAR(half(3.0), 1.5, 1e-15); }
//     PM_TESTS({"half", "half of three is one and a half", halves})
//
// Every test runs in a process of its own (runner.c), so it may crash, hang or exit.
#ifndef PM_TEST_H
#define PM_TEST_H

#include "status.h"

#include <stddef.h>

typedef struct {
    const char *tag;   // header and number, or lab task: "store.2", "3b"; filters go by prefix
    const char *title; // a sentence; a failure reads as feedback
    void (*run)(void);
} pm_test;

/// The table of a test file, at its end.
#define PM_TESTS(...)                                                                          \
    static const pm_test test_table[] = {__VA_ARGS__};                                         \
    __attribute__((constructor)) static void test_table_register(void)                         \
    {                                                                                          \
        pm_test_register(__FILE__, test_table, sizeof test_table / sizeof test_table[0]);      \
    }

void pm_test_register(const char *file, const pm_test *table, size_t count);

/// Ends the running test as failed, as skipped (naming the package to install), or as todo.
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4), noreturn))
#endif
void pm_test_fail(const char *file, int line, const char *format, ...);
#if defined(__GNUC__)
__attribute__((noreturn))
#endif
void pm_test_skip(const char *reason, const char *package);

/// At the start of a test that may need longer than 60 s: its own limit, in seconds.
void pm_test_limit(double seconds);

void pm_test_near(const char *file, int line, const char *what, double got, double want,
                  double tolerance);
void pm_test_status(const char *file, int line, const char *what, pm_status got, pm_status want,
                    const char *message_part);
void pm_test_text(const char *file, int line, const char *what, const char *got,
                  const char *part);

#define CHECK(condition)                                                                       \
    do {                                                                                       \
        if (!(condition)) {                                                                    \
            pm_test_fail(__FILE__, __LINE__, "not true: %s", #condition);                      \
        }                                                                                      \
    } while (0)

/// As CHECK, with a message of its own.
#define CHECK_THAT(condition, ...)                                                             \
    do {                                                                                       \
        if (!(condition)) {                                                                    \
            pm_test_fail(__FILE__, __LINE__, __VA_ARGS__);                                     \
        }                                                                                      \
    } while (0)

/// `call` is PM_OK; PM_ETODO ends the test as todo; else the message is shown.
#define CHECK_OK(call) pm_test_status(__FILE__, __LINE__, #call, (call), PM_OK, NULL)

/// `call` fails with `code`, and its message holds `part`. Clears the message.
#define CHECK_FAILS(call, code, part)                                                          \
    pm_test_status(__FILE__, __LINE__, #call, (call), (code), (part))

/// |got - want| <= tolerance; NaN fails. Prints got, want, tolerance.
#define CHECK_NEAR(got, want, tolerance)                                                       \
    pm_test_near(__FILE__, __LINE__, #got, (got), (want), (tolerance))

/// The text `got` contains `part`.
#define CHECK_CONTAINS(got, part) pm_test_text(__FILE__, __LINE__, #got, (got), (part))

/// What a program did.
typedef struct {
    int exit_code; // 128 + signal when it was killed
    char *out;     // standard output, zero-terminated; freed by pm_test_ran_free()
    char *err;
} pm_test_ran;

/// Runs argv (NULL-terminated; argv[0] a path) and waits, at most `seconds`.
pm_test_ran pm_test_run(const char *const *argv, double seconds);
void pm_test_ran_free(pm_test_ran *ran);

/// Path of a program of this build ("render"), valid until the test ends.
const char *pm_test_program(const char *name);

/// An empty folder for this test's files, removed after it.
const char *pm_test_folder(void);

#endif
