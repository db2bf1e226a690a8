/* A surface that recedes with the pressure (Vieille): rate = rho_c r_0 (p/p_0)^n S. */
#include "coupling/reaction.h"

#include <math.h>

typedef struct burn_par {
    double velocity, pressure, exponent, specific_surface, threshold; /* m/s, Pa, 1, 1/m, K */
} burn_par;

static const param_spec params[] = {
    PAR_POSITIVE(burn_par, velocity, "m/s", NAN, "r_0, at which the surface recedes at the pressure below"),
    PAR_POSITIVE(burn_par, pressure, "Pa", 1e6, "p_0, absolute"),
    PAR_BETWEEN(burn_par, exponent, "1", 0.0, 3.0, NAN, "n of r = r_0 (p/p_0)^n"),
    PAR_NONNEGATIVE(
        burn_par, specific_surface, "1/m", 0.0,
        "of grains: surface over volume of what is left of the reactant; 0: a body, whose surface is the gradient of "
        "its volume fraction"),
    PAR_NONNEGATIVE(burn_par, threshold, "K", 0.0, "nothing burns below this temperature of the cell"),
};

static double burn_rate(const void *par, const reaction_state *q)
{
    const burn_par *a = par;
    if (!(q->T > a->threshold) || !(q->p > 0.0)) return 0.0;
    const double recession = a->velocity * pow(q->p / a->pressure, a->exponent);
    const double surface = a->specific_surface > 0.0 ? a->specific_surface * q->reactant / q->density : q->surface;
    return q->reactant > 0.0 ? q->density * recession * surface : 0.0;
}

const reaction_model reaction_burn = {
    .name = "burn",
    .doc = "a burning surface that recedes at a power of the pressure",
    .cite = "P. Vieille, Memorial des Poudres et Salpetres 6 (1893) 256",
    .param_size = sizeof(burn_par),
    .params = params,
    .n_params = sizeof params / sizeof *params,
    .rate = burn_rate,
};
