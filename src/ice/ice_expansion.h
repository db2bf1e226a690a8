/* Isentropic expansion of a gas between cell and face. Private to src/ice. */
#ifndef ICE_ICE_EXPANSION_H
#define ICE_ICE_EXPANSION_H

#include "ice/ice_internal.h"

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
                 slow = least(most(1.5 - 2.0 * fabs(velocity) / c, 0.0), 1.0),
                 part = slow * least(most(3.0 * (drop - 0.3), 0.0), 1.0);
    return (expansion){part * least(drop, 0.8), part * drop * p / rho, part};
}

#endif
