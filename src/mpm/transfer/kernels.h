/* The point kernels: transfer between the points and the nodes of a tile, and its arguments. They depend on no scene
 * and no run, so that they are compiled again only when they change themselves. */
#ifndef MPM_KERNELS_H
#define MPM_KERNELS_H

#include "base/compiler.h"
#include "grid/mesh.h"
#include "grid/tile_box.h"
#include "mpm/basis/basis.h"
#include "mpm/transfer/scatter_mode.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct point_arrays;

/* Adds the contributions of points [start, end) to the nodes of their tile's window, `out`: a record per node, mass and
 * momentum in lanes_of(1 + dim) doubles (if requested), then force in lanes_of(dim) (if requested). */
typedef void scatter_kernel(const mesh *m, const tile_box *t, const struct point_arrays *p, size_t start, size_t end,
                            double *out);

/* What a gather writes. */
typedef struct gather_result {
    double *x_next[3], *v_next[3];
    double *L[9]; /* rows of a batch, from `start` */
} gather_result;

typedef struct gather_step {
    double kick, dt; /* s: the times over which velocities and positions are advanced */
    double flip;
    const double *mass; /* kg: of the nodes of the window, where light ones matter */
} gather_step;

/* Moments: C of transfer.h in place of the gradient; not for the linear basis, of which the two are the same. */
typedef enum gather_mode { GATHER_MOTION, GATHER_GRADIENT, GATHER_BOTH, GATHER_MOMENTS, GATHER_MODES } gather_mode;

/* From the nodes of a tile's window to points [start, end). A node's record is v^L (or v), then a
 * where points move, in lanes_reserved(lanes_of(.)) doubles. */
typedef void gather_kernel(const mesh *m, const tile_box *t, const struct point_arrays *p, size_t start, size_t end,
                           const double *window, const gather_step *step, const gather_result *out);

/* Light nodes matter (kernels_gather.h) where the linear basis takes gradients of accelerated velocities. */
FLOE_ALWAYS_INLINE bool gather_needs_mass(bool kinks, bool motion, bool gradient)
{
    return kinks && motion && gradient;
}

/* One scalar per node to the points: out[0] for `start`, out[1] for the next, as far as `end`. */
typedef void sample_kernel(const mesh *m, const tile_box *t, const struct point_arrays *p, size_t start, size_t end,
                           const double *window, double *out);

/* Adds `count` numbers of each of the points [start, end) to those of the nodes, by the points' weights there: number[0] to
 * number[count - 1] are those of `start`. Interleaved at the nodes, too. */
typedef void spread_kernel(const mesh *m, const tile_box *t, const struct point_arrays *p, size_t start, size_t end,
                           const double *number, int count, double *window);

/* Adds to the nodes of a window, `out`, the momentum that points [start, end) would return if they took the velocities in another,
 * `window`, with their gradients; lanes_of(dim) doubles a node in both. */
typedef void project_kernel(const mesh *m, const tile_box *t, const struct point_arrays *p, size_t start, size_t end,
                            const double *window, double *out);

typedef struct kernel_set {
    scatter_kernel *scatter[SCATTER_MODES];
    gather_kernel *gather[GATHER_MODES];
    sample_kernel *sample;
    scatter_kernel *fill; /* volume of the points at their nodes */
    spread_kernel *spread;
    project_kernel *project;
} kernel_set;

/* The kernels of a dimension, geometry and basis, the fastest that the machine can run; chosen once. */
const kernel_set *kernels_of(int dim, mesh_geometry geometry, const basis_model *basis);
/* Those for any machine, and those for registers of four doubles (floe_has_quads): they give the same bits. */
const kernel_set *kernels_pairs(int dim, mesh_geometry geometry, const basis_model *basis);
const kernel_set *kernels_quads(int dim, mesh_geometry geometry, const basis_model *basis);

/* Rows of the tables of kernels: what a mesh's dimension and geometry come to. */
typedef enum kernel_space {
    KERNELS_LINE,
    KERNELS_PLANE,
    KERNELS_AXISYMMETRIC,
    KERNELS_SOLID,
    KERNEL_SPACES
} kernel_space;

/* Generated from the list of bases (cmake/FloePointKernels.cmake): rows of KERNEL_SPACES, each with a set for every basis
 * of the registry. */
extern const kernel_set *const kernels_table_pairs[], *const kernels_table_quads[];

#endif
