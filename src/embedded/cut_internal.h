/* How surfaces become cut cells: shared by the dimensions. Private to the module. */
#ifndef EMBEDDED_CUT_INTERNAL_H
#define EMBEDDED_CUT_INTERNAL_H

#include "embedded/cut.h"

enum { CUT_NEW = -3 };

/* Integral of the weight of an area along axis 0: x, or about an axis r^2/2. */
double cut_weight_to(const mesh *m, double x);
/* The cut cell at a global cell, made where it is new. */
floe_status cut_touch(cut_surface *c, const int cell[2], int *out);
/* A piece's part of what is held of its cell, right of the cell's lower side along axis 0: volume and moments. */
typedef struct cut_part {
    double volume, moment[2];
} cut_part;

floe_status cut_add_piece(cut_surface *c, const int cell[2], const cut_piece *piece, const cut_part *part);
/* One line of the plane, one point of a line, cut into pieces. */
floe_status cut_walk(cut_surface *c, const cut_chain *chain);
floe_status cut_point(cut_surface *c, const cut_chain *chain);
/* Of points the nodes are numbered: of two bodies in touch at a node, or past each other there by round-off, the points
 * move into one cell, which they leave nothing of. What they cross by more shows as a share of it below none. */
floe_status cut_join_points(cut_surface *c);

#endif
