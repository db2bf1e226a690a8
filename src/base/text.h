/* Texts of a fixed size, written piece by piece. */
#ifndef BASE_TEXT_H
#define BASE_TEXT_H

#include "base/compiler.h"

#include <stddef.h>

/* Adds behind what `text` holds, of `size` bytes with the NUL; what does not fit is left out. */
void text_add(char *text, size_t size, const char *format, ...) FLOE_PRINTF(3, 4);

#endif
