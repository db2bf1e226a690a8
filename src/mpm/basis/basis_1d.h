/* One-dimensional weights of every basis, inlined into the point kernels with `kind` a literal (theory 4.3). */
#ifndef MPM_BASIS_BASIS_1D_H
#define MPM_BASIS_BASIS_1D_H

#include "base/compiler.h"
#include "mpm/basis/basis.h"

#include <math.h>

/* Nodes along an axis that a point, or a corner of its domain, reaches, and how far the point reaches beyond its own cell. */
FLOE_ALWAYS_INLINE int basis_support(const basis_kind kind)
{
    switch (kind) {
    case BASIS_LINEAR:
    case BASIS_CPDI: return 2;
    case BASIS_GIMP:
    case BASIS_QUADRATIC: return 3;
    case BASIS_CUBIC: return 4;
    case BASIS_KINDS: break;
    }
    return 0;
}
/* Stencils of which the weights of a point are the sum: one, or one a corner of its domain. */
FLOE_ALWAYS_INLINE int basis_pieces(const basis_kind kind, const int dim)
{
    return kind == BASIS_CPDI ? 1 << dim : 1;
}
FLOE_ALWAYS_INLINE int basis_reach(const basis_kind kind)
{
    return kind == BASIS_LINEAR ? 0 : 1;
}

/* Linear: N = 1 - |xi|. */
FLOE_ALWAYS_INLINE int basis_linear_1d(double xi, double inv_h, double *w, double *dw)
{
    w[0] = 1.0 - xi;
    w[1] = xi;
    dw[0] = -inv_h;
    dw[1] = inv_h;
    return 0;
}

/* Quadratic B-spline: 3/4 - d^2 within half a cell of the node, (3/2 - |d|)^2 / 2 to one and a half. */
FLOE_ALWAYS_INLINE int basis_quadratic_1d(double xi, double inv_h, double *w, double *dw)
{
    const int first = xi < 0.5 ? -1 : 0;
    const double d = xi - (first + 1);
    w[0] = 0.5 * (0.5 - d) * (0.5 - d);
    w[1] = 0.75 - d * d;
    w[2] = 0.5 * (0.5 + d) * (0.5 + d);
    dw[0] = (d - 0.5) * inv_h;
    dw[1] = -2.0 * d * inv_h;
    dw[2] = (d + 0.5) * inv_h;
    return first;
}

/* Cubic B-spline: 2/3 - d^2 + |d|^3/2 within a cell of the node, (2 - |d|)^3/6 to two. */
FLOE_ALWAYS_INLINE int basis_cubic_1d(double xi, double inv_h, double *w, double *dw)
{
    const double from = xi, to = 1.0 - xi; /* distances to the nodes of the cell */
    w[0] = to * to * to / 6.0;
    w[1] = 2.0 / 3.0 - from * from + 0.5 * from * from * from;
    w[2] = 2.0 / 3.0 - to * to + 0.5 * to * to * to;
    w[3] = from * from * from / 6.0;
    dw[0] = -0.5 * to * to * inv_h;
    dw[1] = from * (1.5 * from - 2.0) * inv_h;
    dw[2] = to * (2.0 - 1.5 * to) * inv_h;
    dw[3] = 0.5 * from * from * inv_h;
    return -1;
}

/* GIMP (Bardenhagen and Kober 2004): the linear hat averaged over the point's domain of half width l: by the distance a = |d| of the node
 * the domain holds the hat's tip (a < l), lies on one side of it (a < 1 - l), or holds its foot (a < 1 + l). Chosen among, not branched to,
 * so that many points are worked out at once. */
FLOE_ALWAYS_INLINE void basis_gimp_node(double d, double l, double over_l, double inv_h, double *w, double *dw)
{
    const double a = fabs(d), sign = d < 0.0 ? -1.0 : 1.0, foot = 1.0 + l - a;
    const double outer = a < 1.0 + l ? 0.25 * foot * foot * over_l : 0.0, side = a < 1.0 - l ? 1.0 - a : outer;
    const double outer_slope = a < 1.0 + l ? 0.5 * foot * over_l : 0.0, slope = a < 1.0 - l ? 1.0 : outer_slope;
    *w = a < l ? 1.0 - 0.5 * (a * a * over_l + l) : side;
    *dw = (a < l ? -d * over_l : -sign * slope) * inv_h;
}

FLOE_ALWAYS_INLINE int basis_gimp_1d(double xi, double half, double inv_h, double *w, double *dw)
{
    const int first = xi < 0.5 ? -1 : 0;
    const double over = 1.0 / half;
    for (int k = 0; k < 3; ++k) basis_gimp_node(xi - (first + k), half, over, inv_h, &w[k], &dw[k]);
    return first;
}

/* CPDI (Sadeghirad, Brannon and Burghardt 2011) on a box along the axes: the mean of the hats at its two ends, and the mean of the slope
 * between them. */
FLOE_ALWAYS_INLINE double basis_hat(double d)
{
    const double a = fabs(d);
    return a < 1.0 ? 1.0 - a : 0.0;
}

FLOE_ALWAYS_INLINE int basis_cpdi_1d(double xi, double half, double inv_h, double *w, double *dw)
{
    for (int k = 0; k < 4; ++k) {
        const double d = xi - (k - 1), below = basis_hat(d - half), above = basis_hat(d + half);
        w[k] = 0.5 * (below + above);
        dw[k] = (above - below) / (2.0 * half) * inv_h;
    }
    return -1;
}

FLOE_ALWAYS_INLINE int basis_1d(const basis_kind kind, double xi, double half, double inv_h, double *w, double *dw)
{
    switch (kind) {
    case BASIS_LINEAR: return basis_linear_1d(xi, inv_h, w, dw);
    case BASIS_GIMP: return basis_gimp_1d(xi, half, inv_h, w, dw);
    case BASIS_QUADRATIC: return basis_quadratic_1d(xi, inv_h, w, dw);
    case BASIS_CUBIC: return basis_cubic_1d(xi, inv_h, w, dw);
    case BASIS_CPDI: return basis_cpdi_1d(xi, half, inv_h, w, dw);
    case BASIS_KINDS: break;
    }
    return 0;
}

#endif
