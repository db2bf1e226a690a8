/* A function of one number by a table. */
#ifndef EXPRESSION_VALUE_TABLE_H
#define EXPRESSION_VALUE_TABLE_H

#include "base/context.h"

#include <stddef.h>

/* Between the entries of a table. */
typedef enum value_table_between {
    TABLE_LINEAR,
    TABLE_SMOOTH, /* cubic, without overshoot (Steffen 1990) */
    TABLE_STEPS   /* the value of the entry before */
} value_table_between;

/* Before the first entry and beyond the last. */
typedef enum value_table_beyond {
    TABLE_CONSTANT, /* the value of the nearest entry */
    TABLE_ZERO,
    TABLE_REPEAT /* from the first to the last, again and again */
} value_table_beyond;

typedef struct value_table value_table;

/* n entries (2 or more), `at` growing. The arrays are copied. Owner: the caller. */
floe_status value_table_create(context *ctx, const double *at, const double *value, size_t n,
                               value_table_between between, value_table_beyond beyond, value_table **out);
void value_table_destroy(context *ctx, value_table **table);
/* Any number of threads may ask at a time. NAN of NAN. */
double value_table_at(const value_table *table, double at);

#endif
