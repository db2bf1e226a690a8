/* A constant coefficient. */
#include "coupling/exchange_law.h"

#include <math.h>

typedef struct constant_par {
    double coefficient;
} constant_par;

static const param_spec momentum_params[] = {PAR_BETWEEN(constant_par, coefficient, "kg m-3 s-1", 0.0, 1e20, NAN,
                                                         "K of the force theta1 theta2 K (u2 - u1) per volume")};
static const param_spec heat_params[] = {PAR_BETWEEN(constant_par, coefficient, "W m-3 K-1", 0.0, 1e30, NAN,
                                                     "R of the heat theta1 theta2 R (T2 - T1) per volume and time")};

static double constant_coefficient(const void *par, const exchange_pair *pair)
{
    (void)pair;
    return ((const constant_par *)par)->coefficient;
}

const exchange_model exchange_constant = {
    .name = "constant",
    .doc = "a constant coefficient",
    .cite = "Guilkey et al. (2003), exchange terms of eqs 2 and 3",
    .law = {[EXCHANGE_MOMENTUM] = {.param_size = sizeof(constant_par),
                                   .params = momentum_params,
                                   .n_params = 1,
                                   .uniform = true,
                                   .coefficient = constant_coefficient},
            [EXCHANGE_HEAT] = {.param_size = sizeof(constant_par),
                               .params = heat_params,
                               .n_params = 1,
                               .uniform = true,
                               .coefficient = constant_coefficient}},
};
