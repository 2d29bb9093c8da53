// The server picks a free display by itself and tells its number; the runner kills whatever a
// failed test leaves behind. Without -noreset it would be deaf for a moment whenever its last
// client leaves.
#include "screen.h"

#include "command.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static const double patience = 40.0; // [s]

static void pause_shortly(void)
{
    const struct timespec some = {.tv_nsec = 20000000};
    nanosleep(&some, NULL);
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static bool is_installed(const char *program)
{
    char path[512];
    snprintf(path, sizeof path, "/usr/bin/%s", program);
    return access(path, X_OK) == 0;
}

static pid_t start_server(int told, bool opengl)
{
    char number[16];
    snprintf(number, sizeof number, "%d", told);
    pid_t pid = fork();
    if (pid == 0) {
        freopen("/dev/null", "w", stderr); // it tells every display that it finds taken
        execl("/usr/bin/Xvfb", "Xvfb", "-displayfd", number, "-noreset", "-nolisten", "tcp",
              "-screen", "0", "1000x800x24", opengl ? "+extension" : "-extension", "GLX",
              (char *)NULL);
        _exit(127);
    }
    CHECK(pid > 0);
    return pid;
}

/// The number that the server writes when it is ready.
static void read_display(int told, char *display, size_t room)
{
    size_t used = (size_t)snprintf(display, room, ":");
    while (used + 1 < room && read(told, display + used, 1) == 1 && display[used] != '\n') {
        used++;
    }
    display[used] = '\0';
    CHECK_THAT(used > 1, "Xvfb did not start");
}

pm_screen pm_screen_open(bool opengl)
{
    if (!is_installed("Xvfb")) {
        pm_test_skip("Xvfb is missing", "xvfb");
    }
    if (!is_installed("xdotool")) {
        pm_test_skip("xdotool is missing", "xdotool");
    }
    int ends[2];
    char display[32];
    CHECK(pipe(ends) == 0);
    fcntl(ends[0], F_SETFD, FD_CLOEXEC);
    pm_screen screen = {.server = start_server(ends[1], opengl)};
    close(ends[1]);
    read_display(ends[0], display, sizeof display);
    close(ends[0]);
    setenv("DISPLAY", display, 1);
    screen.said = pm_command_path("said.txt");
    screen.complained = pm_command_path("complained.txt");
    return screen;
}

static pm_test_ran run_xdotool(const char *words)
{
    static char copy[512];
    const char *argv[32] = {"/usr/bin/xdotool"};
    int count = 1;
    snprintf(copy, sizeof copy, "%s", words);
    for (char *word = strtok(copy, " "); word != NULL; word = strtok(NULL, " ")) {
        CHECK(count < 31);
        argv[count++] = word;
    }
    return pm_test_run(argv, patience);
}

static char *read_all(const char *path)
{
    const size_t room = 65536;
    char *text = calloc(1, room);
    CHECK(text != NULL);
    FILE *file = fopen(path, "rb");
    if (file != NULL) {
        size_t got = fread(text, 1, room - 1, file);
        text[got] = '\0';
        fclose(file);
    }
    return text;
}

/// Ends the test when the program has ended without being told to.
static void check_alive(pm_screen *screen, double since, const char *what)
{
    int status;
    bool dead = waitpid(screen->program, &status, WNOHANG) == screen->program;
    if (dead || now() - since > patience) {
        char *err = read_all(screen->complained);
        pm_test_fail(__FILE__, __LINE__, "%s: the program %s; it said: %s", what,
                     dead ? "has ended" : "does not answer", err);
    }
}

/// Its window gets a name when it is ready for keys.
static bool has_window(void)
{
    pm_test_ran ran = run_xdotool("search --onlyvisible --name ^Photon.map:");
    bool found = ran.exit_code == 0 && ran.out[0] != '\0';
    pm_test_ran_free(&ran);
    return found;
}

void pm_screen_start(pm_screen *screen, const char *line, const char *s, const char *o)
{
    screen->program = pm_command_start(line, s, o, screen->said, screen->complained);
    double since = now();
    while (!has_window()) {
        check_alive(screen, since, "no window");
        pause_shortly();
    }
}

void pm_screen_do(const char *words)
{
    char whole[512];
    snprintf(whole, sizeof whole, "search --onlyvisible --name ^Photon.map: %s", words);
    pm_test_ran ran = run_xdotool(whole);
    CHECK_THAT(ran.exit_code == 0, "xdotool %s: %s", words, ran.err);
    pm_test_ran_free(&ran);
}

char *pm_screen_hear(pm_screen *screen, const char *part)
{
    double since = now();
    for (;;) {
        char *text = read_all(screen->said);
        if (strstr(text, part) != NULL) {
            return text;
        }
        if (now() - since > 0.5 * patience) {
            pm_test_fail(__FILE__, __LINE__, "\"%s\" is not told; what was told: %s", part,
                         text);
        }
        free(text);
        check_alive(screen, since, part);
        pause_shortly();
    }
}

int pm_screen_end(pm_screen *screen)
{
    int status = 0;
    pid_t ended;
    double since = now();
    while ((ended = waitpid(screen->program, &status, WNOHANG)) == 0) {
        CHECK_THAT(now() - since < patience, "the window is not closed");
        pause_shortly();
    }
    CHECK(ended == screen->program);
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

void pm_screen_close(pm_screen *screen)
{
    kill(screen->server, SIGTERM);
    while (waitpid(screen->server, NULL, 0) < 0 && errno == EINTR) {
    }
    *screen = (pm_screen){0};
}
