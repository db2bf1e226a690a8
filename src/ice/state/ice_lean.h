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

/* The same beside cells that solids fill: cells beside them bear their weight evenly. open: NULL: none are filled. */
FLOE_ALWAYS_INLINE double ice_lean_open(const double *restrict rho, const double *restrict open, ptrdiff_t at,
                                        ptrdiff_t step)
{
    const double lean = ice_lean_at(rho, at, step);
    return !open || (open[at - step] > 0.0 && open[at] > 0.0 && open[at + step] > 0.0) ? lean : 0.0;
}

/* Weight on the lower face of cell R, where cells bear it unevenly, over what it is where they are filled evenly. */
FLOE_ALWAYS_INLINE double ice_weight_on_face(const double *restrict rho, const double *restrict open, ptrdiff_t R,
                                             ptrdiff_t step)
{
    const ptrdiff_t L = R - step;
    const double both = rho[L] + rho[R];
    return (both + 2.0 * (ice_lean_open(rho, open, R, step) - ice_lean_open(rho, open, L, step))) / (both + ICE_TINY);
}

/* kg/m3: mass between the level of the cell's mean pressure and a place z cells above its middle, over area and h. */
static inline double ice_mass_up_to(double below, double here, double above, double z)
{
    const double jump = below - above, ratio = least(below, above) / (most(below, above) + ICE_TINY);
    const double uneven = least(most(ICE_LEAN_RISE * (ICE_LEAN_NONE - ratio), 0.0), 1.0);
    if (!((below - here) * (here - above) > 0.0) || uneven == 0.0) return here * z;
    const double f = (here - above) / jump, up = z + 0.5 - f;
    const double layers = (up < 0.0 ? below : above) * up + 0.5 * (below * f * f - above * (1.0 - f) * (1.0 - f));
    return here * z + uneven * (layers - here * z);
}

#endif
