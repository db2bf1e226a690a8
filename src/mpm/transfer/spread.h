/* Sums of values of points to the nodes of their tile's window, and over tiles: for loops that are too rare for a kernel of their own. Private to the mpm
 * module. */
#ifndef MPM_SPREAD_H
#define MPM_SPREAD_H

#include "grid/tile_box.h"
#include "mpm/mpm.h"
#include "mpm/transfer/point_arrays.h"

/* Adds `count` numbers of a point to those of the nodes of its tile's window, interleaved, by its weights there. */
void spread_numbers(const mpm *s, const tile_box *t, const point_arrays *p, size_t k, const double *number, int count,
                    double *window);
/* Sums of active tiles become sums at the nodes, periodic ends and walls folded, in `count` fields of a group: their
 * components in order, each a number of its own, so that walls keep the sum of every one. */
void gather_numbers(mpm *s, int group, const field_id *id, int count);
/* The same without what sides do: ghost nodes beyond them keep what they got. */
void gather_unfolded(mpm *s, int group, const field_id *id, int count);

#endif
