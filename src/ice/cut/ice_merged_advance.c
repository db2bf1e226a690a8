/* Advection over the step in the velocities of faces beside cells that walls cut (theory 7.8; 2.2 leaves it out where the centring is that of shocks):
 *
 *     u* += sum_k rho_k A_k / (rho_L + rho_R),     A = -dt (u . grad) u (1 - M^2),     k: of the cells on both sides those that are cut
 *
 * with the velocities at t^n, those of covered cells as the fluid sticks to the wall. Without it the pressure depended on the step at first order. */
#include "ice/cut/ice_merged_cells.h"
#include "ice/cut/ice_merged_pieces.h"

/* What advection does to a velocity along an axis in a cell in the time by which u* is ahead. */
static double advance_of(const ice_view *v, int axis, ptrdiff_t at)
{
    const ice_fluid *m = &v->m[0];
    double sum = 0.0, square = 0.0;
    for (int a = 0; a < v->dim; ++a) {
        const ptrdiff_t st = v->b->stride[a];
        sum += m->u[a][at] * v->inv_h[a] * (m->u[axis][at + st] - m->u[axis][at - st]);
        square += m->u[a][at] * m->u[a][at];
    }
    return -0.25 * v->dt * v->limit_hi * v->advance * sum * most(1.0 - square / (m->c[at] * m->c[at]), 0.0);
}

static void advance_face(const ice *s, const ice_merged_cells *p, const ice_view *v, int axis, const int in[3])
{
    const block *b = v->b;
    const ptrdiff_t R = mesh_index(b, in[0], in[1], in[2]), beside[2] = {R - b->stride[axis], R};
    const double *rho = v->m[0].rho, both = rho[beside[0]] + rho[beside[1]];
    double gain = 0.0;
    for (int side = 0; side < 2; ++side) {
        int cell[3] = {b->lo[0] + in[0], b->lo[1] + in[1], b->lo[2] + in[2]};
        if (!mesh_step(s->mesh, cell, axis, side - 1)) return; /* a side of the domain */
        const int k = p->place[cut_index(s->mesh, cell)];
        if (k < 0 || !(p->member[k].open > 0.0) || v->shock[beside[side]] < 1.0) continue;
        gain += rho[beside[side]] / both * advance_of(v, axis, beside[side]);
    }
    v->m[0].fu[axis][R] += gain;
}

void ice_merged_advance(const ice *s, const ice_region *g)
{
    const ice_merged_cells *p = ice_merged_cells_of(s, g);
    if (!ice_covered_stick(s)) return;
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        const ice_view *v = &s->cut_cells->view[id];
        for (int axis = 0; axis < v->dim; ++axis) {
            const ice_rows q = ice_rows_of(v->b, axis, 0);
#pragma omp parallel for schedule(static)
            for (int row = 0; row < q.n; ++row)
                for (int i = 0; i < v->b->n[0] + (axis == 0); ++i)
                    advance_face(s, p, v, axis, (const int[]){i, ice_row_j(q, row), ice_row_k(q, row)});
        }
    }
}
