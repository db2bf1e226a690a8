/* What a gas that expands gives up on the way to a face. Private to src/ice. */
#ifndef ICE_ICE_FALL_H
#define ICE_ICE_FALL_H

#include "ice/ice_internal.h"

#include <math.h>

/* What a slab gives up as it falls to the pressure on its face: of its mass and energy per mass, shares; of its normal velocity, the
 * share that is the face's. From a drop (p - P*)/(rho c^2) of 0.3 on, in full at 0.63: fans over less than some five cells. At
 * three quarters of the speed of sound nothing is left of it: the front of a gas that expands into next to nothing falls for good. */
typedef struct fall {
    double mass, energy, velocity;
} fall;

FLOE_ALWAYS_INLINE fall fall_to(double p, double rho, double c, double velocity, double face_pressure)
{
    const double drop = (p - face_pressure) / (rho * c * c),
                 slow = least(most(1.5 - 2.0 * fabs(velocity) / c, 0.0), 1.0),
                 part = slow * least(most(3.0 * (drop - 0.3), 0.0), 1.0);
    return (fall){part * least(drop, 0.8), part * drop * p / rho, part};
}

#endif
