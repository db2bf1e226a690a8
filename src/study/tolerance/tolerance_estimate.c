/* The error of a quantity without an exact solution. One sequence may settle at a wrong value, or pass through the
 * right one, and its observed order is then worth nothing: orders are believed only if four values agree on one
 * (Roache; Eca and Hoekstra 2014). */
#include "study/tolerance/tolerance.h"

#include "verify/richardson.h"

#include <math.h>

/* Of values that turn round or come from both sides. */
static tolerance_estimate by_span(const double *f, size_t n)
{
    const double low = fmin(f[n - 1], fmin(f[n - 2], f[n - 3])), high = fmax(f[n - 1], fmax(f[n - 2], f[n - 3]));
    return (tolerance_estimate){.relative = 2.0 * (high - low) / fabs(f[n - 1]),
                                .sure = true,
                                .how = "twice the span of the last three values",
                                .order = NAN,
                                .settled = 2.0 * fabs(f[n - 1] - f[n - 2]) / fabs(f[n - 1])};
}

/* With an order that is not observed: between neighbours. */
static double by_pair(const double *h, const double *f, size_t n, double order)
{
    return GCI_SAFETY_ASSUMED * fabs(f[n - 1] - f[n - 2]) / expm1(order * log(h[n - 2] / h[n - 1])) / fabs(f[n - 1]);
}

tolerance_estimate tolerance_estimate_of(size_t n, const double *h, const double *f)
{
    const double least_order = 0.5, most_order = 2.1, agreement = 1.05;
    richardson r;
    const tolerance_estimate none = {NAN, false, "too few values", NAN, 0.0};
    if (n < 2 || f[n - 1] == 0.0) return none;
    if (n == 2) return (tolerance_estimate){by_pair(h, f, n, 1.0), false, "two values, first order assumed", NAN, 0.0};
    if (richardson_estimate(NULL, n, h, f, NAN, &r) != FLOE_OK) return none;
    const bool diverges = r.kind == RICHARDSON_DIVERGENT || r.kind == RICHARDSON_OSCILLATING;
    /* Faster than the methods converge: two parts of the error cancel, and the values may turn round. */
    if (r.kind != RICHARDSON_MONOTONE || r.order > most_order) {
        tolerance_estimate e = by_span(f, n);
        e.sure = !diverges;
        if (diverges) e.how = "the values do not converge";
        return e;
    }
    const bool agree = r.asymptotic_ratio < agreement && r.asymptotic_ratio > 1.0 / agreement;
    if (agree && r.order >= least_order)
        return (tolerance_estimate){r.gci_fine / fabs(f[n - 1]), true,
                                    "grid convergence index, observed order, safety factor 1.25", r.order, 0.0};
    return (tolerance_estimate){by_pair(h, f, n, fmin(r.order, 1.0)), true,
                                "grid convergence index, order at most one, safety factor 3", r.order, 0.0};
}
