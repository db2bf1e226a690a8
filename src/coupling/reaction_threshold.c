/* One step at a fixed rate once it is hot enough: rate = rho/tau where T > T_i. */
#include "coupling/reaction.h"

#include <math.h>

typedef struct threshold_par {
    double temperature, time; /* K, s */
} threshold_par;

static const param_spec params[] = {
    PAR_POSITIVE(threshold_par, temperature, "K", NAN, "above it the reactant reacts"),
    PAR_POSITIVE(threshold_par, time, "s", NAN, "in which all but 1/e of it does"),
};

static double threshold_rate(const void *par, const reaction_state *q)
{
    const threshold_par *a = par;
    return q->T > a->temperature ? q->reactant / a->time : 0.0;
}

const reaction_model reaction_threshold = {
    .name = "threshold",
    .doc = "one step of first order above a temperature",
    .cite = "Guilkey et al. (2003), step 4",
    .param_size = sizeof(threshold_par),
    .params = params,
    .n_params = sizeof params / sizeof *params,
    .rate = threshold_rate,
};
