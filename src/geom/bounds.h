/* Where a shape is. Apart from shape.h for those who ask no more of shapes. */
#ifndef GEOM_BOUNDS_H
#define GEOM_BOUNDS_H

#include "geom/shape.h"

/* A box around the inside; false: there is no shape, or it has no such box (half a space). */
bool shape_bounds(const shape *s, int dim, double lo[3], double hi[3]);

#endif
