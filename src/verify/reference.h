/* References of histories: what a scene's history (the path of a mass, the pressure in a membrane, an energy) should
 * be, as a function of time. One file adds one: reference_<name>.c ends in a const descriptor `reference_<name>`, the
 * build lists it in reference_registry, and the conformance battery covers it unasked. Fields over x and t are in
 * verify/exact.h.
 *
 * Conventions as there: SI, stress tension positive, pressure compression positive. */
#ifndef VERIFY_REFERENCE_H
#define VERIFY_REFERENCE_H

#include "base/context.h"
#include "base/param.h"

#include <stdbool.h>

/* A column of the history that a reference gives. The name is the X of `hmax_X`. */
typedef struct reference_quantity {
    const char *name, *unit, *doc;
    const char *rate_of; /* the quantity of which it is the derivative in time; NULL: none */
    bool constant;       /* it does not change in time (a rest state, a total that is conserved) */
} reference_quantity;

/* A named number that is no history: a period, the time of an event, a coefficient. */
typedef struct reference_scalar {
    const char *name, *unit, *doc;
} reference_scalar;

enum { REFERENCE_MAX_QUANTITIES = 12 };

typedef struct reference_model {
    const char *name;     /* in the deck: verify: {reference: string_mass, ...} */
    const char *doc;      /* one line */
    const char *cite;     /* source, with the equation where it has one */
    const char *validity; /* under which conditions it is exact for what floe solves, and its error otherwise */
    size_t param_size;
    const param_spec *params;
    size_t n_params;
    const reference_quantity *quantities;
    size_t n_quantities;             /* at most REFERENCE_MAX_QUANTITIES */
    const reference_scalar *scalars; /* NULL if none */
    size_t n_scalars;
    const void *sample;   /* param_size bytes: a typical case */
    double sample_end;    /* s: the end of a typical history of it */
    size_t prepared_size; /* bytes that prepare() fills, 0: prepare only checks, or is NULL */
    /* Checks the parameters against each other and fills `prepared` (zeroed before). Errors: FLOE_BAD_INPUT with a
     * message. NULL: nothing to do. */
    floe_status (*prepare)(context *ctx, const void *par, void *prepared);
    /* value[q * n + i], quantity q at t[i] (s, ascending, t[0] >= 0); NAN where it does not hold. Errors:
     * FLOE_NO_MEMORY, FLOE_BAD_INPUT where the equations cannot be integrated. */
    floe_status (*series)(context *ctx, const void *par, const void *prepared, size_t n, const double *t,
                          double *value);
    /* The i-th of `scalars`; NULL if there are none. */
    double (*scalar)(const void *par, const void *prepared, size_t i);
} reference_model;

/* All of them, in alphabetical order, made by the build from the file names. */
extern const reference_model *const reference_registry[];
extern const size_t reference_registry_size;
/* NULL if there is none of that name. */
const reference_model *reference_find(const char *name);

/* Index of the quantity of that name, n_quantities if there is none. */
size_t reference_quantity_find(const reference_model *model, const char *name);

/* A reference with its parameters, ready to be evaluated. */
typedef struct reference {
    const reference_model *model;
    const void *par; /* model->param_size bytes; borrowed: must outlive this */
    void *prepared;  /* owned */
} reference;

/* Prepares `model` with parameters `par` (borrowed; already in the ranges of its table). Errors: FLOE_BAD_INPUT,
 * FLOE_NO_MEMORY; then *out is empty. */
floe_status reference_create(context *ctx, const reference_model *model, const void *par, reference *out);
/* Frees what *r owns and empties it; NULL and an empty reference are fine. */
void reference_destroy(context *ctx, reference *r);

/* All quantities at the n times t[i] (s, ascending, >= 0), value[q * n + i]. Errors: of the model's series(), and
 * FLOE_BAD_INPUT for times that are not so. */
floe_status reference_series(context *ctx, const reference *r, size_t n, const double *t, double *value);

#endif
