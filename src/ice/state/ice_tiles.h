/* Sums over tiles of amounts that a step enters into the ledger. */
#ifndef ICE_TILES_H
#define ICE_TILES_H

#include "ice/ice_view.h"

/* Sums of a step for each tile. */
enum {
    TILE_MASS,     /* advected through open sides, inward */
    TILE_MOMENTUM, /* three, and three moments (ice_add_impulse) */
    TILE_ENERGY = TILE_MOMENTUM + 6,
    TILE_DEFECT,          /* J: energy added or removed by guards */
    TILE_MASS_DEFECT,     /* kg */
    TILE_MOMENTUM_DEFECT, /* as TILE_MOMENTUM */
    TILE_GUARDS = TILE_MOMENTUM_DEFECT + 6,
    TILE_FLOORS,
    TILE_SOURCE_ENERGY,                      /* J: gravity's work */
    TILE_SOURCE_MOMENTUM,                    /* as TILE_MOMENTUM */
    TILE_SCRATCH = TILE_SOURCE_MOMENTUM + 6, /* three, scratch of any stage, otherwise zero */
    TILE_VALUES = TILE_SCRATCH + 3
};

/* The partials of the global tile that holds local cell (i, j, k) of block b. */
double *ice_tile(const ice *s, const block *b, int i, int j, int k);
/* An impulse along an axis at x, and its moment, to six of a tile's. */
static inline void ice_add_impulse(double *tile, const double x[MESH_MAX_DIM], int axis, double impulse)
{
    tile[axis] += impulse;
    add_moment(tile + 3, x, axis, impulse);
}
/* Owned rows that one thread must take together, so that no two meet in a tile: for loops that add to tiles. */
int ice_rows_chunk(const ice *s, ice_rows q);
void ice_clear_tiles(ice *s);
/* Adds the tiles up in order and enters them in the ledger. */
void ice_enter_tiles(ice *s);
/* Sums of the three values of TILE_SCRATCH, which are zero again. */
void ice_sum_scratch(const ice *s, double sum[3]);

#endif
