/* Shocks: sensors (theory 2.5) and bulk viscosity (theory 2.8). */
#ifndef ICE_SHOCK_H
#define ICE_SHOCK_H

#include "ice/ice_constants.h"
#include "ice/ice_view.h"

/* Sensors of the owned cells of a view: shocks, and contacts where they are sharpened. */
void ice_find_sensors(const ice_view *v);
/* Bulk viscosity beside walls that a fluid slips along (ice_slip.c). */
void ice_relieve_slip(const ice *s, const ice_view *v);

/* Rate of compression of a cell (m/s over the largest spacing): the smaller of div u and the sum of its terms along
 * the axes, each times its spacing over the largest. Both are the same on square cells; on others the length V^(1/d)
 * would make the viscosity along the finer axis too large for stable explicit steps. */
FLOE_ALWAYS_INLINE double ice_compression(double div, double jump)
{
    return most(-most(div, jump), 0.0);
}

/* q of theory 2.8 (iv) of a fluid squeezed at `squeeze` (m/s over a cell), s its shock sensor. */
FLOE_ALWAYS_INLINE double ice_bulk_pressure(double rho, double speed, double squeeze, double s)
{
    return rho * squeeze * (ICE_SHOCK_QUADRATIC * squeeze + s * ICE_SHOCK_LINEAR * speed);
}

#endif
