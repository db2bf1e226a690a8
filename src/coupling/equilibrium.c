#include "coupling/equilibrium.h"

#include "base/memory.h"

#include <float.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>
#include <math.h>

enum { MOST_ITERATIONS = 200 };

static const double residual_tolerance = 1e-13;

/* What the function handed to GSL sees: a cell and the shift that makes the variable x = p + shift positive. */
typedef struct problem {
    equilibrium_cell *cell;
    double shift;
} problem;

struct equilibrium_solver {
    context *ctx;
    gsl_root_fdfsolver *solver;
};

/* F(p) and dF/dp; leaves p, v and F in the cell. */
static double evaluate(equilibrium_cell *c, double p, double *slope)
{
    double sum = 0.0, derivative = 0.0;
    for (int r = 0; r < c->n; ++r) {
        if (!(c->a[r] > 0.0)) continue;
        double v, dvdp;
        if (c->path[r])
            v = isentrope_volume(c->path[r], p, &dvdp);
        else
            c->eos[r]->model->volume(c->eos[r]->par, 1, &p, &c->T[r], &v, &dvdp);
        c->v[r] = v;
        sum += c->a[r] * v;
        derivative += c->a[r] * dvdp;
    }
    c->p = p;
    c->residual = sum - 1.0;
    *slope = derivative;
    return c->residual;
}

/* G(x) = x F(x - shift) and its derivative. */
static void shifted_fdf(double x, void *params, double *f, double *df)
{
    const problem *q = params;
    double slope;
    const double F = evaluate(q->cell, x - q->shift, &slope);
    *f = x * F;
    *df = F + x * slope;
}

static double shifted_f(double x, void *params)
{
    double f, df;
    shifted_fdf(x, params, &f, &df);
    return f;
}

static double shifted_df(double x, void *params)
{
    double f, df;
    shifted_fdf(x, params, &f, &df);
    return df;
}

/* The solver "bracketed newton" for functions of x > 0 that fall through their root. */
typedef struct bracketed_newton {
    double f, df;  /* at the root so far */
    double lo, hi; /* f > 0 at lo, f < 0 at hi; 0 and infinity while unknown */
    int fallbacks;
} bracketed_newton;

static void tighten(bracketed_newton *s, double x)
{
    if (s->f > 0.0) s->lo = fmax(s->lo, x);
    if (s->f < 0.0) s->hi = fmin(s->hi, x);
}

static int bracketed_newton_set(void *state, gsl_function_fdf *fdf, double *root)
{
    bracketed_newton *s = state;
    *s = (bracketed_newton){.lo = 0.0, .hi = INFINITY};
    GSL_FN_FDF_EVAL_F_DF(fdf, *root, &s->f, &s->df);
    tighten(s, *root);
    return GSL_SUCCESS;
}

/* Inside an open bracket, whatever is known of it. */
static double middle(const bracketed_newton *s)
{
    if (isinf(s->hi)) return 32.0 * s->lo;
    return s->lo > 0.0 ? sqrt(s->lo) * sqrt(s->hi) : s->hi / 32.0;
}

static int bracketed_newton_iterate(void *state, gsl_function_fdf *fdf, double *root)
{
    bracketed_newton *s = state;
    double x = *root - s->f / s->df;
    if (!(x > s->lo && x < s->hi)) {
        x = middle(s);
        s->fallbacks++;
    }
    *root = x;
    GSL_FN_FDF_EVAL_F_DF(fdf, x, &s->f, &s->df);
    if (!isfinite(s->f) || !isfinite(s->df)) return GSL_EBADFUNC;
    tighten(s, x);
    return GSL_SUCCESS;
}

static const gsl_root_fdfsolver_type bracketed_newton_type = {
    .name = "bracketed newton",
    .size = sizeof(bracketed_newton),
    .set = bracketed_newton_set,
    .iterate = bracketed_newton_iterate,
};

floe_status equilibrium_create(equilibrium_solver **out, context *ctx)
{
    TRY(memory_new(ctx, out, 1, sizeof **out));
    (*out)->ctx = ctx;
    (*out)->solver = gsl_root_fdfsolver_alloc(&bracketed_newton_type);
    if ((*out)->solver) return FLOE_OK;
    memory_free(ctx, out);
    return fail(ctx, FLOE_NO_MEMORY, "no memory for the equilibrium pressure's root solver");
}

void equilibrium_destroy(equilibrium_solver **s)
{
    if (!s || !*s) return;
    gsl_root_fdfsolver_free((*s)->solver);
    memory_free((*s)->ctx, s);
}

/* x = p + shift is positive exactly where every law is defined. */
static double shift_of(const equilibrium_cell *c)
{
    double floor = -DBL_MAX;
    for (int r = 0; r < c->n; ++r)
        if (c->a[r] > 0.0) floor = fmax(floor, c->eos[r]->model->pressure_floor(c->eos[r]->par));
    return isfinite(floor) && floor > -DBL_MAX ? -floor : 0.0;
}

static bool converged(const equilibrium_cell *c, const bracketed_newton *s)
{
    return fabs(c->residual) < residual_tolerance || (isfinite(s->hi) && s->hi - s->lo <= 4.0 * DBL_EPSILON * s->hi);
}

/* Where to begin without a guess: at the pressure of the material that would fill the cell by itself at the highest one, or, where all
 * of them would be torn, as far above their floors as these are below zero. */
static double first_guess(const equilibrium_cell *c, double shift)
{
    double x = shift;
    for (int r = 0; r < c->n; ++r) {
        double e, p, c2;
        if (!(c->a[r] > 0.0)) continue;
        c->eos[r]->model->energy(c->eos[r]->par, 1, &c->a[r], &c->T[r], &e);
        c->eos[r]->model->pressure(c->eos[r]->par, 1, &c->a[r], &e, &p, &c2);
        if (isfinite(p)) x = fmax(x, p + shift);
    }
    return x;
}

floe_status equilibrium_solve(equilibrium_solver *s, equilibrium_cell *cell)
{
    problem q = {.cell = cell, .shift = shift_of(cell)};
    gsl_function_fdf fdf = {.f = shifted_f, .df = shifted_df, .fdf = shifted_fdf, .params = &q};
    const double guess = cell->p + q.shift;
    const bracketed_newton *state = s->solver->state;
    gsl_root_fdfsolver_set(s->solver, &fdf, guess > 0.0 && isfinite(guess) ? guess : first_guess(cell, q.shift));
    cell->iterations = 0;
    while (!converged(cell, state) && cell->iterations < MOST_ITERATIONS) {
        cell->iterations++;
        if (gsl_root_fdfsolver_iterate(s->solver) != GSL_SUCCESS) break;
    }
    cell->fallbacks = state->fallbacks;
    return converged(cell, state) ? FLOE_OK : FLOE_RETRY;
}
