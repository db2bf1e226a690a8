/* A shape with its images around periodic axes. It is in no registry: whoever needs it makes it. */
#ifndef GEOM_IMAGES_H
#define GEOM_IMAGES_H

#include "geom/boolean.h"

/* One of them. */
typedef struct shape_image {
    const shape *of;
    double shift[3]; /* m */
} shape_image;

typedef struct images {
    shape whole;
    shape_image image[27];
    shape part[27];            /* what they are made of: the shape itself, then its images */
    boolean_operands all;      /* outside them is what is outside each */
    double lower[3], upper[3]; /* m: of the box, infinite along other axes: the bounds reach no further */
} images;

/* Finds the images of a shape that come nearer than a margin (m) to a periodic box. Returns the shape itself where there
 * is none, and where it has no bounds; else their union, which refers to `out`. */
shape images_make(images *out, const shape *s, int dim, const double lower[3], const double upper[3],
                  const bool periodic[3], double margin);
/* The shape of which one is made with its images; itself where it is another. */
const shape *images_whole(const shape *s);

#endif
