/* What else a name in a deck may mean: words that other programs and text books have for floe's, and keys that stand elsewhere in a deck. Private to
 * src/deck. */
#ifndef DECK_OTHER_NAMES_H
#define DECK_OTHER_NAMES_H

#include "deck/schema/schema.h"

/* The candidate that is called `name` elsewhere, NULL if there is none. *remedy: what to do beside using that name, NULL if nothing. */
const char *other_name(const char *name, const char *(*candidate)(const void *user, size_t i), const void *user,
                       const char **remedy);
/* Where in a deck keys of this name stand: "'cfl' is a key of time", in `text`; "" if there are none, or too many to help. */
void place_of_key(const char *name, char *text, size_t size);

#endif
