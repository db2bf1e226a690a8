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

/* v and dv/dp of material r in the cells named, where some of them follow isentropes. */
static void follow(const equilibrium_batch *b, const int *id, int n, int r, const double *p, double *v, double *dvdp)
{
    const eos *law = b->eos[r];
    double T[EQUILIBRIUM_BATCH];
    bool frozen = true;
    for (int k = 0; k < n; ++k) {
        frozen = frozen && !(b->path[r][id[k]].exponent > 0.0);
        T[k] = b->T[r][id[k]];
    }
    if (frozen) law->model->volume(law->par, (size_t)n, p, T, v, dvdp);
    for (int k = 0; k < n && !frozen; ++k) {
        const isentrope *path = &b->path[r][id[k]];
        if (path->exponent > 0.0)
            v[k] = isentrope_volume(path, p[k], &dvdp[k]);
        else
            law->model->volume(law->par, 1, &p[k], &T[k], &v[k], &dvdp[k]);
    }
}

/* Adds material r's part of F + 1 and dF/dp in the cells named, at their p, and sets its v there. `all`: they are all of the batch, as they lie. */
static void add_material(equilibrium_batch *b, const int *id, int n, bool all, int r, const double *p, double *sum,
                         double *slope)
{
    double a_of[EQUILIBRIUM_BATCH], T_of[EQUILIBRIUM_BATCH], v_of[EQUILIBRIUM_BATCH], dvdp[EQUILIBRIUM_BATCH];
    const double *a = all ? b->a[r] : a_of, *T = all ? b->T[r] : T_of;
    double *v = all ? b->v[r] : v_of;
    for (int k = 0; k < n && !all; ++k) {
        a_of[k] = b->a[r][id[k]];
        T_of[k] = b->T[r][id[k]];
    }
    if (b->path[r])
        follow(b, id, n, r, p, v, dvdp);
    else
        b->eos[r]->model->volume(b->eos[r]->par, (size_t)n, p, T, v, dvdp);
    for (int k = 0; k < n; ++k) {
        sum[k] += a[k] > 0.0 ? a[k] * v[k] : 0.0;
        slope[k] += a[k] > 0.0 ? a[k] * dvdp[k] : 0.0;
    }
    for (int k = 0; k < n && !all; ++k) b->v[r][id[k]] = v[k];
}

/* p, v, F and dF/dp of the cells named, at the roots so far. */
static void evaluate(equilibrium_batch *b, search *w, const int *id, int n, bool all)
{
    double p[EQUILIBRIUM_BATCH], sum[EQUILIBRIUM_BATCH], slope[EQUILIBRIUM_BATCH];
    for (int k = 0; k < n; ++k) {
        p[k] = b->p[id[k]] = w[id[k]].solver.root - w[id[k]].shift;
        sum[k] = slope[k] = 0.0;
    }
    for (int r = 0; r < b->n; ++r) add_material(b, id, n, all, r, p, sum, slope);
    for (int k = 0; k < n; ++k) {
        w[id[k]].F = sum[k] - 1.0;
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
static double first_guess(const equilibrium_batch *b, int c, double shift)
{
    double x = shift;
    for (int r = 0; r < b->n; ++r) {
        const eos *law = b->eos[r];
        double e, p, c2;
        if (!(b->a[r][c] > 0.0)) continue;
        law->model->energy(law->par, 1, &b->a[r][c], &b->T[r][c], &e);
        law->model->pressure(law->par, 1, &b->a[r][c], &e, &p, &c2);
        if (isfinite(p)) x = fmax(x, p + shift);
    }
    return x;
}

/* The largest pressure floor of the materials of each cell, -DBL_MAX where none has any. */
static void find_floors(const equilibrium_batch *b, int n, double *floor)
{
    for (int k = 0; k < n; ++k) floor[k] = -DBL_MAX;
    for (int r = 0; r < b->n; ++r) {
        const double least = b->eos[r]->model->pressure_floor(b->eos[r]->par);
        for (int k = 0; k < n; ++k) floor[k] = b->a[r][k] > 0.0 && least > floor[k] ? least : floor[k];
    }
}

/* The solver is a struct of GSL's that its users may make: with one beside each cell nothing is allocated. */
static void start(equilibrium_batch *b, int c, double floor, search *s)
{
    s->shift = isfinite(floor) && floor > -DBL_MAX ? -floor : 0.0;
    s->fdf = (gsl_function_fdf){.fdf = shifted_fdf, .params = s};
    s->solver = (gsl_root_fdfsolver){.type = &bracketed_newton_type, .state = &s->state};
    const double guess = b->p[c] + s->shift;
    gsl_root_fdfsolver_set(&s->solver, &s->fdf, guess > 0.0 && isfinite(guess) ? guess : first_guess(b, c, s->shift));
    b->iterations[c] = b->fallbacks[c] = 0;
}

static bool closed(const bracketed_newton *s)
{
    return isfinite(s->hi) && s->hi - s->lo <= 4.0 * DBL_EPSILON * s->hi;
}

/* One more iteration of a cell that has been evaluated; whether it still moves. A start that the laws do not take is left, an iterate is not. */
static bool iterate(equilibrium_batch *b, int c, search *s)
{
    b->residual[c] = s->F;
    b->solved[c] = fabs(s->F) < residual_tolerance;
    if (b->solved[c]) return false;
    const bool taken = gsl_root_fdfsolver_iterate(&s->solver) == GSL_SUCCESS;
    b->solved[c] = closed(&s->state);
    if (b->solved[c] || (b->iterations[c] > 0 && !taken) || b->iterations[c] == MOST_ITERATIONS) return false;
    b->iterations[c]++;
    b->fallbacks[c] += s->state.fell_back;
    return true;
}

/* All cells that still move take their iterations together, so that the laws see them in batches. */
floe_status equilibrium_solve(equilibrium_batch *b, int cells)
{
    search w[EQUILIBRIUM_BATCH];
    double floor[EQUILIBRIUM_BATCH];
    int id[EQUILIBRIUM_BATCH], moving = cells;
    bool good = true;
    find_floors(b, cells, floor);
    for (int k = 0; k < cells; ++k) {
        start(b, k, floor[k], &w[k]);
        id[k] = k;
    }
    while (moving > 0) {
        const int evaluated = moving;
        evaluate(b, w, id, evaluated, evaluated == cells);
        moving = 0;
        for (int k = 0; k < evaluated; ++k)
            if (iterate(b, id[k], &w[id[k]])) id[moving++] = id[k];
    }
    for (int k = 0; k < cells; ++k) good = good && b->solved[k];
    return good ? FLOE_OK : FLOE_RETRY;
}
