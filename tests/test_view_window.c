// Windows and pictures on an X display: one of the test's own, without a screen.
#include "command.h"
#include "room.h"
#include "screen.h"
#include "seen.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LINE "view photons {S} --scene {O} --size 640x480 "

/// Front and back of the room, far from its middle.
static const pm_vec3 places[] = {{5.05, 5.0, 5.45}, {4.95, 5.15, 4.55}};

static const char *map(void)
{
    return pm_room_map("map.ply", places, 2, pm_rgb(1.0, 0.0, 0.0), true);
}

static void check_refusal(const char *option, const char *display, const char *part)
{
    char line[256];
    snprintf(line, sizeof line, LINE "-o %s %s", pm_command_path("none.png"), option);
    unsetenv("DISPLAY");
    if (display != NULL) {
        setenv("DISPLAY", display, 1);
    }
    int before = pm_command_count_files();
    pm_test_ran ran = pm_command_run(line, "map.ply", "scene.xml");
    pm_command_check_refusal(line, &ran, part);
    CHECK_THAT(strchr(ran.err, '\n') == ran.err + strlen(ran.err) - 1, "not one line: %s",
               ran.err);
    CHECK(pm_command_count_files() == before);
    pm_test_ran_free(&ran);
}

static void no_display_is_told(void)
{
    check_refusal("--interactive", NULL,
                  "--interactive needs an X display, and DISPLAY is not set; -o FILE draws "
                  "without one");
    check_refusal("--interactive", ":7654", "and no display answers at \":7654\"; -o FILE");
    check_refusal("--display x", NULL, "--display x needs an X display, and DISPLAY is not");
    check_refusal("--display x", "nonsense", "no display answers at \"nonsense\"");
    pm_screen flat = pm_screen_open(false);
    char name[32];
    snprintf(name, sizeof name, "%s", getenv("DISPLAY"));
    check_refusal("--interactive", name, "needs an X display with OpenGL, and \"");
    check_refusal("--display x", name, "has no GLX; without --display pictures need none");
    pm_screen_close(&flat);
    check_refusal("--interactive --json", NULL, "--json and --interactive cannot be together");
}

/// Drawn by other ways through Mesa, a rounding may go the other way; here none did.
static void check_alike(const pm_seen *a, const pm_seen *b)
{
    CHECK(a->width == b->width && a->height == b->height);
    int differ = 0;
    for (int i = 0; i < 3 * a->width * a->height; i++) {
        differ += abs(a->pixels[i] - b->pixels[i]) > 8;
    }
    CHECK_THAT(differ <= a->width * a->height / 500, "%d of %d values differ by more than 8",
               differ, 3 * a->width * a->height);
}

static void display_makes_no_difference(void)
{
    const char *file = map();
    const char *scene = pm_room_scene();
    pm_seen without = pm_seen_look(LINE, file, scene);
    pm_screen screen = pm_screen_open(true);
    char line[256];
    snprintf(line, sizeof line, LINE "--display x -o %s", pm_command_path("x.png"));
    pm_test_ran ran = pm_command_run(line, file, scene);
    CHECK_THAT(ran.exit_code == 0 && ran.err[0] == '\0', "exit %d: %s", ran.exit_code, ran.err);
    pm_seen on_x = pm_seen_read(pm_command_path("x.png"));
    check_alike(&without, &on_x);
    pm_test_ran_free(&ran);
    pm_screen_close(&screen);
    pm_seen_free(&without);
    pm_seen_free(&on_x);
}

/// The mean x of pure red pixels in the upper (back photon) or lower part of a picture.
static double red_at(const pm_seen *s, int y0, int y1)
{
    double sum = 0.0;
    int count = 0;
    for (int y = y0; y < y1; y++) {
        for (int x = 0; x < s->width; x++) {
            const uint8_t *c = pm_seen_at(s, x, y);
            if (c[0] > 200 && c[1] < 60 && c[2] < 60) {
                sum += x;
                count++;
            }
        }
    }
    CHECK_THAT(count > 0, "no photon is seen between rows %d and %d", y0, y1);
    return sum / count;
}

static pm_seen save(pm_screen *screen, const char *name)
{
    char told[64];
    snprintf(told, sizeof told, "saved %s", name);
    pm_screen_do("mousemove --window %1 320 240 key s");
    free(pm_screen_hear(screen, told));
    return pm_seen_read(pm_command_path(name));
}

static void end_by_key(pm_screen *screen, const char *key)
{
    char words[64];
    snprintf(words, sizeof words, "mousemove --window %%1 320 240 key %s", key);
    pm_screen_do(words);
    int code = pm_screen_end(screen);
    CHECK_THAT(code == 0, "%s: exit code %d", key, code);
}

static void drag_turns_the_scene(void)
{
    const char *file = map();
    const char *scene = pm_room_scene();
    pm_seen still = pm_seen_look(LINE, file, scene);
    int x;
    int middle;
    pm_seen_place(&still, 0, pm_vec(5.0, 5.08, 5.0), &x, &middle);
    pm_screen screen = pm_screen_open(true);
    pm_command_write("view-001.png", "not ours\n");
    pm_screen_start(&screen, LINE "--interactive", file, scene);
    pm_seen first = save(&screen, "view-002.png");
    check_alike(&still, &first);
    pm_screen_do("mousemove --window %1 200 240 mousedown 1 mousemove --window %1 215 240 "
                 "mousemove --window %1 230 240 mouseup 1");
    pm_seen turned = save(&screen, "view-003.png");
    CHECK(red_at(&turned, middle, 480) > red_at(&first, middle, 480) + 4.0); // front
    CHECK(red_at(&turned, 70, middle) < red_at(&first, 70, middle) - 4.0);   // back
    pm_screen_do("key r");
    pm_seen again = save(&screen, "view-004.png");
    CHECK(memcmp(first.pixels, again.pixels, 3 * 640 * 480) == 0);
    end_by_key(&screen, "q");
    pm_screen_close(&screen);
    pm_seen_free(&still);
    pm_seen_free(&first);
    pm_seen_free(&turned);
    pm_seen_free(&again);
}

static void click_on(const pm_seen *s, pm_vec3 point)
{
    int x;
    int y;
    char words[96];
    pm_seen_place(s, 0, point, &x, &y);
    snprintf(words, sizeof words, "mousemove --window %%1 %d %d click 1", x, y);
    pm_screen_do(words);
}

static void click_tells_what_is_there(void)
{
    const char *file = map();
    const char *scene = pm_room_scene();
    pm_seen still = pm_seen_look(LINE, file, scene);
    pm_screen screen = pm_screen_open(true);
    pm_screen_start(&screen, LINE "--interactive", file, scene);
    for (int i = 0; i < 2; i++) {
        char part[96];
        click_on(&still, places[i]);
        snprintf(part, sizeof part, "at %.5g %.5g %.5g m, power 0.0008", places[i].x,
                 places[i].y, places[i].z);
        free(pm_screen_hear(&screen, part));
    }
    click_on(&still, pm_vec(5.2, 5.25, 4.5));
    char *told = pm_screen_hear(&screen, " --normal 0,0,1");
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
    CHECK_CONTAINS(told, "; radiance ");
    CHECK(sscanf(strstr(told, " --at "), " --at %lf,%lf,%lf", &x, &y, &z) == 3);
    CHECK_NEAR(x, 5.2, 0.003); // a pixel
    CHECK_NEAR(y, 5.25, 0.003);
    CHECK_NEAR(z, 4.5, 1e-9);
    free(told);
    pm_screen_do("mousemove --window %1 2 470 click 1");
    free(pm_screen_hear(&screen, "nothing is here"));
    end_by_key(&screen, "Escape");
    pm_screen_close(&screen);
    pm_seen_free(&still);
}

static void interrupt_closes_the_window(void)
{
    const char *file = map();
    pm_screen screen = pm_screen_open(true);
    pm_screen_start(&screen, LINE "--interactive", file, pm_room_scene());
    kill(screen.program, SIGINT);
    int code = pm_screen_end(&screen);
    CHECK_THAT(code == 130, "exit code %d", code);
    pm_screen_close(&screen);
}

#define SHARES "view shares {S} --size 640x480 --title=Photon_map:_shares "
#define LAMP(id, flux, photons)                                                                \
    "{\"id\": \"" id "\", \"type\": \"point\", \"flux\": [" flux "], \"photons\": " photons "}"

/// The bar at x = 1.19 is 40 % high.
static void resized_chart_tells_its_bars(void)
{
    const char *file = pm_command_write(
        "report.json", "{\"lights\": [" LAMP("a", "3, 3, 3", "30") ", " LAMP(
                           "b", "1, 1, 1", "20") "], \"power_sum\": [4, 4, 4], "
                                                 "\"projection\": {\"cells\": 0, "
                                                 "\"active\": 0}}\n");
    pm_seen still = pm_seen_look(SHARES, file, NULL);
    int x;
    int y;
    char words[96];
    pm_seen_chart(&still, 0, 1.19, 20.0, &x, &y);
    pm_screen screen = pm_screen_open(true);
    pm_screen_start(&screen, SHARES "--interactive", file, NULL);
    pm_screen_do("windowsize --sync %1 960 600");
    pm_seen large = save(&screen, "view-001.png");
    CHECK(large.width == 960 && large.height == 600);
    x = x * 3 / 2;
    y = y * 5 / 4;
    CHECK_COLOUR(pm_seen_at(&large, x, y), 86.0, 180.0, 233.0, 6.0);
    snprintf(words, sizeof words, "mousemove --window %%1 %d %d click 1", x, y);
    pm_screen_do(words);
    char *told = pm_screen_hear(&screen, " 40\n");
    CHECK_CONTAINS(told, ": b, ");
    free(told);
    end_by_key(&screen, "q");
    pm_screen_close(&screen);
    pm_seen_free(&still);
    pm_seen_free(&large);
}

PM_TESTS({"view_window.1", "without a display that answers, a window is refused in one line",
          no_display_is_told},
         {"view_window.2", "pictures drawn on a display are those drawn without one",
          display_makes_no_difference},
         {"view_window.3", "a drag turns the scene, r turns it back, s saves over no file",
          drag_turns_the_scene},
         {"view_window.4", "a click tells the photon or the surface that is there",
          click_tells_what_is_there},
         {"view_window.5", "SIGINT closes the window with exit code 130",
          interrupt_closes_the_window},
         {"view_window.6", "a chart in a window of another size tells its bars",
          resized_chart_tells_its_bars})
