// A command is a list of words; placeholders are replaced word by word, so paths may hold
// blanks.
#include "command.h"

#include <dirent.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAX_WORDS = 40, MAX_WORD = 1200, MAX_PATHS = 64 };
static const double patience = 50.0; // [s]

// `word` with its first `mark` replaced.
static void replace(char *word, const char *mark, const char *text)
{
    char *place = strstr(word, mark);
    if (place) {
        char rest[MAX_WORD];
        snprintf(rest, sizeof rest, "%s%s", text, place + strlen(mark));
        snprintf(place, MAX_WORD - (size_t)(place - word), "%s", rest);
    }
}

typedef struct {
    char words[MAX_WORDS][MAX_WORD];
    const char *argv[MAX_WORDS + 1];
    int count;
} command;

static void add_word(command *made, const char *word, int length)
{
    CHECK(made->count < MAX_WORDS);
    char *copy = made->words[made->count];
    snprintf(copy, MAX_WORD, "%.*s", length, word);
    made->argv[made->count++] = copy;
}

static void add_line(command *made, const char *line, const char *scene, const char *output)
{
    int first = made->count;
    for (const char *at = line; *at; at += strspn(at, " ")) {
        int length = (int)strcspn(at, " ");
        add_word(made, at, length);
        replace(made->words[made->count - 1], "{S}", scene ? scene : "");
        replace(made->words[made->count - 1], "{O}", output ? output : "");
        at += length;
    }
    made->argv[first] = pm_test_program(made->words[first]);
}

pm_test_ran pm_command_run(const char *line, const char *scene, const char *output)
{
    static command made;
    made = (command){.count = 0};
    add_line(&made, line, scene, output);
    return pm_test_run(made.argv, patience);
}

pid_t pm_command_start(const char *line, const char *scene, const char *output, const char *out,
                       const char *err)
{
    static command made;
    made = (command){.count = 0};
    add_line(&made, line, scene, output);
    pid_t pid = fork();
    if (pid == 0) {
        bool ready = freopen(out, "wb", stdout) && freopen(err, "wb", stderr) &&
                     chdir(pm_test_folder()) == 0;
        if (ready) {
            execv(made.argv[0], (char *const *)(uintptr_t)made.argv);
        }
        _exit(127);
    }
    CHECK(pid > 0);
    return pid;
}

pm_test_ran pm_command_interrupt(const char *line, const char *scene, const char *output,
                                 double seconds)
{
    static const char *const before[] = {"/usr/bin/timeout", "--foreground",
                                         "--preserve-status", "-sINT"};
    static command made;
    made = (command){.count = 0};
    char delay[32];
    snprintf(delay, sizeof delay, "%g", seconds);
    for (size_t i = 0; i < sizeof before / sizeof before[0]; ++i) {
        add_word(&made, before[i], MAX_WORD - 1);
    }
    add_word(&made, delay, MAX_WORD - 1);
    add_line(&made, line, scene, output);
    return pm_test_run(made.argv, patience);
}

const char *pm_command_path(const char *name)
{
    static char paths[MAX_PATHS][MAX_WORD];
    static int used;
    char *path = paths[used++ % MAX_PATHS];
    snprintf(path, MAX_WORD, "%s/%s", pm_test_folder(), name);
    return path;
}

const char *pm_command_write(const char *name, const char *text)
{
    const char *path = pm_command_path(name);
    FILE *file = fopen(path, "wb");
    CHECK_THAT(file && fputs(text, file) >= 0 && fclose(file) == 0, "cannot write %s", path);
    return path;
}

int pm_command_count_files(void)
{
    int count = 0;
    DIR *folder = opendir(pm_test_folder());
    CHECK(folder != NULL);
    for (const struct dirent *entry = NULL; (entry = readdir(folder)) != NULL;) {
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    }
    closedir(folder);
    return count;
}

void pm_command_check_refusal(const char *line, const pm_test_ran *ran, const char *words)
{
    CHECK_THAT(ran->exit_code == 2, "%s: exit code %d, want 2; it said: %s", line,
               ran->exit_code, ran->err);
    CHECK_THAT(ran->out[0] == '\0', "%s: prints on standard output: %s", line, ran->out);
    CHECK_THAT(strstr(ran->err, words) != NULL, "%s: \"%s\" is not in: %s", line, words,
               ran->err);
    size_t length = strlen(ran->err);
    CHECK_THAT(length > 0 && ran->err[length - 1] == '\n', "%s: no line: %s", line, ran->err);
}
