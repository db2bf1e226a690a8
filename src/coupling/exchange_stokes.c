/* Spheres in slow flow: F = 3 pi mu d (u_c - u_d) each; heat by conduction alone, Nu = 2. */
#include "coupling/dispersed.h"

typedef struct stokes_par {
    dispersed_par spheres;
} stokes_par;

typedef struct conduction_par {
    double diameter, conductivity; /* m, W/m/K */
} conduction_par;

static const param_spec momentum_params[] = {DISPERSED_PARAMS};
static const param_spec heat_params[] = {
    PAR_POSITIVE(conduction_par, diameter, "m", NAN, "diameter of the spheres, the first material"),
    PAR_POSITIVE(conduction_par, conductivity, "W m-1 K-1", NAN, "of the carrier, the second material"),
};

static double stokes_drag(const void *par, const exchange_pair *q)
{
    return dispersed_stokes(&((const stokes_par *)par)->spheres, q);
}

static double conduction_heat(const void *par, const exchange_pair *q)
{
    const conduction_par *a = par;
    return 12.0 * a->conductivity / (a->diameter * a->diameter) * dispersed_share(q);
}

static const char *stokes_check_viscosity(const void *par, const double viscosity[2])
{
    return dispersed_check(&((const stokes_par *)par)->spheres, viscosity);
}

const exchange_model exchange_stokes = {
    .name = "stokes",
    .doc = "dispersed spheres in slow flow: Stokes' drag; conduction, Nu = 2",
    .cite = "G. G. Stokes, Trans. Camb. Phil. Soc. 9 (1851) 8",
    .law = {[EXCHANGE_MOMENTUM] = {.param_size = sizeof(stokes_par),
                                   .params = momentum_params,
                                   .n_params = 2,
                                   .coefficient = stokes_drag,
                                   .check = stokes_check_viscosity},
            [EXCHANGE_HEAT] = {.param_size = sizeof(conduction_par),
                               .params = heat_params,
                               .n_params = 2,
                               .coefficient = conduction_heat}},
};
