/* Position of a point in the window of its tile, and its weights there: inlined into every kernel. */
#ifndef MPM_LOCATE_H
#define MPM_LOCATE_H

#include "mpm/basis/basis_inline.h"
#include "mpm/transfer/kernels.h"
#include "mpm/transfer/point_arrays.h"

#include <math.h>
#include <string.h>

/* Nodes of a tile's window along a used axis. */
FLOE_ALWAYS_INLINE int window_width(const int dim, const int basis)
{
    return (dim == 1 ? 64 : dim == 2 ? 8 : 4) + 1 + 2 * basis_reach(basis);
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

/* Stencils that are worked out together, in loops as wide as the machine. */
enum { STENCILS = 32 };

typedef struct stencils {
    double w[MESH_MAX_DIM][BASIS_MAX_SUPPORT][STENCILS], dw[MESH_MAX_DIM][BASIS_MAX_SUPPORT][STENCILS]; /* 1, 1/m */
    int node[STENCILS];                    /* of the window: the first node of the stencil */
    double offset[MESH_MAX_DIM][STENCILS]; /* m: from the point to the first node along each axis */
    double radius[STENCILS];               /* m: along the first axis, where the weights were taken */
} stencils;

/* Places of points in their tile, in cells, and the cells that hold them. */
typedef struct tile_places {
    double at[MESH_MAX_DIM][STENCILS];
    int cell[MESH_MAX_DIM][STENCILS];
} tile_places;

/* The cell is clamped to the tile, so that round-off at a cell's face never leaves the window. */
FLOE_ALWAYS_INLINE void find_places(tile_places *to, const tile_frame *f, const point_arrays *p, size_t start, int n,
                                    const int dim)
{
    for (int a = 0; a < dim; ++a) {
        const double *restrict x = p->x[a] + start, lower = f->lower[a], inv_h = f->inv_h[a], first = f->first[a];
        const int last = f->cells[a] - 1;
        for (int j = 0; j < n; ++j) {
            const double at = (x[j] - lower) * inv_h - first;
            const int cell = (int)at;
            to->at[a][j] = at;
            to->cell[a][j] = cell < 0 ? 0 : cell > last ? last : cell;
        }
    }
}

/* Moves places to the centres of their cells, but in cells shared with a solid.
 *
 * With the linear basis, fluids take their gradients there, in forces
 * and rates alike. Under pressure the gradient at the point itself makes the force depend on where in the cell the points
 * are, which pushes them further apart or together: a negative stiffness of about p/h^2, whose growth at about c/h no
 * viscosity, PIC blend or stress scheme cures (measured on the gas of the pressurised cylinder: e-fold in about 20 steps).
 * At the centre a uniform pressure gives no force wherever the points are, and rates and forces stay each other's
 * transpose. In cells shared with a solid the point's own place is taken, since the fluid fills but a part of them, and the
 * solid's inertia holds it (the centre there costs 28 for 25 % in the cylinder's stress at h = 0.1). About an axis the hoop
 * terms S/r are part of the divergence, and are taken at the same place. The smooth bases change slowly across a cell, and
 * keep the point's own gradient. */
FLOE_ALWAYS_INLINE void centre_places(tile_places *to, double *radius, const tile_frame *f, int n, const int dim,
                                      const int basis)
{
    const int width = window_width(dim, basis) - 1 - 2 * basis_reach(basis);
    for (int j = 0; j < n; ++j) {
        int bit = 0;
        for (int a = dim - 1; a >= 0; --a) bit = bit * width + to->cell[a][j];
        if ((f->shared >> bit) & 1) continue;
        for (int a = 0; a < dim; ++a) to->at[a][j] = to->cell[a][j] + 0.5;
        radius[j] = f->lower[0] + (f->first[0] + to->at[0][j]) / f->inv_h[0];
    }
}

/* The stencils of the n points from `start`; `centre`: as if they stood at their cells' centres. */
FLOE_ALWAYS_INLINE void locate_points(stencils *s, const tile_frame *f, const point_arrays *p, size_t start, int n,
                                      const int dim, const int basis, const bool centre)
{
    const int width = window_width(dim, basis);
    const bool boxes = basis_has_boxes(basis);
    tile_places places;
    find_places(&places, f, p, start, n, dim);
    memcpy(s->radius, p->x[0] + start, (size_t)n * sizeof *s->radius);
    if (centre) centre_places(&places, s->radius, f, n, dim, basis);
    memset(s->node, 0, sizeof s->node);
    for (int a = 0, row = 1; a < dim; ++a, row *= width) {
        const double inv_h = f->inv_h[a], *restrict own = boxes ? p->half[a] + start : NULL;
        for (int j = 0; j < n; ++j) {
            /* Fluids may swell beyond what three nodes hold. */
            const double half = boxes && own[j] * inv_h < 0.5 ? own[j] * inv_h : 0.5;
            double w[BASIS_MAX_SUPPORT], dw[BASIS_MAX_SUPPORT];
            const int first =
                places.cell[a][j] + basis_weights(basis, places.at[a][j] - places.cell[a][j], half, inv_h, w, dw);
            for (int i = 0; i < basis_support(basis); ++i) {
                s->w[a][i][j] = w[i];
                s->dw[a][i][j] = dw[i];
            }
            s->offset[a][j] = (first - places.at[a][j]) / inv_h;
            s->node[j] += row * (first + basis_reach(basis));
        }
    }
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

/* Largest half width of a domain along an axis, in cells: the deck's limit, and not beyond sides that are no mirrors,
 * where velocities are extrapolated and a corner of an inclined domain would give interior nodes negative weights. A
 * point on such a side keeps a small width. */
FLOE_ALWAYS_INLINE double domain_limit_at_side(const mesh *m, const point_arrays *p, size_t k, int axis)
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
        const double limit = domain_limit_at_side(m, p, k, a);
        if (!(width[a] <= limit)) {
            for (int b = 0; b < dim; ++b) d.side[a][b] *= limit / width[a];
            width[a] = limit;
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
FLOE_ALWAYS_INLINE void locate_corner(stencils *s, int j, const tile_frame *f, const point_arrays *p, size_t k,
                                      const int dim, const int basis, const point_domain *d, const int corner)
{
    const int width = window_width(dim, basis);
    const double share = dim == 1 ? 0.5 : dim == 2 ? 0.25 : 0.125;
    int row = 1;
    s->node[j] = 0;
    s->radius[j] = p->x[0][k];
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
        s->w[a][0][j] = scale * (1.0 - (place - cell));
        s->w[a][1][j] = scale * (place - cell);
        for (int i = 0; i < 2; ++i) s->dw[a][i][j] = slope * f->inv_h[a] * s->w[a][i][j];
        s->offset[a][j] = (cell - at) / f->inv_h[a];
        s->node[j] += row * (cell + basis_reach(basis));
        row *= width;
    }
}

/* Points of which the stencils fit side by side. */
FLOE_ALWAYS_INLINE int points_at_once(const int dim, const int basis)
{
    return STENCILS / basis_pieces(basis, dim);
}

/* Points of a stencil's strip: from `start`, at most as many as fit. */
FLOE_ALWAYS_INLINE int strip_length(size_t start, size_t end, const int dim, const int basis)
{
    const size_t most = (size_t)points_at_once(dim, basis);
    return (int)(end - start < most ? end - start : most);
}

/* The stencils of the n points from `start`; basis_pieces of them side by side, of which the sum is the point's. */
FLOE_ALWAYS_INLINE void locate(stencils *s, const mesh *m, const tile_frame *f, const point_arrays *p, size_t start,
                               int n, const int dim, const int basis)
{
    if (!basis_has_corners(basis)) {
        locate_points(s, f, p, start, n, dim, basis, false);
        return;
    }
    const int pieces = basis_pieces(basis, dim);
    for (int i = 0; i < n; ++i) {
        const size_t k = start + (size_t)i;
        const point_domain d = domain_of(m, p, k, dim);
        for (int piece = 0; piece < pieces; ++piece)
            locate_corner(s, i * pieces + piece, f, p, k, dim, basis, &d, piece);
    }
}

/* Loops over the rows along the first axis of the j-th stencil: the body sees `row` (index in the window of its first node), `W` (product
 * of the weights of the other axes), and the nodes `y_` and `z_` along those. What a row's nodes share is then worked out once. */
#define FOR_ROWS(s, j, dim, basis, ...)                                                                     \
    do {                                                                                                    \
        const int width_ = window_width(dim, basis), support_ = basis_support(basis);                       \
        for (int z_ = 0; z_ < ((dim) > 2 ? support_ : 1); ++z_)                                             \
            for (int y_ = 0; y_ < ((dim) > 1 ? support_ : 1); ++y_) {                                       \
                const double W = ((dim) > 1 ? (s).w[1][y_][j] : 1.0) * ((dim) > 2 ? (s).w[2][z_][j] : 1.0); \
                const int row = (s).node[j] + width_ * (y_ + width_ * z_);                                  \
                __VA_ARGS__                                                                                 \
            }                                                                                               \
    } while (0)

/* Loops over the stencils of which the weights of the i-th point are the sum, each number `j`. */
#define FOR_PIECES(j, i, dim, basis) \
    for (int j = (i)*basis_pieces(basis, dim); j < ((i) + 1) * basis_pieces(basis, dim); ++j)

#endif
