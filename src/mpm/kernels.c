/* The point kernels: one always-inline body each, instantiated on {1, 2, axisymmetric, 3} x basis with literal arguments. */
#include "mpm/locate.h"

/* Components of a point's stress that act in the plane of the nodes: T[a][b], symmetric, 3-D order xx yy zz xy yz zx. */
FLOE_ALWAYS_INLINE void stress_matrix(const point_arrays *p, size_t k, double add, const int dim, double T[3][3])
{
    static const int row[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b) T[a][b] = p->stress[row[a][b]][k] + (a == b ? add : 0.0);
}

/* f_i = -V (sigma + p_p I - q I) . grad S + S m b (numerics 4.1); hoop term of numerics 4.5. `centred`: grad S is taken
 * elsewhere than S (locate.h). */
FLOE_ALWAYS_INLINE void scatter_body(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end,
                                     double *restrict out, const int dim, const bool axisymmetric,
                                     const basis_kind kind, const bool momentum, const bool force, const bool centred)
{
    const int components = (momentum ? 1 + dim : 0) + (force ? dim : 0);
    const int force_at = momentum ? 1 + dim : 0;
    const tile_frame frame = frame_of(m, t, dim);
    const double body_force[3] = {p->acceleration[0], p->acceleration[1], p->acceleration[2]};
    for (size_t k = start; k < end; ++k) {
        const stencil s = locate(&frame, p, k, dim, kind, false);
        const double mass = p->mass[k];
        double mv[3] = {0}, T[3][3] = {{0}}, b[3] = {0};
        if (momentum)
            for (int a = 0; a < dim; ++a) mv[a] = mass * p->v[a][k];
        if (force) {
            const double minus_v = -p->volume0[k] * p->J[k];
            const double add = (p->grid_pressure ? p->grid_pressure[k] : 0.0) - (p->q ? p->q[k] : 0.0);
            stress_matrix(p, k, add, dim, T);
            for (int a = 0; a < dim; ++a) {
                b[a] = mass * body_force[a];
                for (int c = 0; c < dim; ++c) T[a][c] *= minus_v;
            }
            if (axisymmetric) b[0] += minus_v * (p->stress[2][k] + add) / p->x[0][k];
        }
        FOR_STENCIL(s, dim, kind, {
            double *restrict node = out + (ptrdiff_t)at * components;
            if (momentum) {
                node[0] += S * mass;
                for (int a = 0; a < dim; ++a) node[1 + a] += S * mv[a];
            }
            if (force)
                for (int a = 0; a < dim; ++a) {
                    double f = S * b[a];
                    if (!centred)
                        for (int c = 0; c < dim; ++c) f += T[a][c] * G[c];
                    node[force_at + a] += f;
                }
        });
        if (!force || !centred) continue;
        const stencil g = locate(&frame, p, k, dim, kind, true);
        FOR_STENCIL(g, dim, kind, {
            double *restrict node = out + (ptrdiff_t)at * components;
            for (int a = 0; a < dim; ++a)
                for (int c = 0; c < dim; ++c) node[force_at + a] += T[a][c] * G[c];
        });
    }
}

/* A node lighter than this share of a point lends the point's velocity gradient its acceleration in proportion only.
 *
 * A point with weight S alone on a node gives it an acceleration V sigma grad S / (S m_p), and that gives the point's L a
 * term with (grad S)^2/S. The smooth bases keep it bounded; with the linear one it is 1/(h^2 S), unstable for any step once
 * S < (c dt/h)^2: a disc whose edge crosses a cell's face tears. Velocities before the kick are means over points, and safe
 * (numerics 4.4). The points' velocities take all of the acceleration: momentum is untouched. */
static const double light_node = 0.25;

/* L += v (x) grad S of one node: v^L (or v), then a and m where light nodes matter. */
FLOE_ALWAYS_INLINE void add_gradient(const double *restrict node, const double G[3], double floor, double kick,
                                     const int dim, const bool light, double L[3][3])
{
    double u[3] = {0};
    for (int a = 0; a < dim; ++a) u[a] = node[a];
    if (light && node[2 * dim] < floor)
        for (int a = 0; a < dim; ++a) u[a] -= (1.0 - node[2 * dim] / floor) * kick * node[dim + a];
    for (int a = 0; a < dim; ++a)
        for (int c = 0; c < dim; ++c) L[a][c] += u[a] * G[c];
}

/* Motion: v_p += sum S a kick blended with sum S v^L; x_p += dt sum S v^L (numerics 4.2).
 * Gradient: L_p = sum v_i (x) grad S; L_hoop = sum S v_r / r (numerics 4.1, 4.5); rows of L are counted from `start`.
 * The window holds v^L (or v) of each node, then a where points move, then m where light nodes matter. */
FLOE_ALWAYS_INLINE void gather_body(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end,
                                    const double *restrict window, const gather_step *step, const gather_result *to,
                                    const int dim, const bool axisymmetric, const basis_kind kind, const bool motion,
                                    const bool gradient, const bool centred)
{
    const bool light = gather_needs_mass(kind, motion, gradient);
    const int components = (motion ? 2 * dim : dim) + (light ? 1 : 0);
    const tile_frame frame = frame_of(m, t, dim);
    const gather_result out = *to;
    const double kick = step->kick, dt = step->dt, flip = step->flip;
    for (size_t k = start; k < end; ++k) {
        const stencil s = locate(&frame, p, k, dim, kind, false);
        const double floor = light ? light_node * p->mass[k] : 0.0;
        double v[3] = {0}, acceleration[3] = {0}, L[3][3] = {{0}}, radial = 0.0;
        FOR_STENCIL(s, dim, kind, {
            const double *restrict node = window + (ptrdiff_t)at * components;
            if (motion)
                for (int a = 0; a < dim; ++a) {
                    v[a] += S * node[a];
                    acceleration[a] += S * node[dim + a];
                }
            if (gradient && !centred) add_gradient(node, G, floor, kick, dim, light, L);
            if (gradient && axisymmetric) radial += S * node[0];
        });
        if (motion)
            for (int a = 0; a < dim; ++a) {
                out.x_next[a][k] = p->x[a][k] + dt * v[a];
                out.v_next[a][k] = flip * (p->v[a][k] + kick * acceleration[a]) + (1.0 - flip) * v[a];
            }
        if (!gradient) continue;
        if (centred) {
            const stencil g = locate(&frame, p, k, dim, kind, true);
            FOR_STENCIL(g, dim, kind,
                        { add_gradient(window + (ptrdiff_t)at * components, G, floor, kick, dim, light, L); });
        }
        for (int a = 0; a < dim; ++a)
            for (int c = 0; c < dim; ++c) out.L[3 * a + c][k - start] = L[a][c];
        if (axisymmetric) out.L[8][k - start] = radial / p->x[0][k];
    }
}

FLOE_ALWAYS_INLINE void sample_body(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end,
                                    const double *restrict window, double *restrict out, const int dim,
                                    const basis_kind kind)
{
    const tile_frame frame = frame_of(m, t, dim);
    for (size_t k = start; k < end; ++k) {
        const stencil s = locate(&frame, p, k, dim, kind, false);
        double sum = 0.0;
        FOR_STENCIL(s, dim, kind, { sum += S * window[at]; });
        out[k] = sum;
    }
}

#define SCATTER(name, dim, axi, kind, momentum, force)                                                               \
    static void name(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end, double *out) \
    {                                                                                                                \
        if ((kind) == BASIS_LINEAR && (force) && p->centred)                                                         \
            scatter_body(m, t, p, start, end, out, dim, axi, kind, momentum, force, true);                           \
        else                                                                                                         \
            scatter_body(m, t, p, start, end, out, dim, axi, kind, momentum, force, false);                          \
    }

#define GATHER(name, dim, axi, kind, motion, gradient)                                                    \
    static void name(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end,   \
                     const double *window, const gather_step *step, const gather_result *out)             \
    {                                                                                                     \
        if ((kind) == BASIS_LINEAR && (gradient) && p->centred)                                           \
            gather_body(m, t, p, start, end, window, step, out, dim, axi, kind, motion, gradient, true);  \
        else                                                                                              \
            gather_body(m, t, p, start, end, window, step, out, dim, axi, kind, motion, gradient, false); \
    }

#define SAMPLE(name, dim, kind)                                                                         \
    static void name(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end, \
                     const double *window, double *out)                                                 \
    {                                                                                                   \
        sample_body(m, t, p, start, end, window, out, dim, kind);                                       \
    }

#define INSTANTIATE(geometry, dim, axi, basis, kind)                    \
    SCATTER(momentum_##geometry##_##basis, dim, axi, kind, true, false) \
    SCATTER(force_##geometry##_##basis, dim, axi, kind, false, true)    \
    SCATTER(all_##geometry##_##basis, dim, axi, kind, true, true)       \
    GATHER(motion_##geometry##_##basis, dim, axi, kind, true, false)    \
    GATHER(gradient_##geometry##_##basis, dim, axi, kind, false, true)  \
    GATHER(both_##geometry##_##basis, dim, axi, kind, true, true)       \
    SAMPLE(sample_##geometry##_##basis, dim, kind)

#define KERNELS(geometry, basis)                                                                           \
    {                                                                                                      \
        .scatter = {momentum_##geometry##_##basis, force_##geometry##_##basis, all_##geometry##_##basis},  \
        .gather = {motion_##geometry##_##basis, gradient_##geometry##_##basis, both_##geometry##_##basis}, \
        .sample = sample_##geometry##_##basis                                                              \
    }

#define ALL_BASES(X, geometry, dim, axi)        \
    X(geometry, dim, axi, linear, BASIS_LINEAR) \
    X(geometry, dim, axi, gimp, BASIS_GIMP)     \
    X(geometry, dim, axi, quadratic, BASIS_QUADRATIC)

ALL_BASES(INSTANTIATE, line, 1, false)
ALL_BASES(INSTANTIATE, plane, 2, false)
ALL_BASES(INSTANTIATE, axisymmetric, 2, true)
ALL_BASES(INSTANTIATE, solid, 3, false)

kernel_set kernels_of(int dim, mesh_geometry geometry, basis_kind kind)
{
    static const kernel_set table[4][BASIS_KINDS] = {
        {KERNELS(line, linear), KERNELS(line, gimp), KERNELS(line, quadratic)},
        {KERNELS(plane, linear), KERNELS(plane, gimp), KERNELS(plane, quadratic)},
        {KERNELS(axisymmetric, linear), KERNELS(axisymmetric, gimp), KERNELS(axisymmetric, quadratic)},
        {KERNELS(solid, linear), KERNELS(solid, gimp), KERNELS(solid, quadratic)},
    };
    const int row = dim == 1 ? 0 : dim == 3 ? 3 : geometry == MESH_AXISYMMETRIC ? 2 : 1;
    return table[row][kind];
}
