/* The lattice on which a surface is contoured (facets.c), and what of it facets_cut.c needs. */
#ifndef GEOM_FACETS_INTERNAL_H
#define GEOM_FACETS_INTERNAL_H

#include "geom/facets.h"

typedef struct lattice {
    context *ctx;
    const shape *shape;
    const seed_spec *grid;
    double size[3];      /* m: of a box */
    int margin[3];       /* boxes beyond each side of the mesh */
    int n[3];            /* boxes along each axis */
    signed char *inside; /* of each corner; owned */
    int *vertex;         /* of each box, -1: none; owned */
    double (*normal)[3]; /* of each vertex; of one on an edge none; owned */
    size_t capacity[3];  /* vertices, facets, normals */
    bool crowded;        /* some box is passed by more than one piece of surface */
    facet_surface *out;
} lattice;

floe_status facets_add_vertex(lattice *l, const double x[3], const double normal[3], int *number);
/* None where two of its vertices are one. */
floe_status facets_add_facet(lattice *l, int i, int j, int k);
/* Cuts off what lies beyond the mesh, drops vertices without facets, and marks the rims. */
floe_status facets_cut_at_sides(lattice *l);

#endif
