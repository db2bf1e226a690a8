/* Isentropic expansion of a gas between cell and face. Only this folder includes it. */
#ifndef ICE_ICE_EXPANSION_H
#define ICE_ICE_EXPANSION_H

#include "ice/ice_constants.h"
#include "ice/ice_view.h"

#include <math.h>

/* Isentropic expansion of a slab to the pressure on its face: relative changes of its mass and specific energy, and the
 * share of the face's velocity in its normal velocity. From a drop (p - P*)/(rho c^2) of 0.3 on, in full at 0.63: fans
 * over less than some five cells. The correction vanishes at three quarters of the speed of sound, since the front of a
 * gas that expands into near vacuum stays expanded. */
typedef struct expansion {
    double mass, energy, velocity;
} expansion;

FLOE_ALWAYS_INLINE expansion expansion_to(double p, double rho, double c, double velocity, double face_pressure)
{
    const double drop = (p - face_pressure) / (rho * c * c),
                 slow = least(most(ICE_EXPANSION_SLOW - ICE_EXPANSION_SLOWING * fabs(velocity) / c, 0.0), 1.0),
                 part = slow * least(most(ICE_EXPANSION_STEEPNESS * (drop - ICE_EXPANSION_FOOT), 0.0), 1.0);
    return (expansion){part * least(drop, ICE_MOST_EXPANSION), part * drop * p / rho, part};
}

#endif
