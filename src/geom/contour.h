/* The boundary contour of a shape as chains of points, in one dimension as points: the surface between a solid and gas
 * (theory 7.2). */
#ifndef GEOM_CONTOUR_H
#define GEOM_CONTOUR_H

#include "geom/seed.h"

/* Points of one chain, with the shape on its right. */
typedef struct contour_chain {
    size_t first, n;
    bool
        closed; /* else it begins and ends on sides of the mesh; of two neighbours the nearest images around periodic axes are joined */
    int into; /* on a line, where a chain is one point: +1 the shape lies above it, -1 below; 0: the point is where the
                    shape reaches a side of the mesh */
} contour_chain;

typedef struct contour {
    double (*x)[2]; /* m; owned */
    size_t n;
    contour_chain *chain; /* owned */
    size_t n_chains;
} contour;

/* Traces the part of a shape's surface inside the mesh. Cells are divided into `divide` x `divide` sub-boxes; there is
 * a point wherever the surface meets a side of one, on the surface to round-off, and one at every corner whose two
 * sides are straight. What of the surface lies on a side of the mesh is left out, but for the point of a shape on a
 * line. Chains go on around periodic axes. FLOE_NO_MEMORY. */
floe_status contour_trace(contour *out, context *ctx, const shape *s, const seed_spec *grid, int divide);
void contour_free(context *ctx, contour *o);

#endif
