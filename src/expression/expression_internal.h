/* What an expression is made of. Private to src/expression. */
#ifndef EXPRESSION_INTERNAL_H
#define EXPRESSION_INTERNAL_H

#include "expression/expression.h"

enum { EXPRESSION_STACK = 48, EXPRESSION_ARGUMENTS = 3 };

/* Where and when a formula is asked. */
typedef struct expression_event {
    const double *x;
    double t;
} expression_event;

/* What a function asks of the dimensions of its arguments, and gives. */
typedef enum dimension_rule {
    RULE_SAME,    /* all alike; of theirs */
    RULE_NUMBERS, /* none have one; none */
    RULE_COMPARE, /* all alike; none */
    RULE_ANY,     /* whatever; none */
    RULE_PRODUCT,
    RULE_QUOTIENT,
    RULE_POWER,
    RULE_ROOT,
    RULE_CHOICE, /* the last two alike; of theirs */
} dimension_rule;

typedef struct expression_call {
    const char *name; /* of a function; the sign of an operator */
    int arguments;
    double (*value)(const double *argument, const expression_event *at);
    dimension_rule rule;
    const char *form, *doc; /* for the reference; NULL: operators */
    bool of_place;          /* it changes with place beside its arguments */
} expression_call;

/* NULL: there is none of this name. */
const expression_call *expression_find_call(const char *name, size_t length);
/* "+", "-", ... ; "negative" and "not" of one argument. */
const expression_call *expression_operator(const char *sign);

typedef enum step_kind { STEP_NUMBER, STEP_COORDINATE, STEP_TIME, STEP_CALL, STEP_TABLE } step_kind;

/* One step of a formula in postfix order: it takes its arguments from a stack, and leaves its value there. */
typedef struct expression_step {
    step_kind kind;
    double number;
    int coordinate;
    const expression_call *call;
    const value_table *curve;
} expression_step;

struct expression {
    char *text;
    expression_step *step;
    size_t n;
    bool has_place, has_time;
};

/* Dimension of what a call gives; false: *why says what does not fit. `exponent`: the value of the last argument where it is
 * a constant, else NAN. */
bool expression_combine(const expression_call *call, const expression_dimension *argument, double exponent,
                        expression_dimension *out, char *why);

#endif
