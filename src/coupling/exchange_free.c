/* No exchange. */
#include "coupling/exchange_law.h"

static double free_coefficient(const void *par, const exchange_pair *pair)
{
    (void)par;
    (void)pair;
    return 0.0;
}

const exchange_model exchange_free = {
    .name = "free",
    .doc = "no exchange; as `tangential` of a pair: one slips along the other",
    .law = {[EXCHANGE_MOMENTUM] = {.uniform = true, .coefficient = free_coefficient},
            [EXCHANGE_HEAT] = {.uniform = true, .coefficient = free_coefficient}},
};
