#include "io/text.h"

#include "base/memory.h"

#include <stdarg.h>
#include <string.h>

void text_init(text_buffer *t, context *ctx)
{
    *t = (text_buffer){.ctx = ctx};
}

void text_free(text_buffer *t)
{
    memory_free(t->ctx, &t->data);
    text_init(t, t->ctx);
}

static bool make_room(text_buffer *t, size_t more)
{
    if (t->status != FLOE_OK) return false;
    const size_t needed = t->length + more + 1;
    if (needed <= t->capacity) return true;
    const size_t capacity = needed + needed / 2 + 256;
    t->status = memory_resize(t->ctx, &t->data, capacity, 1);
    if (t->status == FLOE_OK) t->capacity = capacity;
    return t->status == FLOE_OK;
}

void text_append(text_buffer *t, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    if (length < 0) {
        t->status = fail(t->ctx, FLOE_INTERNAL, "a text could not be formatted: \"%.200s\"", format);
        return;
    }
    if (!make_room(t, (size_t)length)) return;
    va_start(arguments, format);
    (void)vsnprintf(t->data + t->length, (size_t)length + 1, format, arguments);
    va_end(arguments);
    t->length += (size_t)length;
}

void text_append_xml(text_buffer *t, const char *plain)
{
    for (; *plain; plain++) {
        switch (*plain) {
        case '&': text_append(t, "&amp;"); break;
        case '<': text_append(t, "&lt;"); break;
        case '>': text_append(t, "&gt;"); break;
        case '"': text_append(t, "&quot;"); break;
        case '\'': text_append(t, "&apos;"); break;
        default: text_append(t, "%c", (unsigned char)*plain < ' ' ? ' ' : *plain);
        }
    }
}

const char *text_string(const text_buffer *t)
{
    return t->data ? t->data : "";
}
