// Pixels are found from what a program says of its picture.
#include "seen.h"

#include "command.h"

#include <libpng16/png.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

pm_seen pm_seen_read(const char *path)
{
    pm_seen seen = {0};
    png_image png;
    memset(&png, 0, sizeof png);
    png.version = PNG_IMAGE_VERSION;
    CHECK_THAT(png_image_begin_read_from_file(&png, path) != 0, "%s: %s", path, png.message);
    png.format = PNG_FORMAT_RGB;
    seen.width = (int)png.width;
    seen.height = (int)png.height;
    seen.pixels = malloc(PNG_IMAGE_SIZE(png));
    CHECK(seen.pixels != NULL && png_image_finish_read(&png, NULL, seen.pixels, 0, NULL) != 0);
    return seen;
}

pm_seen pm_seen_look(const char *line, const char *s, const char *o)
{
    char whole[2048];
    unsetenv("DISPLAY");
    snprintf(whole, sizeof whole, "%s --json -o %s", line, pm_command_path("seen.png"));
    pm_test_ran ran = pm_command_run(whole, s, o);
    CHECK_THAT(ran.exit_code == 0, "%s: exit %d: %s", line, ran.exit_code, ran.err);
    CHECK_THAT(ran.err[0] == '\0', "%s says on standard error: %s", line, ran.err);
    pm_seen seen = pm_seen_read(pm_command_path("seen.png"));
    seen.answer = json_loads(ran.out, 0, NULL);
    CHECK_THAT(seen.answer != NULL, "no JSON: %s", ran.out);
    pm_test_ran_free(&ran);
    return seen;
}

void pm_seen_free(pm_seen *seen)
{
    json_decref(seen->answer);
    free(seen->pixels);
    *seen = (pm_seen){0};
}

json_t *pm_seen_member(const pm_seen *seen, const char *key)
{
    char path[128];
    char *rest = NULL;
    json_t *at = seen->answer;
    snprintf(path, sizeof path, "%s", key);
    for (char *word = strtok_r(path, ".", &rest); word != NULL;
         word = strtok_r(NULL, ".", &rest)) {
        at = json_is_array(at) ? json_array_get(at, strtoul(word, NULL, 10))
                               : json_object_get(at, word);
        CHECK_THAT(at != NULL, "the answer has no %s", key);
    }
    return at;
}

double pm_seen_number(const pm_seen *seen, const char *key)
{
    return json_number_value(pm_seen_member(seen, key));
}

const char *pm_seen_text(const pm_seen *seen, const char *key)
{
    return json_string_value(pm_seen_member(seen, key));
}

const uint8_t *pm_seen_at(const pm_seen *seen, int x, int y)
{
    CHECK_THAT(x >= 0 && y >= 0 && x < seen->width && y < seen->height,
               "pixel %d,%d is not in a picture of %dx%d", x, y, seen->width, seen->height);
    return seen->pixels + 3 * ((size_t)y * (size_t)seen->width + (size_t)x);
}

static double part(const json_t *object, const char *key, size_t index)
{
    return json_number_value(json_array_get(json_object_get(object, key), index));
}

static int whole(const json_t *object, const char *key)
{
    return (int)json_integer_value(json_object_get(object, key));
}

static json_t *entry(const pm_seen *seen, const char *list, int index)
{
    char key[64];
    snprintf(key, sizeof key, "%s.%d", list, index);
    return pm_seen_member(seen, key);
}

static double along(const json_t *camera, const char *axis, pm_vec3 to)
{
    return to.x * part(camera, axis, 0) + to.y * part(camera, axis, 1) +
           to.z * part(camera, axis, 2);
}

void pm_seen_place(const pm_seen *seen, int panel, pm_vec3 point, int *x, int *y)
{
    const json_t *p = entry(seen, "panels", panel);
    const json_t *camera = json_object_get(p, "camera");
    pm_vec3 eye = pm_vec(part(camera, "position", 0), part(camera, "position", 1),
                         part(camera, "position", 2));
    pm_vec3 to = pm_vec_sub(point, eye);
    double depth = along(camera, "forward", to);
    double across = along(camera, "right", to) / (depth * part(camera, "tan", 0)) -
                    part(camera, "shift", 0);
    double upward =
        along(camera, "up", to) / (depth * part(camera, "tan", 1)) - part(camera, "shift", 1);
    CHECK_THAT(fabs(across) < 1.0 && fabs(upward) < 1.0,
               "the point is not in the picture: %g, %g", across, upward);
    *x = whole(p, "x") + (int)((1.0 + across) * 0.5 * whole(p, "width"));
    *y = whole(p, "y") + (int)((1.0 - upward) * 0.5 * whole(p, "height"));
}

const uint8_t *pm_seen_pixel(const pm_seen *seen, int panel, pm_vec3 point)
{
    int x = 0;
    int y = 0;
    pm_seen_place(seen, panel, point, &x, &y);
    return pm_seen_at(seen, x, y);
}

/// Where a value stands between an axis' ends, 0 to 1.
static double position(const json_t *chart, const char *ends, const char *log, double value)
{
    double low = part(chart, ends, 0);
    double high = part(chart, ends, 1);
    bool logarithmic = json_is_true(json_object_get(chart, log));
    return logarithmic ? log10(value / low) / log10(high / low) : (value - low) / (high - low);
}

void pm_seen_chart(const pm_seen *seen, int chart, double x, double y, int *px, int *py)
{
    const json_t *c = entry(seen, "charts", chart);
    double across = position(c, "x_ends", "x_log", x);
    double upward = position(c, "y_ends", "y_log", y);
    *px = whole(c, "x") + (int)lround(across * whole(c, "width"));
    *py = whole(c, "y") + (int)lround((1.0 - upward) * whole(c, "height"));
}

const uint8_t *pm_seen_scale(const pm_seen *seen, int scale, double position_on_it)
{
    const json_t *s = entry(seen, "scales", scale);
    int x = whole(s, "x") + whole(s, "width") / 2;
    int inside = whole(s, "height") - 3; // the bar's own ends are half covered
    int y = whole(s, "y") + 1 + (int)lround((1.0 - position_on_it) * inside);
    return pm_seen_at(seen, x, y);
}

static bool alike(const uint8_t *a, const uint8_t *b, int tolerance)
{
    return abs(a[0] - b[0]) <= tolerance && abs(a[1] - b[1]) <= tolerance &&
           abs(a[2] - b[2]) <= tolerance;
}

bool pm_seen_near(const pm_seen *seen, int x, int y, int reach, const uint8_t colour[3],
                  int tolerance)
{
    for (int j = y - reach; j <= y + reach; j++) {
        for (int i = x - reach; i <= x + reach; i++) {
            if (alike(pm_seen_at(seen, i, j), colour, tolerance)) {
                return true;
            }
        }
    }
    return false;
}
