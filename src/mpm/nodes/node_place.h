/* Where nodes are in the blocks (node_place.c). */
#ifndef MPM_NODE_PLACE_H
#define MPM_NODE_PLACE_H

#include "mpm/mpm.h"

/* Where the values of a node are. */
typedef struct node_place {
    int block;
    ptrdiff_t at;
} node_place;
/* In the block that owns the node: one on the seam of two belongs to the upper one, as its cell does. */
node_place owner_of_node(const mesh *m, const int node[MESH_MAX_DIM]);
/* Where a block sees a node, moved by whole periods; false where it does not. */
bool find_node_in_block(const mesh *m, const block *b, const int node[MESH_MAX_DIM], const int period[MESH_MAX_DIM],
                        ptrdiff_t *at);

#endif
