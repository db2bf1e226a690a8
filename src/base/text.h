/* Texts of a fixed size, written piece by piece, and names that are near others. */
#ifndef BASE_TEXT_H
#define BASE_TEXT_H

#include "base/compiler.h"

#include <stddef.h>

/* Adds behind what `text` holds, of `size` bytes with the NUL; what does not fit is left out. */
void text_add(char *text, size_t size, const char *format, ...) FLOE_PRINTF(3, 4);

/* The candidate nearest to `name` by edit distance, NULL when none is near enough to be meant. `candidate(user, i)`
 * returns the i-th name, NULL at the end. */
const char *nearest_name(const char *name, const char *(*candidate)(const void *user, size_t i), const void *user);

#endif
