#include "base/memory.h"
#include "solve/multigrid_level.h"

#include <string.h>

enum { MOST_LEVELS = 3 * 31 };

struct multigrid {
    context *ctx;
    int n;
    double first, memory, second; /* of the Chebyshev polynomial: weight of the first step, the two of the second */
    level level[MOST_LEVELS];
};

/* The polynomial is smallest where D^-1 A has eigenvalues from 1/dim, the least that belongs to a change of sign from
 * cell to cell along a coarsened axis, to 2, the largest there is. */
static void choose_polynomial(multigrid *m, int dim)
{
    const double lo = 1.0 / dim, hi = 2.0, middle = 0.5 * (hi + lo), half = 0.5 * (hi - lo);
    const double sigma = middle / half, rho0 = 1.0 / sigma, rho1 = 1.0 / (2.0 * sigma - rho0);
    m->first = 1.0 / middle;
    m->memory = rho1 * rho0;
    m->second = 2.0 * rho1 / half;
}

/* Axes of about the strength of the strongest are coarsened together, without a stop to smooth between them. */
static const double alike = 0.7;

/* What the choice of axes goes by. */
typedef struct coarsening {
    int dim, n[MESH_MAX_DIM];
    bool periodic[MESH_MAX_DIM];
    double strength[MESH_MAX_DIM]; /* on this level */
    bool together[MESH_MAX_DIM];   /* still to be coarsened with the others, without a stop */
} coarsening;

static int strongest_axis(const coarsening *c)
{
    int axis = -1;
    for (int a = 0; a < c->dim; ++a)
        if (c->n[a] > 1 && (axis < 0 || c->strength[a] > c->strength[axis])) axis = a;
    return axis;
}

/* The axis to coarsen now, -1: none is left. Sets whether the level is one to smooth on. */
static int choose_axis(coarsening *c, bool *smoothed)
{
    *smoothed = false;
    for (int a = 0; a < c->dim; ++a)
        if (c->together[a] && c->n[a] > 1) return a;
    *smoothed = true;
    const int axis = strongest_axis(c);
    for (int a = 0; a < c->dim && axis >= 0; ++a)
        c->together[a] = c->n[a] > 1 && c->strength[a] >= alike * c->strength[axis];
    return axis;
}

static void halve_axis(coarsening *c, int axis)
{
    c->together[axis] = false;
    c->n[axis] = (c->n[axis] + 1) / 2;
    c->strength[axis] *= 0.25;
}

static floe_status fill_level(multigrid *m, level *l, bool finest)
{
    const size_t size = l->grid.size;
    double **array[] = {&l->system.sink, &l->diagonal, &l->inverse, &l->x, &l->y, &l->residual, &l->share};
    for (size_t k = 0; k < sizeof array / sizeof *array; ++k) TRY(memory_new(m->ctx, array[k], size, sizeof(double)));
    for (int a = 0; a < l->grid.dim; ++a) TRY(memory_new(m->ctx, &l->system.link[a], size, sizeof(double)));
    return finest ? FLOE_OK : memory_new(m->ctx, &l->b, size, sizeof(double));
}

static floe_status fill_multigrid(multigrid *m, const solve_grid *g, const double *strength)
{
    coarsening c = {.dim = g->dim};
    memcpy(c.n, g->n, sizeof c.n);
    memcpy(c.periodic, g->periodic, sizeof c.periodic);
    memcpy(c.strength, strength, (size_t)g->dim * sizeof *strength);
    for (int axis = 0; axis >= 0;) {
        level *l = &m->level[m->n++];
        l->grid = solve_grid_make(c.dim, c.n, c.periodic);
        axis = l->axis = choose_axis(&c, &l->smoothed);
        TRY(fill_level(m, l, m->n == 1));
        if (axis >= 0) halve_axis(&c, axis);
    }
    return FLOE_OK;
}

floe_status multigrid_create(multigrid **out, context *ctx, const solve_grid *g, const double *strength)
{
    TRY(memory_new(ctx, out, 1, sizeof **out));
    (*out)->ctx = ctx;
    choose_polynomial(*out, g->dim);
    const floe_status status = fill_multigrid(*out, g, strength);
    if (status != FLOE_OK) multigrid_destroy(out);
    return status;
}

void multigrid_destroy(multigrid **m)
{
    if (!m || !*m) return;
    context *ctx = (*m)->ctx;
    for (int k = 0; k < (*m)->n; ++k) {
        level *l = &(*m)->level[k];
        double **array[] = {
            &l->system.sink,    &l->diagonal,       &l->inverse,        &l->x, &l->y, &l->residual, &l->share,
            &l->system.link[0], &l->system.link[1], &l->system.link[2], &l->b};
        for (size_t i = 0; i < sizeof array / sizeof *array; ++i) memory_free(ctx, array[i]);
    }
    memory_free(ctx, m);
}

link_system multigrid_system(multigrid *m)
{
    return m->level[0].system;
}

void multigrid_prepare(multigrid *m)
{
    level_complete(&m->level[0]);
    for (int k = 0; k + 1 < m->n; ++k) {
        level_coarsen(&m->level[k], &m->level[k + 1]);
        level_complete(&m->level[k + 1]);
    }
}

void multigrid_apply(void *user, double *x, double *y)
{
    const multigrid *m = user;
    level_apply(&m->level[0], x, y);
}

/* Two steps of the polynomial on A x = b; from x, or from 0. The result is in l->x. */
static void smooth_level(const multigrid *m, const level *l, const double *b, bool fresh)
{
    if (fresh)
        level_start(l, b, m->first, l->y, l->x);
    else
        level_relax(l, l->x, l->y, b, 0.0, m->first);
    level_relax(l, l->y, l->x, b, m->memory, m->second);
}

/* Down: b of every level from the residual of the one above. */
static void restrict_residuals(const multigrid *m, const double *b)
{
    for (int k = 0; k + 1 < m->n; ++k) {
        const level *l = &m->level[k];
        const double *here = k == 0 ? b : l->b;
        if (l->smoothed) {
            smooth_level(m, l, here, true);
            level_residual(l, l->x, here, l->residual);
            level_restrict(l, l->residual, l + 1);
        } else {
            level_restrict(l, l->b, l + 1);
        }
    }
}

/* Up: the correction of the level below, smoothed. */
static void prolong_corrections(const multigrid *m, const double *b)
{
    const level *last = &m->level[m->n - 1];
    last->x[last->grid.origin] = last->inverse[last->grid.origin] * (m->n == 1 ? b : last->b)[last->grid.origin];
    for (int k = m->n - 2; k >= 0; --k) {
        const level *l = &m->level[k];
        level_prolong(l, l->x, l + 1, l[1].x, !l->smoothed);
        if (l->smoothed) smooth_level(m, l, k == 0 ? b : l->b, false);
    }
}

void multigrid_cycle(void *user, double *x, double *y)
{
    const multigrid *m = user;
    const level *top = &m->level[0];
    restrict_residuals(m, x);
    prolong_corrections(m, x);
    memcpy(y, top->x, top->grid.size * sizeof *y);
}
