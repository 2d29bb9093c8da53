// Whole files or none: what is there after success, failure, and a full disk.
#include "file.h"
#include "test.h"

#include <dirent.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *path_of(const char *name)
{
    static char path[4096];
    snprintf(path, sizeof path, "%s/%s", pm_test_folder(), name);
    return path;
}

// Entries of the test's folder, "." and ".." left out.
static int count_entries(void)
{
    DIR *folder = opendir(pm_test_folder());
    CHECK(folder != NULL);
    int count = 0;
    while (readdir(folder) != NULL) {
        count++;
    }
    closedir(folder);
    return count - 2;
}

static void write_text(const char *path, const char *text)
{
    FILE *stream = fopen(path, "w");
    CHECK(stream != NULL);
    fputs(text, stream);
    CHECK(fclose(stream) == 0);
}

static void check_text(const char *path, const char *want)
{
    char got[256] = "";
    FILE *stream = fopen(path, "r");
    CHECK(stream != NULL);
    size_t length = fread(got, 1, sizeof got - 1, stream);
    fclose(stream);
    got[length] = '\0';
    CHECK_THAT(strcmp(got, want) == 0, "%s holds \"%s\", not \"%s\"", path, got, want);
}

static void appear_on_commit(void)
{
    pm_file file;
    CHECK_OK(pm_file_begin(path_of("a.txt"), &file));
    fputs("hello", file.stream);
    CHECK(access(path_of("a.txt"), F_OK) != 0);
    CHECK_OK(pm_file_commit(&file));
    check_text(path_of("a.txt"), "hello");
    CHECK(count_entries() == 1);
    pm_file_abandon(&file); // fine after a commit
    CHECK_FAILS(pm_file_commit(&file), PM_EINPUT, "not open");
}

static void keep_the_old_when_abandoned(void)
{
    write_text(path_of("a.txt"), "old");
    pm_file file;
    CHECK_OK(pm_file_begin(path_of("a.txt"), &file));
    fputs("new", file.stream);
    pm_file_abandon(&file);
    check_text(path_of("a.txt"), "old");
    CHECK(count_entries() == 1);
}

static void keep_mode_and_links(void)
{
    write_text(path_of("real.txt"), "old");
    CHECK(chmod(path_of("real.txt"), 0640) == 0);
    CHECK(symlink("real.txt", path_of("link.txt")) == 0);
    pm_file file;
    CHECK_OK(pm_file_begin(path_of("link.txt"), &file));
    fputs("new", file.stream);
    CHECK_OK(pm_file_commit(&file));
    struct stat status;
    CHECK(lstat(path_of("link.txt"), &status) == 0 && S_ISLNK(status.st_mode));
    CHECK(stat(path_of("real.txt"), &status) == 0 && (status.st_mode & 0777) == 0640);
    check_text(path_of("real.txt"), "new");
}

static void refuse_what_cannot_be_written(void)
{
    pm_file file = {0};
    CHECK_FAILS(pm_file_begin(pm_test_folder(), &file), PM_EIO, "it is a directory");
    CHECK_FAILS(pm_file_begin(path_of("no/such/folder"), &file), PM_EIO,
                "no/such/folder: cannot be written: No such file or directory");
    CHECK_FAILS(pm_file_begin("", &file), PM_EIO, "its name is empty");
    CHECK_FAILS(pm_file_begin("/dev/null", &file), PM_EIO, "it is not a regular file");
    write_text(path_of("plain"), "");
    CHECK_FAILS(pm_file_begin(path_of("plain/x"), &file), PM_EIO, "Not a directory");
    CHECK(file.stream == NULL && count_entries() == 1);
}

static void refuse_a_folder_without_permission(void)
{
    // By a relative name, so that no folder above decides.
    CHECK(chdir(pm_test_folder()) == 0 && chmod(".", 0555) == 0);
    if (geteuid() == 0) {
        CHECK(setuid(65534) == 0); // root may write anywhere; somebody else tries
    }
    pm_file file;
    CHECK_FAILS(pm_file_begin("a.txt", &file), PM_EIO,
                "a.txt: cannot be written: Permission denied");
}

static void leave_nothing_without_room(void)
{
    write_text(path_of("a.txt"), "old");
    signal(SIGXFSZ, SIG_IGN);
    struct rlimit limit = {10000, 10000};
    CHECK(setrlimit(RLIMIT_FSIZE, &limit) == 0);
    pm_file file;
    CHECK_OK(pm_file_begin(path_of("a.txt"), &file));
    for (int i = 0; i < 20000; i++) {
        fputc('x', file.stream);
    }
    CHECK_FAILS(pm_file_commit(&file), PM_EIO, "a.txt: cannot be written: File too large");
    check_text(path_of("a.txt"), "old");
    CHECK(count_entries() == 1);
}

static void be_removed_all_at_once(void)
{
    pm_file file[3];
    for (int i = 0; i < 3; i++) {
        CHECK_OK(pm_file_begin(path_of("same.txt"), &file[i]));
    }
    CHECK(count_entries() == 3);
    pm_file_abandon_all();
    CHECK(count_entries() == 0);
    CHECK_FAILS(pm_file_commit(&file[0]), PM_EIO, "No such file or directory");
    pm_file_abandon(&file[1]);
    pm_file_abandon(&file[2]);
}

static void be_limited_but_reusable(void)
{
    pm_file file[17] = {0};
    int opened = 0;
    while (opened < 17 && pm_file_begin(path_of("many"), &file[opened]) == PM_OK) {
        opened++;
    }
    CHECK(opened == 16);
    CHECK_CONTAINS(pm_status_message(), "too many files");
    pm_status_clear();
    pm_file_abandon(&file[3]);
    CHECK_OK(pm_file_begin(path_of("many"), &file[3]));
    for (int i = 0; i < 16; i++) {
        pm_file_abandon(&file[i]);
    }
    CHECK(count_entries() == 0);
}

static void sizes_are_told(void)
{
    uint64_t bytes = 0;
    write_text(path_of("five"), "12345");
    CHECK_OK(pm_file_size(path_of("five"), &bytes));
    CHECK(bytes == 5);
    CHECK_FAILS(pm_file_size(path_of("none"), &bytes), PM_EIO, "none: cannot be read: No such");
    CHECK_FAILS(pm_file_size(pm_test_folder(), &bytes), PM_EIO, "it is a directory");
    CHECK_FAILS(pm_file_size("/dev/null", &bytes), PM_EIO, "it is no regular file");
    CHECK(bytes == 5);
}

PM_TESTS({"file.1", "a file appears when it is committed, and not before", appear_on_commit},
         {"file.2", "an abandoned file leaves the old one and no other",
          keep_the_old_when_abandoned},
         {"file.3", "a replaced file keeps its mode, a link stays a link", keep_mode_and_links},
         {"file.4", "a directory, a device, a missing folder and no name are refused",
          refuse_what_cannot_be_written},
         {"file.5", "a folder without permission is refused with its reason",
          refuse_a_folder_without_permission},
         {"file.6", "no room leaves the old file and nothing half written",
          leave_nothing_without_room},
         {"file.7", "a signal handler can remove all unfinished files", be_removed_all_at_once},
         {"file.8", "sixteen files may be open at once, and their places are used again",
          be_limited_but_reusable},
         {"file.9", "the size of what cannot be read is refused with its reason",
          sizes_are_told})
