/* The pressure where a solid leaves fluids no room (numerics 5.3, 5.4).
 *
 * In a cell that a solid all but fills, the mean stress cancels from the balance: the points carry +p_p I, the cells
 * -theta grad P*. What p is there does not matter, but how smooth it is does, since one is differenced on points, the other on
 * faces, and they cancel only to truncation error. The solid's own bulk pressure serves badly: in tension it falls from the
 * fluid's pressure to nothing within a cell of the surface. So p is continued into the solid as smoothly as can be,
 * harmonically: each such cell takes the mean of its neighbours, one sweep a step from where the last step left it.
 * (Measured on the pressurised cylinder, eq. 13 at h = 0.1, 0.05, 0.025: 7.0, 3.8, 2.5 % with the bulk pressure, 6.1, 2.1,
 * 1.6 % continued; more sweeps, or a limit of 0.001 or 0.05 on the room, change the last figure by less than a tenth of it.) */
#include "ice/ice_internal.h"

/* Fluids that fill less than this of a cell beside a solid have no say in its pressure. */
static const double no_room = 0.01;

bool ice_is_continued(const ice *s, const ice_view *v, ptrdiff_t at)
{
    if (!ice_holds_points(v, at)) return false;
    double fluid = 0.0;
    for (int r = 0; r < s->n_materials; ++r)
        if (!s->material[r].points) fluid += v->m[r].theta[at];
    return fluid < no_room;
}

/* What is done with a cell; `last` is the pressure that the step before left. */
typedef void cell_function(const ice_view *v, ptrdiff_t at, const double *last);

static void for_cells_without_room(const ice *s, cell_function *visit)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        ice_view v;
        ice_view_make(s, id, &v);
        const double *last = field_get(s->domain->fields[id], C_PRESSURE, 0, 0);
        const ice_rows q = ice_rows_of(v.b, -1, 0);
#pragma omp parallel for schedule(static)
        for (int row = 0; row < q.n; ++row) {
            const ptrdiff_t base = mesh_index(v.b, 0, ice_row_j(q, row), ice_row_k(q, row));
            for (ptrdiff_t at = base; at < base + v.b->n[0]; ++at)
                if (ice_is_continued(s, &v, at)) visit(&v, at, last);
        }
    }
}

static void start_from_last(const ice_view *v, ptrdiff_t at, const double *last)
{
    v->p[at] = last[at];
}

/* The mean waits in the array of dP, which the next stage fills. */
static void mean_of_neighbours(const ice_view *v, ptrdiff_t at, const double *last)
{
    (void)last;
    double sum = 0.0, weight = 0.0;
    for (int a = 0; a < v->dim; ++a) {
        const double w = v->inv_h[a] * v->inv_h[a];
        sum += w * (v->p[at - v->b->stride[a]] + v->p[at + v->b->stride[a]]);
        weight += 2.0 * w;
    }
    v->dP[at] = sum / weight;
}

static void take_mean(const ice_view *v, ptrdiff_t at, const double *last)
{
    (void)last;
    v->p[at] = v->dP[at];
}

floe_status ice_continue_pressure(ice *s)
{
    for_cells_without_room(s, start_from_last);
    ice_fill_ghosts(s, C_PRESSURE, 0, FILL_NEXT, GHOST_EVEN);
    for_cells_without_room(s, mean_of_neighbours);
    for_cells_without_room(s, take_mean);
    ice_fill_ghosts(s, C_PRESSURE, 0, FILL_NEXT, GHOST_EVEN);
    return FLOE_OK;
}

static void hold(const ice_view *v, ptrdiff_t at, const double *last)
{
    (void)last;
    v->dP[at] = 0.0;
    v->P[at] = v->p[at];
}

void ice_hold_continued(const ice *s)
{
    for_cells_without_room(s, hold);
}
