/* Lists of cells. */
#ifndef ICE_LISTS_H
#define ICE_LISTS_H

#include "ice/ice_view.h"

/* Owned cells of each block that something concerns: local indices, in order. */
typedef struct ice_cell_list {
    ptrdiff_t *at; /* owned */
    size_t n;
} ice_cell_list;
/* As long as every block has cells. */
floe_status ice_lists_create(ice *s, ice_cell_list list[MESH_MAX_BLOCKS]);
void ice_lists_destroy(context *ctx, ice_cell_list list[MESH_MAX_BLOCKS]);

/* Owned cells of each block of which some part lies in a region, with the share of each that does. Regions stay where they
 * are, and shares are costly: they are found once. */
typedef struct ice_region_cells {
    ice_cell_list cells[MESH_MAX_BLOCKS];
    double *share[MESH_MAX_BLOCKS]; /* of each cell of the list; owned */
} ice_region_cells;
floe_status ice_region_cells_create(ice *s, const shape *region, ice_region_cells *out);
void ice_region_cells_destroy(context *ctx, ice_region_cells *c);

#endif
