/* Multigrid for cells that are linked through their faces. */
#include "base/memory.h"
#include "solve/cell_level.h"
#include "solve/multigrid_level.h"

#include <string.h>

/* The polynomial is smallest where D^-1 A has eigenvalues from 1/dim, the least that belongs to a change of sign from
 * cell to cell along a coarsened axis, to 2, the largest there is. */
static void choose_polynomial(cell_level *l, int dim)
{
    const double lo = 1.0 / dim, hi = 2.0, middle = 0.5 * (hi + lo), half = 0.5 * (hi - lo);
    const double sigma = middle / half, rho0 = 1.0 / sigma, rho1 = 1.0 / (2.0 * sigma - rho0);
    l->first = 1.0 / middle;
    l->memory = rho1 * rho0;
    l->second = 2.0 * rho1 / half;
}

/* Axes of about the strength of the strongest are coarsened together, without a stop to smooth between them. */
static const double alike = 0.7;

/* The criterion for the choice of axes. */
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

static cell_level *cells_of(const multigrid_level *l)
{
    return l->own;
}

static void free_cells(context *ctx, void *own)
{
    cell_level *l = own;
    double **array[] = {&l->system.sink,    &l->diagonal,       &l->inverse,       &l->y, &l->residual, &l->share,
                        &l->system.link[0], &l->system.link[1], &l->system.link[2]};
    for (size_t k = 0; k < sizeof array / sizeof *array; ++k) memory_free(ctx, array[k]);
}

static floe_status fill_cells(context *ctx, cell_level *l)
{
    const size_t size = l->grid.size;
    double **array[] = {&l->system.sink, &l->diagonal, &l->inverse, &l->y, &l->residual, &l->share};
    choose_polynomial(l, l->grid.dim);
    for (size_t k = 0; k < sizeof array / sizeof *array; ++k) TRY(memory_new(ctx, array[k], size, sizeof(double)));
    for (int a = 0; a < l->grid.dim; ++a) TRY(memory_new(ctx, &l->system.link[a], size, sizeof(double)));
    return FLOE_OK;
}

static floe_status add_cells(multigrid *m, const solve_grid *g, const double *strength)
{
    coarsening c = {.dim = g->dim};
    memcpy(c.n, g->n, sizeof c.n);
    memcpy(c.periodic, g->periodic, sizeof c.periodic);
    memcpy(c.strength, strength, (size_t)g->dim * sizeof *strength);
    for (int axis = 0; axis >= 0;) {
        const solve_grid grid = solve_grid_make(c.dim, c.n, c.periodic);
        cell_level *l;
        TRY(multigrid_add(m, grid.size, sizeof *l, &l));
        l->grid = grid;
        axis = l->axis = choose_axis(&c, &l->smoothed);
        TRY(fill_cells(m->ctx, l));
        if (axis >= 0) halve_axis(&c, axis);
    }
    return FLOE_OK;
}

static void apply_cells(const multigrid_level *l, double *x, double *y)
{
    cell_level_apply(cells_of(l), x, y);
}

/* Two steps of the polynomial. */
static void smooth_cells(const multigrid_level *l, const double *b, bool fresh)
{
    const cell_level *c = cells_of(l);
    if (!c->smoothed) return;
    if (fresh)
        cell_level_start(c, b, c->first, c->y, l->x);
    else
        cell_level_relax(c, l->x, c->y, b, 0.0, c->first);
    cell_level_relax(c, c->y, l->x, b, c->memory, c->second);
}

static void restrict_cells(const multigrid_level *l, const double *b, const multigrid_level *coarse)
{
    const cell_level *c = cells_of(l);
    if (c->smoothed) cell_level_residual(c, l->x, b, c->residual);
    cell_level_restrict(c, c->smoothed ? c->residual : l->b, cells_of(coarse), coarse->b);
}

static void prolong_cells(const multigrid_level *l, const multigrid_level *coarse)
{
    const cell_level *c = cells_of(l);
    cell_level_prolong(c, l->x, cells_of(coarse), coarse->x, !c->smoothed);
}

/* Of one cell. */
static void solve_last_cell(const multigrid_level *l, const double *b)
{
    const cell_level *c = cells_of(l);
    l->x[c->grid.origin] = c->inverse[c->grid.origin] * b[c->grid.origin];
}

static bool is_one_cell(const multigrid_level *l)
{
    return cells_of(l)->axis < 0;
}

static floe_status complete_cells(const multigrid_level *l)
{
    cell_level_complete(cells_of(l));
    return FLOE_OK;
}

static floe_status coarsen_cells(const multigrid_level *l, const multigrid_level *coarse)
{
    cell_level_complete(cells_of(l));
    cell_level_coarsen(cells_of(l), cells_of(coarse));
    return FLOE_OK;
}

floe_status multigrid_of_cells(multigrid **out, context *ctx, const solve_grid *g, const double *strength)
{
    static const multigrid_kind cells = {apply_cells, smooth_cells,  restrict_cells, prolong_cells, solve_last_cell,
                                         is_one_cell, coarsen_cells, complete_cells, free_cells};
    TRY(multigrid_new(out, ctx, &cells));
    const floe_status status = add_cells(*out, g, strength);
    if (status != FLOE_OK) multigrid_destroy(out);
    return status;
}

link_system multigrid_links(multigrid *m)
{
    return cells_of(&m->level[0])->system;
}
