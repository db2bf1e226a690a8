/* Richardson extrapolation and the grid convergence index, for sequences f(h) without an exact solution.
 *
 * f = f0 + C h^p is put through three values of the finest spacings (oscillating: the sign of C changes from one to the
 * next), h1 < h2 < h3, with any ratios: p is the root of |f3 - f2|/|f2 - f1| = r21^p (r32^p -+ 1)/(r21^p -+ 1). The
 * index bounds |f - f0| with a safety factor of 1.25, or 3 where the order is not observed (Celik et al., J. Fluids
 * Eng. 130 (2008) 078001; Roache, J. Fluids Eng. 116 (1994) 405). More values: least squares (Eca & Hoekstra, J.
 * Comput. Phys. 262 (2014) 104). Orders of errors against an exact solution are in verify/order.h. */
#ifndef VERIFY_RICHARDSON_H
#define VERIFY_RICHARDSON_H

#include "base/context.h"

#include <stddef.h>

/* Safety factors of the index: where the order is observed, and where it is assumed. */
#define GCI_SAFETY 1.25
#define GCI_SAFETY_ASSUMED 3.0

/* X(enumerator, name): what a sequence shows. */
#define RICHARDSON_LIST(X)                                                      \
    /* differences shrink and keep their sign: the order is observed */         \
    X(RICHARDSON_MONOTONE, "monotone")                                          \
    /* differences shrink and change sign: the limit is in between */           \
    X(RICHARDSON_OSCILLATORY, "oscillatory")                                    \
    /* differences grow, or do not shrink as any power of h does: no limit */   \
    X(RICHARDSON_DIVERGENT, "divergent")                                        \
    /* differences change sign and grow: no limit */                            \
    X(RICHARDSON_OSCILLATING, "oscillatory divergent")                          \
    /* the two finest values agree to round-off: no order is left to observe */ \
    X(RICHARDSON_EQUAL, "equal")                                                \
    /* two spacings: the order is the expected one, not observed */             \
    X(RICHARDSON_ASSUMED, "order assumed")                                      \
    /* least squares end at an order of 1/16 or 16: h^p does not describe it */ \
    X(RICHARDSON_UNFITTED, "no power law")

typedef enum richardson_kind {
#define RICHARDSON_ENUM(enumerator, name) enumerator,
    RICHARDSON_LIST(RICHARDSON_ENUM)
#undef RICHARDSON_ENUM
        RICHARDSON_KIND_COUNT
} richardson_kind;

/* "monotone"; "" out of range. */
const char *richardson_name(richardson_kind kind);

/* What the finest values say; f1 belongs to the finest spacing. Every field by kind:
 *   monotone, order assumed  the power law's
 *   oscillatory              the power law's with alternating sign; the index is the monotone one, the larger of the two
 *   equal                    value f1, both indices 0, order and asymptotic_ratio NAN
 *   (oscillatory) divergent  value f1, both indices INFINITY, order <= 0 (-INFINITY: f3 = f2), asymptotic_ratio NAN */
typedef struct richardson {
    richardson_kind kind;
    double order;      /* p */
    double value;      /* extrapolated to h = 0; unit of f */
    double gci_fine;   /* bounds |f1 - limit|; unit of f (over |f1| it is the index as often printed) */
    double gci_medium; /* bounds |f2 - limit|; unit of f */
    double safety;     /* the factor in both: 1.25, or 3 when the order is assumed */
    /* How well an order that is not fitted to the same differences predicts them; 1 in the asymptotic range. With an
     * expected order: |f3 - f2|/|f2 - f1| over what it should be (Roache's GCI32/(r^p GCI21)). Without: the observed
     * order against |f4 - f3|/|f3 - f2|. NAN if there are neither. */
    double asymptotic_ratio;
} richardson;

/* From the (at most four) finest of n values f over spacings h (any order, any unit). `expected` is the order that the
 * method should have, NAN if not known. Errors: FLOE_BAD_INPUT with a message for n < 2, n = 2 without an expected
 * order, spacings that are equal or not finite and > 0, values that are not finite, expected <= 0; FLOE_NO_MEMORY. */
floe_status richardson_estimate(context *ctx, size_t n, const double *h, const double *f, double expected,
                                richardson *out);

/* f = value + constant h^order by unweighted least squares over all spacings.
 *   equal         all values agree to round-off: value f1, order NAN, the rest 0
 *   no power law  value f1, order 1/16 or 16, uncertainty INFINITY, order_error and value_error NAN
 *   monotone      everything */
typedef struct richardson_fit {
    richardson_kind kind;      /* one of the three above */
    double order, order_error; /* p in 1/16 ... 16, and its standard error */
    double value, value_error; /* limit and its standard error; unit of f */
    double constant;           /* f - value at h = 1 */
    double deviation;          /* standard deviation of the residuals, n - 3 degrees of freedom; unit of f */
    /* Of f1, Eca & Hoekstra's: F |f1 - value| + deviation + |residual of f1|, F = 1.25 for 0.5 <= p <= expected + 0.1
     * (2.1 if not known), else 3; 3 deviation/spread times that with F = 1 if the deviation is over the mean spread
     * (max f - min f)/(n - 1). Unit of f. */
    double uncertainty;
    size_t n;
} richardson_fit;

/* Errors: as richardson_estimate, and FLOE_BAD_INPUT for n < 4. */
floe_status richardson_fit_power(context *ctx, size_t n, const double *h, const double *f, double expected,
                                 richardson_fit *out);

#endif
