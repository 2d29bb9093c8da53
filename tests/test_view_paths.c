// Paths seen: every stretch in the colour of what the photon did before it.
#include "command.h"
#include "path_pick.h"
#include "room.h"
#include "seen.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HEADER "photon,step,event,x,y,z,r,g,b\n"

/// A staircase in front of the back wall: right, down, left, down and right, each 0.4 to 0.6
/// long.
static const char stairs[] = HEADER "3,0,L,4.7,5.4,5,1,1,1\n"
                                    "3,1,D,5.3,5.4,5,1,1,1\n"
                                    "3,2,S,5.3,5.0,5,1,1,1\n"
                                    "3,3,T,4.7,5.0,5,1,1,1\n"
                                    "3,4,V,4.7,4.7,5,1,1,1\n"
                                    "3,5,A,5.3,4.7,5,0,0,0\n";
static const pm_vec3 middles[] = {
    {5.0, 5.4, 5.0}, {5.3, 5.2, 5.0}, {5.0, 5.0, 5.0}, {4.7, 4.85, 5.0}, {5.0, 4.7, 5.0}};
enum { MIDDLES = 5 };

static pm_seen look(const char *text, const char *options)
{
    char line[256];
    snprintf(line, sizeof line, "view paths {S} --scene {O} --size 640x480 %s", options);
    return pm_seen_look(line, pm_command_write("paths.csv", text), pm_room_scene());
}

/// How much a pixel differs from the ground, and how much of that is towards a colour (1: all).
static double towards(const uint8_t *pixel, const uint8_t *ground, const uint8_t colour[3],
                      double *much)
{
    double along = 0.0;
    double length = 0.0;
    double way = 0.0;
    for (int c = 0; c < 3; c++) {
        double off = pixel[c] - ground[c];
        double to = colour[c] - ground[c];
        along += off * to;
        length += off * off;
        way += to * to;
    }
    *much = sqrt(length);
    return length > 0.0 ? along / sqrt(length * way) : 0.0;
}

/// What at a point differs the most from the ground beside it, as towards().
static double seen_at(const pm_seen *s, pm_vec3 at, const uint8_t colour[3], double *much)
{
    int x = 0;
    int y = 0;
    double best = 0.0;
    pm_seen_place(s, 0, at, &x, &y);
    const uint8_t *ground = pm_seen_pixel(s, 0, pm_vec(at.x + 0.1, at.y + 0.1, at.z));
    *much = 0.0;
    for (int j = y - 1; j <= y + 1; j++) {
        for (int i = x - 1; i <= x + 1; i++) {
            double here = 0.0;
            double part = towards(pm_seen_at(s, i, j), ground, colour, &here);
            best = here > *much ? part : best;
            *much = here > *much ? here : *much;
        }
    }
    return best;
}

/// Of `count` colours the one that is nearest to what is seen at each middle is its own.
static void check_middles(const pm_seen *s, const uint8_t colours[][3], int count)
{
    for (int m = 0; m < MIDDLES; m++) {
        double much = 0.0;
        double own = seen_at(s, middles[m], colours[m], &much);
        CHECK_THAT(much > 60.0 && own > 0.97, "stretch %d: %.0f seen, %.3f of it its own", m,
                   much, own);
        for (int c = 0; c < count; c++) {
            CHECK_THAT(c == m || seen_at(s, middles[m], colours[c], &much) < own,
                       "stretch %d has colour number %d", m, c);
        }
    }
}

static void stretches_by_event(void)
{
    // In the order of the stairs: light, diffuse, specular, transmitted, medium; then what is
    // none of these: absorbed and cut.
    static const uint8_t colours[][3] = {{240, 228, 66}, {230, 159, 0}, {86, 180, 233},
                                         {0, 158, 115},  {0, 114, 178}, {204, 121, 167},
                                         {213, 94, 0}};
    pm_seen s = look(stairs, "");
    check_middles(&s, colours, 7);
    int x = 0;
    int y = 0;
    pm_seen_place(&s, 0, pm_vec(5.3, 4.7, 5.0), &x, &y);
    CHECK(pm_seen_near(&s, x, y, 1, colours[5], 30)); // the dot at the end
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "1 of 1 paths drawn");
    pm_seen_free(&s);
}

static void stretches_by_bounce(void)
{
    // Inferno from its bright end downwards; the last is not there yet.
    static const uint8_t colours[][3] = {{252, 255, 164}, {249, 186, 34}, {246, 137, 20},
                                         {225, 88, 55},   {191, 58, 83},  {140, 36, 104}};
    pm_seen s = look(stairs, "--by bounce");
    check_middles(&s, colours, 6);
    pm_seen_free(&s);
}

static void escaped_paths_fade(void)
{
    pm_seen s = look(HEADER "0,0,L,4.6,5.2,5,1,1,1\n0,1,D,4.7,5.2,5,1,1,1\n"
                            "0,2,E,5.4,5.2,5,0,0,0\n",
                     "");
    const uint8_t orange[3] = {230, 159, 0};
    double begin = 0.0;
    double middle = 0.0;
    double end = 0.0;
    CHECK(seen_at(&s, pm_vec(4.78, 5.2, 5.0), orange, &begin) > 0.97);
    CHECK(seen_at(&s, pm_vec(5.05, 5.2, 5.0), orange, &middle) > 0.97);
    seen_at(&s, pm_vec(5.38, 5.2, 5.0), orange, &end);
    CHECK_THAT(begin > 1.3 * middle && middle > 1.3 * end, "%.0f, %.0f, %.0f seen", begin,
               middle, end);
    pm_seen_free(&s);
}

static void picks_are_fair(void)
{
    enum { ALL = 100000, PICKED = 1000 };
    int odd = 0;
    uint64_t before = 0;
    for (uint64_t i = 0; i < PICKED; i++) {
        uint64_t p = pm_path_pick(ALL, PICKED, i);
        CHECK(p / (ALL / PICKED) == i); // every hundredth of the file gives one
        CHECK(i == 0 || p > before);
        before = p;
        odd += (int)(p % 2);
    }
    // Of a fair coin sd is 16: five of them. Even steps would give 0 or 1000.
    CHECK_THAT(abs(odd - PICKED / 2) < 80, "%d of %d are odd", odd, PICKED);
    for (uint64_t i = 0; i < 7; i++) {
        CHECK(pm_path_pick(7, 7, i) == i);
    }
}

static void refuse(const char *options, const char *text, const char *words)
{
    char line[256];
    const char *csv = pm_command_write("paths.csv", text);
    const char *scene = pm_room_scene();
    snprintf(line, sizeof line, "view paths {S} --scene {O} %s", options);
    int before = pm_command_count_files();
    pm_test_ran ran = pm_command_run(line, csv, scene);
    pm_command_check_refusal(line, &ran, words);
    CHECK(pm_command_count_files() == before);
    pm_test_ran_free(&ran);
}

static void other_words_are_refused(void)
{
    char png[512];
    char jpg[512];
    snprintf(png, sizeof png, "-o %s --by light", pm_command_path("a.png"));
    snprintf(jpg, sizeof jpg, "-o %s", pm_command_path("a.jpg"));
    refuse(png, stairs, "--by of paths must be event or bounce");
    refuse(jpg, "no paths at all", "-o must end in .png, .webp");
    png[strlen(png) - strlen(" --by light")] = '\0';
    refuse(png, HEADER "0,0,L,5,5,5,1,1,1\n0,1,R,5,5,5,1,1,1\n",
           "paths.csv:3: event must be one of L D S T V A E C, got \"R\"");
    refuse(png, HEADER "0,0,T,5,5,5,1,1,1\n", "paths.csv:2: a path begins with event L");
}

PM_TESTS({"view_paths.1", "light, mirror, glass, medium and wall have colours of their own",
          stretches_by_event},
         {"view_paths.2", "colours run from bounce to bounce", stretches_by_bounce},
         {"view_paths.3", "the line of an escaped photon fades", escaped_paths_fade},
         {"view_paths.4", "each part of a file gives one path, at no fixed step",
          picks_are_fair},
         {"view_paths.5", "colours that paths do not have, endings and events are refused",
          other_words_are_refused})
