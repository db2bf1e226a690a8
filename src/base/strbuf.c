#include "base/strbuf.h"

#include "base/memory.h"

#include <stdarg.h>
#include <string.h>

void strbuf_init(strbuf *t, context *ctx)
{
    *t = (strbuf){.ctx = ctx};
}

void strbuf_free(strbuf *t)
{
    memory_free(t->ctx, &t->data);
    strbuf_init(t, t->ctx);
}

void strbuf_note(strbuf *t, floe_status status)
{
    if (t->status == FLOE_OK) t->status = status;
}

static bool reserve_bytes(strbuf *t, size_t more)
{
    if (t->status != FLOE_OK) return false;
    const size_t needed = t->length + more + 1;
    if (needed <= t->capacity) return true;
    const size_t capacity = needed + needed / 2 + 256;
    t->status = memory_resize(t->ctx, &t->data, capacity, 1);
    if (t->status == FLOE_OK) t->capacity = capacity;
    return t->status == FLOE_OK;
}

void strbuf_append(strbuf *t, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    const int length = vsnprintf(NULL, 0, format, arguments);
    if (length < 0) {
        t->status = fail(t->ctx, FLOE_INTERNAL, "a text could not be formatted: \"%.200s\"", format);
    } else if (reserve_bytes(t, (size_t)length)) {
        (void)vsnprintf(t->data + t->length, (size_t)length + 1, format, again);
        t->length += (size_t)length;
    }
    va_end(again);
    va_end(arguments);
}

void strbuf_append_bytes(strbuf *t, const char *bytes, size_t length)
{
    if (!reserve_bytes(t, length)) return;
    memcpy(t->data + t->length, bytes, length);
    t->length += length;
    t->data[t->length] = '\0';
}

floe_status strbuf_take(strbuf *t, char **out)
{
    *out = NULL;
    if (reserve_bytes(t, 0)) {
        if (t->length == 0) t->data[0] = '\0';
        *out = t->data;
        t->data = NULL;
    }
    const floe_status status = t->status;
    strbuf_free(t);
    return status;
}

void strbuf_append_xml(strbuf *t, const char *plain)
{
    for (; *plain; plain++) {
        switch (*plain) {
        case '&': strbuf_append(t, "&amp;"); break;
        case '<': strbuf_append(t, "&lt;"); break;
        case '>': strbuf_append(t, "&gt;"); break;
        case '"': strbuf_append(t, "&quot;"); break;
        case '\'': strbuf_append(t, "&apos;"); break;
        default: strbuf_append(t, "%c", (unsigned char)*plain < ' ' ? ' ' : *plain);
        }
    }
}

void strbuf_append_csv(strbuf *t, const char *text)
{
    strbuf_append(t, "\"");
    for (; *text; text++) strbuf_append(t, *text == '"' ? "\"\"" : "%c", (unsigned char)*text < ' ' ? ' ' : *text);
    strbuf_append(t, "\"");
}

const char *strbuf_string(const strbuf *t)
{
    return t->data ? t->data : "";
}
