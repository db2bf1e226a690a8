/* Parameter tables: how materials, equations of state, shapes, bases and exact solutions say what they take.
 * The deck reads, checks, defaults, lists and documents from these tables; nobody parses a parameter by hand. */
#ifndef BASE_PARAM_H
#define BASE_PARAM_H

#include <stdbool.h>
#include <stddef.h>

typedef enum param_range {
    PARAM_ANY,         /* any finite number */
    PARAM_POSITIVE,    /* > 0 */
    PARAM_NONNEGATIVE, /* >= 0 */
    PARAM_BETWEEN      /* lo <= x <= hi */
} param_range;

typedef struct param_spec {
    const char *key;  /* name in the deck */
    const char *unit; /* SI unit in udunits2 spelling, "1" if none */
    param_range range;
    double lo, hi;   /* used by PARAM_BETWEEN */
    double fallback; /* default; NAN: required */
    size_t offset;   /* of the first double in the parameter struct */
    int count; /* 1: a number; n > 1: a list of exactly n numbers; -3: a vector of the scene's dimension in double[3] */
    const char *doc; /* one line */
} param_spec;

/* Entries of a table, one line each. `type` is the parameter struct, `field` its double, which has the name of the
 * key. */
#define PAR_ENTRY(type, field, unit_, range_, lo_, hi_, fallback_, count_, doc_)                    \
    {                                                                                               \
        .key = #field, .unit = unit_, .range = range_, .lo = lo_, .hi = hi_, .fallback = fallback_, \
        .offset = offsetof(type, field), .count = count_, .doc = doc_                               \
    }
#define PAR_ANY(type, field, unit, fallback, doc) PAR_ENTRY(type, field, unit, PARAM_ANY, 0.0, 0.0, fallback, 1, doc)
#define PAR_POSITIVE(type, field, unit, fallback, doc) \
    PAR_ENTRY(type, field, unit, PARAM_POSITIVE, 0.0, 0.0, fallback, 1, doc)
#define PAR_NONNEGATIVE(type, field, unit, fallback, doc) \
    PAR_ENTRY(type, field, unit, PARAM_NONNEGATIVE, 0.0, 0.0, fallback, 1, doc)
#define PAR_BETWEEN(type, field, unit, lo, hi, fallback, doc) \
    PAR_ENTRY(type, field, unit, PARAM_BETWEEN, lo, hi, fallback, 1, doc)
/* A vector of the scene's dimension, in double[3]. */
#define PAR_VECTOR(type, field, unit, range, fallback, doc) \
    PAR_ENTRY(type, field, unit, range, 0.0, 0.0, fallback, -3, doc)

/* true when x is finite and inside the range of the spec. */
bool param_in_range(const param_spec *spec, double x);
/* "a number > 0", "a number from 0 to 0.5": the words of an error message. Writes at most size bytes. */
void param_describe_range(const param_spec *spec, char *text, size_t size);

/* Fills a parameter struct, zeroed by the caller, with the defaults of its table: NAN where a parameter is required. */
void param_fill_defaults(const param_spec *specs, size_t n, void *par);
/* The (first) double of the parameter `key` inside `par`; NULL if there is none of that key. */
double *param_find(const param_spec *specs, size_t n, void *par, const char *key);

#endif
