// How results are told: lines for people, TAP and JSON for programs. The last line counts.
#include "runner.h"

#include <jansson.h>
#include <string.h>

static const char *const words[] = {
    [PM_VERDICT_NONE] = "none",     [PM_VERDICT_PASSED] = "passed",
    [PM_VERDICT_FAILED] = "failed", [PM_VERDICT_SKIPPED] = "skipped",
    [PM_VERDICT_TODO] = "todo",
};

static size_t count_of(const pm_test_result *results, size_t count, pm_verdict verdict)
{
    size_t found = 0;
    for (size_t i = 0; i < count; ++i) {
        found += results[i].verdict == verdict;
    }
    return found;
}

// `text` line by line, each behind `margin`.
static void print_behind(FILE *out, const char *margin, const char *text)
{
    while (*text) {
        size_t length = strcspn(text, "\n");
        fprintf(out, "%s%.*s\n", margin, (int)length, text);
        text += length + (text[length] == '\n');
    }
}

void pm_report_line(FILE *out, const pm_test_result *result)
{
    static const char *const marks[] = {
        [PM_VERDICT_PASSED] = "ok  ",
        [PM_VERDICT_FAILED] = "FAIL",
        [PM_VERDICT_SKIPPED] = "skip",
        [PM_VERDICT_TODO] = "todo",
    };
    fprintf(out, "%s %-12s %s (%.2f s)\n", marks[result->verdict], result->test->tag,
            result->test->title, result->seconds);
    if (result->verdict == PM_VERDICT_FAILED || result->verdict == PM_VERDICT_TODO) {
        print_behind(out, "     ", result->message);
    }
    if (result->verdict == PM_VERDICT_FAILED) {
        print_behind(out, "     | ", result->output);
    }
}

void pm_report_tap(FILE *out, const pm_test_result *result, size_t number)
{
    bool good = result->verdict == PM_VERDICT_PASSED || result->verdict == PM_VERDICT_SKIPPED;
    fprintf(out, "%s %zu - %s %s", good ? "ok" : "not ok", number, result->test->tag,
            result->test->title);
    if (result->verdict == PM_VERDICT_SKIPPED) {
        fprintf(out, " # skip %s: %s", result->message, result->package);
    } else if (result->verdict == PM_VERDICT_TODO) {
        fprintf(out, " # todo %s", result->message);
    }
    fputc('\n', out);
    if (result->verdict == PM_VERDICT_FAILED) {
        print_behind(out, "# ", result->message);
        print_behind(out, "# | ", result->output);
    }
}

static void list_skips(FILE *out, const pm_test_result *results, size_t count,
                       const char *margin)
{
    for (size_t i = 0; i < count; ++i) {
        if (results[i].verdict == PM_VERDICT_SKIPPED) {
            fprintf(out, "%sskipped: %s %s: %s; install %s\n", margin, results[i].test->tag,
                    results[i].test->title, results[i].message, results[i].package);
        }
    }
}

void pm_report_closing(FILE *out, const pm_test_result *results, size_t count, bool tap)
{
    const char *margin = tap ? "# " : "";
    size_t todo = count_of(results, count, PM_VERDICT_TODO);
    size_t skipped = count_of(results, count, PM_VERDICT_SKIPPED);
    list_skips(out, results, count, margin);
    fprintf(out, "%s%zu passed, %zu failed", margin,
            count_of(results, count, PM_VERDICT_PASSED),
            count_of(results, count, PM_VERDICT_FAILED));
    if (todo) {
        fprintf(out, ", %zu todo", todo);
    }
    if (skipped) {
        fprintf(out, ", %zu skipped", skipped);
    }
    fputc('\n', out);
}

// A text that is not UTF-8 (a test may print anything) is replaced as a whole.
static json_t *text_of(const char *text)
{
    json_t *value = json_string(text);
    return value ? value : json_string("(not UTF-8)");
}

static json_t *describe(const pm_test_result *result)
{
    json_t *about = json_object();
    json_object_set_new(about, "tag", text_of(result->test->tag));
    json_object_set_new(about, "title", text_of(result->test->title));
    json_object_set_new(about, "file", text_of(result->file));
    json_object_set_new(about, "result", text_of(words[result->verdict]));
    json_object_set_new(about, "seconds", json_real(result->seconds));
    json_object_set_new(about, "message", text_of(result->message));
    json_object_set_new(about, "package", text_of(result->package));
    json_object_set_new(about, "output", text_of(result->output));
    return about;
}

bool pm_report_json(const char *path, const pm_test_result *results, size_t count)
{
    json_t *all = json_object();
    json_t *tests = json_array();
    for (pm_verdict v = PM_VERDICT_PASSED; v <= PM_VERDICT_TODO; ++v) {
        json_int_t found = (json_int_t)count_of(results, count, v);
        json_object_set_new(all, words[v], json_integer(found));
    }
    for (size_t i = 0; i < count; ++i) {
        json_array_append_new(tests, describe(&results[i]));
    }
    json_object_set_new(all, "tests", tests);
    bool written = json_dump_file(all, path, JSON_INDENT(1)) == 0;
    json_decref(all);
    return written;
}
