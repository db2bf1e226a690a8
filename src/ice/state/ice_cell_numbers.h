/* Cells of the mesh by their numbers, and which block owns them. */
#ifndef ICE_CELL_NUMBERS_H
#define ICE_CELL_NUMBERS_H

#include "ice/ice_view.h"

/* Number of a cell of the mesh, row by row, and which cell has a number. */
int ice_cell_number(const mesh *m, const int cell[MESH_MAX_DIM]);
void ice_numbered_cell(const mesh *m, int number, int cell[MESH_MAX_DIM]);
/* A cell of the mesh in the block that owns it. */
typedef struct ice_owned_cell {
    const block *b;
    const fields *f;
    ptrdiff_t at;
} ice_owned_cell;
ice_owned_cell ice_find_cell(const ice *s, const int cell[MESH_MAX_DIM]);

#endif
