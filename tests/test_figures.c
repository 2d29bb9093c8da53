// The list of figures and the figures themselves: neither has what the other lacks. Whether
// they still look like what their calls draw is `make check-figures`.
#include "test.h"

#include <glob.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#define LIST "visualize/figures.txt"
#define FIGURE_MOST (100 * 1024)
#define ROWS_MOST 256
#define FIELDS 4

typedef struct {
    char text[1024];
    char *field[FIELDS]; // FILE, what it teaches, call, test; or "data", NAME, call
    int count;
} row;

static char *trim(char *text)
{
    text += strspn(text, " ");
    char *end = text + strlen(text);
    while (end > text && strchr(" \n", end[-1]) != NULL) {
        *--end = '\0';
    }
    return text;
}

static void split(row *r)
{
    char *rest = NULL;
    for (char *part = strtok_r(r->text, "|", &rest); part != NULL;
         part = strtok_r(NULL, "|", &rest)) {
        CHECK_THAT(r->count < FIELDS, "%s: %s has more than %d fields", LIST, r->field[0],
                   FIELDS);
        r->field[r->count++] = trim(part);
    }
}

/// The rows of figures, without those of data.
static int read_list(row *rows)
{
    FILE *file = fopen(LIST, "r");
    int count = 0;
    CHECK(file != NULL);
    while (count < ROWS_MOST && fgets(rows[count].text, sizeof rows[count].text, file)) {
        row *r = &rows[count];
        r->count = 0;
        CHECK_THAT(strchr(r->text, '\n') != NULL, "%s: a line is too long: %s", LIST, r->text);
        if (r->text[0] != '#' && strspn(r->text, " \n") < strlen(r->text)) {
            split(r);
            count += strcmp(r->field[0], "data") != 0;
        }
    }
    fclose(file);
    CHECK(count > 0 && count < ROWS_MOST);
    return count;
}

/// Runs `run --list`; free with pm_test_ran_free().
static pm_test_ran list_tests(void)
{
    const char *argv[] = {"/proc/self/exe", "--list", NULL};
    pm_test_ran ran = pm_test_run(argv, 30.0);
    CHECK(ran.exit_code == 0);
    return ran;
}

/// Whether some test's tag is `tag`, or the name of its suite.
static int has_test(const char *tests, const char *tag)
{
    size_t length = strlen(tag);
    for (const char *line = tests; line != NULL && *line != '\0';) {
        if (strncmp(line, tag, length) == 0 && strchr(" .\n", line[length]) != NULL) {
            return 1;
        }
        line = strchr(line, '\n');
        line = line != NULL ? line + 1 : NULL;
    }
    return 0;
}

static void every_line_is_whole(void)
{
    static row rows[ROWS_MOST];
    pm_test_ran tests = list_tests();
    int count = read_list(rows);
    for (int i = 0; i < count; i++) {
        const row *r = &rows[i];
        struct stat there;
        CHECK_THAT(r->count == FIELDS, "%s: %s has %d fields of %d", LIST, r->field[0],
                   r->count, FIELDS);
        CHECK_THAT(strlen(r->field[1]) > 20, "%s: %s does not say what it teaches", LIST,
                   r->field[0]);
        CHECK_THAT(strchr(r->field[2], '%') != NULL, "%s: the call of %s writes no %%", LIST,
                   r->field[0]);
        CHECK_THAT(has_test(tests.out, r->field[3]), "%s: %s is asserted by no test: \"%s\"",
                   LIST, r->field[0], r->field[3]);
        CHECK_THAT(stat(r->field[0], &there) == 0, "%s: %s is not there", LIST, r->field[0]);
        CHECK_THAT(there.st_size <= FIGURE_MOST, "%s has %lld bytes, at most %d are allowed",
                   r->field[0], (long long)there.st_size, FIGURE_MOST);
    }
    pm_test_ran_free(&tests);
}

static int listed(const row *rows, int count, const char *path)
{
    for (int i = 0; i < count; i++) {
        if (strcmp(rows[i].field[0], path) == 0) {
            return 1;
        }
    }
    return 0;
}

static void every_figure_is_listed(void)
{
    static row rows[ROWS_MOST];
    int count = read_list(rows);
    glob_t found;
    CHECK(glob("labs/*/figures/*", 0, NULL, &found) == 0);
    glob("slides/figures/*", GLOB_APPEND, NULL, &found);
    for (size_t i = 0; i < found.gl_pathc; i++) {
        CHECK_THAT(listed(rows, count, found.gl_pathv[i]),
                   "%s is no line of %s, so nobody can draw it again", found.gl_pathv[i], LIST);
    }
    globfree(&found);
}

static void pictures_of_the_readme_are_figures(void)
{
    static row rows[ROWS_MOST];
    char line[1024];
    int count = read_list(rows);
    int seen = 0;
    FILE *file = fopen("README.md", "r");
    CHECK(file != NULL);
    while (fgets(line, sizeof line, file) != NULL) {
        char path[512];
        const char *image = strstr(line, "![");
        const char *link = image != NULL ? strstr(image, "](") : NULL;
        if (link != NULL && sscanf(link, "](%511[^)])", path) == 1) {
            CHECK_THAT(listed(rows, count, path), "README.md shows %s, which is no line of %s",
                       path, LIST);
            seen++;
        }
    }
    fclose(file);
    CHECK(seen > 0);
}

PM_TESTS({"figures.1", "every figure says what it teaches, and a test asserts it",
          every_line_is_whole},
         {"figures.2", "every figure that is committed can be drawn again",
          every_figure_is_listed},
         {"figures.3", "the README shows only figures of the list",
          pictures_of_the_readme_are_figures})
