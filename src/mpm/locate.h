/* Where a point stands in its tile's window, and its weights there: inlined into every kernel. */
#ifndef MPM_LOCATE_H
#define MPM_LOCATE_H

#include "mpm/basis/basis_1d.h"
#include "mpm/work.h"

/* Nodes of a tile's window along a used axis. */
FLOE_ALWAYS_INLINE int window_width(const int dim, const basis_kind kind)
{
    return (dim == 1 ? 64 : dim == 2 ? 8 : 4) + 1 + 2 * basis_reach(kind);
}

/* What of the mesh and the tile the kernels need, by value: nothing that they write can then alias it. */
typedef struct tile_frame {
    double lower[MESH_MAX_DIM], inv_h[MESH_MAX_DIM]; /* m, 1/m */
    double first[MESH_MAX_DIM];
    int cells[MESH_MAX_DIM];
    uint64_t shared;
} tile_frame;

FLOE_ALWAYS_INLINE tile_frame frame_of(const mesh *m, const tile_box *t, const int dim)
{
    tile_frame f = {.shared = t->shared};
    for (int a = 0; a < dim; ++a) {
        f.lower[a] = m->lower[a];
        f.inv_h[a] = 1.0 / m->h[a];
        f.first[a] = t->first[a];
        f.cells[a] = t->cells[a];
    }
    return f;
}

typedef struct stencil {
    double w[MESH_MAX_DIM][BASIS_MAX_SUPPORT], dw[MESH_MAX_DIM][BASIS_MAX_SUPPORT];
    int node;                    /* of the window: the first node of the stencil */
    double offset[MESH_MAX_DIM]; /* m: from the point to the first node along each axis */
    double radius;               /* m: along the first axis, where the weights were taken */
} stencil;

/* The cell is clamped to the tile, so that round-off at a cell's face never leaves the window.
 *
 * `centre`: as if the point stood at its cell's centre. With the linear basis, fluids take their gradients there, in forces
 * and rates alike. Under pressure the gradient at the point itself makes the force depend on where in the cell the points
 * are, which pushes them further apart or together: a negative stiffness of about p/h^2, whose growth at about c/h no
 * viscosity, PIC blend or stress scheme cures (measured on the gas of the pressurised cylinder: e-fold in about 20 steps).
 * At the centre a uniform pressure gives no force wherever the points are, and rates and forces stay each other's
 * transpose. In cells shared with a solid the point's own place is taken, since the fluid fills but a part of them, and the
 * solid's inertia holds it (the centre there costs 28 for 25 % in the cylinder's stress at h = 0.1). About an axis the hoop
 * terms S/r are part of the divergence, and are taken at the same place. The smooth bases change slowly across a cell, and
 * keep the point's own gradient. */
FLOE_ALWAYS_INLINE stencil locate(const tile_frame *f, const point_arrays *p, size_t k, const int dim,
                                  const basis_kind kind, const bool centre)
{
    stencil s;
    const int width = window_width(dim, kind);
    double at[3];
    int cell[3], bit = 0, bit_row = 1;
    for (int a = 0; a < dim; ++a) {
        at[a] = (p->x[a][k] - f->lower[a]) * f->inv_h[a] - f->first[a];
        cell[a] = (int)at[a];
        cell[a] = cell[a] < 0 ? 0 : cell[a] >= f->cells[a] ? f->cells[a] - 1 : cell[a];
        bit += bit_row * cell[a];
        bit_row *= width - 1 - 2 * basis_reach(kind);
    }
    const bool centred = centre && !((f->shared >> bit) & 1);
    s.node = 0;
    int row = 1;
    for (int a = 0; a < dim; ++a) {
        /* Fluids may swell beyond what three nodes hold. */
        const double half = kind == BASIS_GIMP ? fmin(p->half[a][k] * f->inv_h[a], 0.5) : 0.5;
        const int first = basis_1d(kind, centred ? 0.5 : at[a] - cell[a], half, f->inv_h[a], s.w[a], s.dw[a]);
        if (a == 0) s.radius = centred ? f->lower[0] + (f->first[0] + cell[0] + 0.5) / f->inv_h[0] : p->x[0][k];
        s.offset[a] = (cell[a] + first - at[a]) / f->inv_h[a];
        s.node += row * (cell[a] + first + basis_reach(kind));
        row *= width;
    }
    for (int a = dim; a < 3; ++a) {
        s.w[a][0] = 1.0;
        s.dw[a][0] = 0.0;
    }
    return s;
}

/* The domain of a point in CPDI: centre and half sides of a parallelogram (parallelepiped). */
typedef struct point_domain {
    double side[MESH_MAX_DIM][MESH_MAX_DIM];    /* cells: component a of half side b */
    double inverse[MESH_MAX_DIM][MESH_MAX_DIM]; /* of that matrix */
} point_domain;

/* Inverse of a d x d matrix, d literal; returns the determinant, of which the inverse lacks the division where it is 0. */
FLOE_ALWAYS_INLINE double domain_invert(double a[3][3], double b[3][3], const int dim)
{
    double det = a[0][0];
    if (dim == 1) b[0][0] = 1.0;
    if (dim == 2) {
        b[0][0] = a[1][1];
        b[0][1] = -a[0][1];
        b[1][0] = -a[1][0];
        b[1][1] = a[0][0];
        det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    }
    if (dim == 3) {
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                const int p = (j + 1) % 3, q = (j + 2) % 3, r = (i + 1) % 3, t = (i + 2) % 3;
                b[i][j] = a[p][r] * a[q][t] - a[p][t] * a[q][r];
            }
        det = a[0][0] * b[0][0] + a[0][1] * b[1][0] + a[0][2] * b[2][0];
    }
    for (int i = 0; i < dim && det != 0.0; ++i)
        for (int j = 0; j < dim; ++j) b[i][j] /= det;
    return det;
}

/* How far a domain may reach along an axis, in cells: the deck's limit, and no farther than sides that do not mirror, beyond which
 * velocities are extrapolated: a corner of a domain that leans would give nodes inside negative weights. A point on such a side keeps a
 * sliver. */
FLOE_ALWAYS_INLINE double domain_room(const mesh *m, const point_arrays *p, size_t k, int axis)
{
    const double sliver = 1e-4;
    const double below = (p->x[axis][k] - p->linear_side[axis][0]) / m->h[axis],
                 above = (p->linear_side[axis][1] - p->x[axis][k]) / m->h[axis], side = below < above ? below : above;
    return side > p->domain_limit ? p->domain_limit : side > sliver ? side : sliver;
}

/* Half sides r_b = F r_b0. What reaches farther than it may along an axis is squeezed along that axis: it stays a parallelogram about
 * its point, so that linear fields stay exact, and the nodes that it reaches stay within the window. (Homel, Brannon and Guilkey 2016
 * shorten the diagonals.) One that is next to flat becomes the box about it: gradients across it would be differences of next to
 * nothing. */
FLOE_ALWAYS_INLINE point_domain domain_of(const mesh *m, const point_arrays *p, size_t k, const int dim)
{
    const double flat = 1e-3;
    point_domain d = {.side = {{0.0}}};
    double width[3], box = 1.0;
    for (int a = 0; a < dim; ++a) {
        width[a] = 0.0;
        for (int b = 0; b < dim; ++b) {
            const double stretch = p->deform[0] ? p->deform[dim * a + b][k] : a == b ? 1.0 : 0.0;
            d.side[a][b] = stretch * p->half[b][k] / m->h[a];
            width[a] += fabs(d.side[a][b]);
        }
        const double room = domain_room(m, p, k, a);
        if (!(width[a] <= room)) {
            for (int b = 0; b < dim; ++b) d.side[a][b] *= room / width[a];
            width[a] = room;
        }
        box *= width[a];
    }
    if (fabs(domain_invert(d.side, d.inverse, dim)) > flat * box) return d;
    for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b) {
            d.side[a][b] = a == b ? width[a] : 0.0;
            d.inverse[a][b] = a == b ? 1.0 / width[a] : 0.0;
        }
    return d;
}

/* A corner of a point's domain: S_i is the mean over the corners of the linear N_i there, and grad S_i that over the domain of the gradient
 * of what the corners interpolate: sum over corners of N_i g/2^d, g = R^-T s, R the half sides and s = +-1 the corner's place on each
 * (Sadeghirad, Brannon and Burghardt 2011). So a corner is a stencil of the linear basis with slopes of its own. */
FLOE_ALWAYS_INLINE stencil locate_corner(const tile_frame *f, const point_arrays *p, size_t k, const int dim,
                                         const point_domain *d, const int corner)
{
    stencil s;
    const int width = window_width(dim, BASIS_CPDI);
    const double share = dim == 1 ? 0.5 : dim == 2 ? 0.25 : 0.125;
    int row = 1;
    s.node = 0;
    s.radius = p->x[0][k];
    for (int a = 0; a < dim; ++a) {
        const double at = (p->x[a][k] - f->lower[a]) * f->inv_h[a] - f->first[a];
        double place = at, slope = 0.0;
        for (int b = 0; b < dim; ++b) {
            const double sign = (corner >> b) & 1 ? 1.0 : -1.0;
            place += sign * d->side[a][b];
            slope += sign * d->inverse[b][a];
        }
        int cell = (int)(place + 1.0) - 1; /* floor, from -1 on */
        cell = cell < -1 ? -1 : cell > f->cells[a] ? f->cells[a] : cell;
        const double scale = a == 0 ? share : 1.0;
        s.w[a][0] = scale * (1.0 - (place - cell));
        s.w[a][1] = scale * (place - cell);
        for (int i = 0; i < 2; ++i) s.dw[a][i] = slope * f->inv_h[a] * s.w[a][i];
        s.offset[a] = (cell - at) / f->inv_h[a];
        s.node += row * (cell + basis_reach(BASIS_CPDI));
        row *= width;
    }
    for (int a = dim; a < 3; ++a) {
        s.w[a][0] = 1.0;
        s.dw[a][0] = 0.0;
    }
    return s;
}

/* One of the stencils of which a point's weights are the sum. */
FLOE_ALWAYS_INLINE stencil locate_piece(const tile_frame *f, const point_arrays *p, size_t k, const int dim,
                                        const basis_kind kind, const point_domain *d, const int piece)
{
    return kind == BASIS_CPDI ? locate_corner(f, p, k, dim, d, piece) : locate(f, p, k, dim, kind, false);
}

/* Loops over the rows of a stencil along the first axis: the body sees `row` (index in the window of its first node), `W` (product
 * of the weights of the other axes) and its derivatives `Wy`, `Wz` (1/m), and the nodes `y_` and `z_` along those. What a row's nodes share is then worked out once. */
#define FOR_ROWS(s, dim, kind, ...)                                                               \
    do {                                                                                          \
        const int width_ = window_width(dim, kind), support_ = basis_support(kind);               \
        for (int z_ = 0; z_ < ((dim) > 2 ? support_ : 1); ++z_)                                   \
            for (int y_ = 0; y_ < ((dim) > 1 ? support_ : 1); ++y_) {                             \
                const double W = (s).w[1][(dim) > 1 ? y_ : 0] * (s).w[2][(dim) > 2 ? z_ : 0];     \
                const double Wy = (dim) > 1 ? (s).dw[1][y_] * (s).w[2][(dim) > 2 ? z_ : 0] : 0.0; \
                const double Wz = (dim) > 2 ? (s).w[1][y_] * (s).dw[2][z_] : 0.0;                 \
                const int row = (s).node + width_ * (y_ + width_ * z_);                           \
                (void)W, (void)Wy, (void)Wz;                                                      \
                __VA_ARGS__                                                                       \
            }                                                                                     \
    } while (0)

/* Visits the stencils of which the weights of a point are the sum, `s` each. */
#define FOR_PIECES(s, m, frame, p, k, dim, kind, ...)                                 \
    do {                                                                              \
        point_domain domain_ = {.side = {{0.0}}};                                     \
        if ((kind) == BASIS_CPDI) domain_ = domain_of(m, p, k, dim);                  \
        for (int piece_ = 0; piece_ < basis_pieces(kind, dim); ++piece_) {            \
            const stencil s = locate_piece(frame, p, k, dim, kind, &domain_, piece_); \
            __VA_ARGS__                                                               \
        }                                                                             \
    } while (0)

#endif
