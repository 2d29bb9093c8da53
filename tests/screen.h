// An X display of the test's own, and a program's window on it: keys and mouse by xdotool.
// Everything waits for what it needs to see, never for a time. Calls that fail end the running
// test; without Xvfb or xdotool it is skipped.
#ifndef PM_SCREEN_H
#define PM_SCREEN_H

#include <stdbool.h>
#include <sys/types.h>

typedef struct {
    pid_t server, program;
    const char *said; // path of what the program writes on standard output
    const char *complained;
} pm_screen;

/// Starts a display of 1000 x 800, with OpenGL or without, and makes it DISPLAY. Close it with
/// pm_screen_close().
pm_screen pm_screen_open(bool opengl);

/// Starts a view of photons, words as in pm_command_run(), in the test's folder, and waits
/// for its window.
void pm_screen_start(pm_screen *screen, const char *line, const char *s, const char *o);

/// Runs xdotool with these words; %1 is the window.
void pm_screen_do(const char *words);

/// Waits until standard output holds `part`, and returns all of it. free()
char *pm_screen_hear(pm_screen *screen, const char *part);

/// Waits for the program's end and returns its exit code, 128 + signal when it was killed.
int pm_screen_end(pm_screen *screen);

void pm_screen_close(pm_screen *screen);

#endif
