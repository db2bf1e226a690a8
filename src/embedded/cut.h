/* Cut cells of an embedded boundary (a membrane, or the surface of a solid): exact open fractions of cells and
 * apertures of faces for the gas that it encloses.
 *
 * In three dimensions a boundary is triangles, in two one or several polylines with the enclosed gas on their left; in
 * one dimension it is points, each with the side on which its gas lies. The boundary is split into pieces that lie in
 * one cell each, and its crossings of cell edges are recorded. The crossings determine which nodes are inside: in one
 * dimension these are the faces; in two dimensions the crossings give the aperture of each face, in three those and the
 * cuts across the face (Green). Apertures and pieces give the open fraction of each cell by Gauss's theorem. Nothing is sampled: in every cut cell the area vectors of open faces and of
 * the boundary sum to zero to round-off, so that a uniform pressure exerts no net force. In axisymmetric scenes all
 * areas are weighted with the radius. Nothing depends on blocks or threads. */
#ifndef EMBEDDED_CUT_H
#define EMBEDDED_CUT_H

#include "grid/mesh.h"

#include <stddef.h>

/* A vertex, and the material point or surface marker (by number, from 0) that moves it and takes its load. */
typedef struct cut_vertex {
    double x[3]; /* m */
    int point;
    int body; /* of its surface, by number; bodies that touch are thin only by themselves */
} cut_vertex;

/* A piece of the boundary in one cell. */
typedef struct cut_piece {
    int cell; /* index in `cell` */
    int vertex
        [3]; /* it lies between these: in the order of the polyline, or the corners of its triangle; of a point both are it */
    double weight[3]; /* of these vertices at the middle of the piece; as many as the mesh has dimensions */
    double area[3];   /* m2 (per metre, per radian): area vector, outward from the enclosed gas */
    int through; /* 1 + 2 axis + side of the face of this cell through which it reaches it, from the cell in which it lies; 0: it lies in this one */
} cut_piece;

/* One polyline; in one dimension, a point. */
typedef struct cut_chain {
    int first, n; /* vertices; of a point 1 */
    bool closed;  /* the last vertex is connected to the first */
    int outward; /* of a point: sign of its area, outward from the enclosed gas, +1 or -1; 0: it lies on a side of the mesh and bounds no gas */
} cut_chain;

/* One triangle in space, counterclockwise as the solid sees it: its area vector points out of the gas. */
typedef struct cut_triangle {
    int vertex[3];
    unsigned char
        rim; /* bit k: no other triangle joins it between vertex k and the next, which lie on one side of the mesh */
} cut_triangle;

/* A cell that the boundary cuts. */
typedef struct cut_cell {
    int cell[3];       /* global */
    double open;       /* open fraction: share of its volume inside the boundary */
    double face[3][2]; /* apertures of its faces, by axis and side */
    double moment
        [3];      /* m: of its open part, about the cell's centre, about an axis its centroid, over the cell's volume */
    double upper; /* m2: moment along axis 1 of its upper face across axis 0: scratch of the walk */
    /* Scratch. In the plane crossings of each face, by axis and side; on a line those along the cell, in [0][0]; in space
     * those of the edges along each axis (cut_space.c). */
    int jump[3][4];
    bool overlap;          /* solids overlap here, or touch in one of its faces */
    unsigned char crossed; /* faces in which some of the boundary lies, as bits 2 axis + side; of a line none */
} cut_cell;

enum { CUT_INSIDE = -1, CUT_OUTSIDE = -2 };

typedef struct cut_surface {
    context *ctx;           /* not owned */
    const mesh *mesh;       /* not owned */
    cut_vertex *vertex;     /* owned; set by the caller after cut_reserve, as are the chains */
    cut_chain *chain;       /* owned; none in space */
    cut_triangle *triangle; /* owned; in space, set by the caller after cut_reserve_triangles */
    int n_vertices, n_chains, n_triangles;
    cut_cell *cell;
    cut_piece *piece;
    int n_cells, n_pieces; /* in the order of the polylines, or triangles */
    int *at;               /* of every global cell: its index in `cell`, or CUT_INSIDE, CUT_OUTSIDE; owned */
    signed char *node;     /* of every global node: 1 inside; owned */
    double
        overlap; /* solids in contact may overlap each other, or a side of the mesh, by this share of a cell; 0: lines that cross are refused */
    size_t capacity[5]; /* reserved vertices, cells, pieces, chains, triangles */
} cut_surface;

floe_status cut_create(cut_surface *c, context *ctx, const mesh *m);
void cut_destroy(cut_surface *c);
/* Reserves vertices and chains; sets n_vertices and n_chains. */
floe_status cut_reserve(cut_surface *c, int vertices, int chains);
/* Reserves triangles; sets n_triangles. */
floe_status cut_reserve_triangles(cut_surface *c, int triangles);
/* Whether some cell has gas on both sides of a body thinner than itself, near x (m). Tests pairs of pieces, for the
 * start of a run. */
floe_status cut_find_thin(const cut_surface *c, bool *thin, double x[3]);
/* Finds the cut cells of the boundary after a time (s) at the given velocities of its vertices (m/s, three numbers each).
 * As cut_find; `from` does not change. Ends stay on the sides of the mesh. */
floe_status cut_ahead(const cut_surface *from, const double *velocity, double time, cut_surface *out);
/* Finds the cut cells from the vertices, of which those beyond periodic sides are brought back; segments and triangles
 * go to the nearest images of their vertices. Open polylines, and rims of triangles, must end on sides of the mesh. FLOE_RETRY where boundaries
 * cross so that a gas would lie on both their sides, solids overlap by more than they may, or what is open of the two sides of a periodic axis differs. */
floe_status cut_find(cut_surface *c);

/* Index of a global cell in `at` and similar arrays. */
static inline size_t cut_index(const mesh *m, const int cell[3])
{
    return ((size_t)cell[2] * (size_t)m->n[1] + (size_t)cell[1]) * (size_t)m->n[0] + (size_t)cell[0];
}
/* Component of the place of the middle of a piece (m), of its images around a periodic axis that at its cell: corners of solids give pieces to the
 * cells in front of them. */
static inline double cut_at_middle(const cut_surface *c, const cut_piece *q, int axis)
{
    const double first = c->vertex[q->vertex[0]].x[axis];
    double sum = q->weight[0] * first;
    for (int k = 1; k < c->mesh->dim; ++k) {
        const double x = c->vertex[q->vertex[k]].x[axis];
        sum += q->weight[k] * (x + mesh_to_image(c->mesh, axis, x, first));
    }
    return sum + mesh_to_image(c->mesh, axis, sum, mesh_centre(c->mesh, axis, c->cell[q->cell].cell[axis]));
}
/* Open fraction of a cell, moment of its open part, and aperture of one of its faces; of the gas outside it is one less that. */
static inline double cut_open(const cut_surface *c, const int cell[3])
{
    const int at = c->at[cut_index(c->mesh, cell)];
    return at >= 0 ? c->cell[at].open : at == CUT_INSIDE ? 1.0 : 0.0;
}
static inline double cut_moment(const cut_surface *c, const int cell[3], int axis)
{
    const int at = c->at[cut_index(c->mesh, cell)];
    return at >= 0 ? c->cell[at].moment[axis] : 0.0;
}
static inline double cut_face(const cut_surface *c, const int cell[3], int axis, int side)
{
    const int at = c->at[cut_index(c->mesh, cell)];
    return at >= 0 ? c->cell[at].face[axis][side] : at == CUT_INSIDE ? 1.0 : 0.0;
}
/* Whether some of the boundary crosses one of a cell's faces, be it closed by that. */
static inline bool cut_crosses(const cut_surface *c, const int cell[3], int axis, int side)
{
    const int at = c->at[cut_index(c->mesh, cell)];
    return at >= 0 && c->cell[at].crossed >> (2 * axis + side) & 1;
}

#endif
