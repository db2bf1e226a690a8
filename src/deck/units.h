/* Numbers and units of a deck. Private to src/deck; units.c is the only file that sees udunits2. */
#ifndef DECK_UNITS_H
#define DECK_UNITS_H

#include "base/context.h"

#include <stdbool.h>

enum { WHY_SIZE = 200 };

/* Units known to udunits2; opened at the first number that carries a unit, for it reads files. {0} is closed. */
typedef struct unit_book {
    void *system;
} unit_book;

/* Converts *x from unit `from` to unit `to`. false: *why says what is wrong with `from` (size WHY_SIZE). */
bool units_convert(unit_book *book, double *x, const char *from, const char *to, char *why);
void units_close(unit_book *book);

/* Splits "117 GPa" into 117 and "GPa" (*unit points into text, "" when there is none). false: *why says what is wrong.
 * Refused: octal, hexadecimal, nan, inf, underscores, overflow, a unit without a space before it. */
bool number_split(const char *text, double *x, const char **unit, char *why);
/* A whole number without a unit. */
bool number_whole(const char *text, long *x, char *why);

#endif
