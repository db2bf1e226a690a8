/* From nodes to points, axis by axis (kernels_body.h). */
#ifndef MPM_KERNELS_GATHER_H
#define MPM_KERNELS_GATHER_H

#include "mpm/transfer/lanes.h"
#include "mpm/transfer/locate.h"

/* A node with less mass than this share of a point's contributes its acceleration to the point's velocity gradient only
 * in proportion.
 *
 * A point with weight S alone on a node gives it an acceleration V sigma grad S / (S m_p), and that gives the point's L
 * a term with (grad S)^2/S. The smooth bases keep it bounded; with the linear one it is 1/(h^2 S), unstable for any
 * step once S < (c dt/h)^2: a disc whose edge crosses a cell's face tears. Velocities before the kick are means over
 * points, and safe (theory 4.4). The points' velocities take all of the acceleration: momentum is untouched. */
static const double light_node = 0.25;

/* What is wanted of a gather: literals. `light`: light nodes matter. */
typedef struct gather_want {
    bool motion, gradient, light;
} gather_want;

/* Sums over nodes: S (v, a); S u and the columns of u (x) grad S, where u is the velocity that gradients see: v^L (or v), but for light
 * nodes. */
typedef struct point_sums {
    lanes v, u, L[3];
} point_sums;

/* Lanes of (v, a), or of v alone. */
FLOE_ALWAYS_INLINE int seen_lanes(const int dim, const gather_want want)
{
    return lanes_of(want.motion ? 2 * dim : dim);
}

/* The contribution of a node along an axis, or of the row or plane that it represents, to the sums over that axis. */
FLOE_ALWAYS_INLINE point_sums sums_share_along(const point_sums *part, const int axis, double w, double dw,
                                               const int dim, const gather_want want)
{
    const int V = seen_lanes(dim, want), F = lanes_of(dim);
    const lanes u = want.light ? part->u : lanes_head(part->v, F, V);
    point_sums share = *part;
    share.v = lanes_times(w, part->v, V);
    if (want.gradient && want.light) share.u = lanes_times(w, u, F);
    for (int c = 0; want.gradient && c < axis; ++c) share.L[c] = lanes_times(w, part->L[c], F);
    if (want.gradient) share.L[axis] = lanes_times(dw, u, F);
    return share;
}

/* Adds other sums over an axis and those before it. */
FLOE_ALWAYS_INLINE void add_sums(point_sums *sum, const point_sums *other, const int axis, const int dim,
                                 const gather_want want)
{
    const int V = seen_lanes(dim, want), F = lanes_of(dim);
    sum->v = lanes_sum(sum->v, other->v, V);
    if (want.gradient && want.light) sum->u = lanes_sum(sum->u, other->u, F);
    for (int c = 0; want.gradient && c <= axis; ++c) sum->L[c] = lanes_sum(sum->L[c], other->L[c], F);
}

/* What a gather reads of the nodes, by value. */
typedef struct nodes_seen {
    const double *window; /* records: v^L (or v), then a where points move */
    int record;           /* doubles from node to node */
    const double *mass;   /* kg: where light nodes matter */
    double kick;          /* s */
} nodes_seen;

/* What a node gives to sums along its row; `floor`: the mass (kg) below which it is light. */
FLOE_ALWAYS_INLINE point_sums node_share(const stencils *s, int j, int x, int node, const nodes_seen *nodes,
                                         double floor, const int dim, const gather_want want)
{
    const int F = lanes_of(dim);
    const double *record = nodes->window + (ptrdiff_t)node * nodes->record;
    point_sums own;
    own.v = lanes_at(record, seen_lanes(dim, want));
    if (want.light) {
        const double mass = nodes->mass[node], withheld = mass < floor ? (1.0 - mass / floor) * nodes->kick : 0.0;
        own.u = lanes_plus(lanes_at(record, F), -withheld, lanes_at(record + dim, F), F);
    }
    return sums_share_along(&own, 0, s->w[0][x][j], s->dw[0][x][j], dim, want);
}

FLOE_ALWAYS_INLINE point_sums sum_row(const stencils *s, int j, int node, const nodes_seen *nodes, double floor,
                                      const int dim, const int basis, const gather_want want)
{
    point_sums row = node_share(s, j, 0, node, nodes, floor, dim, want);
    for (int x = 1; x < basis_support(basis); ++x) {
        const point_sums share = node_share(s, j, x, node + x, nodes, floor, dim, want);
        add_sums(&row, &share, 0, dim, want);
    }
    return row;
}

FLOE_ALWAYS_INLINE point_sums row_share(const stencils *s, int j, int y, int node, const nodes_seen *nodes,
                                        double floor, const int dim, const int basis, const gather_want want)
{
    const point_sums row = sum_row(s, j, node, nodes, floor, dim, basis, want);
    return sums_share_along(&row, 1, s->w[1][y][j], s->dw[1][y][j], dim, want);
}

FLOE_ALWAYS_INLINE point_sums sum_plane(const stencils *s, int j, int node, const nodes_seen *nodes, double floor,
                                        const int dim, const int basis, const gather_want want)
{
    const int width = window_width(dim, basis);
    point_sums plane = row_share(s, j, 0, node, nodes, floor, dim, basis, want);
    for (int y = 1; y < basis_support(basis); ++y) {
        const point_sums share = row_share(s, j, y, node + y * width, nodes, floor, dim, basis, want);
        add_sums(&plane, &share, 1, dim, want);
    }
    return plane;
}

FLOE_ALWAYS_INLINE point_sums plane_share(const stencils *s, int j, int z, int node, const nodes_seen *nodes,
                                          double floor, const int dim, const int basis, const gather_want want)
{
    const point_sums plane = sum_plane(s, j, node, nodes, floor, dim, basis, want);
    return sums_share_along(&plane, 2, s->w[2][z][j], s->dw[2][z][j], dim, want);
}

/* Sums over the nodes of the j-th stencil. */
FLOE_ALWAYS_INLINE point_sums sum_stencil(const stencils *s, int j, const nodes_seen *nodes, double floor,
                                          const int dim, const int basis, const gather_want want)
{
    const int layer = window_width(dim, basis) * window_width(dim, basis), node = s->node[j];
    if (dim == 1) return sum_row(s, j, node, nodes, floor, dim, basis, want);
    if (dim == 2) return sum_plane(s, j, node, nodes, floor, dim, basis, want);
    point_sums sum = plane_share(s, j, 0, node, nodes, floor, dim, basis, want);
    for (int z = 1; z < basis_support(basis); ++z) {
        const point_sums share = plane_share(s, j, z, node + z * layer, nodes, floor, dim, basis, want);
        add_sums(&sum, &share, 2, dim, want);
    }
    return sum;
}

/* Whether a node of the j-th stencil is lighter than the floor. */
FLOE_ALWAYS_INLINE bool has_light_node(const stencils *s, int j, const double *mass, double floor, const int dim,
                                       const int basis)
{
    int light = 0;
    FOR_ROWS(*s, j, dim, basis, {
        (void)W;
        for (int x = 0; x < basis_support(basis); ++x) light |= mass[row + x] < floor;
    });
    return light != 0;
}

/* The sums of the i-th point of a strip: most have no light node, and u = v. */
FLOE_ALWAYS_INLINE point_sums sum_point(const stencils *s, int i, const nodes_seen *nodes, double floor, const int dim,
                                        const int basis, const gather_want want)
{
    const gather_want plain = {want.motion, want.gradient, false};
    const int pieces = basis_pieces(basis, dim), j = i * pieces;
    if (want.light && has_light_node(s, j, nodes->mass, floor, dim, basis))
        return sum_stencil(s, j, nodes, floor, dim, basis, want);
    point_sums sum = sum_stencil(s, j, nodes, floor, dim, basis, plain);
    for (int piece = 1; piece < pieces; ++piece) {
        const point_sums other = sum_stencil(s, j + piece, nodes, floor, dim, basis, plain);
        add_sums(&sum, &other, dim - 1, dim, plain);
    }
    return sum;
}

FLOE_ALWAYS_INLINE void move_point_by_sums(const point_arrays *p, size_t k, const point_sums *sum,
                                           const gather_step *step, const gather_result *to, const int dim)
{
    const int V = lanes_of(2 * dim);
    for (int a = 0; a < dim; ++a) {
        const double v = lanes_get(sum->v, a, V), acceleration = lanes_get(sum->v, dim + a, V);
        to->x_next[a][k] = p->x[a][k] + step->dt * v;
        to->v_next[a][k] = step->flip * (p->v[a][k] + step->kick * acceleration) + (1.0 - step->flip) * v;
    }
}

/* Motion: v_p += sum S a kick blended with sum S v^L; x_p += dt sum S v^L (theory 4.2).
 * Gradient: L_p = sum v_i (x) grad S; L_hoop = sum S v_r / r (theory 4.1, 4.5); rows of L are counted from `start`.
 * `centred`: grad S is taken elsewhere than S (locate.h). */
FLOE_ALWAYS_INLINE void gather_body(const mesh *m, const tile_box *t, const point_arrays *p, size_t start, size_t end,
                                    const double *restrict window, const gather_step *now, const gather_result *to,
                                    const int dim, const bool axisymmetric, const int basis, const bool motion,
                                    const bool gradient, const bool centred)
{
    const bool light = gather_needs_mass(basis_has_kinks(basis), motion, gradient);
    const gather_want want = {motion, gradient && !centred, light && !centred}, rates = {false, true, light};
    const int F = lanes_of(dim);
    const tile_frame frame = frame_of(m, t, dim);
    const int V = seen_lanes(dim, want);
    const nodes_seen nodes = {window, lanes_reserved(V), now->mass, now->kick};
    const gather_result out = *to;
    const gather_step step = *now;
    const size_t origin = start;
    stencils s, centres;
    for (int n; start < end; start += (size_t)n) {
        n = strip_length(start, end, dim, basis);
        locate(&s, m, &frame, p, start, n, dim, basis);
        if (gradient && centred) locate_points(&centres, &frame, p, start, n, dim, basis, true);
        for (int i = 0; i < n; ++i) {
            const size_t k = start + (size_t)i, row = k - origin;
            const double floor = light ? light_node * p->mass[k] : 0.0;
            point_sums sum = sum_point(&s, i, &nodes, floor, dim, basis, want);
            if (motion) move_point_by_sums(p, k, &sum, &step, &out, dim);
            if (gradient && centred) sum = sum_point(&centres, i, &nodes, floor, dim, basis, rates);
            if (gradient && axisymmetric)
                out.L[8][row] = lanes_get(sum.v, 0, centred ? F : V) / (centred ? centres.radius[i] : p->x[0][k]);
            for (int a = 0; gradient && a < dim; ++a)
                for (int c = 0; c < dim; ++c) out.L[3 * a + c][row] = lanes_get(sum.L[c], a, F);
        }
    }
}

#endif
