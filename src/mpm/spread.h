/* Numbers of each point, spread to the nodes of its tile's window and summed over the tiles: for passes that are too rare for a kernel of
 * their own. Private to the mpm room. */
#ifndef MPM_SPREAD_H
#define MPM_SPREAD_H

#include "mpm/work.h"

/* Weights of the nodes about a point, and the first of them in the window of its tile. */
typedef struct tile_weights {
    double w[MESH_MAX_DIM][BASIS_MAX_SUPPORT];
    int n[MESH_MAX_DIM], first;
} tile_weights;

tile_weights weights_at(const mpm *s, const tile_box *t, const point_arrays *p, size_t k);
/* Adds `count` numbers of a point to those of the nodes of a window, interleaved. */
void spread_numbers(const mpm *s, const tile_weights *at, const double *number, int count, double *window);
/* What active tiles hold becomes sums at the nodes, periodic ends and walls folded, in `count` scalar fields of a group. */
void gather_numbers(mpm *s, int group, const field_id *id, int count);

#endif
