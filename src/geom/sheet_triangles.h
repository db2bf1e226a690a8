/* Triangles between the points of a surface in space: what keeps the gases on its two sides apart (theory 7.1). */
#ifndef GEOM_SHEET_TRIANGLES_H
#define GEOM_SHEET_TRIANGLES_H

#include "geom/facets.h"
#include "geom/sheet_seeding.h"

/* A vertex lies at a point, or at its foot on sides of the mesh, where the surface ends. */
typedef struct sheet_vertex {
    int point;      /* of the surface, from 0 */
    unsigned sides; /* bits 2 axis + side */
} sheet_vertex;

typedef struct sheet_triangles {
    sheet_vertex *vertex; /* owned */
    int n;
    facet *facet; /* area vectors out of what the surface surrounds; of a plane along first x second; owned */
    int n_facets;
} sheet_triangles;

/* Joins the points of rows, at x (m, three each). Only the sides of triangles along `rim` lie on sides of the mesh. The surface
 * has to be closed, alone or with these: FLOE_BAD_INPUT where it ends inside the domain. */
floe_status sheet_triangles_make(sheet_triangles *out, context *ctx, const sheet_rows *rows, const double *x,
                                 const seed_spec *grid);
void sheet_triangles_free(context *ctx, sheet_triangles *t);
/* Place (m) of a vertex where the points lie at x, three numbers each, in a mesh. */
void sheet_vertex_at(const sheet_vertex *v, const double *x, const double lower[3], const double upper[3],
                     double out[3]);
/* What the triangles and the sides on which they end surround (m3); NAN where only sides tell where that ends. */
double sheet_triangles_volume(const sheet_triangles *t, const double *x, const double lower[3], const double upper[3]);

#endif
