/* B-splines along an axis, in cells: the functions of which a colour, or a function with a given isosurface, is made
 * (Sulsky and York 2000, sections 2 and 5; York 1997, appendix A.3). */
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

/* At four nodes, one of them beyond the cell on either side. */
FLOE_ALWAYS_INLINE spline_values spline_cubic(double xi)
{
    const double eta = 1.0 - xi;
    return (spline_values){.first = -1,
                           .n = 4,
                           .w = {eta * eta * eta / 6.0, (4.0 - 6.0 * xi * xi + 3.0 * xi * xi * xi) / 6.0,
                                 (4.0 - 6.0 * eta * eta + 3.0 * eta * eta * eta) / 6.0, xi * xi * xi / 6.0},
                           .dw = {-0.5 * eta * eta, (-4.0 * xi + 3.0 * xi * xi) / 2.0,
                                  (4.0 * eta - 3.0 * eta * eta) / 2.0, 0.5 * xi * xi}};
}

/* At the same four nodes: to cells with the quadratic spline, and from there to the nodes with the gradient of the
 * linear one. A node takes half of the cell on either side, and their difference (York 1997, equations 7.4, 7.5 and
 * 9.10, 9.11). */
FLOE_ALWAYS_INLINE spline_values spline_by_cells(double xi)
{
    const spline_values cell = spline_quadratic(xi);
    spline_values r = {.first = -1, .n = 4};
    for (int k = 0; k < 4; ++k) {
        const double below = k > 0 ? cell.w[k - 1] : 0.0, above = k < 3 ? cell.w[k] : 0.0;
        r.w[k] = 0.5 * (below + above);
        r.dw[k] = below - above;
    }
    return r;
}

FLOE_ALWAYS_INLINE spline_values spline_of(int degree, double xi)
{
    return degree == 1 ? spline_linear(xi) : spline_quadratic(xi);
}

#endif
