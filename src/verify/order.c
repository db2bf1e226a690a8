#include "verify/order.h"

#include "base/memory.h"

#include <gsl/gsl_fit.h>
#include <math.h>

static floe_status check_points(context *ctx, size_t n, const double *h, const double *error)
{
    if (n < 2) return fail(ctx, FLOE_BAD_INPUT, "an observed order needs at least 2 points, not %zu", n);
    for (size_t i = 0; i < n; i++) {
        if (!(h[i] > 0.0 && isfinite(h[i]))) {
            return fail(ctx, FLOE_BAD_INPUT, "spacing %zu is %g: an observed order needs finite values > 0", i + 1,
                        h[i]);
        }
        if (!(error[i] > 0.0 && isfinite(error[i]))) {
            return fail(ctx, FLOE_BAD_INPUT, "the error at spacing %g is %g: an observed order needs finite values > 0",
                        h[i], error[i]);
        }
    }
    return FLOE_OK;
}

static floe_status check_spread(context *ctx, size_t n, const double *h)
{
    for (size_t i = 1; i < n; i++) {
        if (h[i] != h[0]) return FLOE_OK;
    }
    return fail(ctx, FLOE_BAD_INPUT, "all %zu points have the spacing %g: an observed order needs two", n, h[0]);
}

floe_status order_fit_power(context *ctx, size_t n, const double *h, const double *error, order_fit *out)
{
    *out = (order_fit){NAN, NAN, NAN, n};
    TRY(check_points(ctx, n, h, error));
    TRY(check_spread(ctx, n, h));
    double *logs = NULL;
    TRY(memory_new(ctx, &logs, 2 * n, sizeof *logs));
    for (size_t i = 0; i < n; i++) {
        logs[i] = log(h[i]);
        logs[n + i] = log(error[i]);
    }
    double intercept, slope, variance_intercept, covariance, variance_slope, residual;
    gsl_fit_linear(logs, 1, logs + n, 1, n, &intercept, &slope, &variance_intercept, &covariance, &variance_slope,
                   &residual);
    memory_free(ctx, &logs);
    out->order = slope;
    out->constant = exp(intercept);
    out->standard_error = n > 2 ? sqrt(variance_slope) : (double)NAN;
    return FLOE_OK;
}

floe_status order_pairwise(context *ctx, size_t n, const double *h, const double *error, double *order)
{
    TRY(check_points(ctx, n, h, error));
    for (size_t i = 0; i + 1 < n; i++) {
        if (h[i + 1] == h[i]) {
            return fail(ctx, FLOE_BAD_INPUT, "points %zu and %zu have the same spacing %g", i + 1, i + 2, h[i]);
        }
    }
    for (size_t i = 0; i + 1 < n; i++) order[i] = log(error[i + 1] / error[i]) / log(h[i + 1] / h[i]);
    return FLOE_OK;
}
