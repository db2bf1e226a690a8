/* From nodes to points and back to the nodes in one pass (kernels_body.h): the velocity that points give back if they take velocities and their gradients
 * from the nodes (restore.c). */
#ifndef MPM_KERNELS_PROJECT_H
#define MPM_KERNELS_PROJECT_H

#include "mpm/transfer/kernels_gather.h"
#include "mpm/transfer/kernels_scatter.h"

/* Puts S r in the place of grad S, by axis: r from the point to the node (m). With the linear basis grad S is S r over its second moment
 * already, and does not become 0/0 where a point stands on a node. */
FLOE_ALWAYS_INLINE void take_arms(stencils *s, const mesh *m, int n, const int dim, const int basis)
{
    for (int a = 0; !basis_has_kinks(basis) && a < dim; ++a)
        for (int x = 0; x < basis_support(basis); ++x)
            for (int j = 0; j < n * basis_pieces(basis, dim); ++j)
                s->dw[a][x][j] = s->w[a][x][j] * (s->offset[a][j] + x * m->h[a]);
}

/* Second moments of the weights about the i-th point, D (m2). They are diagonal but for domains that lean. */
FLOE_ALWAYS_INLINE void weight_moments(const stencils *s, const mesh *m, int i, double D[3][3], const int dim,
                                       const int basis)
{
    FOR_PIECES(j, i, dim, basis)
    {
        double sum[3][3];
        for (int a = 0; a < dim; ++a) {
            sum[a][0] = sum[a][1] = sum[a][2] = 0.0;
            for (int x = 0; x < basis_support(basis); ++x) {
                const double r = s->offset[a][j] + x * m->h[a], w = s->w[a][x][j];
                sum[a][0] += w;
                sum[a][1] += w * r;
                sum[a][2] += w * r * r;
            }
        }
        for (int a = 0; a < dim; ++a)
            for (int b = 0; b < dim; ++b) {
                if (!basis_has_corners(basis) && a != b) continue;
                double product = a == b ? sum[a][2] : sum[a][1] * sum[b][1];
                for (int c = 0; basis_has_corners(basis) && c < dim; ++c)
                    if (c != a && c != b) product *= sum[c][0];
                D[a][b] += product;
            }
    }
}

/* Makes of the sums of S v r (linear: of v grad S) the columns of m C, and of m S r C with what stands for S r. */
FLOE_ALWAYS_INLINE void affine_columns(const point_sums *sum, double D[3][3], double mass, lanes C[3], lanes T[3],
                                       const int dim, const int basis)
{
    const int F = lanes_of(dim);
    double over[3][3] = {{0.0}};
    if (basis_has_corners(basis)) (void)domain_invert(D, over, dim);
    for (int c = 0; c < dim; ++c) {
        if (basis_has_kinks(basis)) {
            C[c] = sum->L[c];
            T[c] = lanes_times(mass * D[c][c], sum->L[c], F);
            continue;
        }
        if (!basis_has_corners(basis)) over[c][c] = 1.0 / D[c][c];
        C[c] = lanes_times(over[c][c], sum->L[c], F);
        for (int b = 0; basis_has_corners(basis) && b < dim; ++b)
            if (b != c) C[c] = lanes_plus(C[c], over[b][c], sum->L[b], F);
        T[c] = lanes_times(mass, C[c], F);
    }
}

/* out += m S (v' + C' r) of v' = sum S v and C' = sum S v r^T / D; the windows hold v and the momentum, in lanes_of(dim) doubles a node. */
FLOE_ALWAYS_INLINE void project_body(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end,
                                     const double *restrict window, double *restrict out, const int dim,
                                     const int basis)
{
    const gather_want rates = {false, true, false};
    const scatter_want give = {.force = true};
    const int F = lanes_of(dim);
    const tile_frame frame = frame_of(m, t, dim);
    const nodes_seen nodes = {window, lanes_reserved(F), NULL, 0.0};
    stencils s;
    for (int n; start < end; start += (size_t)n) {
        n = strip_length(start, end, dim, basis);
        locate(&s, m, &frame, p, start, n, dim, basis);
        take_arms(&s, m, n, dim, basis);
        for (int i = 0; i < n; ++i) {
            const size_t k = start + (size_t)i;
            const point_sums sum = sum_point(&s, i, &nodes, 0.0, dim, basis, rates);
            double D[3][3] = {{0.0}}, numbers[9];
            lanes C[3];
            point_gift gift;
            weight_moments(&s, m, i, D, dim, basis);
            gift.b = lanes_times(p->mass[k], sum.v, F);
            affine_columns(&sum, D, p->mass[k], C, gift.T, dim, basis);
            for (int a = 0; a < dim; ++a)
                for (int c = 0; c < dim; ++c) numbers[dim * a + c] = lanes_get(C[c], a, F);
            FOR_PIECES(j, i, dim, basis)
            {
                scatter_stencil(&gift, &s, j, m->h, out, F, dim, basis, give);
                extend_affine(m, p, k, numbers, &s, j, F, dim, basis, out);
            }
        }
    }
}

#endif
