/* Text that grows as it is printed to. A failed allocation is kept and returned by text_take, so that printing needs no
 * checks. Private to src/deck. */
#ifndef DECK_TEXT_H
#define DECK_TEXT_H

#include "base/context.h"

typedef struct text_buffer {
    context *ctx; /* not owned */
    char *data;   /* counted memory; NULL while empty */
    size_t length, capacity;
    floe_status status; /* FLOE_OK until memory is out */
} text_buffer;

void text_print(text_buffer *b, const char *format, ...) FLOE_PRINTF(2, 3);
/* `length` bytes as they are. */
void text_append(text_buffer *b, const char *text, size_t length);
/* Hands the text over (never NULL on success; the caller frees it with memory_free) and empties the buffer. */
floe_status text_take(text_buffer *b, char **out);
void text_free(text_buffer *b);

#endif
