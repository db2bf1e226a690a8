/* The order that errors fall with. */
#ifndef TESTS_VERIFICATION_ORDER_FIXTURE_H
#define TESTS_VERIFICATION_ORDER_FIXTURE_H

#include "check.h"

#include "verify/order.h"

/* The exponent of h that fits n errors best. */
static inline double fitted_order(size_t n, const double *h, const double *error)
{
    context *ctx = context_create();
    order_fit fit;
    check_ok(ctx, order_fit_power(ctx, n, h, error, &fit));
    context_destroy(&ctx);
    return fit.order;
}

#endif
