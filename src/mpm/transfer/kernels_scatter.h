/* From points to nodes, axis by axis (kernels_body.h). */
#ifndef MPM_KERNELS_SCATTER_H
#define MPM_KERNELS_SCATTER_H

#include "mpm/transfer/lanes.h"
#include "mpm/transfer/locate.h"

/* What is wanted of a scatter: literals. `centred`: no gradients of S here; `affine`: points bring C_p (transfer.h). */
typedef struct scatter_want {
    bool momentum, force, centred, affine;
} scatter_want;

/* What a point gives to a node: S (m, m v + m C r) to mass and momentum, S b + T grad S to force. */
typedef struct point_gift {
    lanes m, C[3]; /* (m, m v); (0, column of m C) */
    lanes b, T[3]; /* m b, and the hoop's; columns of -V (sigma + p_p I - q I) */
} point_gift;

/* Contribution to the i-th node along an axis, after the factor of that axis in the product of weights is applied. r:
 * from the point to the node (m). */
FLOE_ALWAYS_INLINE point_gift give_along(const point_gift *g, const int axis, double w, double dw, double r,
                                         const int dim, const scatter_want want)
{
    const int M = lanes_of(1 + dim), F = lanes_of(dim);
    point_gift to = *g;
    if (want.affine) to.m = lanes_plus(to.m, r, g->C[axis], M);
    if (want.momentum) to.m = lanes_times(w, to.m, M);
    if (want.force) to.b = lanes_times(w, g->b, F);
    if (want.force && !want.centred) to.b = lanes_plus(to.b, dw, g->T[axis], F);
    for (int c = 0; c < axis; ++c) {
        if (want.affine) to.C[c] = lanes_times(w, g->C[c], M);
        if (want.force && !want.centred) to.T[c] = lanes_times(w, g->T[c], F);
    }
    return to;
}

/* Adds contributions to the nodes of a row. */
FLOE_ALWAYS_INLINE void scatter_row(const point_gift *g, const stencils *s, int j, const double h[3],
                                    double *restrict node, const int record, const int dim, const int basis,
                                    const scatter_want want)
{
    const int M = want.momentum ? lanes_of(1 + dim) : 0, F = lanes_of(dim);
    for (int x = 0; x < basis_support(basis); ++x, node += record) {
        const point_gift own = give_along(g, 0, s->w[0][x][j], s->dw[0][x][j], s->offset[0][j] + x * h[0], dim, want);
        if (want.momentum) lanes_add_to(node, own.m, M);
        if (want.force) lanes_add_to(node + M, own.b, F);
    }
}

FLOE_ALWAYS_INLINE void scatter_plane(const point_gift *g, const stencils *s, int j, const double h[3],
                                      double *restrict node, const int record, const int dim, const int basis,
                                      const scatter_want want)
{
    const int width = window_width(dim, basis);
    for (int y = 0; y < basis_support(basis); ++y, node += width * record) {
        const point_gift row = give_along(g, 1, s->w[1][y][j], s->dw[1][y][j], s->offset[1][j] + y * h[1], dim, want);
        scatter_row(&row, s, j, h, node, record, dim, basis, want);
    }
}

/* Adds a point's gift by its j-th stencil to the window; `record`: doubles from node to node. */
FLOE_ALWAYS_INLINE void scatter_stencil(const point_gift *g, const stencils *s, int j, const double h[3],
                                        double *restrict window, const int record, const int dim, const int basis,
                                        const scatter_want want)
{
    const int width = window_width(dim, basis);
    double *restrict node = window + (ptrdiff_t)s->node[j] * record;
    if (dim == 1) scatter_row(g, s, j, h, node, record, dim, basis, want);
    if (dim == 2) scatter_plane(g, s, j, h, node, record, dim, basis, want);
    for (int z = 0; dim == 3 && z < basis_support(basis); ++z, node += width * width * record) {
        const point_gift plane = give_along(g, 2, s->w[2][z][j], s->dw[2][z][j], s->offset[2][j] + z * h[2], dim, want);
        scatter_plane(&plane, s, j, h, node, record, dim, basis, want);
    }
}

/* Moves what a ghost beyond a side that extrapolates got of a point's C to where the fold of the weights has it. Folded (wall.c), the
 * ghost's share of the weight is +2 at the node on the side and -1 at the first inner one, of the velocity v + C (x - x_p) there, whereas
 * the fold of what the ghost got has that of the velocity at the ghost for both. The sums are the same, but next to the side the inner
 * node, with all but no weight left, would get a momentum all the same: a velocity without bound. `ghost`: in the window. */
static void move_affine(const mesh *m, const double C[9], int axis, ptrdiff_t inward, double share, double *ghost)
{
    const double distance = inward > 0 ? m->h[axis] : -m->h[axis];
    for (int a = 0; a < m->dim; ++a) {
        const double momentum = 2.0 * share * C[m->dim * a + axis] * distance;
        ghost[inward + a] += momentum;
        ghost[2 * inward + a] -= momentum;
    }
}

/* The same for the ghosts at one end of a stencil along an axis. */
static void move_affine_row(const mesh *m, const double C[9], const stencils *s, int j, int axis, int side, double mass,
                            int record, const int basis, double *out)
{
    const int n = basis_support(basis), width = window_width(m->dim, basis), stride[3] = {1, width, width * width};
    const ptrdiff_t inward = (ptrdiff_t)record * (side == SIDE_LOWER ? stride[axis] : -stride[axis]);
    int lo[3] = {0, 0, 0}, hi[3] = {1, 1, 1};
    for (int a = 0; a < m->dim; ++a) hi[a] = n;
    lo[axis] = side == SIDE_LOWER ? 0 : n - 1;
    hi[axis] = lo[axis] + 1;
    for (int z = lo[2]; z < hi[2]; ++z)
        for (int y = lo[1]; y < hi[1]; ++y)
            for (int x = lo[0]; x < hi[0]; ++x) {
                const ptrdiff_t node = s->node[j] + x + (ptrdiff_t)stride[1] * y + (ptrdiff_t)stride[2] * z;
                const double S =
                    s->w[0][x][j] * (m->dim > 1 ? s->w[1][y][j] : 1.0) * (m->dim > 2 ? s->w[2][z][j] : 1.0);
                move_affine(m, C, axis, inward, mass * S, out + node * record);
            }
}

/* The same for a stencil that may reach beyond the mesh; `out`: the momentum of the window's first node. */
FLOE_ALWAYS_INLINE void extend_affine(const mesh *m, const point_arrays *p, size_t k, const double C[9],
                                      const stencils *s, int j, int record, const int dim, const int basis, double *out)
{
    for (int a = 0; basis_reach(basis) > 0 && a < dim; ++a) {
        const double first = p->x[a][k] + s->offset[a][j], last = first + (basis_support(basis) - 1) * m->h[a],
                     half = 0.5 * m->h[a];
        if (first < p->linear_side[a][SIDE_LOWER] - half)
            move_affine_row(m, C, s, j, a, SIDE_LOWER, p->mass[k], record, basis, out);
        if (last > p->linear_side[a][SIDE_UPPER] + half)
            move_affine_row(m, C, s, j, a, SIDE_UPPER, p->mass[k], record, basis, out);
    }
}

/* (m, m v) and (0, m C). */
FLOE_ALWAYS_INLINE void give_momentum(point_gift *g, const point_arrays *p, size_t k, const int dim, const bool affine)
{
    const int M = lanes_of(1 + dim);
    const double m = p->mass[k];
    double mv[4] = {m};
    for (int a = 0; a < dim; ++a) mv[1 + a] = m * p->v[a][k];
    g->m = lanes_from(mv[0], mv[1], mv[2], mv[3], M);
    for (int c = 0; affine && c < dim; ++c) {
        double column[4] = {0.0};
        for (int a = 0; a < dim; ++a) column[1 + a] = m * p->affine[dim * a + c][k];
        g->C[c] = lanes_from(column[0], column[1], column[2], column[3], M);
    }
}

/* m b and the columns of -V (sigma + p_p I - q I), of which the stress acts in the plane of the nodes; returns that about the axis. */
FLOE_ALWAYS_INLINE double give_force(point_gift *g, const point_arrays *p, size_t k, const double body_force[3],
                                     const int dim, const bool axisymmetric, const bool centred)
{
    static const int stored[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}; /* xx yy zz xy yz zx */
    const int F = lanes_of(dim);
    const double minus_v = -p->volume0[k] * p->J[k];
    const double add = (p->grid_pressure ? p->grid_pressure[k] : 0.0) - (p->q ? p->q[k] : 0.0) + p->enclosed_pressure;
    for (int c = 0; c < dim; ++c) {
        double column[4] = {0.0};
        for (int a = 0; a < dim; ++a) column[a] = minus_v * (p->stress[stored[a][c]][k] + (a == c ? add : 0.0));
        g->T[c] = lanes_from(column[0], column[1], column[2], 0.0, F);
    }
    const double hoop = axisymmetric ? minus_v * (p->stress[2][k] + add) : 0.0;
    double b[4] = {0.0};
    for (int a = 0; a < dim; ++a) b[a] = p->mass[k] * (body_force[a] + (p->drive[a] ? p->drive[a][k] : 0.0));
    if (axisymmetric && !centred) b[0] += hoop / p->x[0][k];
    g->b = lanes_from(b[0], b[1], b[2], 0.0, F);
    return hoop;
}

/* f_i = -V (sigma + p_p I - q I) . grad S + S m b (theory 4.1); hoop term of theory 4.5. `centred`: grad S is taken
 * elsewhere than S (locate.h). */
FLOE_ALWAYS_INLINE void scatter_body(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end,
                                     double *restrict out, const int dim, const bool axisymmetric, const int basis,
                                     const scatter_want want)
{
    const int M = want.momentum ? lanes_of(1 + dim) : 0, F = want.force ? lanes_of(dim) : 0;
    const tile_frame frame = frame_of(m, t, dim);
    const double body_force[3] = {p->acceleration[0], p->acceleration[1], p->acceleration[2]};
    stencils s, centres;
    for (int n; start < end; start += (size_t)n) {
        n = strip_length(start, end, dim, basis);
        locate(&s, m, &frame, p, start, n, dim, basis);
        if (want.force && want.centred) locate_points(&centres, &frame, p, start, n, dim, basis, true);
        for (int i = 0; i < n; ++i) {
            const size_t k = start + (size_t)i;
            point_gift gift;
            double hoop = 0.0, C[9];
            for (int c = 0; want.affine && c < dim * dim; ++c) C[c] = p->affine[c][k];
            if (want.momentum) give_momentum(&gift, p, k, dim, want.affine);
            if (want.force) hoop = give_force(&gift, p, k, body_force, dim, axisymmetric, want.centred);
            FOR_PIECES(j, i, dim, basis)
            {
                scatter_stencil(&gift, &s, j, m->h, out, M + F, dim, basis, want);
                if (want.affine) extend_affine(m, p, k, C, &s, j, M + F, dim, basis, out + 1);
            }
            if (!want.force || !want.centred) continue;
            gift.b = lanes_from(axisymmetric ? hoop / centres.radius[i] : 0.0, 0.0, 0.0, 0.0, F);
            scatter_stencil(&gift, &centres, i, m->h, out + M, M + F, dim, basis, (scatter_want){.force = true});
        }
    }
}

#endif
