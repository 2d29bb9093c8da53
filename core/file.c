// The names of unfinished files live in a fixed table, because a signal handler may neither
// allocate nor lock: a slot is claimed, filled, and only then marked as live.
#include "file.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define SLOTS 16
#define TRIES 1000

enum { SLOT_FREE, SLOT_CLAIMED, SLOT_LIVE };

typedef struct {
    atomic_int state;
    char name[PATH_MAX];
} slot;

static slot slots[SLOTS]; // a signal handler can reach nothing else

static pm_status refuse(const char *path, const char *why)
{
    return pm_status_fail(PM_EIO, "%s: cannot be written: %s", path, why);
}

static slot *claim_slot(void)
{
    for (int i = 0; i < SLOTS; i++) {
        int expected = SLOT_FREE;
        if (atomic_compare_exchange_strong(&slots[i].state, &expected, SLOT_CLAIMED)) {
            return &slots[i];
        }
    }
    return NULL;
}

static void release_slot(const char *name)
{
    for (int i = 0; i < SLOTS; i++) {
        if (slots[i].name == name) {
            atomic_store(&slots[i].state, SLOT_FREE);
        }
    }
}

// Where a rename would do harm (a folder, a device) or undo a protection, it is refused.
static pm_status check_target(const char *path, mode_t *mode)
{
    struct stat status;
    *mode = 0;
    if (path[0] == '\0') {
        return refuse("output", "its name is empty");
    }
    if (stat(path, &status) != 0) {
        return PM_OK;
    }
    if (S_ISDIR(status.st_mode)) {
        return refuse(path, "it is a directory");
    }
    if (!S_ISREG(status.st_mode)) {
        return refuse(path, "it is not a regular file");
    }
    if (access(path, W_OK) != 0) {
        return refuse(path, strerror(errno));
    }
    *mode = status.st_mode & 07777;
    return PM_OK;
}

// Creates a file of a new name in the folder of `target`. Its descriptor, or -1 with errno.
static int create_beside(const char *target, char name[PATH_MAX])
{
    const char *slash = strrchr(target, '/');
    int folder = slash == NULL ? 0 : (int)(slash - target) + 1;
    for (int i = 0; i < TRIES; i++) {
        int length = snprintf(name, PATH_MAX, "%.*s.photonlab-%ld-%d", folder, target,
                              (long)getpid(), i);
        if (length >= PATH_MAX) {
            errno = ENAMETOOLONG;
            return -1;
        }
        int handle = open(name, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (handle >= 0 || errno != EEXIST) {
            return handle;
        }
    }
    return -1;
}

static pm_status open_temporary(const char *target, mode_t mode, slot *claimed, pm_file *file)
{
    int handle = create_beside(target, claimed->name);
    if (handle < 0) {
        return refuse(target, strerror(errno));
    }
    atomic_store(&claimed->state, SLOT_LIVE);
    if (mode != 0) {
        (void)fchmod(handle, mode); // keeping the old mode is a courtesy, not a promise
    }
    file->stream = fdopen(handle, "w+b");
    if (file->stream == NULL) {
        pm_status status = refuse(target, strerror(errno));
        close(handle);
        unlink(claimed->name);
        return status;
    }
    file->temporary = claimed->name;
    return PM_OK;
}

pm_status pm_file_begin(const char *path, pm_file *file)
{
    mode_t mode;
    PM_TRY(check_target(path, &mode));
    // A link stays a link: what it points at is replaced.
    char *target = realpath(path, NULL);
    if (target == NULL) {
        target = strdup(path);
    }
    if (target == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for a path");
    }
    slot *claimed = claim_slot();
    if (claimed == NULL) {
        free(target);
        return refuse(path, "too many files are being written");
    }
    pm_file begun = {.path = target};
    pm_status status = open_temporary(target, mode, claimed, &begun);
    if (status != PM_OK) {
        atomic_store(&claimed->state, SLOT_FREE);
        free(target);
        return status;
    }
    *file = begun;
    return PM_OK;
}

static void forget(pm_file *file)
{
    release_slot(file->temporary);
    free(file->path);
    *file = (pm_file){0};
}

pm_status pm_file_commit(pm_file *file)
{
    if (file->stream == NULL) {
        return PM_FAIL(PM_EINPUT, "the file is not open");
    }
    errno = 0;
    bool written = fflush(file->stream) == 0 && !ferror(file->stream);
    int why = errno;
    if (fclose(file->stream) != 0 && written) {
        written = false;
        why = errno;
    }
    if (written && rename(file->temporary, file->path) != 0) {
        written = false;
        why = errno;
    }
    pm_status status = PM_OK;
    if (!written) {
        unlink(file->temporary);
        status = refuse(file->path, why != 0 ? strerror(why) : "an earlier write failed");
    }
    forget(file);
    return status;
}

void pm_file_abandon(pm_file *file)
{
    if (file->stream == NULL) {
        return;
    }
    fclose(file->stream);
    unlink(file->temporary);
    forget(file);
}

void pm_file_abandon_all(void)
{
    for (int i = 0; i < SLOTS; i++) {
        if (atomic_load(&slots[i].state) == SLOT_LIVE) {
            unlink(slots[i].name);
        }
    }
}

pm_status pm_file_size(const char *path, uint64_t *bytes)
{
    struct stat status;
    if (stat(path, &status) != 0) {
        return pm_status_fail(PM_EIO, "%s: cannot be read: %s", path, strerror(errno));
    }
    if (!S_ISREG(status.st_mode)) {
        return pm_status_fail(PM_EIO, "%s: cannot be read: it is %s", path,
                              S_ISDIR(status.st_mode) ? "a directory" : "no regular file");
    }
    if (access(path, R_OK) != 0) {
        return pm_status_fail(PM_EIO, "%s: cannot be read: %s", path, strerror(errno));
    }
    *bytes = (uint64_t)status.st_size;
    return PM_OK;
}
