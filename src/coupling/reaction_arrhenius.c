/* One step after Arrhenius: rate = A rho exp(-T_a/T). */
#include "coupling/reaction.h"

#include <math.h>

typedef struct arrhenius_par {
    double frequency, activation, threshold; /* 1/s, K, K */
} arrhenius_par;

static const param_spec params[] = {
    PAR_POSITIVE(arrhenius_par, frequency, "1/s", NAN, "A, the rate at infinite temperature"),
    PAR_NONNEGATIVE(arrhenius_par, activation, "K", NAN,
                    "activation temperature, the activation energy over the gas constant"),
    PAR_NONNEGATIVE(arrhenius_par, threshold, "K", 0.0, "nothing reacts below this temperature"),
};

static double arrhenius_rate(const void *par, const reaction_state *q)
{
    const arrhenius_par *a = par;
    if (!(q->T > a->threshold)) return 0.0;
    return a->frequency * q->reactant * exp(-a->activation / q->T);
}

const reaction_model reaction_arrhenius = {
    .name = "arrhenius",
    .doc = "one step of first order, at a rate that grows with temperature",
    .cite = "S. Arrhenius, Z. phys. Chem. 4 (1889) 226",
    .param_size = sizeof(arrhenius_par),
    .params = params,
    .n_params = sizeof params / sizeof *params,
    .rate = arrhenius_rate,
};
