#include "verify/richardson.h"

#include "base/memory.h"
#include "verify/sequence.h"
#include "verify/verify_internal.h"

static const char *const names[] = {
#define RICHARDSON_ENTRY(enumerator, name) [enumerator] = name,
    RICHARDSON_LIST(RICHARDSON_ENTRY)
#undef RICHARDSON_ENTRY
};

const char *richardson_name(richardson_kind kind)
{
    return (size_t)kind < RICHARDSON_KIND_COUNT ? names[kind] : "";
}

/* log of r21^p (r32^p - s)/(r21^p - s), the ratio of neighbouring differences under the power law; it grows with p in
 * both cases, from log(log r32/log r21) at p = 0 for s = 1, and from 0 for s = -1. */
typedef struct growth {
    double fine, coarse; /* log r21, log r32 */
    bool alternating;    /* s = -1 */
    double measured;     /* log |f3 - f2|/|f2 - f1| */
} growth;

/* log |e^y - 1| and log(e^y + 1), without overflow. */
static double log_less_one(double y)
{
    return fmax(y, 0.0) + log(-expm1(-fabs(y)));
}

static double log_plus_one(double y)
{
    return fmax(y, 0.0) + log1p(exp(-fabs(y)));
}

static double growth_excess(double p, void *user)
{
    const growth *g = user;
    if (g->alternating) return log_plus_one(g->coarse * p) - log_plus_one(-g->fine * p) - g->measured;
    if (p == 0.0) return log(g->coarse / g->fine) - g->measured;
    return log_less_one(g->coarse * p) - log_less_one(-g->fine * p) - g->measured;
}

/* The order whose growth is the measured one. The bracket is doubled from 1: it ends, as the growth has no bound. */
static double growth_order(growth *g)
{
    if (isinf(g->measured)) return g->measured;
    const double sign = growth_excess(0.0, g) < 0.0 ? 1.0 : -1.0;
    double reach = 1.0;
    while (growth_excess(sign * reach, g) * sign < 0.0) reach *= 2.0;
    return find_root(growth_excess, g, fmin(0.0, sign * reach), fmax(0.0, sign * reach));
}

static richardson settled_limit(double f1)
{
    return (richardson){RICHARDSON_EQUAL, NAN, f1, 0.0, 0.0, GCI_SAFETY, NAN};
}

static richardson from_pair(const double h[2], const double f[2], double expected)
{
    if (fabs(f[1] - f[0]) <= sequence_roundoff(f[0], f[1])) return settled_limit(f[0]);
    const double error = (f[0] - f[1]) / expm1(expected * log(h[1] / h[0]));
    return (richardson){.kind = RICHARDSON_ASSUMED,
                        .order = expected,
                        .value = f[0] + error,
                        .gci_fine = GCI_SAFETY_ASSUMED * fabs(error),
                        .gci_medium = GCI_SAFETY_ASSUMED * fabs(f[1] - f[0] - error),
                        .safety = GCI_SAFETY_ASSUMED,
                        .asymptotic_ratio = NAN};
}

static growth measure_growth(const double h[3], const double f[3])
{
    const double fine = f[1] - f[0];
    const double coarse = f[2] - f[1];
    const bool same = fabs(coarse) <= sequence_roundoff(f[1], f[2]);
    return (growth){.fine = log(h[1] / h[0]),
                    .coarse = log(h[2] / h[1]),
                    .alternating = !same && (fine > 0.0) != (coarse > 0.0),
                    .measured = same ? -(double)INFINITY : log(fabs(coarse / fine))};
}

static richardson from_triplet(const double h[3], const double f[3], double expected)
{
    if (fabs(f[1] - f[0]) <= sequence_roundoff(f[0], f[1])) return settled_limit(f[0]);
    growth g = measure_growth(h, f);
    const double p = growth_order(&g);
    if (!(p > 0.0)) {
        return (richardson){.kind = g.alternating ? RICHARDSON_OSCILLATING : RICHARDSON_DIVERGENT,
                            .order = p,
                            .value = f[0],
                            .gci_fine = INFINITY,
                            .gci_medium = INFINITY,
                            .safety = GCI_SAFETY,
                            .asymptotic_ratio = NAN};
    }
    const double fine = (f[0] - f[1]) / expm1(p * g.fine);
    const double coarse = (f[1] - f[2]) / expm1(p * g.coarse);
    return (richardson){.kind = g.alternating ? RICHARDSON_OSCILLATORY : RICHARDSON_MONOTONE,
                        .order = p,
                        .value = f[0] + (g.alternating ? (f[1] - f[0]) / (exp(p * g.fine) + 1.0) : fine),
                        .gci_fine = GCI_SAFETY * fabs(fine),
                        .gci_medium = GCI_SAFETY * fabs(coarse),
                        .safety = GCI_SAFETY,
                        .asymptotic_ratio = isnan(expected) ? (double)NAN : exp(-growth_excess(expected, &g))};
}

/* The differences that the triplet did not use, against its order. */
static void judge_by_fourth(richardson *r, const double h[4], const double f[4])
{
    const bool converges = r->kind == RICHARDSON_MONOTONE || r->kind == RICHARDSON_OSCILLATORY;
    if (!converges || !isnan(r->asymptotic_ratio)) return;
    growth next = measure_growth(h + 1, f + 1);
    next.alternating = r->kind == RICHARDSON_OSCILLATORY;
    r->asymptotic_ratio = exp(-growth_excess(r->order, &next));
}

floe_status richardson_estimate(context *ctx, size_t n, const double *h, const double *f, double expected,
                                richardson *out)
{
    if (n == 2 && isnan(expected)) {
        return fail(ctx, FLOE_BAD_INPUT, "two spacings show no order: give the expected one, or a third spacing");
    }
    sequence s;
    TRY(sequence_make(ctx, n, 2, h, f, expected, &s));
    *out = n == 2 ? from_pair(s.h, s.f, expected) : from_triplet(s.h, s.f, expected);
    if (n > 3) judge_by_fourth(out, s.h, s.f);
    memory_free(ctx, &s.h);
    return FLOE_OK;
}
