/* Owned cells of a block one after the other. */
#ifndef ICE_WALK_H
#define ICE_WALK_H

#include "ice/ice_view.h"

/* All owned cells of a block: for (ice_walk c = ICE_FIRST; ice_next_cell(b, &c);). Not for kernels. */
typedef struct ice_walk {
    int in[MESH_MAX_DIM], cell[MESH_MAX_DIM]; /* local, global */
    ptrdiff_t at;
} ice_walk;
#define ICE_FIRST    \
    {                \
        .in = { -1 } \
    }
bool ice_next_cell(const block *b, ice_walk *c);

#endif
