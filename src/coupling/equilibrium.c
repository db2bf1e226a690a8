#include "coupling/equilibrium.h"

#include "coupling/coupling_constants.h"

#include <float.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>
#include <math.h>

/* One cell's search for the root of G(x) = x F(x - shift), x > 0, which falls through it. */
typedef struct search {
    equilibrium_batch *b;
    int cell;
    double shift;       /* makes x = p + shift positive exactly where every law is defined */
    double x, F, slope; /* F and dF/dp where the laws were evaluated last */
    double lo, hi;      /* G > 0 at lo, G < 0 at hi; 0 and infinity while unknown */
    bool refused;       /* the last requested value lies outside of the bracket, or is none */
} search;

/* GSL's Newton and Brent. Their structs are open and say how large their states are: with the states here nothing is allocated. */
typedef struct root_solvers {
    gsl_function_fdf fdf;
    gsl_function f;
    gsl_root_fdfsolver newton;
    gsl_root_fsolver brent;
    double newton_state[4], brent_state[12];
} root_solvers;

/* v and dv/dp of material r in the given cells, some of which follow isentropes. */
static void follow_isentropes(const equilibrium_batch *b, const int *id, int n, int r, const double *p, double *v,
                              double *dvdp)
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
        follow_isentropes(b, id, n, r, p, v, dvdp);
    else
        b->eos[r]->model->volume(b->eos[r]->par, (size_t)n, p, T, v, dvdp);
    for (int k = 0; k < n; ++k) {
        sum[k] += a[k] > 0.0 ? a[k] * v[k] : 0.0;
        slope[k] += a[k] > 0.0 ? a[k] * dvdp[k] : 0.0;
    }
    for (int k = 0; k < n && !all; ++k) b->v[r][id[k]] = v[k];
}

/* v, F and dF/dp of the cells named, each at its x, and what that says of its bracket. */
static void evaluate_residual(equilibrium_batch *b, search *const *w, int n, bool all)
{
    double p[EQUILIBRIUM_BATCH], sum[EQUILIBRIUM_BATCH], slope[EQUILIBRIUM_BATCH];
    int id[EQUILIBRIUM_BATCH];
    for (int k = 0; k < n; ++k) {
        id[k] = w[k]->cell;
        p[k] = w[k]->x - w[k]->shift;
        sum[k] = slope[k] = 0.0;
    }
    for (int r = 0; r < b->n; ++r) add_material(b, id, n, all, r, p, sum, slope);
    for (int k = 0; k < n; ++k) {
        search *s = w[k];
        s->F = sum[k] - 1.0;
        s->slope = slope[k];
        if (s->F > 0.0) s->lo = fmax(s->lo, s->x);
        if (s->F < 0.0) s->hi = fmin(s->hi, s->x);
    }
}

/* Evaluates the laws at x, unless that has just been done or x lies outside of the bracket. */
static void evaluate_at(search *s, double x)
{
    if (x == s->x) return;
    s->refused = !(x > 0.0 && x >= s->lo && x <= s->hi && isfinite(x));
    if (s->refused) return;
    s->x = x;
    evaluate_residual(s->b, &s, 1, s->cell == 0);
}

/* Values passed to GSL: never NaN, at which it would abort the program, and never a slope of zero. */
static double passable_value(search *s, double value)
{
    const bool usable = isfinite(value) && value != 0.0;
    s->refused = s->refused || !usable;
    return s->refused ? 1.0 : value;
}

static double slope_of(const search *s)
{
    return s->F + s->x * s->slope;
}

static double shifted_residual(double x, void *params)
{
    search *s = params;
    evaluate_at(s, x);
    return s->F == 0.0 && !s->refused ? 0.0 : passable_value(s, x * s->F);
}

static double shifted_residual_slope(double x, void *params)
{
    search *s = params;
    evaluate_at(s, x);
    return passable_value(s, slope_of(s));
}

static void shifted_and_slope(double x, void *params, double *f, double *df)
{
    *f = shifted_residual(x, params);
    *df = shifted_residual_slope(x, params);
}

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

static void start_search(search *s, equilibrium_batch *b, int cell, double floor)
{
    const double shift = isfinite(floor) && floor > -DBL_MAX ? -floor : 0.0, guess = b->p[cell] + shift;
    *s = (search){.b = b, .cell = cell, .shift = shift, .hi = INFINITY};
    s->x = guess > 0.0 && isfinite(guess) ? guess : first_guess(b, cell, shift);
    b->iterations[cell] = b->fallbacks[cell] = 0;
}

static bool residual_is_small(const search *s)
{
    return gsl_root_test_residual(s->F, EQUILIBRIUM_RESIDUAL) == GSL_SUCCESS;
}

static bool bracket_is_closed(const search *s)
{
    return isfinite(s->hi) && s->lo <= s->hi &&
           gsl_root_test_interval(s->lo, s->hi, 0.0, EQUILIBRIUM_INTERVAL) == GSL_SUCCESS;
}

/* Newton's steps of all cells side by side, so that the laws see them in batches: GSL's method begins where these end. */
static void come_closer(equilibrium_batch *b, search *w, int cells)
{
    search *moving[EQUILIBRIUM_BATCH] = {0};
    int n = 0;
    for (int k = 0; k < cells; ++k) moving[n++] = &w[k];
    evaluate_residual(b, moving, n, true);
    for (int step = 0; step < EQUILIBRIUM_STARTING_STEPS && n > 0; ++step) {
        const int evaluated = n;
        n = 0;
        for (int k = 0; k < evaluated; ++k) {
            search *s = moving[k];
            const double x = s->x - s->x * s->F / slope_of(s);
            if (residual_is_small(s) || !(x > s->lo && x < s->hi)) continue;
            s->x = x;
            b->iterations[s->cell]++;
            moving[n++] = s;
        }
        if (n > 0) evaluate_residual(b, moving, n, n == cells);
    }
}

/* The middle of a wide bracket, whatever is known of it. */
static double bracket_middle(const search *s)
{
    if (isinf(s->hi)) return EQUILIBRIUM_NARROW * s->lo;
    return s->lo > 0.0 ? sqrt(s->lo) * sqrt(s->hi) : s->hi / EQUILIBRIUM_NARROW;
}

/* Brent's method inside the bracket. */
static bool finish_by_brent(search *s, root_solvers *g)
{
    int *iterations = &s->b->iterations[s->cell];
    gsl_root_fsolver_set(&g->brent, &g->f, s->lo, s->hi);
    while (!residual_is_small(s) && !bracket_is_closed(s) && *iterations < EQUILIBRIUM_MOST_ITERATIONS) {
        ++*iterations;
        if (gsl_root_fsolver_iterate(&g->brent) != GSL_SUCCESS || s->refused) return false;
    }
    evaluate_at(s, gsl_root_fsolver_root(&g->brent));
    return residual_is_small(s) || bracket_is_closed(s);
}

/* Newton's method, from where the batch has come; where a step leaves the bracket the middle of a wide one is the next start, and in a narrow one
 * Brent's method ends the search. A start that the laws do not take is left, an iterate is not. */
static bool solve_cell(search *s, root_solvers *g)
{
    equilibrium_batch *b = s->b;
    if (!isfinite(s->F) && b->iterations[s->cell] == 0) evaluate_at(s, first_guess(b, s->cell, s->shift));
    if (residual_is_small(s)) return true;
    g->fdf.params = g->f.params = s;
    gsl_root_fdfsolver_set(&g->newton, &g->fdf, s->x);
    while (!residual_is_small(s) && b->iterations[s->cell] < EQUILIBRIUM_MOST_ITERATIONS) {
        const double lo = s->lo, hi = s->hi;
        if (!isfinite(s->F)) return false;
        if (bracket_is_closed(s)) return true;
        b->iterations[s->cell]++;
        gsl_root_fdfsolver_iterate(&g->newton);
        const double x = gsl_root_fdfsolver_root(&g->newton);
        if (!s->refused && x > lo && x < hi) continue;
        b->fallbacks[s->cell]++;
        s->refused = false;
        if (s->lo > 0.0 && s->hi <= EQUILIBRIUM_NARROW * s->lo) return finish_by_brent(s, g);
        gsl_root_fdfsolver_set(&g->newton, &g->fdf, bracket_middle(s));
    }
    return residual_is_small(s);
}

static bool is_solved(search *s, root_solvers *g)
{
    const bool solved = solve_cell(s, g);
    s->b->p[s->cell] = s->x - s->shift;
    s->b->residual[s->cell] = s->F;
    return solved;
}

floe_status equilibrium_solve(equilibrium_batch *b, int cells)
{
    search w[EQUILIBRIUM_BATCH];
    double floor[EQUILIBRIUM_BATCH];
    root_solvers g = {.fdf = {.f = shifted_residual, .df = shifted_residual_slope, .fdf = shifted_and_slope},
                      .f = {.function = shifted_residual},
                      .newton = {.type = gsl_root_fdfsolver_newton, .state = g.newton_state},
                      .brent = {.type = gsl_root_fsolver_brent, .state = g.brent_state}};
    bool good = gsl_root_fdfsolver_newton->size <= sizeof g.newton_state &&
                gsl_root_fsolver_brent->size <= sizeof g.brent_state;
    if (!good) return FLOE_RETRY;
    find_floors(b, cells, floor);
    for (int k = 0; k < cells; ++k) start_search(&w[k], b, k, floor[k]);
    come_closer(b, w, cells);
    for (int k = 0; k < cells; ++k) {
        b->solved[k] = is_solved(&w[k], &g);
        good = good && b->solved[k];
    }
    return good ? FLOE_OK : FLOE_RETRY;
}
