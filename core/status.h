// How a call says that it failed: a code, and one message per thread. The first message since
// the last pm_status_clear() is kept, because later ones are mostly its consequences. Only
// `main` exits; pm_status_exit_code() gives it the number.
#ifndef PM_STATUS_H
#define PM_STATUS_H

typedef enum {
    PM_OK = 0,
    PM_EINPUT,   // the user's input or an argument is wrong
    PM_ENOMEM,   // no memory
    PM_EIO,      // a file cannot be read or written
    PM_ETODO,    // a lab task that is not written yet
    PM_ELIMIT,   // a stated limit was reached
    PM_ESTOPPED, // SIGINT
} pm_status;

/// Records a message that already says where (`scene.xml:12: ...`) and returns `code`.
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
pm_status
pm_status_fail(pm_status code, const char *format, ...);

/// The first message since the last clear in this thread; "" when there is none. It stays valid
/// until this thread's next clear. May hold several lines, one per fault, without a final
/// newline.
const char *pm_status_message(void);

/// Forgets this thread's message.
void pm_status_clear(void);

/// 0 for PM_OK, 130 for PM_ESTOPPED, 2 for everything else.
int pm_status_exit_code(pm_status status);

/// Fails with the source line in front, for faults that are not in a user's file.
#define PM_FAIL(code, ...) PM_FAIL_AT(code, __FILE__, __LINE__, __VA_ARGS__)
#define PM_FAIL_AT(code, file, line, ...) PM_FAIL_TEXT(code, file, line, __VA_ARGS__, "")
#define PM_FAIL_TEXT(code, file, line, format, ...)                                            \
    pm_status_fail(code, "%s:%d: " format "%s", file, line, __VA_ARGS__)

/// Returns from the calling function when `call` fails.
#define PM_TRY(call)                                                                           \
    do {                                                                                       \
        pm_status try_status = (call);                                                         \
        if (try_status != PM_OK) {                                                             \
            return try_status;                                                                 \
        }                                                                                      \
    } while (0)

/// What a lab's stub returns: `return PM_TODO("3b");`
#define PM_TODO(task) pm_status_fail(PM_ETODO, "lab %s: not implemented yet", task)

#endif
