// The test runner: `run [options] [FILTER...]` runs the tests of all linked test files.
//
// Each test has a process of its own, several run side by side, and results are told in the
// order of the tables. A filter is the beginning of a tag or a part of a title.
#include "runner.h"

#include <errno.h>
#include <getopt.h>
#include <signal.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { MAX_TABLES = 256, MAX_JOBS = 256 };
static const double usual_limit = 60.0; // [s]

static struct {
    const char *file;
    const pm_test *tests;
    size_t count;
} tables[MAX_TABLES];
static size_t table_count;

void pm_test_register(const char *file, const pm_test *table, size_t count)
{
    if (table_count == MAX_TABLES) {
        fprintf(stderr, "%s: more than %d test files\n", file, MAX_TABLES);
        exit(2);
    }
    tables[table_count].file = file;
    tables[table_count].tests = table;
    tables[table_count].count = count;
    ++table_count;
}

typedef struct {
    bool tap, list, strict;
    const char *json;
    size_t jobs;
    double limit;        // [s] of a test that asks for none; others are scaled alike
    const char *without; // beginnings of tags, separated by blanks
    char **filters;
    size_t filter_count;
} options;

typedef struct {
    pm_test_result *results;
    size_t count, started, told;
    pm_test_process running[MAX_JOBS];
    char root[256];
} session;

static void usage(FILE *out)
{
    fputs(
        "usage: run [--tap] [--json FILE] [--jobs N] [--limit SEC] [--without TAGS] [--list]\n"
        "           [FILTER...]\n"
        "  FILTER       the beginning of a test's tag, or a part of its title\n"
        "  --tap        results in TAP\n"
        "  --json FILE  results as JSON in FILE as well\n"
        "  --jobs N     tests that run side by side (default: one per core)\n"
        "  --limit SEC  time limit of one test (default 60)\n"
        "  --without \"A B\"  leaves out tests whose tag begins so\n"
        "  --list       name the tests and run none\n"
        "STRICT=1 in the environment makes a skipped test a failure.\n",
        out);
}

static double positive_number(const char *text)
{
    char *end = NULL;
    double number = strtod(text, &end);
    if (end == text || *end || !(number > 0.0 && number < 1e9)) {
        fprintf(stderr, "run: a number above 0 is needed, got \"%s\"\n", text);
        exit(2);
    }
    return number;
}

static size_t job_count(double wanted)
{
    size_t jobs = wanted >= 1.0 ? (size_t)wanted : 1;
    return jobs < MAX_JOBS ? jobs : MAX_JOBS;
}

static options read_options(int argc, char **argv)
{
    static const struct option known[] = {
        {"tap", no_argument, NULL, 't'},           {"json", required_argument, NULL, 'o'},
        {"jobs", required_argument, NULL, 'j'},    {"limit", required_argument, NULL, 'l'},
        {"without", required_argument, NULL, 'w'}, {"list", no_argument, NULL, 'n'},
        {"help", no_argument, NULL, 'h'},          {NULL, 0, NULL, 0}};
    const char *strict = getenv("STRICT");
    options o = {.limit = usual_limit, .strict = strict && strcmp(strict, "1") == 0};
    o.jobs = job_count((double)sysconf(_SC_NPROCESSORS_ONLN));
    for (int c = 0; (c = getopt_long(argc, argv, "", known, NULL)) != -1;) {
        switch (c) {
        case 't':
            o.tap = true;
            break;
        case 'o':
            o.json = optarg;
            break;
        case 'j':
            o.jobs = job_count(positive_number(optarg));
            break;
        case 'l':
            o.limit = positive_number(optarg);
            break;
        case 'w':
            o.without = optarg;
            break;
        case 'n':
            o.list = true;
            break;
        case 'h':
            usage(stdout);
            exit(0);
        default:
            usage(stderr);
            exit(2);
        }
    }
    o.filters = argv + optind;
    o.filter_count = (size_t)(argc - optind);
    return o;
}

static bool left_out(const options *o, const pm_test *test)
{
    const char *word = o->without == NULL ? "" : o->without;
    for (size_t length; *(word += strspn(word, " ")) != '\0'; word += length) {
        length = strcspn(word, " ");
        if (strncmp(test->tag, word, length) == 0) {
            return true;
        }
    }
    return false;
}

static bool wanted(const options *o, const pm_test *test)
{
    if (left_out(o, test)) {
        return false;
    }
    bool found = o->filter_count == 0;
    for (size_t i = 0; i < o->filter_count; ++i) {
        const char *filter = o->filters[i];
        found |= strncmp(test->tag, filter, strlen(filter)) == 0;
        found |= strstr(test->title, filter) != NULL;
    }
    return found;
}

static void choose_tests(session *s, const options *o)
{
    size_t room = 1;
    for (size_t t = 0; t < table_count; ++t) {
        room += tables[t].count;
    }
    s->results = calloc(room, sizeof *s->results);
    if (!s->results) {
        fputs("run: no memory\n", stderr);
        exit(2);
    }
    for (size_t t = 0; t < table_count; ++t) {
        for (size_t i = 0; i < tables[t].count; ++i) {
            const pm_test *test = &tables[t].tests[i];
            if (wanted(o, test)) {
                s->results[s->count++] = (pm_test_result){.test = test, .file = tables[t].file};
            }
        }
    }
}

static void start_next(session *s, const options *o, pm_test_process *slot)
{
    pm_test_result *result = &s->results[s->started];
    if (!pm_process_start(slot, result, s->root, s->started, o->limit)) {
        result->verdict = PM_VERDICT_FAILED;
        snprintf(result->message, sizeof result->message, "no process: %s", strerror(errno));
    }
    ++s->started;
}

static void be_strict(pm_test_result *result)
{
    char reason[sizeof result->message];
    snprintf(reason, sizeof reason, "%s", result->message);
    snprintf(result->message, sizeof result->message,
             "skipped, which STRICT=1 forbids: %.800s; install %s", reason, result->package);
    result->verdict = PM_VERDICT_FAILED;
}

// Tells every result that is settled and whose predecessors have been told.
static void tell(session *s, const options *o)
{
    for (; s->told < s->started; ++s->told) {
        pm_test_result *result = &s->results[s->told];
        for (size_t i = 0; i < o->jobs; ++i) {
            if (s->running[i].pid && s->running[i].result == result) {
                return;
            }
        }
        if (o->strict && result->verdict == PM_VERDICT_SKIPPED) {
            be_strict(result);
        }
        if (o->tap) {
            pm_report_tap(stdout, result, s->told + 1);
        } else {
            pm_report_line(stdout, result);
        }
        fflush(stdout);
    }
}

static void reap(session *s, const options *o, double scale)
{
    int status = 0;
    for (pid_t pid = 0; (pid = waitpid(-1, &status, WNOHANG)) > 0;) {
        for (size_t i = 0; i < o->jobs; ++i) {
            if (s->running[i].pid == pid) {
                pm_process_finish(&s->running[i], status, scale);
            }
        }
    }
}

// One turn: start what there is room for, look after what runs. Returns whether any runs.
static bool turn(session *s, const options *o)
{
    double scale = o->limit / usual_limit;
    bool busy = false;
    reap(s, o, scale);
    for (size_t i = 0; i < o->jobs; ++i) {
        pm_test_process *slot = &s->running[i];
        if (!slot->pid && s->started < s->count) {
            start_next(s, o, slot);
        }
        if (slot->pid) {
            pm_process_watch(slot, scale);
            busy = true;
        }
    }
    tell(s, o);
    return busy || s->told < s->count;
}

static void stop(session *s, const options *o, int number)
{
    for (size_t i = 0; i < o->jobs; ++i) {
        if (s->running[i].pid) {
            kill(-s->running[i].pid, SIGKILL);
        }
    }
    pm_folder_remove(s->root);
    fprintf(stderr, "run: stopped by signal %d after %zu of %zu tests\n", number, s->told,
            s->count);
    exit(128 + number);
}

// Signals are waited for, never handled, so nothing here runs at an odd moment.
static void run_all(session *s, const options *o)
{
    sigset_t awaited;
    sigemptyset(&awaited);
    sigaddset(&awaited, SIGCHLD);
    sigaddset(&awaited, SIGINT);
    sigaddset(&awaited, SIGTERM);
    sigprocmask(SIG_BLOCK, &awaited, NULL);
    while (turn(s, o)) {
        const struct timespec moment = {.tv_nsec = 20000000};
        int number = sigtimedwait(&awaited, NULL, &moment);
        if (number == SIGINT || number == SIGTERM) {
            stop(s, o, number);
        }
    }
}

static void make_root(session *s)
{
    const char *base = getenv("TMPDIR");
    snprintf(s->root, sizeof s->root, "%s/photonlab-test-XXXXXX", base ? base : "/tmp");
    if (!mkdtemp(s->root)) {
        fprintf(stderr, "run: cannot make a folder %s: %s\n", s->root, strerror(errno));
        exit(2);
    }
}

static bool all_good(const session *s)
{
    for (size_t i = 0; i < s->count; ++i) {
        pm_verdict verdict = s->results[i].verdict;
        if (verdict != PM_VERDICT_PASSED && verdict != PM_VERDICT_SKIPPED) {
            return false;
        }
    }
    return true;
}

int main(int argc, char **argv)
{
    static session s;
    options o = read_options(argc, argv);
    choose_tests(&s, &o);
    if (s.count == 0) {
        fputs("run: no test has such a tag or title; --list names them\n", stderr);
        return 2;
    }
    for (size_t i = 0; o.list && i < s.count; ++i) {
        printf("%-12s %s\n", s.results[i].test->tag, s.results[i].test->title);
    }
    if (!o.list) {
        if (o.tap) {
            printf("TAP version 13\n1..%zu\n", s.count);
        }
        make_root(&s);
        run_all(&s, &o);
        pm_folder_remove(s.root);
        pm_report_closing(stdout, s.results, s.count, o.tap);
    }
    int exit_code = o.list || all_good(&s) ? 0 : 1;
    if (o.json && !pm_report_json(o.json, s.results, s.count)) {
        fprintf(stderr, "run: cannot write %s\n", o.json);
        exit_code = 2;
    }
    free(s.results);
    return exit_code;
}
