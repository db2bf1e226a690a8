/* A text that grows. Once an append has failed, the rest do nothing and `status` says why. */
#ifndef BASE_STRBUF_H
#define BASE_STRBUF_H

#include "base/context.h"

typedef struct strbuf {
    context *ctx;       /* not owned */
    char *data;         /* counted memory, owned; NULL while empty */
    size_t length;      /* characters, without the NUL */
    size_t capacity;    /* bytes */
    floe_status status; /* FLOE_OK, or why the first failed append failed */
} strbuf;

/* An empty text. */
void strbuf_init(strbuf *t, context *ctx);
void strbuf_free(strbuf *t);
/* Takes note of a failure of what goes into it, as of its own. */
void strbuf_note(strbuf *t, floe_status status);
void strbuf_append(strbuf *t, const char *format, ...) FLOE_PRINTF(2, 3);
/* `length` bytes as they are. */
void strbuf_append_bytes(strbuf *t, const char *bytes, size_t length);
/* Hands the text over (never NULL on success; the caller frees it with memory_free) and empties the buffer. */
floe_status strbuf_take(strbuf *t, char **out);
/* Appends with the five characters that XML reserves replaced by their entities, control characters by blanks. */
void strbuf_append_xml(strbuf *t, const char *plain);
/* Appends a field of CSV, in quotes, those inside doubled; control characters become blanks. */
void strbuf_append_csv(strbuf *t, const char *text);
/* The content, "" while empty. */
const char *strbuf_string(const strbuf *t);

#endif
