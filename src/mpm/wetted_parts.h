/* What the files of walls of points share (wetted.h): the list of nodes at which fluid and solid have mass, and lines of them across a wall. */
#ifndef MPM_WETTED_PARTS_H
#define MPM_WETTED_PARTS_H

#include "mpm/wetted.h"
#include "mpm/work.h"

enum { FLUID, SOLID }; /* indices of wetted_node.mass, v, before, gained */

static inline double wetted_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Number of a global node. */
static inline size_t wetted_number(const mpm_wetted *w, const int at[MESH_MAX_DIM])
{
    return (size_t)at[0] + (size_t)w->nodes[0] * ((size_t)at[1] + (size_t)w->nodes[1] * (size_t)at[2]);
}

/* Visits nodes of a block from `lo` to `end`, counted in it, at which both have mass. */
typedef floe_status shared_visitor(mpm *s, int blk, const int at[MESH_MAX_DIM], ptrdiff_t local);
floe_status wetted_visit(mpm *s, int blk, const int lo[MESH_MAX_DIM], const int end[MESH_MAX_DIM],
                         shared_visitor *visit);

/* wetted_list.c: lists the nodes, in global order, each with the root of its line; members and first of all lines. */
floe_status wetted_list(mpm *s);
/* In the list, of a node that may lie beyond the mesh; -1: it is not there. */
int wetted_find(const mpm *s, const int at[MESH_MAX_DIM]);

/* wetted_line.c: one velocity of the wall for the line of a root; what it has lost is heat of its fluid. */
void wetted_hold_line(const mpm *s, int root);

#endif
