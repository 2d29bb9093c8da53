// Films of growing paths: files, frames, and where the light has come to in each of them.
#include "command.h"
#include "room.h"
#include "seen.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <webp/demux.h>

#define HEADER "photon,step,event,x,y,z,r,g,b\n"
enum { FRAMES = 5, WIDTH = 320, HEIGHT = 240 };

/// Right by 0.8 and down by 0.8: after half the way the photon is at the corner. The other one
/// ends there.
static const char corner[] = HEADER "0,0,L,4.6,5.4,5,1,1,1\n"
                                    "0,1,D,5.4,5.4,5,1,1,1\n"
                                    "0,2,A,5.4,4.6,5,0,0,0\n"
                                    "1,0,L,4.6,5.0,5,1,1,1\n"
                                    "1,1,A,5.0,5.0,5,0,0,0\n";

static pm_test_ran run(const char *options, const char *text, const char *name)
{
    char line[512];
    const char *scene = pm_room_scene();
    snprintf(line, sizeof line, "view growth {S} --scene %s --size %dx%d -o {O} %s", scene,
             WIDTH, HEIGHT, options);
    return pm_command_run(line, pm_command_write("paths.csv", text), pm_command_path(name));
}

/// The frames' PNGs, with what --json says of all of them.
static void shoot(const char *options, pm_seen frames[FRAMES])
{
    char line[128];
    snprintf(line, sizeof line, "--frames %d --json %s", FRAMES, options);
    pm_test_ran ran = run(line, corner, "film.webp");
    CHECK_THAT(ran.exit_code == 0 && ran.err[0] == '\0', "exit %d: %s", ran.exit_code, ran.err);
    for (int i = 0; i < FRAMES; i++) {
        char name[32];
        snprintf(name, sizeof name, "film.%03d.png", i + 1);
        frames[i] = pm_seen_read(pm_command_path(name));
        CHECK(frames[i].width == WIDTH && frames[i].height == HEIGHT);
        frames[i].answer = json_loads(ran.out, 0, NULL);
        CHECK_THAT(frames[i].answer != NULL, "no JSON: %s", ran.out);
    }
    pm_test_ran_free(&ran);
}

static void close_frames(pm_seen frames[FRAMES])
{
    for (int i = 0; i < FRAMES; i++) {
        pm_seen_free(&frames[i]);
    }
}

/// The brightest red around a point: yellow, orange and white have much of it, the room little.
static int red_at(const pm_seen *s, pm_vec3 at)
{
    int x = 0;
    int y = 0;
    int most = 0;
    pm_seen_place(s, 0, at, &x, &y);
    for (int j = y - 1; j <= y + 1; j++) {
        for (int i = x - 1; i <= x + 1; i++) {
            int red = pm_seen_at(s, i, j)[0];
            most = red > most ? red : most;
        }
    }
    return most;
}

static bool has_head(const pm_seen *s, pm_vec3 at)
{
    static const uint8_t white[3] = {245, 245, 245};
    int x = 0;
    int y = 0;
    pm_seen_place(s, 0, at, &x, &y);
    return pm_seen_near(s, x, y, 1, white, 12);
}

static void photons_fly_equally_fast(void)
{
    // Where the first photon is in each frame, and the second before it ends.
    static const pm_vec3 first[FRAMES] = {
        {4.6, 5.4, 5}, {5.0, 5.4, 5}, {5.4, 5.4, 5}, {5.4, 5.0, 5}, {5.4, 4.6, 5}};
    static const pm_vec3 second = {4.6, 5.0, 5};
    pm_seen frames[FRAMES];
    shoot("", frames);
    CHECK_NEAR(pm_seen_number(&frames[0], "length"), 1.6, 1e-9);
    CHECK(pm_seen_number(&frames[0], "frames") == FRAMES);
    for (int i = 0; i < FRAMES; i++) {
        for (int j = 0; j < FRAMES; j++) {
            bool there = i == j && j != FRAMES - 1 && j != 2;
            CHECK_THAT(j == 2 || has_head(&frames[i], first[j]) == there,
                       "frame %d: %s head at place %d", i + 1, there ? "no" : "a", j + 1);
        }
        CHECK(has_head(&frames[i], second) == (i == 0));
    }
    close_frames(frames);
}

static void paths_grow_from_start_to_whole(void)
{
    // Middles of the three stretches, and the frame from which on they are seen.
    static const pm_vec3 middle[] = {
        {4.8, 5.4, 5}, {5.2, 5.4, 5}, {5.4, 5.1, 5}, {5.4, 4.7, 5}, {4.8, 5.0, 5}};
    static const int from[] = {1, 2, 3, 4, 1};
    pm_seen frames[FRAMES];
    shoot("", frames);
    for (int i = 0; i < FRAMES; i++) {
        for (size_t m = 0; m < sizeof from / sizeof from[0]; m++) {
            int red = red_at(&frames[i], middle[m]);
            CHECK_THAT((red > 100) == (i >= from[m]), "frame %d: red %d at middle %zu", i + 1,
                       red, m);
        }
    }
    static const uint8_t purple[3] = {204, 121, 167};
    int x = 0;
    int y = 0;
    pm_seen_place(&frames[4], 0, pm_vec(5.4, 4.6, 5), &x, &y);
    CHECK(pm_seen_near(&frames[4], x, y, 1, purple, 60));
    CHECK(!pm_seen_near(&frames[3], x, y, 1, purple, 60));
    close_frames(frames);
}

static uint8_t *read_file(const char *path, size_t *size)
{
    enum { MOST = 1 << 20 };
    uint8_t *bytes = malloc(MOST);
    FILE *file = fopen(path, "rb");
    CHECK(bytes != NULL && file != NULL);
    *size = fread(bytes, 1, MOST, file);
    CHECK(*size < MOST);
    fclose(file);
    return bytes;
}

/// Mean difference of a channel, frame (RGBA) against picture (RGB).
static double difference(const uint8_t *frame, const pm_seen *picture)
{
    double sum = 0.0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        for (int c = 0; c < 3; c++) {
            sum += abs(frame[4 * i + c] - picture->pixels[3 * i + c]);
        }
    }
    return sum / (3.0 * WIDTH * HEIGHT);
}

static void film_is_its_frames(void)
{
    pm_seen frames[FRAMES];
    shoot("--by bounce", frames);
    size_t size = 0;
    uint8_t *bytes = read_file(pm_command_path("film.webp"), &size);
    const WebPData data = {bytes, size};
    WebPAnimDecoder *decoder = WebPAnimDecoderNew(&data, NULL);
    WebPAnimInfo info;
    CHECK(decoder != NULL && WebPAnimDecoderGetInfo(decoder, &info) != 0);
    CHECK(info.frame_count == FRAMES && info.loop_count == 0);
    CHECK(info.canvas_width == WIDTH && info.canvas_height == HEIGHT);
    for (int i = 0; i < FRAMES; i++) {
        uint8_t *frame = NULL;
        int end = 0;
        CHECK(WebPAnimDecoderGetNext(decoder, &frame, &end) != 0);
        for (int j = 0; j < FRAMES; j++) {
            double own = difference(frame, &frames[i]);
            double other = difference(frame, &frames[j]);
            CHECK_THAT(own < 3.0 && (i == j || own < other),
                       "frame %d is %.3f off its PNG, %.3f off number %d", i + 1, own, other,
                       j + 1);
        }
        CHECK(end == (i + 1 < FRAMES ? 100 * (i + 1) : 3400));
    }
    WebPAnimDecoderDelete(decoder);
    free(bytes);
    close_frames(frames);
}

static void check_nothing_made(const char *options, const char *text, const char *name,
                               const char *words)
{
    pm_command_write("paths.csv", text);
    pm_room_scene();
    int before = pm_command_count_files();
    pm_test_ran ran = run(options, text, name);
    pm_command_check_refusal(words, &ran, words);
    CHECK_THAT(pm_command_count_files() == before, "%s: files are left", words);
    pm_test_ran_free(&ran);
}

static void refusals_leave_nothing(void)
{
    check_nothing_made("", HEADER "0,0,L,5,5,5,1,1,1\n0,2,A,5,5,5,0,0,0\n", "a.webp",
                       "paths.csv:3: photon 0 step 2 does not follow");
    check_nothing_made("", corner, "a.png", "-o of a film must end in .webp");
    check_nothing_made("", corner, "a.gif", "-o must end in .png, .webp");
    check_nothing_made("--frames 1", corner, "a.webp",
                       "--frames must be a whole number from 2");
    check_nothing_made("--by light", corner, "a.webp",
                       "--by of growth must be event or bounce");
    CHECK(mkdir(pm_command_path("a.003.png"), 0700) == 0);
    check_nothing_made("", corner, "a.webp", "a.003.png: cannot be written: it is a directory");
}

static void interrupted_films_leave_nothing(void)
{
    char line[512];
    const char *scene = pm_room_scene();
    const char *csv = pm_command_write("paths.csv", corner);
    int before = pm_command_count_files();
    snprintf(line, sizeof line, "view growth {S} --scene %s --frames 999 -o {O}", scene);
    pm_test_ran ran = pm_command_interrupt(line, csv, pm_command_path("film.webp"), 0.5);
    CHECK_THAT(ran.exit_code == 130, "exit %d: %s", ran.exit_code, ran.err);
    CHECK(pm_command_count_files() == before);
    pm_test_ran_free(&ran);
}

PM_TESTS({"view_growth.1", "every photon has come equally far, and a bright dot shows where",
          photons_fly_equally_fast},
         {"view_growth.2", "the first frame shows the start alone, the last one whole paths",
          paths_grow_from_start_to_whole},
         {"view_growth.3", "a film has the frames that lie beside it as pictures",
          film_is_its_frames},
         {"view_growth.4", "a refused film leaves no file", refusals_leave_nothing},
         {"view_growth.5", "an interrupted film leaves no file",
          interrupted_films_leave_nothing})
