// Every broken file of tests/bad is refused with its message: a line a fault, none for the
// rest.
#include "scene_read.h"
#include "test.h"

#include <stdio.h>
#include <string.h>

static int count_lines(const char *message)
{
    int lines = 1;
    for (const char *c = message; *c != '\0'; c++) {
        lines += *c == '\n';
    }
    return lines;
}

/// The next part of a line of the table, without the " | " behind it; NULL at the end.
static char *next_part(char **rest)
{
    char *part = *rest;
    if (part == NULL) {
        return NULL;
    }
    char *bar = strstr(part, " | ");
    *rest = bar == NULL ? NULL : bar + 3;
    if (bar != NULL) {
        *bar = '\0';
    }
    return part;
}

static void check_row(char *row)
{
    char *who = next_part(&row);
    char *file = next_part(&row);
    char path[200];
    CHECK_THAT(file != NULL, "the table has a line without a file: %s", who);
    CHECK_THAT(strcmp(who, "any") == 0 || strcmp(who, "picture") == 0, "who is %s?", who);
    snprintf(path, sizeof path, "tests/bad/%s", file);
    pm_scene scene = {0};
    pm_status status = pm_scene_read(path, NULL, 0, true, &scene);
    CHECK_THAT(status == PM_EINPUT, "%s is not refused", path);
    for (char *part = next_part(&row); part != NULL; part = next_part(&row)) {
        CHECK_CONTAINS(pm_status_message(), part);
    }
    int lines = strcmp(file, "thirty-faults.xml") == 0 ? 20 : 1;
    CHECK_THAT(count_lines(pm_status_message()) == lines, "%s: not %d lines but %s", path,
               lines, pm_status_message());
    pm_status_clear();
}

static void every_file(void)
{
    FILE *table = fopen("tests/bad/expected.txt", "r");
    CHECK(table != NULL);
    char row[1000];
    int rows = 0;
    while (fgets(row, sizeof row, table) != NULL) {
        row[strcspn(row, "\n")] = '\0';
        if (row[0] != '#') {
            check_row(row);
            rows++;
        }
    }
    fclose(table);
    CHECK_THAT(rows >= 130, "only %d rows were read", rows);
}

static void missing(void)
{
    pm_scene scene = {0};
    CHECK_FAILS(pm_scene_read("tests/bad/nowhere.xml", NULL, 0, false, &scene), PM_EIO,
                "tests/bad/nowhere.xml: cannot be read: No such file");
    CHECK_FAILS(pm_scene_read("tests/bad", NULL, 0, false, &scene), PM_EIO,
                "tests/bad: is a folder");
}

static void camera_on_request(void)
{
    pm_scene scene = {0};
    CHECK_OK(pm_scene_read("tests/bad/no-camera.xml", NULL, 0, false, &scene));
    CHECK(!scene.has_camera);
    pm_scene_free(&scene);
}

static void untouched(void)
{
    pm_scene scene = {.shape_count = 77};
    CHECK_FAILS(pm_scene_read("tests/bad/radius-zero.xml", NULL, 0, false, &scene), PM_EINPUT,
                "radius");
    CHECK(scene.shape_count == 77 && scene.storage == NULL);
}

PM_TESTS({"scene_bad.1", "every broken scene is refused with one line that says where and what",
          every_file},
         {"scene_bad.2", "a scene file that cannot be read is an error of its own", missing},
         {"scene_bad.3", "a camera is needed only by who asks for one", camera_on_request},
         {"scene_bad.4", "a refused scene leaves the caller's scene alone", untouched})
