/* The point kernels: one always-inline body each, instantiated on {1, 2, axisymmetric, 3} x basis with literal arguments. */
#include "mpm/locate.h"
#include "mpm/pairs.h"

/* Components of a point's stress that act in the plane of the nodes: T[a][b], symmetric, 3-D order xx yy zz xy yz zx. */
FLOE_ALWAYS_INLINE void stress_matrix(const point_arrays *p, size_t k, double add, const int dim, double T[3][3])
{
    static const int row[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b) T[a][b] = p->stress[row[a][b]][k] + (a == b ? add : 0.0);
}

/* Adds the share m S C (x_i - x_p) of a point to a node's momentum; r = x_i - x_p. */
FLOE_ALWAYS_INLINE void add_affine(double *restrict momentum, const point_arrays *p, size_t k, double share,
                                   const double r[3], const int dim)
{
    for (int a = 0; a < dim; ++a) {
        double v = 0.0;
        for (int c = 0; c < dim; ++c) v += p->affine[dim * a + c][k] * r[c];
        momentum[a] += share * v;
    }
}

/* Moves what a ghost beyond a side that extrapolates got of a point's C to where the fold of the weights has it. Folded (wall.c), the
 * ghost's share of the weight is +2 at the node on the side and -1 at the first inner one, of the velocity v + C (x - x_p) there, whereas
 * the fold of what the ghost got has that of the velocity at the ghost for both. The sums are the same, but next to the side the inner
 * node, with all but no weight left, would get a momentum all the same: a velocity without bound. `ghost`: in the window. */
static void move_affine(const mesh *m, const point_arrays *p, size_t k, int axis, ptrdiff_t inward, double share,
                        double *ghost)
{
    const double way = inward > 0 ? m->h[axis] : -m->h[axis];
    for (int a = 0; a < m->dim; ++a) {
        const double momentum = 2.0 * share * p->affine[m->dim * a + axis][k] * way;
        ghost[inward + a] += momentum;
        ghost[2 * inward + a] -= momentum;
    }
}

/* The same for the ghosts at one end of a stencil along an axis. */
static void move_affine_row(const mesh *m, const point_arrays *p, size_t k, const stencil *s, int axis, int side,
                            double mass, int components, const basis_kind kind, double *out)
{
    const int n = basis_support(kind), width = window_width(m->dim, kind), stride[3] = {1, width, width * width};
    const ptrdiff_t inward = (ptrdiff_t)components * (side == SIDE_LOWER ? stride[axis] : -stride[axis]);
    int lo[3] = {0, 0, 0}, hi[3] = {1, 1, 1};
    for (int a = 0; a < m->dim; ++a) hi[a] = n;
    lo[axis] = side == SIDE_LOWER ? 0 : n - 1;
    hi[axis] = lo[axis] + 1;
    for (int z = lo[2]; z < hi[2]; ++z)
        for (int y = lo[1]; y < hi[1]; ++y)
            for (int x = lo[0]; x < hi[0]; ++x) {
                const ptrdiff_t node = s->node + x + (ptrdiff_t)stride[1] * y + (ptrdiff_t)stride[2] * z;
                move_affine(m, p, k, axis, inward, mass * s->w[0][x] * s->w[1][y] * s->w[2][z],
                            out + node * components + 1);
            }
}

/* The same for a stencil that may reach beyond the mesh. */
FLOE_ALWAYS_INLINE void extend_affine(const mesh *m, const point_arrays *p, size_t k, const stencil *s, double mass,
                                      int components, const int dim, const basis_kind kind, double *out)
{
    for (int a = 0; basis_reach(kind) > 0 && a < dim; ++a) {
        const double first = p->x[a][k] + s->offset[a], last = first + (basis_support(kind) - 1) * m->h[a],
                     half = 0.5 * m->h[a];
        if (first < p->linear_side[a][SIDE_LOWER] - half)
            move_affine_row(m, p, k, s, a, SIDE_LOWER, mass, components, kind, out);
        if (last > p->linear_side[a][SIDE_UPPER] + half)
            move_affine_row(m, p, k, s, a, SIDE_UPPER, mass, components, kind, out);
    }
}

/* What a point gives: to a node's momentum with S, to its force with grad S and S. */
typedef struct point_gift {
    double mass, mv[3];
    double T[3][3], b[3], hoop; /* -V sigma in the plane of the nodes; m b; -V sigma about the axis */
} point_gift;

/* Adds a point's share by one stencil. `centred`: no gradients here. */
FLOE_ALWAYS_INLINE void scatter_stencil(const mesh *m, const point_arrays *p, size_t k, const stencil *s,
                                        const point_gift *g, double *restrict out, const int dim, const basis_kind kind,
                                        const bool momentum, const bool force, const bool centred, const bool affine)
{
    const int components = (momentum ? 1 + dim : 0) + (force ? dim : 0);
    const int force_at = momentum ? 1 + dim : 0;
    FOR_ROWS(*s, dim, kind, {
        const pairs M = pairs_of(g->mass * W, g->mv[0] * W, g->mv[1] * W, g->mv[2] * W);
        double A[3] = {0}, B[3] = {0};
        for (int a = 0; a < dim; ++a) {
            A[a] = g->T[a][0] * W;
            B[a] = g->b[a] * W + (centred ? 0.0 : g->T[a][1] * Wy + g->T[a][2] * Wz);
        }
        const pairs along = pairs_of(A[0], A[1], A[2], 0.0), across = pairs_of(B[0], B[1], B[2], 0.0);
        for (int x = 0; x < basis_support(kind); ++x) {
            double *restrict node = out + (ptrdiff_t)(row + x) * components;
            if (momentum) pairs_scatter(node, s->w[0][x], &M, 1 + dim);
            if (affine) {
                const double r[3] = {s->offset[0] + x * m->h[0], dim > 1 ? s->offset[1] + y_ * m->h[1] : 0.0,
                                     dim > 2 ? s->offset[2] + z_ * m->h[2] : 0.0};
                add_affine(node + 1, p, k, g->mass * W * s->w[0][x], r, dim);
            }
            if (force && centred) pairs_scatter(node + force_at, s->w[0][x], &across, dim);
            if (force && !centred) pairs_scatter_two(node + force_at, s->w[0][x], &across, s->dw[0][x], &along, dim);
        }
    });
}

/* f_i = -V (sigma + p_p I - q I) . grad S + S m b (numerics 4.1); hoop term of numerics 4.5. `centred`: grad S is taken
 * elsewhere than S (locate.h). */
FLOE_ALWAYS_INLINE void scatter_body(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end,
                                     double *restrict out, const int dim, const bool axisymmetric,
                                     const basis_kind kind, const bool momentum, const bool force, const bool centred,
                                     const bool affine)
{
    const int components = (momentum ? 1 + dim : 0) + (force ? dim : 0);
    const int force_at = momentum ? 1 + dim : 0;
    const tile_frame frame = frame_of(m, t, dim);
    const double body_force[3] = {p->acceleration[0], p->acceleration[1], p->acceleration[2]};
    for (size_t k = start; k < end; ++k) {
        point_gift gift = {.mass = p->mass[k]};
        if (momentum)
            for (int a = 0; a < dim; ++a) gift.mv[a] = gift.mass * p->v[a][k];
        if (force) {
            const double minus_v = -p->volume0[k] * p->J[k];
            const double add = (p->grid_pressure ? p->grid_pressure[k] : 0.0) - (p->q ? p->q[k] : 0.0) + p->held;
            stress_matrix(p, k, add, dim, gift.T);
            for (int a = 0; a < dim; ++a) {
                gift.b[a] = gift.mass * (body_force[a] + (p->drive[a] ? p->drive[a][k] : 0.0));
                for (int c = 0; c < dim; ++c) gift.T[a][c] *= minus_v;
            }
            if (axisymmetric) gift.hoop = minus_v * (p->stress[2][k] + add);
            if (axisymmetric && !centred) gift.b[0] += gift.hoop / p->x[0][k];
        }
        FOR_PIECES(s, m, &frame, p, k, dim, kind, {
            scatter_stencil(m, p, k, &s, &gift, out, dim, kind, momentum, force, centred, affine);
            if (affine) extend_affine(m, p, k, &s, gift.mass, components, dim, kind, out);
        });
        if (!force || !centred) continue;
        const stencil g = locate(&frame, p, k, dim, kind, true);
        FOR_ROWS(g, dim, kind, {
            double A[3] = {0}, B[3] = {0};
            for (int a = 0; a < dim; ++a) {
                A[a] = gift.T[a][0] * W;
                B[a] = gift.T[a][1] * Wy + gift.T[a][2] * Wz;
            }
            if (axisymmetric) B[0] += gift.hoop / g.radius * W;
            const pairs along = pairs_of(A[0], A[1], A[2], 0.0), across = pairs_of(B[0], B[1], B[2], 0.0);
            for (int x = 0; x < basis_support(kind); ++x)
                pairs_scatter_two(out + (ptrdiff_t)(row + x) * components + force_at, g.w[0][x], &across, g.dw[0][x],
                                  &along, dim);
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

/* Sums over the nodes of a row: S v and S a, S u and dS u, where u is the velocity that gradients see: v^L (or v), but for light
 * nodes. In the window a follows v^L where points move, and m is last where light nodes matter. */
typedef struct row_sums {
    pairs va, u, slope;
} row_sums;

FLOE_ALWAYS_INLINE row_sums sum_row(const double *restrict node, const double *w, const double *dw, double floor,
                                    double kick, const int dim, const basis_kind kind, const bool motion,
                                    const bool gradient, const bool light)
{
    const int components = (motion ? 2 * dim : dim) + (light ? 1 : 0);
    row_sums r = {pairs_zero(), pairs_zero(), pairs_zero()};
    for (int x = 0; x < basis_support(kind); ++x, node += components) {
        double u[4] = {0};
        const double *seen = node;
        if (light && node[2 * dim] < floor) {
            for (int a = 0; a < dim; ++a) u[a] = node[a] - (1.0 - node[2 * dim] / floor) * kick * node[dim + a];
            seen = u;
        }
        pairs_gather(&r.va, w[x], node, motion ? 2 * dim : dim);
        if (gradient) pairs_gather(&r.slope, dw[x], seen, dim);
        if (gradient && light) pairs_gather(&r.u, w[x], seen, dim);
    }
    if (!light) r.u = r.va;
    return r;
}

/* Sums over a stencil: v^L and a, and the columns of L. */
typedef struct point_sums {
    pairs va, L[3];
} point_sums;

FLOE_ALWAYS_INLINE void sum_stencil(point_sums *sum, const stencil *s, const double *restrict window, double floor,
                                    double kick, const int dim, const basis_kind kind, const bool motion,
                                    const bool gradient, const bool light)
{
    const int components = (motion ? 2 * dim : dim) + (light ? 1 : 0);
    FOR_ROWS(*s, dim, kind, {
        const row_sums r = sum_row(window + (ptrdiff_t)row * components, s->w[0], s->dw[0], floor, kick, dim, kind,
                                   motion, gradient, light);
        pairs_add(&sum->va, W, &r.va, motion ? 2 * dim : dim);
        if (gradient) pairs_add(&sum->L[0], W, &r.slope, dim);
        if (gradient && dim > 1) pairs_add(&sum->L[1], Wy, &r.u, dim);
        if (gradient && dim > 2) pairs_add(&sum->L[2], Wz, &r.u, dim);
    });
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
    const tile_frame frame = frame_of(m, t, dim);
    const gather_result out = *to;
    const double kick = step->kick, dt = step->dt, flip = step->flip;
    for (size_t k = start; k < end; ++k) {
        const double floor = light ? light_node * p->mass[k] : 0.0;
        point_sums sum = {pairs_zero(), {pairs_zero(), pairs_zero(), pairs_zero()}};
        FOR_PIECES(s, m, &frame, p, k, dim, kind,
                   { sum_stencil(&sum, &s, window, floor, kick, dim, kind, motion, gradient && !centred, light); });
        for (int a = 0; motion && a < dim; ++a) {
            const double v = pairs_get(&sum.va, a), acceleration = pairs_get(&sum.va, dim + a);
            out.x_next[a][k] = p->x[a][k] + dt * v;
            out.v_next[a][k] = flip * (p->v[a][k] + kick * acceleration) + (1.0 - flip) * v;
        }
        if (!gradient) continue;
        double radius = p->x[0][k];
        if (centred) {
            const stencil g = locate(&frame, p, k, dim, kind, true);
            sum = (point_sums){pairs_zero(), {pairs_zero(), pairs_zero(), pairs_zero()}};
            sum_stencil(&sum, &g, window, floor, kick, dim, kind, motion, true, light);
            radius = g.radius;
        }
        if (axisymmetric) out.L[8][k - start] = pairs_get(&sum.va, 0) / radius;
        for (int a = 0; a < dim; ++a)
            for (int c = 0; c < dim; ++c) out.L[3 * a + c][k - start] = pairs_get(&sum.L[c], a);
    }
}

/* Moments of the velocity and of the weights about a point, summed over its nodes. */
typedef struct point_moments {
    double B[3][3], D[3][3]; /* m2/s, m2: sum of S v r, of S r r */
} point_moments;

FLOE_ALWAYS_INLINE void sum_moments(point_moments *sum, const mesh *m, const stencil *s, const double *restrict window,
                                    const int dim, const basis_kind kind)
{
    FOR_ROWS(*s, dim, kind, {
        const double ry = dim > 1 ? s->offset[1] + y_ * m->h[1] : 0.0, rz = dim > 2 ? s->offset[2] + z_ * m->h[2] : 0.0;
        for (int x = 0; x < basis_support(kind); ++x) {
            const double S = W * s->w[0][x], r[3] = {s->offset[0] + x * m->h[0], ry, rz};
            const double *v = window + (ptrdiff_t)(row + x) * dim;
            for (int a = 0; a < dim; ++a)
                for (int c = 0; c < dim; ++c) {
                    sum->B[a][c] += S * v[a] * r[c];
                    if (kind == BASIS_CPDI) sum->D[a][c] += S * r[a] * r[c];
                }
        }
    });
    for (int a = 0; kind != BASIS_CPDI && a < dim; ++a)
        for (int i = 0; i < basis_support(kind); ++i) {
            const double r = s->offset[a] + i * m->h[a];
            sum->D[a][a] += s->w[a][i] * r * r;
        }
}

/* C = B/D (transfer.h), rows counted from `start`; the window holds v of each node. D is diagonal where weights are products of those
 * along the axes, and of a domain that leans it is not. */
FLOE_ALWAYS_INLINE void moments_body(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end,
                                     const double *restrict window, const gather_result *to, const int dim,
                                     const basis_kind kind)
{
    const tile_frame frame = frame_of(m, t, dim);
    for (size_t k = start; k < end; ++k) {
        point_moments sum = {.B = {{0.0}}};
        FOR_PIECES(s, m, &frame, p, k, dim, kind, { sum_moments(&sum, m, &s, window, dim, kind); });
        double over[3][3] = {{0.0}};
        if (kind == BASIS_CPDI) (void)domain_invert(sum.D, over, dim);
        for (int a = 0; a < dim; ++a)
            for (int c = 0; c < dim; ++c) {
                double C = sum.B[a][c] / sum.D[c][c];
                if (kind == BASIS_CPDI) {
                    C = 0.0;
                    for (int b = 0; b < dim; ++b) C += sum.B[a][b] * over[b][c];
                }
                to->L[3 * a + c][k - start] = C;
            }
    }
}

FLOE_ALWAYS_INLINE void sample_body(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end,
                                    const double *restrict window, double *restrict out, const int dim,
                                    const basis_kind kind)
{
    const tile_frame frame = frame_of(m, t, dim);
    for (size_t k = start; k < end; ++k) {
        double sum = 0.0;
        FOR_PIECES(s, m, &frame, p, k, dim, kind, {
            FOR_ROWS(s, dim, kind, {
                for (int x = 0; x < basis_support(kind); ++x) sum += W * s.w[0][x] * window[row + x];
            });
        });
        out[k] = sum;
    }
}

/* Volume of the points at their nodes. */
FLOE_ALWAYS_INLINE void fill_body(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end,
                                  double *restrict window, const int dim, const basis_kind kind)
{
    const tile_frame frame = frame_of(m, t, dim);
    for (size_t k = start; k < end; ++k) {
        const double volume = p->volume0[k] * p->J[k];
        FOR_PIECES(s, m, &frame, p, k, dim, kind, {
            FOR_ROWS(s, dim, kind, {
                for (int x = 0; x < basis_support(kind); ++x) window[row + x] += volume * W * s.w[0][x];
            });
        });
    }
}

#define SCATTER(name, dim, axi, kind, momentum, force)                                                               \
    static void name(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end, double *out) \
    {                                                                                                                \
        const bool centred = (kind) == BASIS_LINEAR && (force) && p->centred, affine = (momentum) && p->affine[0];   \
        if (centred && affine)                                                                                       \
            scatter_body(m, t, p, start, end, out, dim, axi, kind, momentum, force, true, true);                     \
        else if (centred)                                                                                            \
            scatter_body(m, t, p, start, end, out, dim, axi, kind, momentum, force, true, false);                    \
        else if (affine)                                                                                             \
            scatter_body(m, t, p, start, end, out, dim, axi, kind, momentum, force, false, true);                    \
        else                                                                                                         \
            scatter_body(m, t, p, start, end, out, dim, axi, kind, momentum, force, false, false);                   \
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

#define MOMENTS(name, dim, kind)                                                                        \
    static void name(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end, \
                     const double *window, const gather_step *step, const gather_result *out)           \
    {                                                                                                   \
        (void)step;                                                                                     \
        moments_body(m, t, p, start, end, window, out, dim, kind);                                      \
    }

#define SAMPLE(name, dim, kind)                                                                         \
    static void name(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end, \
                     const double *window, double *out)                                                 \
    {                                                                                                   \
        sample_body(m, t, p, start, end, window, out, dim, kind);                                       \
    }

#define FILL(name, dim, kind)                                                                           \
    static void name(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end, \
                     double *window)                                                                    \
    {                                                                                                   \
        fill_body(m, t, p, start, end, window, dim, kind);                                              \
    }

#define INSTANTIATE(geometry, dim, axi, basis, kind)                    \
    SCATTER(momentum_##geometry##_##basis, dim, axi, kind, true, false) \
    SCATTER(force_##geometry##_##basis, dim, axi, kind, false, true)    \
    SCATTER(all_##geometry##_##basis, dim, axi, kind, true, true)       \
    GATHER(motion_##geometry##_##basis, dim, axi, kind, true, false)    \
    GATHER(gradient_##geometry##_##basis, dim, axi, kind, false, true)  \
    GATHER(both_##geometry##_##basis, dim, axi, kind, true, true)       \
    MOMENTS(moments_##geometry##_##basis, dim, kind)                    \
    SAMPLE(sample_##geometry##_##basis, dim, kind)                      \
    FILL(fill_##geometry##_##basis, dim, kind)

#define KERNELS(geometry, basis)                                                                          \
    {                                                                                                     \
        .scatter = {momentum_##geometry##_##basis, force_##geometry##_##basis, all_##geometry##_##basis}, \
        .gather = {motion_##geometry##_##basis, gradient_##geometry##_##basis, both_##geometry##_##basis, \
                   moments_##geometry##_##basis},                                                         \
        .sample = sample_##geometry##_##basis, .fill = fill_##geometry##_##basis                          \
    }

#define ALL_KERNELS(geometry)                                                                                       \
    {                                                                                                               \
        KERNELS(geometry, linear), KERNELS(geometry, gimp), KERNELS(geometry, quadratic), KERNELS(geometry, cubic), \
            KERNELS(geometry, cpdi)                                                                                 \
    }

#define ALL_BASES(X, geometry, dim, axi)              \
    X(geometry, dim, axi, linear, BASIS_LINEAR)       \
    X(geometry, dim, axi, gimp, BASIS_GIMP)           \
    X(geometry, dim, axi, quadratic, BASIS_QUADRATIC) \
    X(geometry, dim, axi, cubic, BASIS_CUBIC)         \
    X(geometry, dim, axi, cpdi, BASIS_CPDI)

ALL_BASES(INSTANTIATE, line, 1, false)
ALL_BASES(INSTANTIATE, plane, 2, false)
ALL_BASES(INSTANTIATE, axisymmetric, 2, true)
ALL_BASES(INSTANTIATE, solid, 3, false)

kernel_set kernels_of(int dim, mesh_geometry geometry, basis_kind kind)
{
    static const kernel_set table[4][BASIS_KINDS] = {
        ALL_KERNELS(line),
        ALL_KERNELS(plane),
        ALL_KERNELS(axisymmetric),
        ALL_KERNELS(solid),
    };
    const int row = dim == 1 ? 0 : dim == 3 ? 3 : geometry == MESH_AXISYMMETRIC ? 2 : 1;
    return table[row][kind];
}
