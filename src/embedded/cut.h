/* Cells that a membrane, or the surface of a solid, cuts: what it leaves of cells and faces to the gas that it holds,
 * exactly.
 *
 * In the plane a surface is one or several lines of vertices, straight between them, with the gas that they hold on
 * their left; on a line it is points, each with the side on which its gas is. Measures follow by recursion of
 * dimension: a surface is cut into pieces that lie in one cell each, and noted where it passes through edges of cells.
 * From these passages follow which nodes are held; on a line that is which faces are, in the plane the passages give
 * what part of each face is; from the faces and the pieces, by Green's theorem, what part of each cell. Nothing is
 * sampled, so that in every cut cell the areas of open faces and of the surface close to round-off: even pressure
 * pushes nothing. About an axis all of it is weighted with the radius. Nothing depends on blocks or threads. */
#ifndef EMBEDDED_CUT_H
#define EMBEDDED_CUT_H

#include "grid/mesh.h"

#include <stddef.h>

/* A vertex of a line, and the material point or the marker of a surface (by number, 0 first) that moves it and bears
 * its load. */
typedef struct cut_vertex {
    double x[2]; /* m */
    int point;
} cut_vertex;

/* A piece of the surface in one cell; a point is a piece with both ends at its vertex. */
typedef struct cut_piece {
    int cell;       /* in cut.cell */
    int vertex[2];  /* its ends lie between these, in the order of the line */
    double share;   /* of the second vertex in the middle of the piece; 1 - share of the first */
    double area[2]; /* m2 per metre (per radian): area vector, from the held gas outward */
} cut_piece;

/* One of the lines; on a mesh of one dimension, a point. */
typedef struct cut_chain {
    int first, n; /* vertices; of a point 1 */
    bool closed;  /* the last vertex is joined to the first */
    int outward;  /* of a point: way of its area, from the held gas outward, +1 or -1; 0: it lies on a side of the mesh
                     and holds nothing back */
} cut_chain;

/* A cell that the surface goes through. */
typedef struct cut_cell {
    int cell[2];       /* global */
    double open;       /* share of its volume that is held */
    double face[2][2]; /* the same of its faces, by axis and side */
    double
        moment[2];  /* m: of what is held, about the cell's centre, over the cell's volume; about an axis not of [0] */
    double upper;   /* m2: moment along axis 1 of its upper face across axis 0: scratch of the walk */
    int jump[2][2]; /* passages of a line through each face, by direction: scratch of the walk; of points along the
                          cell, in [0][0] */
} cut_cell;

enum { CUT_HELD = -1, CUT_OUTSIDE = -2 };

typedef struct cut_surface {
    context *ctx;       /* not owned */
    const mesh *mesh;   /* not owned */
    cut_vertex *vertex; /* owned; filled by the caller after cut_reserve, as are the chains */
    cut_chain *chain;   /* owned */
    int n_vertices, n_chains;
    cut_cell *cell;
    cut_piece *piece;
    int n_cells, n_pieces; /* in the order of the lines */
    int *at;               /* of every global cell: its place in `cell`, or CUT_HELD, CUT_OUTSIDE; owned */
    signed char *node;     /* of every global node: 1 held; owned */
    size_t capacity[4];    /* for vertices, cells, pieces, chains */
} cut_surface;

floe_status cut_create(cut_surface *c, context *ctx, const mesh *m);
void cut_destroy(cut_surface *c);
/* Room for so many vertices and chains; sets n_vertices and n_chains. */
floe_status cut_reserve(cut_surface *c, int vertices, int chains);
/* Whether gas lies on two sides of something thinner than a cell, in one cell: about x (m). Looks at every pair of
 * pieces, for the start of a run. */
bool cut_is_thin(const cut_surface *c, double x[2]);
/* Finds the cut cells of the lines where their vertices are after a time (s) at these velocities (m/s, two numbers
 * each). As cut_find; `from` keeps on standing. Ends stay on the sides of the mesh. */
floe_status cut_ahead(const cut_surface *from, const double *velocity, double time, cut_surface *out);
/* Finds the cut cells from the vertices. Open lines must end on sides of the mesh. FLOE_RETRY where lines cross so
 * that some gas would lie on both its sides. */
floe_status cut_find(cut_surface *c);

/* Place of a global cell in cut.at and its like. */
static inline size_t cut_index(const mesh *m, const int cell[2])
{
    return (size_t)cell[1] * (size_t)m->n[0] + (size_t)cell[0];
}
/* Share of a cell, moment, and share of one of its faces, that is held; of the gas outside it is one less that. */
static inline double cut_open(const cut_surface *c, const int cell[2])
{
    const int at = c->at[cut_index(c->mesh, cell)];
    return at >= 0 ? c->cell[at].open : at == CUT_HELD ? 1.0 : 0.0;
}
static inline double cut_moment(const cut_surface *c, const int cell[2], int axis)
{
    const int at = c->at[cut_index(c->mesh, cell)];
    return at >= 0 ? c->cell[at].moment[axis] : 0.0;
}
static inline double cut_face(const cut_surface *c, const int cell[2], int axis, int side)
{
    const int at = c->at[cut_index(c->mesh, cell)];
    return at >= 0 ? c->cell[at].face[axis][side] : at == CUT_HELD ? 1.0 : 0.0;
}

#endif
