/* Observed order of convergence: the slope of log(error) over log(h). */
#ifndef VERIFY_ORDER_H
#define VERIFY_ORDER_H

#include "base/context.h"

#include <stddef.h>

/* error = constant * h^order. */
typedef struct order_fit {
    double order; /* slope of the straight line through (log h, log error), by least squares */
    /* Of `order`, from the scatter about the line with n - 2 degrees of freedom; NAN for n = 2. */
    double standard_error;
    double constant; /* error at h = 1, in the unit of the errors */
    size_t n;        /* points */
} order_fit;

/* Fits n >= 2 points; h is a spacing or a time step (any unit), not all the same. Errors: FLOE_BAD_INPUT with a message
 * for too few points, a value that is not finite and > 0 (an error of 0 has no logarithm), or one h alone. */
floe_status order_fit_power(context *ctx, size_t n, const double *h, const double *error, order_fit *out);

/* order[i] = log(error[i+1]/error[i]) / log(h[i+1]/h[i]) for i < n - 1. Errors: as order_fit_power, and neighbours with
 * the same h. */
floe_status order_pairwise(context *ctx, size_t n, const double *h, const double *error, double *order);

#endif
