#include "coupling/equilibrium.h"

#include <float.h>
#include <math.h>

enum { MOST_ITERATIONS = 200 };

static const double residual_tolerance = 1e-13;

/* Newton's method on G(x) = x F(x - shift) of one cell. */
typedef struct newton {
    double shift;    /* makes x = p + shift positive exactly where every law is defined */
    double x, f, df; /* the iterate, G and dG/dx there */
    double lo, hi;   /* G > 0 at lo, G < 0 at hi; 0 and infinity while unknown */
} newton;

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

/* p, v and F of the cells named at their x, and G and its derivative. */
static void evaluate(equilibrium_cell *cell, newton *w, const int *id, int n)
{
    double sum[EQUILIBRIUM_BATCH], slope[EQUILIBRIUM_BATCH];
    for (int k = 0; k < n; ++k) {
        cell[id[k]].p = w[id[k]].x - w[id[k]].shift;
        sum[k] = slope[k] = 0.0;
    }
    for (int r = 0; r < cell->n; ++r) add_material(cell, id, n, r, sum, slope);
    for (int k = 0; k < n; ++k) {
        newton *s = &w[id[k]];
        const double F = sum[k] - 1.0;
        cell[id[k]].residual = F;
        s->f = s->x * F;
        s->df = F + s->x * slope[k];
    }
}

static void tighten(newton *s)
{
    if (s->f > 0.0) s->lo = fmax(s->lo, s->x);
    if (s->f < 0.0) s->hi = fmin(s->hi, s->x);
}

/* Inside an open bracket, whatever is known of it. */
static double middle(const newton *s)
{
    if (isinf(s->hi)) return 32.0 * s->lo;
    return s->lo > 0.0 ? sqrt(s->lo) * sqrt(s->hi) : s->hi / 32.0;
}

/* The next x. */
static void iterate(equilibrium_cell *c, newton *s)
{
    c->iterations++;
    const double x = s->x - s->f / s->df;
    const bool inside = x > s->lo && x < s->hi;
    s->x = inside ? x : middle(s);
    c->fallbacks += !inside;
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

static newton start(const equilibrium_cell *c)
{
    double floor = -DBL_MAX;
    for (int r = 0; r < c->n; ++r)
        if (c->a[r] > 0.0) floor = fmax(floor, c->eos[r]->model->pressure_floor(c->eos[r]->par));
    newton s = {.shift = isfinite(floor) && floor > -DBL_MAX ? -floor : 0.0, .hi = INFINITY};
    const double guess = c->p + s.shift;
    s.x = guess > 0.0 && isfinite(guess) ? guess : first_guess(c, s.shift);
    return s;
}

static bool converged(const equilibrium_cell *c, const newton *s)
{
    return fabs(c->residual) < residual_tolerance || (isfinite(s->hi) && s->hi - s->lo <= 4.0 * DBL_EPSILON * s->hi);
}

/* Another iteration may help; a start that the laws do not take is left, an iterate is not. */
static bool goes_on(const equilibrium_cell *c, const newton *s)
{
    return c->iterations == 0 || (isfinite(s->f) && isfinite(s->df) && c->iterations < MOST_ITERATIONS);
}

/* Up to EQUILIBRIUM_BATCH cells: all that still move take their iterations together, so that the laws see them in batches. */
static bool solve_batch(equilibrium_cell *cell, int n)
{
    newton w[EQUILIBRIUM_BATCH];
    int id[EQUILIBRIUM_BATCH], moving = n;
    bool good = true;
    for (int k = 0; k < n; ++k) {
        w[k] = start(&cell[k]);
        cell[k].iterations = cell[k].fallbacks = 0;
        id[k] = k;
    }
    while (moving > 0) {
        const int evaluated = moving;
        evaluate(cell, w, id, evaluated);
        moving = 0;
        for (int k = 0; k < evaluated; ++k) {
            equilibrium_cell *c = &cell[id[k]];
            newton *s = &w[id[k]];
            tighten(s);
            c->solved = converged(c, s);
            if (c->solved) continue;
            if (goes_on(c, s)) {
                iterate(c, s);
                id[moving++] = id[k];
            } else {
                good = false;
            }
        }
    }
    return good;
}

floe_status equilibrium_solve(equilibrium_cell *cell, int n)
{
    bool good = true;
    for (int first = 0; first < n; first += EQUILIBRIUM_BATCH)
        good = solve_batch(cell + first, n - first < EQUILIBRIUM_BATCH ? n - first : EQUILIBRIUM_BATCH) && good;
    return good ? FLOE_OK : FLOE_RETRY;
}
