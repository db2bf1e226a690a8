/* Seeding: from a shape to material points. */
#ifndef GEOM_SEED_H
#define GEOM_SEED_H

#include "geom/shape.h"

typedef enum seed_method {
    /* The papers': a point at the centre of each sub-cell whose centre is inside, with the whole sub-cell's volume. */
    SEED_LATTICE,
    /* A point at the centroid of each sub-cell's inside part, with exactly that volume; small volume fractions under
     * `merge` of a sub-cell join their largest neighbour, keeping mass and first moments. */
    SEED_FITTED
} seed_method;

typedef struct seed_spec {
    int dim;
    bool axisymmetric;     /* volumes per radian: r dr dz */
    double lower[3], h[3]; /* mesh corner and cell, m */
    int n[3];              /* cells of the whole mesh, 1 along unused axes */
    bool periodic[3];      /* axes around which surfaces go on */
    int per_cell[3];       /* points along each axis of a cell, 1 to 8 */
    double offset[3];      /* of the sub-cells against the mesh, in sub-cells, -0.5 to 0.5; lattices only */
    seed_method method;
    double merge; /* fraction of a sub-cell, 0 to 1; 0.3 is usual */
} seed_spec;

/* Points in the order of global cells, then sub-cells (axis 0 fastest): independent of blocks. Arrays are counted
 * memory owned by the list; seed_list_free releases them. */
typedef struct seed_list {
    size_t n;
    double *x[3];    /* m; dim arrays are set */
    double *volume;  /* m3 (design's per-metre and per-radian conventions) */
    double *half[3]; /* m, half width of the sub-cell */
    int *cell[3];    /* global cell along each axis */
} seed_list;

/* Fills *out for one shape. Only cells that meet the shape's bounds are visited. */
floe_status seed_shape(seed_list *out, context *ctx, const shape *s, const seed_spec *spec);
void seed_list_free(context *ctx, seed_list *list);

#endif
