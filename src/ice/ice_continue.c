/* The pressure in cells that a solid fills (theory 5.3, 5.4).
 *
 * In a cell that a solid all but fills, the mean stress cancels from the balance: the points carry +p_p I, the cells
 * -theta grad P*. What p is there does not matter, but how smooth it is does, since one is differenced on points, the
 * other on faces, and they cancel only to truncation error. The solid's own bulk pressure serves badly: in tension it
 * falls from the fluid's pressure to nothing within a cell of the surface. So p is continued into the solid as smoothly
 * as can be, harmonically: each such cell takes the mean of its neighbours, one sweep a step from where the last step
 * left it. (Measured on the pressurised cylinder, eq. 13 at h = 0.1, 0.05, 0.025: 7.0, 3.8, 2.5 % with the bulk
 * pressure, 6.1, 2.1, 1.6 % continued; more sweeps, or a limit of 0.001 or 0.05 on the room, change the last figure by
 * less than a tenth of it.) */
#include "ice/ice_internal.h"

bool ice_is_continued(const ice *s, const ice_view *v, ptrdiff_t at)
{
    if (!ice_holds_points(v, at)) return false;
    double fluid = 0.0;
    for (int r = 0; r < s->n_materials; ++r)
        if (!s->material[r].points) fluid += v->m[r].theta[at];
    return fluid < ICE_LEAST_FLUID_FRACTION;
}

/* Lists a block's cells without fluid volume, in order; the list is valid until the next equilibrium. */
static void list_continued(const ice *s, const ice_view *v, ice_cell_list *list)
{
    const ice_rows q = ice_rows_of(v->b, -1, 0);
    list->n = 0;
    for (int row = 0; row < q.n; ++row) {
        const ptrdiff_t base = mesh_index(v->b, 0, ice_row_j(q, row), ice_row_k(q, row));
        for (ptrdiff_t at = base; at < base + v->b->n[0]; ++at)
            if (ice_is_continued(s, v, at)) list->at[list->n++] = at;
    }
}

/* From the pressure that the step before left. */
static void start_from_last(ice *s)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        ice_view v;
        ice_view_make(s, id, &v);
        const double *last = field_get(s->domain->fields[id], C_PRESSURE, 0, 0);
        ice_cell_list *list = &s->work->continued[id];
        list_continued(s, &v, list);
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
static void take_means(const ice *s)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        ice_view v;
        ice_view_make(s, id, &v);
        const ice_cell_list *list = &s->work->continued[id];
#pragma omp parallel for schedule(static)
        for (size_t n = 0; n < list->n; ++n) v.dP[list->at[n]] = mean_of_neighbours(&v, list->at[n]);
        for (size_t n = 0; n < list->n; ++n) v.p[list->at[n]] = v.dP[list->at[n]];
    }
}

floe_status ice_continue_pressure(ice *s)
{
    start_from_last(s);
    ice_fill_ghosts(s, C_PRESSURE, 0, FILL_NEXT, GHOST_EVEN);
    take_means(s);
    ice_fill_ghosts(s, C_PRESSURE, 0, FILL_NEXT, GHOST_EVEN);
    return FLOE_OK;
}

void ice_constrain_continued(const ice *s)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        ice_view v;
        ice_view_make(s, id, &v);
        const ice_cell_list *list = &s->work->continued[id];
        for (size_t n = 0; n < list->n; ++n) {
            v.dP[list->at[n]] = 0.0;
            v.P[list->at[n]] = v.p[list->at[n]];
        }
    }
}
