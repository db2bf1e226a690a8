/* Cut cells of an embedded boundary (a membrane, or the surface of a solid): exact open fractions of cells and
 * apertures of faces for the gas that it encloses.
 *
 * In two dimensions a boundary is one or several polylines with the enclosed gas on their left; in one dimension it is
 * points, each with the side on which its gas lies. The boundary is split into pieces that lie in one cell each, and
 * its crossings of cell edges are recorded. The crossings determine which nodes are inside: in one dimension these are
 * the faces, in two dimensions the crossings give the aperture of each face. Apertures and pieces give the open
 * fraction of each cell by Green's theorem. Nothing is sampled: in every cut cell the area vectors of open faces and of
 * the boundary sum to zero to round-off, so that a uniform pressure exerts no net force. In axisymmetric scenes all
 * areas are weighted with the radius. Nothing depends on blocks or threads. */
#ifndef EMBEDDED_CUT_H
#define EMBEDDED_CUT_H

#include "grid/mesh.h"

#include <stddef.h>

/* A vertex, and the material point or surface marker (by number, from 0) that moves it and takes its load. */
typedef struct cut_vertex {
    double x[2]; /* m */
    int point;
} cut_vertex;

/* A piece of the boundary in one cell; in one dimension both its ends are its vertex. */
typedef struct cut_piece {
    int cell;       /* index in `cell` */
    int vertex[2];  /* its ends lie between these, in the order of the polyline */
    double share;   /* weight of the second vertex at the middle of the piece; that of the first is 1 - share */
    double area[2]; /* m2 per metre (per radian): area vector, outward from the enclosed gas */
} cut_piece;

/* One polyline; in one dimension, a point. */
typedef struct cut_chain {
    int first, n; /* vertices; of a point 1 */
    bool closed;  /* the last vertex is connected to the first */
    int outward; /* of a point: sign of its area, outward from the enclosed gas, +1 or -1; 0: it lies on a side of the mesh and bounds no gas */
} cut_chain;

/* A cell that the boundary cuts. */
typedef struct cut_cell {
    int cell[2];       /* global */
    double open;       /* open fraction: share of its volume inside the boundary */
    double face[2][2]; /* apertures of its faces, by axis and side */
    double
        moment[2]; /* m: of what is held, about the cell's centre, over the cell's volume; about an axis not of [0] */
    double upper;  /* m2: moment along axis 1 of its upper face across axis 0: scratch of the walk */
    int jump[2]
            [2]; /* crossings of each face, by direction: scratch; in one dimension those along the cell, in [0][0] */
} cut_cell;

enum { CUT_INSIDE = -1, CUT_OUTSIDE = -2 };

typedef struct cut_surface {
    context *ctx;       /* not owned */
    const mesh *mesh;   /* not owned */
    cut_vertex *vertex; /* owned; set by the caller after cut_reserve, as are the chains */
    cut_chain *chain;   /* owned */
    int n_vertices, n_chains;
    cut_cell *cell;
    cut_piece *piece;
    int n_cells, n_pieces; /* in the order of the polylines */
    int *at;               /* of every global cell: its index in `cell`, or CUT_INSIDE, CUT_OUTSIDE; owned */
    signed char *node;     /* of every global node: 1 inside; owned */
    size_t capacity[4];    /* reserved vertices, cells, pieces, chains */
} cut_surface;

floe_status cut_create(cut_surface *c, context *ctx, const mesh *m);
void cut_destroy(cut_surface *c);
/* Reserves vertices and chains; sets n_vertices and n_chains. */
floe_status cut_reserve(cut_surface *c, int vertices, int chains);
/* Whether some cell has gas on both sides of a body thinner than itself, near x (m). Tests every pair of pieces, for
 * the start of a run. */
bool cut_is_thin(const cut_surface *c, double x[2]);
/* Finds the cut cells of the boundary after a time (s) at the given velocities of its vertices (m/s, two numbers each).
 * As cut_find; `from` does not change. Ends stay on the sides of the mesh. */
floe_status cut_ahead(const cut_surface *from, const double *velocity, double time, cut_surface *out);
/* Finds the cut cells from the vertices. Open polylines must end on sides of the mesh. FLOE_RETRY where boundaries
 * cross so that a gas would lie on both their sides. */
floe_status cut_find(cut_surface *c);

/* Index of a global cell in `at` and similar arrays. */
static inline size_t cut_index(const mesh *m, const int cell[2])
{
    return (size_t)cell[1] * (size_t)m->n[0] + (size_t)cell[0];
}
/* Share of a cell, moment, and share of one of its faces, that is held; of the gas outside it is one less that. */
static inline double cut_open(const cut_surface *c, const int cell[2])
{
    const int at = c->at[cut_index(c->mesh, cell)];
    return at >= 0 ? c->cell[at].open : at == CUT_INSIDE ? 1.0 : 0.0;
}
static inline double cut_moment(const cut_surface *c, const int cell[2], int axis)
{
    const int at = c->at[cut_index(c->mesh, cell)];
    return at >= 0 ? c->cell[at].moment[axis] : 0.0;
}
static inline double cut_face(const cut_surface *c, const int cell[2], int axis, int side)
{
    const int at = c->at[cut_index(c->mesh, cell)];
    return at >= 0 ? c->cell[at].face[axis][side] : at == CUT_INSIDE ? 1.0 : 0.0;
}

#endif
