#include "deck/text.h"

#include "base/memory.h"

#include <stdarg.h>
#include <string.h>

enum { TEXT_FIRST = 1024 };

/* Room for `length` more bytes and a zero. */
static bool reserve(text_buffer *b, size_t length)
{
    if (b->status != FLOE_OK) return false;
    const size_t needed = b->length + length + 1;
    if (needed <= b->capacity) return true;
    size_t capacity = b->capacity > 0 ? b->capacity : TEXT_FIRST;
    while (capacity < needed) capacity *= 2;
    b->status = memory_resize(b->ctx, &b->data, capacity, 1);
    if (b->status == FLOE_OK) b->capacity = capacity;
    return b->status == FLOE_OK;
}

void text_append(text_buffer *b, const char *text, size_t length)
{
    if (!reserve(b, length)) return;
    memcpy(b->data + b->length, text, length);
    b->length += length;
    b->data[b->length] = '\0';
}

void text_print(text_buffer *b, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    const int length = vsnprintf(NULL, 0, format, arguments);
    if (length > 0 && reserve(b, (size_t)length)) {
        vsnprintf(b->data + b->length, (size_t)length + 1, format, again);
        b->length += (size_t)length;
    }
    va_end(again);
    va_end(arguments);
}

floe_status text_take(text_buffer *b, char **out)
{
    *out = NULL;
    if (reserve(b, 0)) {
        *out = b->data;
        b->data = NULL;
    }
    const floe_status status = b->status;
    text_free(b);
    return status;
}

void text_free(text_buffer *b)
{
    memory_free(b->ctx, &b->data);
    *b = (text_buffer){.ctx = b->ctx};
}
