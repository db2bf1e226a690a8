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
        const double half = kind == BASIS_GIMP ? p->half[a][k] * f->inv_h[a] : 0.5;
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

#endif
