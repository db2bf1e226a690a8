/* Cells of a block: their positions, and their description in messages. */
#ifndef ICE_CELLS_H
#define ICE_CELLS_H

#include "ice/ice_view.h"

/* Where a block's cell is, and the middle of its face on a side; zero along axes that the mesh does not have. */
void ice_place_of(const ice *s, const block *b, const int cell[MESH_MAX_DIM], double x[MESH_MAX_DIM]);
void ice_side_place(const ice *s, const block *b, int axis, bool upper, const int cell[MESH_MAX_DIM],
                    double x[MESH_MAX_DIM]);
/* Share of a cell of the mesh that lies in a region; 1 where that has no model. */
double ice_region_share(const mesh *m, const shape *region, const int cell[MESH_MAX_DIM]);
/* Local (i, j, k) of a linear index. */
void ice_cell_of(const block *b, ptrdiff_t at, int cell[MESH_MAX_DIM]);
/* "cell (3, 4), material 0 (air)" for messages. */
void ice_place(const ice *s, const block *b, ptrdiff_t at, int r, char *text, size_t size);

#endif
