/* A surface that recedes with the pressure (Vieille): rate = rho_c r_0 (p/p_0)^n S. */
#include "coupling/reaction.h"

#include <math.h>

typedef struct burn_par {
    double velocity, pressure, exponent, specific_surface, threshold; /* m/s, Pa, 1, 1/m, K */
} burn_par;

static const param_spec params[] = {
    {.key = "velocity",
     .unit = "m/s",
     .range = PARAM_POSITIVE,
     .fallback = NAN,
     .offset = offsetof(burn_par, velocity),
     .count = 1,
     .doc = "r_0, at which the surface recedes at the pressure below"},
    {.key = "pressure",
     .unit = "Pa",
     .range = PARAM_POSITIVE,
     .fallback = 1e6,
     .offset = offsetof(burn_par, pressure),
     .count = 1,
     .doc = "p_0, absolute"},
    {.key = "exponent",
     .unit = "1",
     .range = PARAM_BETWEEN,
     .lo = 0.0,
     .hi = 3.0,
     .fallback = NAN,
     .offset = offsetof(burn_par, exponent),
     .count = 1,
     .doc = "n of r = r_0 (p/p_0)^n"},
    {.key = "specific_surface",
     .unit = "1/m",
     .range = PARAM_NONNEGATIVE,
     .fallback = 0.0,
     .offset = offsetof(burn_par, specific_surface),
     .count = 1,
     .doc = "of grains: surface over volume of what is left of the reactant; 0: a body, whose surface is the gradient "
            "of its "
            "volume fraction"},
    {.key = "threshold",
     .unit = "K",
     .range = PARAM_NONNEGATIVE,
     .fallback = 0.0,
     .offset = offsetof(burn_par, threshold),
     .count = 1,
     .doc = "nothing burns below this temperature of the cell"},
};

static double rate(const void *par, const reaction_state *q)
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
    .rate = rate,
};
