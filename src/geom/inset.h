/* The part of a shape between planes along the axes. It is in no registry: whoever needs the surface of that part makes it. */
#ifndef GEOM_INSET_H
#define GEOM_INSET_H

#include "geom/shape.h"

typedef struct inset {
    shape whole;
    double lower[3], upper[3]; /* m: the planes; infinite where there is none */
} inset;

/* The part as a shape, which refers to it. */
shape inset_shape(inset *of);

#endif
