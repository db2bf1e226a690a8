/* Numbers and units of a deck. Private to src/deck; units.c is the only file that sees udunits2. */
#ifndef DECK_UNITS_H
#define DECK_UNITS_H

#include "base/context.h"
#include "expression/expression.h"

#include <stdbool.h>

enum { WHY_SIZE = 200 };

/* Converts *x from unit `from` to unit `to`, of those known to udunits2. false: *why says what is wrong with `from` (size WHY_SIZE). */
bool units_convert(double *x, const char *from, const char *to, char *why);

/* `given` of a unit in SI, with its dimension: expression_unit of formulas. */
bool units_to_si(const char *unit, double given, double *value, expression_dimension *dimension, char *why);

/* Splits "117 GPa" into 117 and "GPa" (*unit points into text, "" when there is none). false: *why says what is wrong.
 * Refused: octal, hexadecimal, nan, inf, underscores, overflow, a unit without a space before it. */
bool number_split(const char *text, double *x, const char **unit, char *why);
/* A whole number without a unit. */
bool number_whole(const char *text, long *x, char *why);

#endif
