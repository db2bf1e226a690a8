/* The point kernels: one always-inline body each, instantiated with literal arguments by POINT_KERNELS.
 *
 * Weights are products of those along the axes, S = w_x w_y w_z, and so sums over nodes are taken axis by axis: what a point gives is
 * contracted with w_z and w_z' for each plane of its nodes, then with w_y and w_y' for each row, then with w_x and w_x' for each node; and
 * what it takes is summed along rows, planes, and all.
 *
 * The build writes one file for each geometry, basis and width of lanes (cmake/FloePointKernels.cmake): all in one took a minute. */
#ifndef MPM_KERNELS_BODY_H
#define MPM_KERNELS_BODY_H

#include "mpm/transfer/kernels_gather.h"
#include "mpm/transfer/kernels_project.h"
#include "mpm/transfer/kernels_scatter.h"

/* Moments of the velocity and of the weights about a point, summed over its nodes. */
typedef struct point_moments {
    double B[3][3], D[3][3]; /* m2/s, m2: sum of S v r, of S r r */
} point_moments;

FLOE_ALWAYS_INLINE void sum_moments(point_moments *sum, const mesh *m, const stencils *s, int j,
                                    const double *restrict window, const int dim, const int basis)
{
    FOR_ROWS(*s, j, dim, basis, {
        const double ry = dim > 1 ? s->offset[1][j] + y_ * m->h[1] : 0.0,
                     rz = dim > 2 ? s->offset[2][j] + z_ * m->h[2] : 0.0;
        for (int x = 0; x < basis_support(basis); ++x) {
            const double S = W * s->w[0][x][j], r[3] = {s->offset[0][j] + x * m->h[0], ry, rz};
            const double *v = window + (ptrdiff_t)(row + x) * lanes_of(dim);
            for (int a = 0; a < dim; ++a)
                for (int c = 0; c < dim; ++c) {
                    sum->B[a][c] += S * v[a] * r[c];
                    if (basis_has_corners(basis)) sum->D[a][c] += S * r[a] * r[c];
                }
        }
    });
    for (int a = 0; !basis_has_corners(basis) && a < dim; ++a)
        for (int i = 0; i < basis_support(basis); ++i) {
            const double r = s->offset[a][j] + i * m->h[a];
            sum->D[a][a] += s->w[a][i][j] * r * r;
        }
}

/* C = B/D (transfer.h), rows counted from `start`; the window holds v of each node. D is diagonal where weights are products of those
 * along the axes, and of a domain that leans it is not. */
FLOE_ALWAYS_INLINE void moments_body(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end,
                                     const double *restrict window, const gather_result *to, const int dim,
                                     const int basis)
{
    const tile_frame frame = frame_of(m, t, dim);
    const size_t origin = start;
    stencils s;
    for (int n; start < end; start += (size_t)n) {
        n = strip_length(start, end, dim, basis);
        locate(&s, m, &frame, p, start, n, dim, basis);
        for (int i = 0; i < n; ++i) {
            point_moments sum = {.B = {{0.0}}};
            FOR_PIECES(j, i, dim, basis) sum_moments(&sum, m, &s, j, window, dim, basis);
            double over[3][3] = {{0.0}};
            if (basis_has_corners(basis))
                (void)domain_invert(sum.D, over, dim);
            else
                for (int c = 0; c < dim; ++c) over[c][c] = 1.0 / sum.D[c][c];
            for (int a = 0; a < dim; ++a)
                for (int c = 0; c < dim; ++c) {
                    double C = 0.0;
                    for (int b = 0; b < dim; ++b) C += sum.B[a][b] * over[b][c];
                    to->L[3 * a + c][start + (size_t)i - origin] = C;
                }
        }
    }
}

FLOE_ALWAYS_INLINE void sample_body(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end,
                                    const double *restrict window, double *restrict out, const int dim, const int basis)
{
    const tile_frame frame = frame_of(m, t, dim);
    stencils s;
    for (int n; start < end; start += (size_t)n) {
        n = strip_length(start, end, dim, basis);
        locate(&s, m, &frame, p, start, n, dim, basis);
        for (int i = 0; i < n; ++i) {
            double sum = 0.0;
            FOR_PIECES(j, i, dim, basis)
            FOR_ROWS(s, j, dim, basis, {
                for (int x = 0; x < basis_support(basis); ++x) sum += W * s.w[0][x][j] * window[row + x];
            });
            *out++ = sum;
        }
    }
}

/* Volume of the points at their nodes. */
FLOE_ALWAYS_INLINE void fill_body(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end,
                                  double *restrict window, const int dim, const int basis)
{
    const tile_frame frame = frame_of(m, t, dim);
    stencils s;
    for (int n; start < end; start += (size_t)n) {
        n = strip_length(start, end, dim, basis);
        locate(&s, m, &frame, p, start, n, dim, basis);
        for (int i = 0; i < n; ++i) {
            const double volume = p->volume0[start + (size_t)i] * p->J[start + (size_t)i];
            FOR_PIECES(j, i, dim, basis)
            FOR_ROWS(s, j, dim, basis, {
                for (int x = 0; x < basis_support(basis); ++x) window[row + x] += volume * W * s.w[0][x][j];
            });
        }
    }
}

/* `count` numbers of each point, from `number` on, to those of the nodes. */
FLOE_ALWAYS_INLINE void spread_body(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end,
                                    const double *restrict number, double *restrict window, const int dim,
                                    const int basis, const int count)
{
    const tile_frame frame = frame_of(m, t, dim);
    stencils s;
    for (int n; start < end; start += (size_t)n) {
        n = strip_length(start, end, dim, basis);
        locate(&s, m, &frame, p, start, n, dim, basis);
        for (int i = 0; i < n; ++i, number += count) {
            FOR_PIECES(j, i, dim, basis)
            FOR_ROWS(s, j, dim, basis, {
                for (int x = 0; x < basis_support(basis); ++x) {
                    double *node = window + count * (ptrdiff_t)(row + x);
                    for (int c = 0; c < count; ++c) node[c] += W * s.w[0][x][j] * number[c];
                }
            });
        }
    }
}

#define SCATTER(name, dim, axi, basis, momentum, force)                                                              \
    static void name(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end, double *out) \
    {                                                                                                                \
        const bool centred = basis_has_kinks(basis) && (force) && p->centred, affine = (momentum) && p->affine[0];   \
        if (centred && affine)                                                                                       \
            scatter_body(m, t, p, start, end, out, dim, axi, basis, (scatter_want){momentum, force, true, true});    \
        else if (centred)                                                                                            \
            scatter_body(m, t, p, start, end, out, dim, axi, basis, (scatter_want){momentum, force, true, false});   \
        else if (affine)                                                                                             \
            scatter_body(m, t, p, start, end, out, dim, axi, basis, (scatter_want){momentum, force, false, true});   \
        else                                                                                                         \
            scatter_body(m, t, p, start, end, out, dim, axi, basis, (scatter_want){momentum, force, false, false});  \
    }

#define GATHER(name, dim, axi, basis, motion, gradient)                                                    \
    static void name(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end,    \
                     const double *window, const gather_step *step, const gather_result *out)              \
    {                                                                                                      \
        if (basis_has_kinks(basis) && (gradient) && p->centred)                                            \
            gather_body(m, t, p, start, end, window, step, out, dim, axi, basis, motion, gradient, true);  \
        else                                                                                               \
            gather_body(m, t, p, start, end, window, step, out, dim, axi, basis, motion, gradient, false); \
    }

#define MOMENTS(name, dim, basis)                                                                       \
    static void name(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end, \
                     const double *window, const gather_step *step, const gather_result *out)           \
    {                                                                                                   \
        (void)step;                                                                                     \
        moments_body(m, t, p, start, end, window, out, dim, basis);                                     \
    }

#define SAMPLE(name, dim, basis)                                                                        \
    static void name(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end, \
                     const double *window, double *out)                                                 \
    {                                                                                                   \
        sample_body(m, t, p, start, end, window, out, dim, basis);                                      \
    }

#define FILL(name, dim, basis)                                                                          \
    static void name(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end, \
                     double *window)                                                                    \
    {                                                                                                   \
        fill_body(m, t, p, start, end, window, dim, basis);                                             \
    }

#define SPREAD(name, dim, basis)                                                                        \
    static void name(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end, \
                     const double *number, int count, double *window)                                   \
    {                                                                                                   \
        if (count == 1)                                                                                 \
            spread_body(m, t, p, start, end, number, window, dim, basis, 1);                            \
        else if (count == dim)                                                                          \
            spread_body(m, t, p, start, end, number, window, dim, basis, dim);                          \
        else                                                                                            \
            spread_body(m, t, p, start, end, number, window, dim, basis, count);                        \
    }

#define PROJECT(name, dim, basis)                                                                       \
    static void name(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end, \
                     const double *window, double *out)                                                 \
    {                                                                                                   \
        project_body(m, t, p, start, end, window, out, dim, basis);                                     \
    }

/* All kernels of a geometry and a basis, for lanes of a width, as `kernels_<geometry>_<basis>_<width>`. */
#define POINT_KERNELS(geometry, dim, axi, name, width)                                                 \
    SCATTER(momentum_##geometry##_##name, dim, axi, BASIS_NUMBER_##name, true, false)                  \
    SCATTER(force_##geometry##_##name, dim, axi, BASIS_NUMBER_##name, false, true)                     \
    SCATTER(all_##geometry##_##name, dim, axi, BASIS_NUMBER_##name, true, true)                        \
    GATHER(motion_##geometry##_##name, dim, axi, BASIS_NUMBER_##name, true, false)                     \
    GATHER(gradient_##geometry##_##name, dim, axi, BASIS_NUMBER_##name, false, true)                   \
    GATHER(both_##geometry##_##name, dim, axi, BASIS_NUMBER_##name, true, true)                        \
    MOMENTS(moments_##geometry##_##name, dim, BASIS_NUMBER_##name)                                     \
    SAMPLE(sample_##geometry##_##name, dim, BASIS_NUMBER_##name)                                       \
    FILL(fill_##geometry##_##name, dim, BASIS_NUMBER_##name)                                           \
    SPREAD(spread_##geometry##_##name, dim, BASIS_NUMBER_##name)                                       \
    PROJECT(project_##geometry##_##name, dim, BASIS_NUMBER_##name)                                     \
    extern const kernel_set kernels_##geometry##_##name##_##width;                                     \
    const kernel_set kernels_##geometry##_##name##_##width = {                                         \
        .scatter = {momentum_##geometry##_##name, force_##geometry##_##name, all_##geometry##_##name}, \
        .gather = {motion_##geometry##_##name, gradient_##geometry##_##name, both_##geometry##_##name, \
                   moments_##geometry##_##name},                                                       \
        .sample = sample_##geometry##_##name,                                                          \
        .fill = fill_##geometry##_##name,                                                              \
        .spread = spread_##geometry##_##name,                                                          \
        .project = project_##geometry##_##name,                                                        \
    };

#endif
