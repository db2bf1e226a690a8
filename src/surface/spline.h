/* B-splines along an axis, in cells: the functions of which a colour, or a function with a given isosurface, is made (Sulsky and York 2000,
 * sections 2 and 5; York 1997, appendix A.3). Private to the surface room. */
#ifndef SURFACE_SPLINE_H
#define SURFACE_SPLINE_H

#include "base/compiler.h"

enum { SPLINE_MOST = 4 };

/* Values and derivatives (per cell) at xi, 0 to 1 within its cell. */
typedef struct spline_values {
    int first, n; /* first function: offset from the cell of its node (odd degrees) or cell (even degrees) */
    double w[SPLINE_MOST], dw[SPLINE_MOST];
} spline_values;

/* At the two nodes of the cell. */
FLOE_ALWAYS_INLINE spline_values spline_linear(double xi)
{
    return (spline_values){.n = 2, .w = {1.0 - xi, xi}, .dw = {-1.0, 1.0}};
}

/* At the centres of the cell and of its two neighbours. */
FLOE_ALWAYS_INLINE spline_values spline_quadratic(double xi)
{
    const double d = xi - 0.5;
    return (spline_values){.first = -1,
                           .n = 3,
                           .w = {0.5 * (0.5 - d) * (0.5 - d), 0.75 - d * d, 0.5 * (0.5 + d) * (0.5 + d)},
                           .dw = {d - 0.5, -2.0 * d, d + 0.5}};
}

FLOE_ALWAYS_INLINE spline_values spline_of(int degree, double xi)
{
    return degree == 1 ? spline_linear(xi) : spline_quadratic(xi);
}

#endif
