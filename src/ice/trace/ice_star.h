/* The state between two waves that run from a face (theory 2.17; Toro, Spruce and Speares 1994; Batten et al. 1997). Only this folder includes
 * it. It is ICE's own split: P* and P* u* are what the pressure does in the Lagrangian step, and what crosses the face is the donor's slab, brought
 * to P* by the wave that lies between, with velocity u*. */
#ifndef ICE_ICE_STAR_H
#define ICE_ICE_STAR_H

#include "ice/ice_constants.h"
#include "ice/ice_view.h"

#include <math.h>

/* Fluid at one side of a face, at half the step. */
typedef struct ice_side_of_face {
    double rho, p, energy, u[3]; /* kg/m3, Pa, J/m3, m/s */
    double c;                    /* m/s: of its cell */
    double early;                /* m/s: normal velocity at the start of the step */
} ice_side_of_face;

/* What crosses the face: P*, and density, specific energy and velocity of the donor's slab; u* is its normal velocity. */
typedef struct ice_star {
    double p, rho, e, u[3];
} ice_star;

/* `slow`: share by which the viscous part of P* is reduced, in flow far below the speed of sound with little dilatation. */
FLOE_ALWAYS_INLINE ice_star ice_star_of(const ice_side_of_face *L, const ice_side_of_face *R, int axis, double slow,
                                        const int dim)
{
    const double uL = L->u[axis], uR = R->u[axis];
    /* The mean state's wave speeds (Einfeldt 1988), by densities' roots. */
    const double wL = sqrt(L->rho), wR = sqrt(R->rho), inverse = 1.0 / (wL + wR), mean = (wL * uL + wR * uR) * inverse,
                 jump = uR - uL;
    const double c =
        sqrt((wL * L->c * L->c + wR * R->c * R->c) * inverse + 0.5 * wL * wR * inverse * inverse * jump * jump);
    const double slowest = least(uL - L->c, mean - c), fastest = most(uR + R->c, mean + c);
    const double zL = L->rho * (uL - slowest), zR = R->rho * (fastest - uR), both = 1.0 / (zL + zR);
    const double u = (zL * uL + zR * uR + L->p - R->p) * both;
    const double p = (zR * L->p + zL * R->p - zL * zR * (jump + slow * (L->early - R->early))) * both;

    const bool upwind = u > 0.0, all_up = slowest > 0.0, all_down = fastest < 0.0, outrun = all_up || all_down;
    const double z = upwind ? zL : zR, rho = upwind ? L->rho : R->rho, donor_u = upwind ? uL : uR,
                 donor_p = upwind ? L->p : R->p;
    /* The wave changes 1/rho by (u* - u)/z, and e as it must: by the mean pressure. */
    const double change = (upwind ? u - donor_u : donor_u - u) / z, expanded = 1.0 / rho + change;
    const double energy = (upwind ? L->energy : R->energy) / rho;
    ice_star s = {.p = outrun ? donor_p : p,
                  .rho = outrun ? rho : 1.0 / expanded,
                  .e = outrun ? energy : energy - 0.5 * (donor_p + p) * change};
    for (int a = 0; a < dim; ++a) s.u[a] = upwind ? L->u[a] : R->u[a];
    s.u[axis] = outrun ? donor_u : u;
    return s;
}

#endif
