/* From blocks to whole arrays and back: cells in global order (z, y, x, last fastest), points in the order of their
 * ids. Both are independent of how the mesh is cut into blocks. */
#ifndef IO_GATHER_H
#define IO_GATHER_H

#include "sim/sim.h"

#include <stdint.h>

/* Where a point lies. */
typedef struct point_place {
    uint64_t id; /* P_ID */
    uint32_t block;
    uint32_t index; /* in the block's arrays of the body */
} point_place;

/* All points of a body. */
typedef struct point_list {
    int body; /* instance of the point fields */
    size_t n;
    point_place *place; /* counted memory, owned */
} point_list;

/* Lists the points of a body in the order of their ids. */
floe_status point_list_make(point_list *out, const sim *s, int body);
void point_list_free(context *ctx, point_list *list);

/* Copies one component of a point field to to[0], to[stride], ... in the order of the list. */
void gather_points(const sim *s, const point_list *list, field_id id, int comp, size_t stride, double *to);

/* Copies the owned cells of one component of a cell field to to[0], to[stride], ... in global order. */
void gather_cells(const sim *s, field_id id, int instance, int comp, size_t stride, double *to);
/* The way back; ghosts are left alone. */
void scatter_cells(const sim *s, field_id id, int instance, int comp, const double *from);

#endif
