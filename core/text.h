// Text put together line by line in room that its owner knows to be enough.
#ifndef PM_TEXT_H
#define PM_TEXT_H

#include <stddef.h>

typedef struct {
    char *start;
    size_t room;   // bytes at `start`
    size_t length; // of the text so far, without the zero that ends it
} pm_text;

/// Appends as printf does. What does not fit is cut, and `length` is then past the room.
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void
pm_text_put(pm_text *text, const char *format, ...);

#endif
