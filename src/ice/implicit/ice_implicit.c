/* The implicit pressure (theory 3): the pressure that moves the faces is the one at the end of the step,
 *
 *     u* = u*_0 - phi dt/h v^ (y_R - y_L),     y = phi dP,     dP = -(dt/V) sum_f A_f F / S,     F = sum_r theta^r,f u*^r,
 *
 * so that sound bounds no step. u*_0 is u* by the pressure at the start, with its advection over the step; v^ is what a
 * gradient of pressure does to a material after exchange, which is linear: u* is exact in y, and only the upwind
 * theta^r,f make a search of it. With one fluid one solve does. phi is 1 (backward Euler, which damps what it does not
 * resolve), or 1/2 with `centring: half` (the midpoint rule, which keeps all sound there is).
 *
 * The rows for y are symmetric: S/phi on the diagonal, dt^2 phi M / h^2 between two cells, M = sum_r theta^r,f v^r; all
 * times the cell's volume. They are solved by conjugate gradients with multigrid. */
#include "ice/implicit/ice_implicit.h"

#include "base/memory.h"
#include "ice/fraction/ice_fraction.h"
#include "ice/ice_constants.h"
#include "ice/sides/ice_sides.h"
#include "ice/state/ice_materials.h"

#include <math.h>

static bool is_weighted(const ice *s)
{
    return s->mesh->geometry == MESH_AXISYMMETRIC;
}

static void set_weights(const ice *s, ice_implicit *w)
{
    const double box = mesh_box_volume(s->mesh);
    for (int row = 0; row < solve_rows(&w->grid); ++row)
        for (int i = 0; i < w->grid.n[0]; ++i)
            w->weight[solve_row(&w->grid, row) + i] = box / mesh_cell_volume(s->mesh, i);
}

static floe_status fill_implicit(const ice *s, ice_implicit *w)
{
    double strength[MESH_MAX_DIM];
    for (int a = 0; a < MESH_MAX_DIM; ++a) strength[a] = 1.0 / (s->mesh->h[a] * s->mesh->h[a]);
    w->grid = solve_grid_of_cells(s->mesh);
    TRY(multigrid_of_cells(&w->m, s->ctx, &w->grid, strength));
    if (!s->cut) TRY(cg_create(&w->c, s->ctx, &w->grid, 1, ICE_MOST_CG));
    TRY(memory_new(s->ctx, &w->b, w->grid.size, sizeof(double)));
    TRY(memory_new(s->ctx, &w->x, w->grid.size, sizeof(double)));
    TRY(memory_new(s->ctx, &w->tile, (size_t)solve_rows(&w->grid), sizeof(double)));
    if (!is_weighted(s)) return FLOE_OK;
    TRY(memory_new(s->ctx, &w->weight, w->grid.size, sizeof(double)));
    set_weights(s, w);
    return FLOE_OK;
}

floe_status ice_implicit_create(ice *s)
{
    TRY(memory_new(s->ctx, &s->rows, (size_t)s->n_regions, sizeof(ice_implicit)));
    for (int g = 0; g < s->n_regions; ++g) TRY(fill_implicit(s, &s->rows[g])); /* what it has made goes with the work */
    return FLOE_OK;
}

static void free_implicit(context *ctx, ice_implicit *w)
{
    multigrid_destroy(&w->m);
    cg_destroy(&w->c);
    memory_free(ctx, &w->b);
    memory_free(ctx, &w->x);
    memory_free(ctx, &w->weight);
    memory_free(ctx, &w->tile);
}

void ice_implicit_destroy(context *ctx, ice_implicit **w, int n_regions)
{
    for (int g = 0; *w && g < n_regions; ++g) free_implicit(ctx, &(*w)[g]);
    memory_free(ctx, w);
}

floe_status ice_implicit_give_up(const ice *s, double residual, double best, int outer)
{
    return fail(
        s->ctx, FLOE_RETRY,
        "implicit pressure: volumes are off by %.3g of a cell after %d outer iterations (best %.3g, asked for %.3g)",
        residual, outer, best, s->scene->method.pressure_tolerance);
}

void ice_implicit_tally(const ice *s, int outer, int iterations)
{
    ledger_tally(s->ledger, COUNT_PRESSURE_SOLVES, 1);
    ledger_tally(s->ledger, COUNT_OUTER_ITERATIONS, outer);
    ledger_tally(s->ledger, COUNT_CG_ITERATIONS, iterations);
}

double ice_implicit_tolerance(const ice *s, const ice_implicit *w, double residual)
{
    const double cells = (double)w->grid.n[0] * w->grid.n[1] * w->grid.n[2];
    return fmin(ICE_SHARE_OF_TOLERANCE * s->scene->method.pressure_tolerance * sqrt(sqrt(cells)),
                ICE_SHARE_OF_RESIDUAL * residual);
}

static int solve_once(ice *s, const ice_region *g, double residual)
{
    const ice_implicit *w = &s->rows[g->number];
    const double tolerance = ice_implicit_tolerance(s, w, residual);
    const cg_system system = {multigrid_apply, multigrid_cycle, w->m, CG_WEIGHTED, w->weight};
    return cg_solve_afresh(w->c, &system, tolerance, w->b, w->x).iterations;
}

void ice_implicit_fractions(const ice *s, const ice_region *g)
{
    /* The outflow of ghost cells at interfaces bounds what they give up. */
    for (int r = g->first; ice_has_interfaces(s, g) && r < g->first + g->n; ++r) ice_fill_faces(s, F_VEL, r);
    ice_view v;
    for (int id = 0; g->n > 1 && ice_next_view(s, g, &id, &v);) ice_face_fractions(&v);
    if (g->n > 1 && s->cut) s->cut->bound_outflow(s, g);
}

/* The search for y. */
static floe_status search_pressure_step(ice *s, const ice_region *g)
{
    const double tolerance = s->scene->method.pressure_tolerance;
    double best = INFINITY;
    int iterations = 0;
    for (int outer = 0;; ++outer) {
        ice_implicit_fractions(s, g);
        const double residual = ice_implicit_residual(s, g);
        if (residual <= tolerance) {
            ice_implicit_tally(s, outer, iterations);
            return FLOE_OK;
        }
        if (!(residual < ICE_HOPELESS_RESIDUAL * best) || outer == ICE_MOST_OUTER)
            return ice_implicit_give_up(s, residual, best, outer);
        best = fmin(best, residual);
        if (outer == 0 || g->n > 1) TRY(ice_implicit_matrix(s, g));
        iterations += solve_once(s, g, residual);
        ice_implicit_take(s, g);
        ice_implicit_push(s, g);
    }
}

floe_status ice_implicit_pressure_of(ice *s, const ice_region *g)
{
    TRY(ice_implicit_begin(s, g));
    ice_implicit_centre(s, g);
    ice_implicit_guess(s, g);
    ice_implicit_push(s, g);
    TRY(search_pressure_step(s, g));
    for (int r = g->first; g->n > 1 && r < g->first + g->n; ++r) ice_fill_faces(s, F_VEL, r);
    ice_implicit_finish(s, g);
    return FLOE_OK;
}
