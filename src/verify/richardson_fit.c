/* The power law through more than three values, by least squares. */
#include "verify/richardson.h"

#include "base/memory.h"
#include "math/small_solve.h"
#include "verify/sequence.h"

#include <gsl/gsl_fit.h>

/* Linear least squares f = value + constant (h/unit)^p at a given p. */
typedef struct line {
    const sequence *s;
    double unit;   /* geometric mean of the spacings, so that powers stay near 1 */
    double *power; /* [n]: work */
    double value, constant, squares;
} line;

static double line_fit(line *l, double p)
{
    double variance, covariance, variance_slope;
    for (size_t i = 0; i < l->s->n; i++) l->power[i] = pow(l->s->h[i] / l->unit, p);
    gsl_fit_linear(l->power, 1, l->s->f, 1, l->s->n, &l->value, &l->constant, &variance, &covariance, &variance_slope,
                   &l->squares);
    return l->squares;
}

enum { SCAN = 160, SECTIONS = 60 };
static const double least_order = 1.0 / 16.0, largest_order = 16.0;

static double scan_order(int i)
{
    return least_order * pow(largest_order / least_order, (double)i / SCAN);
}

/* The order of the least sum of squares: the best of a scan, then golden sections between its neighbours (the sum may
 * have several minima in data with scatter). */
static double best_order(line *l)
{
    const double section = 0.5 * (sqrt(5.0) - 1.0);
    double least = INFINITY;
    int best = 0;
    for (int i = 0; i <= SCAN; i++) {
        const double squares = line_fit(l, scan_order(i));
        if (squares < least) {
            least = squares;
            best = i;
        }
    }
    if (best == 0 || best == SCAN) return scan_order(best);
    double lo = scan_order(best - 1);
    double hi = scan_order(best + 1);
    for (int i = 0; i < SECTIONS; i++) {
        const double width = section * (hi - lo);
        if (line_fit(l, hi - width) < line_fit(l, lo + width)) {
            hi = lo + width;
        } else {
            lo = hi - width;
        }
    }
    return 0.5 * (lo + hi);
}

/* Standard errors of value and order from the linearised fit: deviation^2 (J^T J)^-1 with the columns 1, h^p and
 * C h^p log h of J. */
static void standard_errors(const line *l, richardson_fit *out)
{
    double normal[9] = {0.0};
    double first[3] = {1.0, 0.0, 0.0};
    double last[3] = {0.0, 0.0, 1.0};
    for (size_t i = 0; i < l->s->n; i++) {
        const double row[3] = {1.0, l->power[i], l->constant * l->power[i] * log(l->s->h[i] / l->unit)};
        for (int k = 0; k < 9; k++) normal[k] += row[k / 3] * row[k % 3];
    }
    const bool solved = small_ldl_factor(3, normal);
    if (solved) {
        small_ldl_solve(3, normal, first);
        small_ldl_solve(3, normal, last);
    }
    out->value_error = solved ? out->deviation * sqrt(first[0]) : (double)INFINITY;
    out->order_error = solved ? out->deviation * sqrt(last[2]) : (double)INFINITY;
}

static double fit_uncertainty(const richardson_fit *fit, double residual, double error, double spread, double expected)
{
    if (fit->deviation > spread) return 3.0 * fit->deviation / spread * (error + fit->deviation + residual);
    const bool usual = fit->order >= 0.5 && fit->order <= (isnan(expected) ? 2.0 : expected) + 0.1;
    return (usual ? GCI_SAFETY : GCI_SAFETY_ASSUMED) * error + fit->deviation + residual;
}

static void fit_sequence(line *l, double expected, double range, richardson_fit *out)
{
    const sequence *s = l->s;
    out->order = best_order(l);
    line_fit(l, out->order);
    if (out->order == scan_order(0) || out->order == scan_order(SCAN)) {
        out->kind = RICHARDSON_UNFITTED;
        out->value = s->f[0];
        out->uncertainty = INFINITY;
        out->order_error = out->value_error = NAN;
    } else {
        out->kind = RICHARDSON_MONOTONE;
        out->value = l->value;
    }
    out->constant = l->constant * pow(l->unit, -out->order);
    out->deviation = sqrt(l->squares / (double)(s->n - 3));
    if (out->kind == RICHARDSON_UNFITTED) return;
    standard_errors(l, out);
    const double residual = fabs(s->f[0] - l->value - l->constant * l->power[0]);
    out->uncertainty = fit_uncertainty(out, residual, fabs(s->f[0] - l->value), range / (double)(s->n - 1), expected);
}

floe_status richardson_fit_power(context *ctx, size_t n, const double *h, const double *f, double expected,
                                 richardson_fit *out)
{
    sequence s;
    TRY(sequence_make(ctx, n, 4, h, f, expected, &s));
    line l = {.s = &s};
    const floe_status status = memory_new(ctx, &l.power, n, sizeof *l.power);
    if (status != FLOE_OK) {
        memory_free(ctx, &s.h);
        return status;
    }
    double lo = s.f[0];
    double hi = s.f[0];
    double logs = 0.0;
    for (size_t i = 0; i < n; i++) {
        lo = fmin(lo, s.f[i]);
        hi = fmax(hi, s.f[i]);
        logs += log(s.h[i]);
    }
    l.unit = exp(logs / (double)n);
    *out = (richardson_fit){.kind = RICHARDSON_EQUAL, .order = NAN, .value = s.f[0], .n = n};
    if (hi - lo > sequence_roundoff(lo, hi)) fit_sequence(&l, expected, hi - lo, out);
    memory_free(ctx, &l.power);
    memory_free(ctx, &s.h);
    return FLOE_OK;
}
