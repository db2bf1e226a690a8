/* Values over spacings, as extrapolation takes them. Only src/verify includes this. */
#ifndef VERIFY_SEQUENCE_H
#define VERIFY_SEQUENCE_H

#include "base/context.h"

#include <stddef.h>

/* Spacings and values, finest first. */
typedef struct sequence {
    size_t n;
    double *h, *f; /* one allocation, at h, owned */
} sequence;

/* Sorts copies of h[n], f[n] into *out; free out->h with memory_free. Errors: FLOE_BAD_INPUT for n < least, spacings
 * that are equal or not finite and > 0, values that are not finite, an expected order that is infinite or <= 0 (NAN:
 * none); FLOE_NO_MEMORY. */
floe_status sequence_make(context *ctx, size_t n, size_t least, const double *h, const double *f, double expected,
                          sequence *out);

/* A difference that is left of a - b when both are the same but for round-off. */
double sequence_roundoff(double a, double b);

#endif
