/* Artificial viscous pressure: spreads a shock over a few cells. */
#ifndef MATERIAL_ARTIFICIAL_VISCOSITY_H
#define MATERIAL_ARTIFICIAL_VISCOSITY_H

#include "base/compiler.h"

/* q = rho (A1 c h |D| + A2 h^2 D^2) for D = div v < 0, else 0 (Pa, compression positive).
 * rho kg/m3, c m/s, D 1/s, length h m; linear A1 and quadratic A2 have no unit.
 * York, Sulsky, Schreyer 2000, eqs. 24-25 (Wilkins 1980): as printed, eq. 24 lacks the sign and the unit of a pressure;
 * this is the form that it stands for. */
FLOE_ALWAYS_INLINE double artificial_pressure(double rho, double c, double D, double length, double linear,
                                              double quadratic)
{
    const double closing = D < 0.0 ? -length * D : 0.0; /* m/s: the velocity jump over a length */
    return rho * closing * (linear * c + quadratic * closing);
}

#endif
