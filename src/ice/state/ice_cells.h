/* Cells of a block: their positions, and their description in messages. */
#ifndef ICE_CELLS_H
#define ICE_CELLS_H

#include "ice/ice_view.h"

/* Where a block's cell is, and the middle of its face on a side; zero along axes that the mesh does not have. */
void ice_place_of(const ice *s, const block *b, const int cell[MESH_MAX_DIM], double x[MESH_MAX_DIM]);
void ice_side_place(const ice *s, const block *b, int axis, bool upper, const int cell[MESH_MAX_DIM],
                    double x[MESH_MAX_DIM]);
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
/* Local (i, j, k) of a linear index. */
void ice_cell_of(const block *b, ptrdiff_t at, int cell[MESH_MAX_DIM]);
/* "cell (3, 4), material 0 (air)" for messages. */
void ice_place(const ice *s, const block *b, ptrdiff_t at, int r, char *text, size_t size);

#endif
