/* Intersections and differences of shapes. They are in no registry: a scene makes them from the shapes of its
 * bodies. */
#ifndef GEOM_COMPOUND_H
#define GEOM_COMPOUND_H

#include "geom/shape.h"

enum { COMPOUND_MOST = 32 };

/* The inside of `whole` (everywhere, where its model is NULL) that none of the `less` covers. */
typedef struct compound {
    shape whole;
    int n;
    shape less[COMPOUND_MOST];
} compound;

/* The compound as a shape, which refers to it. */
shape compound_shape(compound *of);

/* The volume (m3; per radian where weighted by the radius) that two shapes share in the box [lo, hi], cut into boxes of
 * the sizes h (m). */
double compound_common_volume(const shape *a, const shape *b, int dim, const double lo[3], const double hi[3],
                              const double h[3], bool weight_by_radius);

/* The volume of a shape in the same boxes. */
double compound_volume(const shape *s, int dim, const double lo[3], const double hi[3], const double h[3],
                       bool weight_by_radius);

/* Share of the box [lo, hi] that lies inside a region; all of it where the region is NULL or has no model. */
double region_share(const shape *region, int dim, const double lo[3], const double hi[3], bool weight_by_radius);

#endif
