/* The Jaumann rate over a step, for laws in rate form: the elastic (trial) stress of linear_elastic and of what yields.
 *
 * sigma <- Q (sigma + dsigma/2) Q^T + dsigma/2,  dsigma = dt (lambda tr(D) I + 2 G D), second order in dt. Q = (I - A)^-1
 * (I + A) is orthogonal to round-off whatever the antisymmetric A (Hughes & Winget 1980); A is W dt/2 stretched by
 * tan(w)/w, w = |W| dt/2 half the angle turned, which makes Q = exp(W dt) to O(w^7). Only src/material includes
 * this. */
#ifndef MATERIAL_HYPOELASTIC_H
#define MATERIAL_HYPOELASTIC_H

#include "base/compiler.h"
#include "material/solid.h"

#include <math.h>

enum { XX, YY, ZZ, XY, YZ, ZX };

/* sigma + R + R^T + R B^T with R = B sigma, B = Q - I: keeps the digits of small rotations. `planar` leaves out the
 * products with zeros of a rotation about z and nothing else, so that both forms agree to the bit: which one runs
 * depends on the other points of the batch, and the result must not. */
FLOE_ALWAYS_INLINE void hypoelastic_rotate(double s[6], double ax, double ay, double az, bool planar)
{
    const double angle2 = planar ? az * az : ax * ax + ay * ay + az * az;
    const double stretch = 1.0 + angle2 * (1.0 / 3.0 + angle2 * (2.0 / 15.0));
    ax *= stretch;
    ay *= stretch;
    az *= stretch;
    const double x2 = ax * ax, y2 = ay * ay, z2 = az * az;
    const double f = 2.0 / (1.0 + (planar ? z2 : x2 + y2 + z2));

    if (planar) {
        const double d = -f * z2, o = f * az; /* B = [d -o; o d] */
        const double rxx = d * s[XX] - o * s[XY], rxy = d * s[XY] - o * s[YY], rxz = d * s[ZX] - o * s[YZ];
        const double ryx = o * s[XX] + d * s[XY], ryy = o * s[XY] + d * s[YY], ryz = o * s[ZX] + d * s[YZ];
        s[XX] = s[XX] + (rxx + rxx + (rxx * d - rxy * o));
        s[YY] = s[YY] + (ryy + ryy + (ryx * o + ryy * d));
        s[XY] = s[XY] + (rxy + ryx + (rxx * o + rxy * d));
        s[YZ] = s[YZ] + ryz;
        s[ZX] = s[ZX] + rxz;
        return;
    }
    const double bxx = -f * (y2 + z2), byy = -f * (x2 + z2), bzz = -f * (x2 + y2);
    const double bxy = f * (ax * ay - az), byx = f * (ax * ay + az);
    const double bxz = f * (ax * az + ay), bzx = f * (ax * az - ay);
    const double byz = f * (ay * az - ax), bzy = f * (ay * az + ax);
    const double rxx = bxx * s[XX] + bxy * s[XY] + bxz * s[ZX];
    const double rxy = bxx * s[XY] + bxy * s[YY] + bxz * s[YZ];
    const double rxz = bxx * s[ZX] + bxy * s[YZ] + bxz * s[ZZ];
    const double ryx = byx * s[XX] + byy * s[XY] + byz * s[ZX];
    const double ryy = byx * s[XY] + byy * s[YY] + byz * s[YZ];
    const double ryz = byx * s[ZX] + byy * s[YZ] + byz * s[ZZ];
    const double rzx = bzx * s[XX] + bzy * s[XY] + bzz * s[ZX];
    const double rzy = bzx * s[XY] + bzy * s[YY] + bzz * s[YZ];
    const double rzz = bzx * s[ZX] + bzy * s[YZ] + bzz * s[ZZ];
    s[XX] = s[XX] + (rxx + rxx + (rxx * bxx + rxy * bxy + rxz * bxz));
    s[YY] = s[YY] + (ryy + ryy + (ryx * byx + ryy * byy + ryz * byz));
    s[ZZ] = s[ZZ] + (rzz + rzz + (rzx * bzx + rzy * bzy + rzz * bzz));
    s[XY] = s[XY] + (rxy + ryx + (rxx * byx + rxy * byy + rxz * byz));
    s[YZ] = s[YZ] + (ryz + rzy + (ryx * bzx + ryy * bzy + ryz * bzz));
    s[ZX] = s[ZX] + (rzx + rxz + (rxx * bzx + rxy * bzy + rxz * bzz));
}

/* The stress of point i of a batch at the end of the step, as if it were elastic. h is half the stress increment. L is
 * row-major: 0 xx, 1 xy, 2 xz, 3 yx, 4 yy, 5 yz, 6 zx, 7 zy, 8 zz. */
FLOE_ALWAYS_INLINE void hypoelastic_step(double lambda, double G, const solid_batch *restrict b, size_t i, bool planar,
                                         double s[6])
{
    const double half = 0.5 * b->dt, quarter = 0.25 * b->dt;
    const double volumetric = half * lambda * (b->L[0][i] + b->L[4][i] + b->L[8][i]);
    const double h[6] = {
        volumetric + half * 2.0 * G * b->L[0][i], volumetric + half * 2.0 * G * b->L[4][i],
        volumetric + half * 2.0 * G * b->L[8][i], half * G * (b->L[1][i] + b->L[3][i]),
        half * G * (b->L[5][i] + b->L[7][i]),     half * G * (b->L[2][i] + b->L[6][i]),
    };
    for (int k = 0; k < 6; k++) s[k] = b->stress[k][i] + h[k];
    hypoelastic_rotate(s, quarter * (b->L[7][i] - b->L[5][i]), quarter * (b->L[2][i] - b->L[6][i]),
                       quarter * (b->L[3][i] - b->L[1][i]), planar);
    for (int k = 0; k < 6; k++) s[k] += h[k];
}

FLOE_ALWAYS_INLINE double mean_stress(const double s[6])
{
    return (s[XX] + s[YY] + s[ZZ]) / 3.0;
}

/* Of von Mises. */
FLOE_ALWAYS_INLINE double equivalent_stress(const double s[6], double mean)
{
    const double sx = s[XX] - mean, sy = s[YY] - mean, sz = s[ZZ] - mean;
    const double shear = s[XY] * s[XY] + s[YZ] * s[YZ] + s[ZX] * s[ZX];
    return sqrt(1.5 * (sx * sx + sy * sy + sz * sz + 2.0 * shear));
}

/* Keeps the share `left` of the deviator, and changes the mean stress. */
FLOE_ALWAYS_INLINE void return_stress(double s[6], double mean, double left, double end_mean)
{
    const double sx = s[XX] - mean, sy = s[YY] - mean, sz = s[ZZ] - mean;
    s[XX] = end_mean + left * sx;
    s[YY] = end_mean + left * sy;
    s[ZZ] = end_mean + left * sz;
    for (int k = XY; k <= ZX; k++) s[k] *= left;
}

/* Plane and axisymmetric batches. A NaN is no equal, and takes the general form. */
FLOE_ALWAYS_INLINE bool spins_about_z_alone(const solid_batch *b)
{
    long long other = 0; /* as wide as a double, so that the loop is vectorised */
    for (size_t i = 0; i < b->n; i++) other |= (b->L[7][i] != b->L[5][i]) | (b->L[2][i] != b->L[6][i]);
    return other == 0;
}

#endif
