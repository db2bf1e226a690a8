/* Spheres at any speed below that of sound: C_D = 24/Re (1 + 0.15 Re^0.687), and 0.44 where that is more (Re > 1000);
 * heat by Ranz and Marshall, Nu = 2 + 0.6 Re^(1/2) Pr^(1/3). */
#include "coupling/dispersed.h"

typedef struct sphere_par {
    dispersed_par spheres;
} sphere_par;

typedef struct sphere_heat_par {
    dispersed_par spheres;
    double conductivity, prandtl; /* W/m/K, 1 */
} sphere_heat_par;

static const param_spec momentum_params[] = {DISPERSED_PARAMS};
static const param_spec heat_params[] = {
    DISPERSED_PARAMS,
    PAR_POSITIVE(sphere_heat_par, conductivity, "W m-1 K-1", NAN, "of the carrier"),
    PAR_POSITIVE(sphere_heat_par, prandtl, "1", 0.71, "Prandtl number of the carrier"),
};

static double schiller_naumann_drag(const void *par, const exchange_pair *q)
{
    const dispersed_par *a = &((const sphere_par *)par)->spheres;
    const double Re = dispersed_reynolds(a, q);
    return dispersed_stokes(a, q) * fmax(1.0 + 0.15 * pow(Re, 0.687), 0.44 / 24.0 * Re);
}

static double ranz_marshall_heat(const void *par, const exchange_pair *q)
{
    const sphere_heat_par *a = par;
    const double d = a->spheres.diameter, Re = dispersed_reynolds(&a->spheres, q);
    const double nusselt = 2.0 + 0.6 * sqrt(Re) * cbrt(a->prandtl);
    return 6.0 * a->conductivity * nusselt / (d * d) * dispersed_share(q);
}

static const char *schiller_naumann_check_viscosity(const void *par, const double viscosity[2])
{
    return dispersed_check(par, viscosity); /* both parameter structs begin with the spheres */
}

const exchange_model exchange_schiller_naumann = {
    .name = "schiller_naumann",
    .doc = "dispersed spheres: drag by Schiller and Naumann (Newton's 0.44 above Re = 1000), heat by Ranz and Marshall",
    .cite = "L. Schiller, A. Naumann, Z. VDI 77 (1935) 318; W. E. Ranz, W. R. Marshall, Chem. Eng. Prog. 48 (1952) 141",
    .law = {[EXCHANGE_MOMENTUM] = {.param_size = sizeof(sphere_par),
                                   .params = momentum_params,
                                   .n_params = 2,
                                   .coefficient = schiller_naumann_drag,
                                   .check = schiller_naumann_check_viscosity},
            [EXCHANGE_HEAT] = {.param_size = sizeof(sphere_heat_par),
                               .params = heat_params,
                               .n_params = 4,
                               .coefficient = ranz_marshall_heat,
                               .check = schiller_naumann_check_viscosity}},
};
