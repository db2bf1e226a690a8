/* Heights over a plane by a polynomial of weighted least squares. Private to the surface module.
 *
 * In places over the reach the problem is of order one, and its normal equations lose no more than the square of a
 * small condition: they take a row in a third of the time that rotations take, and a Cholesky factorization (Golub and
 * Van Loan, 4th ed., section 4.2.3) solves them. Where a pivot is small, as for points on a line in space, the triangle
 * of least_squares.h decides what the points determine. */
#ifndef SURFACE_HEIGHT_H
#define SURFACE_HEIGHT_H

#include "surface/neighbours.h"
#include "surface/plane.h"

enum { HEIGHT_TERMS = 6 };

typedef struct height_fit {
    /* Of 1, u, u2, u3 in a plane; of 1, u, v, u2, uv, v2 in space; u, v and height over the reach. */
    double x[HEIGHT_TERMS];
    double condition; /* ratio of the largest pivot to the smallest of the triangle */
} height_fit;

/* The highest degree that the point (at 0, of weight 1) and its n neighbours determine, at most 3 in a plane and 2 in
 * space. reach (m): where the weight of neighbours ends; they all lie within it. False where not even a slope is
 * determined. */
bool height_find(int dim, int n, const surface_neighbour *near, double reach, const surface_frame *f, height_fit *out);

#endif
