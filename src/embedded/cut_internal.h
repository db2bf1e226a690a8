/* Parts of the search for cut cells that all dimensions share. Private to the module. */
#ifndef EMBEDDED_CUT_INTERNAL_H
#define EMBEDDED_CUT_INTERNAL_H

#include "embedded/cut.h"

enum { CUT_NEW = -3 };

/* Integral of the weight of areas along axis 0: x, or r^2/2 in axisymmetric scenes. */
double cut_weight_to(const mesh *m, double x);
/* The cut cell of a global cell; added where it is new. */
floe_status cut_touch(cut_surface *c, const int cell[2], int *out);
/* Contribution of a piece to the open volume of its cell and its moments, measured from the cell's lower side along
 * axis 0. */
typedef struct cut_part {
    double volume, moment[2];
} cut_part;

floe_status cut_add_piece(cut_surface *c, const int cell[2], const cut_piece *piece, const cut_part *part);
/* Splits one polyline of the plane, or one point in one dimension, into pieces. */
floe_status cut_walk(cut_surface *c, const cut_chain *chain);
floe_status cut_point(cut_surface *c, const cut_chain *chain);
/* In one dimension: where two bodies touch at a node, or overlap there by round-off, their points are moved into one
 * cell, whose open fraction becomes zero. A larger overlap gives a negative open fraction. */
floe_status cut_join_points(cut_surface *c);

#endif
