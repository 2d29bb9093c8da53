// Memory that is taken piece by piece and freed all at once: what a scene points to.
#ifndef PM_ARENA_H
#define PM_ARENA_H

#include <stddef.h>

/// Zero-initialised it is valid and empty.
typedef struct {
    struct pm_arena_block *blocks; // newest first
} pm_arena;

/// Room for `count` items of `size` bytes, zeroed, aligned for any type, valid until
/// pm_arena_free(). NULL when there is no memory or the product overflows.
void *pm_arena_take(pm_arena *arena, size_t count, size_t size);

/// A copy of the first `length` bytes of `text`, zero-terminated; NULL when there is no memory.
char *pm_arena_copy(pm_arena *arena, const char *text, size_t length);

/// Text as printf makes it; NULL when there is no memory.
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
char *
pm_arena_print(pm_arena *arena, const char *format, ...);

/// Frees everything; the arena is empty and usable again.
void pm_arena_free(pm_arena *arena);

#endif
