/* Tiles as boxes of global cells: what a pass over the points of a tile needs to know of it. */
#ifndef GRID_TILE_BOX_H
#define GRID_TILE_BOX_H

#include "grid/mesh.h"

#include <stdint.h>

/* A tile of a mesh. */
typedef struct tile_box {
    int first[MESH_MAX_DIM]; /* global cell of its corner */
    int cells[MESH_MAX_DIM]; /* owned cells; the last tile of an axis may be cut short */
    int number;              /* of the tile in the whole mesh */
    uint64_t
        shared; /* bit of each of its (at most 64) cells that holds points of a solid; set by those who ask for it */
} tile_box;

/* A tile of a block, by its number there. */
tile_box tile_box_of(const mesh *m, const block *b, int tile_in_block);
/* Nodes that a tile owns along each axis: the last tile owns those of the upper wall; a periodic end is node 0
 * again. */
void tile_nodes(const mesh *m, const tile_box *t, int end[MESH_MAX_DIM]);

#endif
