/* Elements of a shape's surface: for loads that act on it, and for gaps between surfaces. */
#ifndef GEOM_SURFACE_H
#define GEOM_SURFACE_H

#include "geom/seed.h"

/* One surface element. */
typedef struct surface_element {
    double x[3];      /* m, on the surface */
    double normal[3]; /* unit, along the gradient of the level: out of the shape */
    double area;      /* m2 (m in 2-D per metre, 1 in 1-D; per radian, times r, when axisymmetric) */
    /* m, on the surface: a point, the ends of a segment, the corners of a triangle, in such an order that (y, -x) along the segment or the
     * triangle's normal points out of the shape. Elements that meet have the same bits there: together they are closed where the surface is. */
    int corners;
    double corner[3][3];
} surface_element;

typedef void surface_visitor(void *user, const surface_element *element);

/* Visits the elements of the part of the surface inside the mesh, in the order of global cells, then of `divide`
 * sub-boxes along each axis of a cell. Each sub-box is cut into simplices about its middle and those of its faces, 4 and 24 of them, the same ones
 * however it is mirrored or its axes are exchanged; elements have corners where the surface meets their edges, and centres brought onto it. */
void surface_visit(const shape *s, const seed_spec *grid, int divide, surface_visitor *visit, void *user);

#endif
