/* Scratch of passes over the points: sums of tiles, and a batch of points for each thread. */
#ifndef MPM_SCRATCH_H
#define MPM_SCRATCH_H

#include "mpm/mpm.h"

enum { MPM_TILE_SUMS = 64 };

struct mpm_scratch {
    double *tile_sum;   /* per global tile, MPM_TILE_SUMS values, which domain_sum_tiles adds in global order; owned */
    solid_batch *batch; /* one per thread; owned */
};
floe_status scratch_create(mpm *s);
void scratch_free(mpm *s);

/* Sums over tiles, in global order: `add` adds those of a tile to `sum`, `count` numbers that begin as 0. */
typedef void tile_adder(mpm *s, int blk, int tile, void *user, double *sum);
void sum_over_tiles(mpm *s, int count, tile_adder *add, void *user, double *sum);

#endif
