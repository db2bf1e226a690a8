#include "base/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void text_add(char *text, size_t size, const char *format, ...)
{
    const size_t at = strnlen(text, size);
    va_list arguments;
    if (at == size) return;
    va_start(arguments, format);
    (void)vsnprintf(text + at, size - at, format, arguments);
    va_end(arguments);
}
