#include "verify/sequence.h"

#include "base/memory.h"

#include <float.h>
#include <math.h>

static floe_status check_point(context *ctx, double h, double f)
{
    if (!(h > 0.0 && isfinite(h))) {
        return fail(ctx, FLOE_BAD_INPUT, "a spacing is %g: extrapolation needs finite spacings > 0", h);
    }
    if (isfinite(f)) return FLOE_OK;
    return fail(ctx, FLOE_BAD_INPUT, "the value at spacing %g is %g: extrapolation needs finite values", h, f);
}

static floe_status check_sequence(context *ctx, size_t n, size_t least, const double *h, const double *f,
                                  double expected)
{
    if (n < least) return fail(ctx, FLOE_BAD_INPUT, "%zu spacings: this extrapolation needs at least %zu", n, least);
    if (expected <= 0.0 || isinf(expected)) {
        return fail(ctx, FLOE_BAD_INPUT, "the expected order is %g: must be over 0 and finite", expected);
    }
    for (size_t i = 0; i < n; i++) {
        TRY(check_point(ctx, h[i], f[i]));
        for (size_t k = 0; k < i; k++) {
            if (h[k] == h[i]) return fail(ctx, FLOE_BAD_INPUT, "spacing %g comes twice: each must differ", h[i]);
        }
    }
    return FLOE_OK;
}

floe_status sequence_make(context *ctx, size_t n, size_t least, const double *h, const double *f, double expected,
                          sequence *out)
{
    TRY(check_sequence(ctx, n, least, h, f, expected));
    double *store = NULL;
    TRY(memory_new(ctx, &store, 2 * n, sizeof *store));
    *out = (sequence){n, store, store + n};
    for (size_t i = 0; i < n; i++) {
        size_t at = i;
        for (; at > 0 && out->h[at - 1] > h[i]; at--) {
            out->h[at] = out->h[at - 1];
            out->f[at] = out->f[at - 1];
        }
        out->h[at] = h[i];
        out->f[at] = f[i];
    }
    return FLOE_OK;
}

double sequence_roundoff(double a, double b)
{
    return 16.0 * DBL_EPSILON * fmax(fabs(a), fabs(b));
}
