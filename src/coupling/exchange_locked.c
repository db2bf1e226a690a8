/* One velocity, or one temperature, wherever both materials are. */
#include "coupling/exchange_law.h"

static double locked_coefficient(const void *par, const exchange_pair *pair)
{
    (void)par;
    (void)pair;
    return EXCHANGE_LOCKED;
}

const exchange_model exchange_locked = {
    .name = "locked",
    .doc = "one velocity, or one temperature: no difference is left after a step",
    .law = {[EXCHANGE_MOMENTUM] = {.uniform = true, .coefficient = locked_coefficient},
            [EXCHANGE_HEAT] = {.uniform = true, .coefficient = locked_coefficient}},
};
