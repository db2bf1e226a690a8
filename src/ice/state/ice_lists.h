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

#endif
