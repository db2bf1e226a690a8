/* Parts of the search for cut cells that all dimensions share. Private to the module. */
#ifndef EMBEDDED_CUT_INTERNAL_H
#define EMBEDDED_CUT_INTERNAL_H

#include "embedded/cut.h"

enum { CUT_NEW = -3 };

/* Integral of the weight of areas along axis 0: x, or r^2/2 in axisymmetric scenes. */
double cut_weight_to(const mesh *m, double x);
/* The cut cell of a global cell; added where it is new. */
floe_status cut_touch(cut_surface *c, const int cell[3], int *out);
/* Whether an end lies on a side of the mesh normal to the axis; it then stays on it. */
static inline bool cut_is_on_side(const mesh *m, double x, int axis)
{
    return x == m->lower[axis] || x == m->upper[axis];
}
/* Contribution of a piece to the open volume of its cell and its moments, measured from the cell's lower side along
 * axis 0. */
typedef struct cut_part {
    double volume, moment[3];
} cut_part;

floe_status cut_add_piece(cut_surface *c, const int cell[3], const cut_piece *piece, const cut_part *part);
/* Splits one polyline of the plane, or one point in one dimension, into pieces. */
floe_status cut_walk(cut_surface *c, const cut_chain *chain);
floe_status cut_point(cut_surface *c, const cut_chain *chain);
/* Splits the triangles into pieces, and finishes the cells that they cut once nodes are numbered. */
floe_status cut_triangles(cut_surface *c);
floe_status cut_finish_in_space(cut_surface *c);
/* Space for one more than n items of a kind, growing by half. */
enum { CAPACITY_VERTICES, CAPACITY_CELLS, CAPACITY_PIECES, CAPACITY_CHAINS, CAPACITY_TRIANGLES };
floe_status cut_grow(cut_surface *c, int which, void *array, size_t n, size_t size);
/* Lines that cross hold more than all of a cell, or less than none, by more than this: bodies of a deck touch to some nine digits. */
static const double cut_crossing = 1e-6;

/* Shares of one cell that round-off keeps from none or all are that; unsound where one is far outside, but for
 * apertures of solids that overlap. */
typedef struct cut_shares {
    bool sound, overlap; /* overlap: less than none was open */
} cut_shares;

double cut_snapped_volume(const cut_surface *c, double share, cut_shares *of);
double cut_snapped_face(const cut_surface *c, double share, cut_shares *of);
/* Closes cells in which solids overlap (cut_contact.c). */
floe_status cut_close_contacts(cut_surface *c);
/* Finds what of a cell is open, once nodes are numbered. */
typedef floe_status cut_finisher(cut_surface *c, cut_cell *k);
/* Cells without volume around corners of solids are no passage (cut_corner.c); `finish` is for cells that become cut by that. In the plane. */
floe_status cut_free_corners(cut_surface *c, cut_finisher *finish);
/* The cut cell behind face 2 axis + side of another, finished where it is new; -1: beyond a side of the mesh. */
floe_status cut_reach_behind(cut_surface *c, int cell, int face, cut_finisher *finish, int *at);
/* Closes a share of a face of a cell. */
void cut_close_share(const cut_surface *c, cut_cell *k, int face, double share);
/* Pieces behind faces that corners of solids shade, in part those of the cells in front of them (cut_shade.c). In the plane. */
floe_status cut_shade_corners(cut_surface *c, cut_finisher *finish);
/* Nodes of the mesh, and number of one in `node`. */
int cut_nodes(const mesh *m);
static inline ptrdiff_t cut_node(const mesh *m, const int node[3])
{
    ptrdiff_t at = node[0];
    if (m->dim > 1) at += (ptrdiff_t)node[1] * (m->n[0] + 1);
    return m->dim > 2 ? at + (ptrdiff_t)node[2] * (m->n[0] + 1) * (m->n[1] + 1) : at;
}
/* In one dimension: where two bodies touch at a node, or overlap there by round-off, their points are moved into one
 * cell, whose open fraction becomes zero. A larger overlap gives a negative open fraction. */
floe_status cut_join_points(cut_surface *c);

#endif
