/* The pressure in cells that a solid fills (theory 5.3, 5.4).
 *
 * In a cell that a solid nearly fills, the pressure cancels from the balance: the points carry +p_p I, the cells -theta grad P*. Its value there does not
 * matter, but its smoothness does, since one term is differenced on points and the other on faces, and they cancel only to truncation error. The solid's own
 * bulk pressure is not smooth: in tension it falls from the fluid's pressure to zero within a cell of the surface. So p is continued into the solid
 * harmonically: each such cell takes the mean of its neighbours, one sweep a step, starting from the last step. (Measured on the pressurised cylinder, eq. 13
 * at h = 0.1, 0.05, 0.025: 7.0, 3.8, 2.5 % with the bulk pressure, 6.1, 2.1, 1.6 % continued; more sweeps, or a limit of 0.001 or 0.05 on the fluid's
 * fraction, change the last figure by less than a tenth of it.) */
#include "base/memory.h"
#include "ice/ice_constants.h"
#include "ice/points/ice_points.h"
#include "ice/sides/ice_sides.h"
#include "ice/state/ice_lists.h"

/* Cells inside a solid whose pressure is extrapolated from the fluid. */
typedef struct ice_continued {
    ice_cell_list block[MESH_MAX_BLOCKS];
} ice_continued;

floe_status ice_continued_create(ice *s)
{
    TRY(memory_new(s->ctx, &s->continued, 1, sizeof *s->continued));
    return ice_lists_create(s, s->continued->block);
}

void ice_continued_destroy(context *ctx, ice_continued **w)
{
    if (*w) ice_lists_destroy(ctx, (*w)->block);
    memory_free(ctx, w);
}

bool ice_is_continued(const ice_view *v, ptrdiff_t at)
{
    if (!ice_holds_points(v, at)) return false;
    double fluid = 0.0;
    for (int r = 0; r < v->n_materials; ++r)
        if (!v->material[r].points) fluid += v->m[r].theta[at];
    return fluid < ICE_LEAST_FLUID_FRACTION;
}

/* Lists a block's cells without fluid volume, in order; the list is valid until the next equilibrium. */
static void list_continued(const ice_view *v, ice_cell_list *list)
{
    const ice_rows q = ice_rows_of(v->b, -1, 0);
    list->n = 0;
    for (int row = 0; row < q.n; ++row) {
        const ptrdiff_t base = ice_row_start(v->b, q, row);
        for (ptrdiff_t at = base; at < base + v->b->n[0]; ++at)
            if (ice_is_continued(v, at)) list->at[list->n++] = at;
    }
}

/* From the pressure that the step before left. */
static void start_from_last(ice *s, const ice_region *g)
{
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);) {
        const double *last = field_get(s->domain->fields[v.b->id], C_PRESSURE, g->number, 0);
        ice_cell_list *list = &s->continued->block[v.b->id];
        list_continued(&v, list);
        for (size_t n = 0; n < list->n; ++n) v.p[list->at[n]] = last[list->at[n]];
    }
}

static double mean_of_neighbours(const ice_view *v, ptrdiff_t at)
{
    double sum = 0.0, weight = 0.0;
    for (int a = 0; a < v->dim; ++a) {
        const double w = v->inv_h[a] * v->inv_h[a];
        sum += w * (v->p[at - v->b->stride[a]] + v->p[at + v->b->stride[a]]);
        weight += 2.0 * w;
    }
    return sum / weight;
}

/* The means wait in the array of dP, which the next stage fills. */
static void take_means(const ice *s, const ice_region *g)
{
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);) {
        const ice_cell_list *list = &s->continued->block[v.b->id];
#pragma omp parallel for schedule(static)
        for (size_t n = 0; n < list->n; ++n) v.dP[list->at[n]] = mean_of_neighbours(&v, list->at[n]);
        for (size_t n = 0; n < list->n; ++n) v.p[list->at[n]] = v.dP[list->at[n]];
    }
}

floe_status ice_continue_pressure_of(ice *s, const ice_region *g)
{
    start_from_last(s, g);
    ice_fill_ghosts(s, C_PRESSURE, g->number, FILL_NEXT, GHOST_EVEN);
    take_means(s, g);
    ice_fill_ghosts(s, C_PRESSURE, g->number, FILL_NEXT, GHOST_EVEN);
    return FLOE_OK;
}

void ice_constrain_continued(const ice *s, const ice_region *g)
{
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);) {
        const ice_cell_list *list = &s->continued->block[v.b->id];
        for (size_t n = 0; n < list->n; ++n) {
            v.dP[list->at[n]] = 0.0;
            v.P[list->at[n]] = v.p[list->at[n]];
        }
    }
}
