// Nothing is written past the room, whatever is put.
#include "text.h"

#include <stdarg.h>
#include <stdio.h>

void pm_text_put(pm_text *text, const char *format, ...)
{
    size_t left = text->length < text->room ? text->room - text->length : 0;
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(text->start + (text->room - left), left, format, arguments);
    va_end(arguments);
    text->length += length > 0 ? (size_t)length : 0;
}
