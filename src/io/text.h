/* A text that grows. Once an append has failed, the rest do nothing and text_status says why. */
#ifndef IO_TEXT_H
#define IO_TEXT_H

#include "base/context.h"

typedef struct text_buffer {
    context *ctx;       /* not owned */
    char *data;         /* counted memory, owned; NULL while empty */
    size_t length;      /* characters, without the NUL */
    size_t capacity;    /* bytes */
    floe_status status; /* FLOE_OK, or why the first failed append failed */
} text_buffer;

/* An empty text. */
void text_init(text_buffer *t, context *ctx);
void text_free(text_buffer *t);
void text_append(text_buffer *t, const char *format, ...) FLOE_PRINTF(2, 3);
/* Appends with the five characters that XML reserves replaced by their entities, control characters by blanks. */
void text_append_xml(text_buffer *t, const char *plain);
/* The content, "" while empty. */
const char *text_string(const text_buffer *t);

#endif
