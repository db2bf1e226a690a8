/* Numbers that are given by formulas of place and time: "1 atm + 10 kPa * exp(-(x / 5 cm)^2)". */
#ifndef EXPRESSION_EXPRESSION_H
#define EXPRESSION_EXPRESSION_H

#include "base/context.h"
#include "expression/value_table.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct expression expression;

enum { EXPRESSION_WHY = 200 /* characters of what is wrong with a formula */, EXPRESSION_BASES = 8 };

/* Exponents of the base units; unknown: it may stand for anything. */
typedef struct expression_dimension {
    bool known;
    signed char power[EXPRESSION_BASES];
} expression_dimension;

/* A number with a name. */
typedef struct expression_constant {
    char name[64];
    double value; /* SI */
    expression_dimension dimension;
} expression_constant;

/* A function with a name, given by a table. */
typedef struct expression_function {
    char name[64];
    const value_table *curve; /* NULL: it has no value */
} expression_function;

/* `given` of a unit in SI (*value), and its dimension. false: *why (EXPRESSION_WHY) says what is wrong with the unit. */
typedef bool expression_unit(const char *unit, double given, double *value, expression_dimension *dimension, char *why);

/* What a formula may name beside the functions of floe. All pointers must outlive the expression. */
typedef struct expression_scope {
    const char *axis[3]; /* names of the coordinates, "x" or "r" first; NULL: none */
    const expression_constant *constant;
    size_t n_constants;
    const expression_function *function;
    size_t n_functions;
    expression_unit *unit; /* NULL: numbers carry no unit */
} expression_scope;

/* Reads a formula. FLOE_BAD_INPUT: *why says what is wrong and where; it is not entered in the context. `dimension` (may be
 * NULL): of its value; unknown unless a number of the formula carries a unit. Owner: the caller. */
floe_status expression_create(context *ctx, const char *text, const expression_scope *scope, expression **out,
                              expression_dimension *dimension, char why[EXPRESSION_WHY]);
void expression_destroy(context *ctx, expression **e);
/* Its value at x (m, as many coordinates as the scope has axes) and t (s); NAN or infinite where it has none. Any number
 * of threads may ask at a time. */
double expression_value(const expression *e, const double x[3], double t);
/* Whether its value depends on position, or on time. */
bool expression_has_place(const expression *e);
bool expression_has_time(const expression *e);
/* As it was written. */
const char *expression_text(const expression *e);
/* The i-th function of floe, with its arguments and what it gives; false at the end. */
bool expression_describe(size_t i, const char **form, const char **doc);

#endif
