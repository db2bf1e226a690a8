/* Where in a cell its mass lies, between far denser and far lighter neighbours (theory 2.17): at the interface of a liquid and a gas each lies at its own side. */
#ifndef ICE_LEAN_H
#define ICE_LEAN_H

#include "ice/ice_constants.h"
#include "ice/ice_view.h"

/* kg/m3 of the cell: mass of its lower half beyond half of its own. A share f of the lower neighbour at the bottom, the rest of the upper one: pressure then has the mean that it has
 * in such layers. */
FLOE_ALWAYS_INLINE double ice_lean(double below, double here, double above)
{
    const double jump = below - above, ratio = least(below, above) / (most(below, above) + ICE_TINY);
    const double share = least(most(ICE_LEAN_RISE * (ICE_LEAN_NONE - ratio), 0.0), 1.0),
                 product = most((below - here) * (here - above), 0.0);
    return 0.5 * share * product * jump / (jump * jump + ICE_TINY);
}

FLOE_ALWAYS_INLINE double ice_lean_at(const double *restrict rho, ptrdiff_t at, ptrdiff_t step)
{
    return ice_lean(rho[at - step], rho[at], rho[at + step]);
}

/* kg/m3: twice the mass between the centres of a cell and the next one up, over a cell's volume. uneven: 1; 0: as if it were even in both. */
FLOE_ALWAYS_INLINE double ice_mass_to_next(const double *restrict rho, ptrdiff_t at, ptrdiff_t step, double uneven)
{
    return rho[at] + rho[at + step] + 2.0 * uneven * (ice_lean_at(rho, at + step, step) - ice_lean_at(rho, at, step));
}

#endif
