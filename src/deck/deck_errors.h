/* The errors of a deck, all of them, each with its place, the line, a caret and what was expected. Private to
 * src/deck. */
#ifndef DECK_DECK_ERRORS_H
#define DECK_DECK_ERRORS_H

#include "base/strbuf.h"
#include "deck/deck.h"
#include "deck/tree.h"

enum { ERRORS_SHOWN = 50 };

typedef struct deck_error deck_error;

typedef struct error_list {
    deck_arena *arena;         /* not owned */
    const char *path;          /* of the deck, as the user gave it */
    const char *text;          /* of the deck */
    const deck_overrides *set; /* may be NULL */
    deck_error *first;         /* sorted: the file from top to bottom, then --set in order */
    size_t count;
} error_list;

/* Enters an error. `expected` and `hint` may be NULL or "". Returns FLOE_OK, or FLOE_NO_MEMORY. */
floe_status error_add(error_list *list, deck_location at, const char *expected, const char *hint, const char *format,
                      ...) FLOE_PRINTF(5, 6);
/* The first message, NULL when there is no error. */
const char *error_first(const error_list *list);
/* Prints all errors. */
void errors_print(const error_list *list, strbuf *out);

#endif
