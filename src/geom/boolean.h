/* Boolean operations: unions, differences and intersections of shapes, as the intersection of what operands, or what lies
 * outside them, have in common. Private to the geom module. */
#ifndef GEOM_BOOLEAN_H
#define GEOM_BOOLEAN_H

#include "geom/shape.h"

/* What lies inside `first` (NULL: everywhere) and inside every part, or outside every part where `outside`. */
typedef struct boolean_operands {
    const shape *first, *part;
    size_t n;
    bool outside;
    double extent; /* m, of all operands: their surfaces are one where they are nearer than a share of it */
} boolean_operands;

/* The greatest of the levels, signed for what lies outside a shape: never larger in size than the distance, as these
 * are. Where two operands share a side and lie on its two sides they have nothing in common there, and no surface. */
double boolean_level(const boolean_operands *o, int dim, const double x[3]);
/* What the bounds of the operands have in common; false where all are unbounded. Of operands that lie outside only the
 * first counts. */
bool boolean_bounds(const boolean_operands *o, int dim, double lo[3], double hi[3]);
/* Bounds about all parts together; false where one is unbounded. */
bool boolean_bounds_of_all(const boolean_operands *o, int dim, double lo[3], double hi[3]);
/* The extent of operands (m). */
double boolean_extent(const boolean_operands *o, int dim);
/* "" unless no two bounds have anything in common. */
void boolean_check(const boolean_operands *o, int dim, char why[SHAPE_WHY]);

#endif
