/* Points on a shape's surface, each with its share of the area: for loads that act on a surface. */
#ifndef GEOM_SURFACE_H
#define GEOM_SURFACE_H

#include "geom/seed.h"

/* One surface element. */
typedef struct surface_element {
    double x[3];      /* m, on the surface */
    double normal[3]; /* unit, along the gradient of the level: out of the shape */
    double area;      /* m2 (m in 2-D per metre, 1 in 1-D; per radian, times r, when axisymmetric) */
} surface_element;

typedef void surface_visitor(void *user, const surface_element *element);

/* How a box is cut into simplices. DIAGONALS: about the diagonal from its lower corner to its upper one, 2 in the plane
 * and 6 in space. Sides of a shape that meet at another corner of the box are one element there, across both. MIDDLES:
 * about its middle and those of its faces, 4 and 24, the same ones however the box is mirrored or its axes are
 * exchanged; sides that meet at a corner of it stay two. */
typedef enum surface_cut { SURFACE_DIAGONALS, SURFACE_MIDDLES } surface_cut;

/* Visits the elements of the part of the surface inside the mesh, in the order of global cells, then of `divide`
 * sub-boxes along each axis of a cell. Each sub-box is cut into simplices, in which the level is taken as linear;
 * centres are then brought onto the surface. */
void surface_visit(const shape *s, const seed_spec *grid, int divide, surface_cut cut, surface_visitor *visit,
                   void *user);

#endif
