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

/* Visits the elements of the part of the surface inside the mesh, in the order of global cells, then of `divide` sub-boxes along
 * each axis of a cell. Each sub-box is cut into simplices, in which the level is taken as linear; centres are then brought onto the surface. */
void surface_visit(const shape *s, const seed_spec *grid, int divide, surface_visitor *visit, void *user);

#endif
