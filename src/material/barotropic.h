/* Liquids whose pressure follows from the density alone: with de = -p dv + c_v dT their energy is e = c_v T + e_0(rho),
 * the cold energy e_0 being that of compression from a density rho_0, so that heat moves the temperature and nothing
 * else. */
#ifndef MATERIAL_BAROTROPIC_H
#define MATERIAL_BAROTROPIC_H

#include "base/param.h"

/* The first member of such a law's parameters. */
typedef struct barotropic {
    double density;       /* kg/m3, rho_0 */
    double pressure;      /* Pa, p_0, at rho_0 */
    double specific_heat; /* J/kg/K, c_v > 0 */
} barotropic;

/* The entries that every such law has in its table of parameters: the density comes first, the law's own follow, then
 * the rest. */
#define BAROTROPIC_DENSITY PAR_POSITIVE(barotropic, density, "kg/m^3", NAN, "density at the pressure below")
#define BAROTROPIC_REST                                                   \
    PAR_ANY(barotropic, pressure, "Pa", 0.0, "pressure at that density"), \
        PAR_POSITIVE(barotropic, specific_heat, "J/kg/K", 1000.0, "specific heat; it changes temperatures alone")

/* The entries dpde and heat of eos_model (material/eos.h): (dp/de)_rho = 0; c_v is constant and nothing expands with
 * heat. */
void barotropic_dpde(const void *par, size_t n, const double *rho, const double *e, double *dpde);
void barotropic_heat(const void *par, size_t n, const double *rho, const double *e, double *cv, double *alpha);

#endif
