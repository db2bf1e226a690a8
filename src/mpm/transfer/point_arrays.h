/* The points of one body in one block as arrays. The kernels see nothing else of them: these depend on no scene and no
 * run. */
#ifndef MPM_POINT_ARRAYS_H
#define MPM_POINT_ARRAYS_H

#include "grid/tile_box.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct mpm;

/* Arrays of one body in one block, by component (SoA); NULL where the scene has no such field. */
typedef struct point_arrays {
    const double *x[3], *v[3], *half[3]; /* m, m/s, m */
    const double *mass, *volume0, *J;    /* kg, m3, 1 */
    const double *all_mass;              /* kg: of points that supports hold, too (nodes/supports.h) */
    const double *stress[6];             /* Pa, 1-D xx yy zz; 2-D xx yy zz xy; 3-D xx yy zz xy yz zx */
    const double *q, *grid_pressure;     /* Pa */
    const double *affine[9];             /* 1/s, d x d by rows: C_p (transfer.h) */
    const double *deform[9]; /* 1: F as it is stored, for what shapes domains; NULL: they keep their shape */
    double domain_limit;     /* cells: how far from its point a domain may reach along an axis */
    double linear_side
        [3]
        [2]; /* m: sides beyond which velocities are extrapolated (wall.c); infinite at those that mirror or repeat */
    double acceleration[3];   /* m/s2: body forces on this body */
    const double *drive[3];   /* m/s2: on top of them, on each point */
    double enclosed_pressure; /* Pa: the mean pressure that the membrane takes instead */
    bool centred;             /* gradients are taken at the cell's centre (locate.h) */
} point_arrays;

/* Arrays of a body's current state in a block; with `next_stress`, `next_velocity` these are of the next state. */
point_arrays points_of(const struct mpm *s, int blk, int body, bool next_stress, bool next_velocity);
/* Bit of the cell of a tile that holds point k. */
uint64_t cell_bit(const mesh *m, const tile_box *t, const point_arrays *p, size_t k);
/* The cells of a tile in which fluid points meet solid ones; 0 where the tile has only one kind. */
uint64_t shared_cells(const struct mpm *s, int blk, int tile, const tile_box *t);

#endif
