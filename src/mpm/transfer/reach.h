/* Extent of bodies at nodes, determined by the points: the maximum over the points near a node. Private to the mpm module. */
#ifndef MPM_REACH_H
#define MPM_REACH_H

#include "grid/tile_box.h"
#include "mpm/mpm.h"
#include "mpm/transfer/point_arrays.h"
#include "mpm/transfer/windows.h"

/* The nodes of a tile's window that a point gives to. */
typedef struct point_span {
    int first[MESH_MAX_DIM], n[MESH_MAX_DIM];
    double from[MESH_MAX_DIM]; /* m: from the first node to the point */
} point_span;

point_span span_of_point(const mpm *s, const tile_box *t, const point_arrays *p, size_t k);

/* Nothing yet at the nodes of a tile's window, `count` numbers each; returns the window. */
double *start_reach(const mpm *s, const tile_box *t, int count);

/* Nodes get the largest of what `scatter` says of the tiles, in `count` fields of each group: their components in order. It begins with
 * start_reach where it has anything to say, and sets whether the tile is active. */
void reach_to_nodes(mpm *s, tile_visitor *scatter, const field_id *id, int count);

#endif
