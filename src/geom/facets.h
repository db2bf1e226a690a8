/* The surface of a shape in space as triangles: the surface between a solid and gas (theory 7.2). */
#ifndef GEOM_FACETS_H
#define GEOM_FACETS_H

#include "geom/seed.h"

/* One triangle, counterclockwise as the shape sees it. */
typedef struct facet {
    int vertex[3];
    unsigned char rim; /* bit k: the surface ends between vertex k and the next, on a side of the mesh */
} facet;

typedef struct facet_surface {
    double (*x)[3]; /* m; owned */
    int n;
    facet *facet; /* owned */
    int n_facets;
} facet_surface;

/* Triangles of the part of a shape's surface inside the mesh, their sides about a cell over `divide` long, or a half or a
 * quarter of that where the shape has walls or gaps that thin. Edges and
 * corners of the shape are kept, planes are exact, and of curved sides the volume is right to the fourth order. What of
 * the surface lies on a side of the mesh is left out; around a periodic axis it goes on where its vertices on both sides are images. Errors: FLOE_BAD_INPUT where the shape is too thin even so,
 * FLOE_NO_MEMORY. */
floe_status facets_make(facet_surface *out, context *ctx, const shape *s, const seed_spec *grid, int divide);
void facets_free(context *ctx, facet_surface *f);

#endif
