/* What laws of the deformation gradient share: components and bounds of B = F F^T at point i of a batch. Only
 * src/material includes this. */
#ifndef MATERIAL_HYPERELASTIC_H
#define MATERIAL_HYPERELASTIC_H

#include "base/compiler.h"
#include "material/solid.h"

#include <math.h>

enum { XX, YY, ZZ, XY, YZ, ZX };

/* Row r of F times row s of F: B_rs. */
FLOE_ALWAYS_INLINE double left_cauchy_green(const solid_batch *b, int r, int s, size_t i)
{
    return b->F[3 * r][i] * b->F[3 * s][i] + b->F[3 * r + 1][i] * b->F[3 * s + 1][i] +
           b->F[3 * r + 2][i] * b->F[3 * s + 2][i];
}

/* tr B. */
FLOE_ALWAYS_INLINE double trace_of_left_cauchy_green(const solid_batch *b, size_t i)
{
    return left_cauchy_green(b, 0, 0, i) + left_cauchy_green(b, 1, 1, i) + left_cauchy_green(b, 2, 2, i);
}

/* All of B: xx, yy, zz, xy, yz, zx. */
FLOE_ALWAYS_INLINE void left_cauchy_green_at(const solid_batch *b, size_t i, double B[6])
{
    B[XX] = left_cauchy_green(b, 0, 0, i);
    B[YY] = left_cauchy_green(b, 1, 1, i);
    B[ZZ] = left_cauchy_green(b, 2, 2, i);
    B[XY] = left_cauchy_green(b, 0, 1, i);
    B[YZ] = left_cauchy_green(b, 1, 2, i);
    B[ZX] = left_cauchy_green(b, 2, 0, i);
}

/* An upper bound of the largest eigenvalue of B, mean + sqrt(2/3) |dev B|: exact at rest and for a stretch along one
 * axis. */
FLOE_ALWAYS_INLINE double largest_square_stretch(const solid_batch *b, size_t i)
{
    const double xx = left_cauchy_green(b, 0, 0, i), yy = left_cauchy_green(b, 1, 1, i),
                 zz = left_cauchy_green(b, 2, 2, i);
    const double xy = left_cauchy_green(b, 0, 1, i), yz = left_cauchy_green(b, 1, 2, i),
                 zx = left_cauchy_green(b, 2, 0, i);
    const double mean = (xx + yy + zz) / 3.0, dx = xx - mean, dy = yy - mean, dz = zz - mean;
    return mean + sqrt(2.0 / 3.0 * (dx * dx + dy * dy + dz * dz + 2.0 * (xy * xy + yz * yz + zx * zx)));
}

/* B B of a symmetric B, both xx, yy, zz, xy, yz, zx. */
FLOE_ALWAYS_INLINE void symmetric_square(const double B[6], double square[6])
{
    square[XX] = B[XX] * B[XX] + B[XY] * B[XY] + B[ZX] * B[ZX];
    square[YY] = B[XY] * B[XY] + B[YY] * B[YY] + B[YZ] * B[YZ];
    square[ZZ] = B[ZX] * B[ZX] + B[YZ] * B[YZ] + B[ZZ] * B[ZZ];
    square[XY] = B[XX] * B[XY] + B[XY] * B[YY] + B[ZX] * B[YZ];
    square[YZ] = B[XY] * B[ZX] + B[YY] * B[YZ] + B[YZ] * B[ZZ];
    square[ZX] = B[XX] * B[ZX] + B[XY] * B[YZ] + B[ZX] * B[ZZ];
}

#endif
