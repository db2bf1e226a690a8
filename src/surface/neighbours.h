/* The nearest points of a point. Private to the surface room. */
#ifndef SURFACE_NEIGHBOURS_H
#define SURFACE_NEIGHBOURS_H

#include "surface/surface.h"

typedef struct surface_neighbour {
    double d[3];   /* m: from the point to it */
    double square; /* m2: its squared length */
    uint32_t number, image;
} surface_neighbour;

/* The nearest entries of `of`, itself left out, nearest first, out[most]; how many there are. Looks at no more than SURFACE_RINGS cells
 * on every side. Of equally near ones that of the lower cell, then number, comes first. */
int surface_nearest(const surface_set *s, const surface_entry *of, int most, surface_neighbour *out);

#endif
