#include "coupling/equilibrium.h"

#include <float.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>
#include <math.h>

enum { MOST_ITERATIONS = 200 };

static const double residual_tolerance = 1e-13;

/* The solver "bracketed newton" for functions of x > 0 that fall through their root. An iteration takes the function at the root so far and moves
 * the root, so that the function can be found for many roots at once in between. */
typedef struct bracketed_newton {
    double f, df;   /* where it was taken last */
    double lo, hi;  /* f > 0 at lo, f < 0 at hi; 0 and infinity while unknown */
    bool fell_back; /* the last move was to the middle of the bracket */
} bracketed_newton;

/* One cell's search for the root of G(x) = x F(x - shift). */
typedef struct search {
    double shift;    /* makes x = p + shift positive exactly where every law is defined */
    double F, slope; /* F and dF/dp at the root so far */
    bracketed_newton state;
    gsl_function_fdf fdf;
    gsl_root_fdfsolver solver; /* of `state` and `fdf` */
} search;

/* Adds material r's part of F + 1 and dF/dp in the cells named, at their p, and sets its v there. */
static void add_material(equilibrium_cell *cell, const int *id, int n, int r, double *sum, double *slope)
{
    const eos *law = cell->eos[r];
    double p[EQUILIBRIUM_BATCH], T[EQUILIBRIUM_BATCH], v[EQUILIBRIUM_BATCH], dvdp[EQUILIBRIUM_BATCH];
    int frozen[EQUILIBRIUM_BATCH], n_frozen = 0; /* cells in which T is */
    for (int k = 0; k < n; ++k) {
        equilibrium_cell *c = &cell[id[k]];
        if (!(c->a[r] > 0.0)) continue;
        if (!c->path[r]) {
            p[n_frozen] = c->p;
            T[n_frozen] = c->T[r];
            frozen[n_frozen++] = k;
            continue;
        }
        double change;
        c->v[r] = isentrope_volume(c->path[r], c->p, &change);
        sum[k] += c->a[r] * c->v[r];
        slope[k] += c->a[r] * change;
    }
    if (n_frozen > 0) law->model->volume(law->par, (size_t)n_frozen, p, T, v, dvdp);
    for (int i = 0; i < n_frozen; ++i) {
        equilibrium_cell *c = &cell[id[frozen[i]]];
        c->v[r] = v[i];
        sum[frozen[i]] += c->a[r] * v[i];
        slope[frozen[i]] += c->a[r] * dvdp[i];
    }
}

/* p, v, F and dF/dp of the cells named, at the roots so far. */
static void evaluate(equilibrium_cell *cell, search *w, const int *id, int n)
{
    double sum[EQUILIBRIUM_BATCH], slope[EQUILIBRIUM_BATCH];
    for (int k = 0; k < n; ++k) {
        cell[id[k]].p = gsl_root_fdfsolver_root(&w[id[k]].solver) - w[id[k]].shift;
        sum[k] = slope[k] = 0.0;
    }
    for (int r = 0; r < cell->n; ++r) add_material(cell, id, n, r, sum, slope);
    for (int k = 0; k < n; ++k) {
        cell[id[k]].residual = w[id[k]].F = sum[k] - 1.0;
        w[id[k]].slope = slope[k];
    }
}

/* G and its derivative where `evaluate` has been. */
static void shifted_fdf(double x, void *params, double *f, double *df)
{
    const search *s = params;
    *f = x * s->F;
    *df = s->F + x * s->slope;
}

static int bracketed_newton_set(void *state, gsl_function_fdf *fdf, double *root)
{
    (void)fdf;
    (void)root;
    *(bracketed_newton *)state = (bracketed_newton){.hi = INFINITY};
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
    GSL_FN_FDF_EVAL_F_DF(fdf, *root, &s->f, &s->df);
    if (s->f > 0.0) s->lo = fmax(s->lo, *root);
    if (s->f < 0.0) s->hi = fmin(s->hi, *root);
    const double x = *root - s->f / s->df;
    s->fell_back = !(x > s->lo && x < s->hi);
    *root = s->fell_back ? middle(s) : x;
    return isfinite(s->f) && isfinite(s->df) ? GSL_SUCCESS : GSL_EBADFUNC;
}

static const gsl_root_fdfsolver_type bracketed_newton_type = {
    .name = "bracketed newton",
    .size = sizeof(bracketed_newton),
    .set = bracketed_newton_set,
    .iterate = bracketed_newton_iterate,
};

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

/* The solver is a struct of GSL's that its users may make: with one beside each cell nothing is allocated. */
static void start(const equilibrium_cell *c, search *s)
{
    double floor = -DBL_MAX;
    for (int r = 0; r < c->n; ++r)
        if (c->a[r] > 0.0) floor = fmax(floor, c->eos[r]->model->pressure_floor(c->eos[r]->par));
    s->shift = isfinite(floor) && floor > -DBL_MAX ? -floor : 0.0;
    s->fdf = (gsl_function_fdf){.fdf = shifted_fdf, .params = s};
    s->solver = (gsl_root_fdfsolver){.type = &bracketed_newton_type, .state = &s->state};
    const double guess = c->p + s->shift;
    gsl_root_fdfsolver_set(&s->solver, &s->fdf, guess > 0.0 && isfinite(guess) ? guess : first_guess(c, s->shift));
}

static bool converged(const equilibrium_cell *c, const bracketed_newton *s)
{
    return fabs(c->residual) < residual_tolerance || (isfinite(s->hi) && s->hi - s->lo <= 4.0 * DBL_EPSILON * s->hi);
}

/* One more iteration of a cell that has been evaluated; whether it still moves. A start that the laws do not take is left, an iterate is not. */
static bool iterate(equilibrium_cell *c, search *s)
{
    const bool taken = gsl_root_fdfsolver_iterate(&s->solver) == GSL_SUCCESS;
    c->solved = converged(c, &s->state);
    if (c->solved || (c->iterations > 0 && !taken) || c->iterations == MOST_ITERATIONS) return false;
    c->iterations++;
    c->fallbacks += s->state.fell_back;
    return true;
}

/* Up to EQUILIBRIUM_BATCH cells: all that still move take their iterations together, so that the laws see them in batches. */
static bool solve_batch(equilibrium_cell *cell, int n)
{
    search w[EQUILIBRIUM_BATCH];
    int id[EQUILIBRIUM_BATCH], moving = n;
    bool good = true;
    for (int k = 0; k < n; ++k) {
        start(&cell[k], &w[k]);
        cell[k].iterations = cell[k].fallbacks = 0;
        id[k] = k;
    }
    while (moving > 0) {
        const int evaluated = moving;
        evaluate(cell, w, id, evaluated);
        moving = 0;
        for (int k = 0; k < evaluated; ++k)
            if (iterate(&cell[id[k]], &w[id[k]])) id[moving++] = id[k];
    }
    for (int k = 0; k < n; ++k) good = good && cell[k].solved;
    return good;
}

floe_status equilibrium_solve(equilibrium_cell *cell, int n)
{
    bool good = true;
    for (int first = 0; first < n; first += EQUILIBRIUM_BATCH)
        good = solve_batch(cell + first, n - first < EQUILIBRIUM_BATCH ? n - first : EQUILIBRIUM_BATCH) && good;
    return good ? FLOE_OK : FLOE_RETRY;
}
