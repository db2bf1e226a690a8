#include "mpm/basis/basis_1d.h"

extern const basis_model basis_linear;

static int weights(double xi, double half, double inv_h, double *w, double *dw)
{
    return basis_1d(BASIS_LINEAR, xi, half, inv_h, w, dw);
}

const basis_model basis_linear = {
    .name = "linear",
    .doc = "hat functions; cheapest, noisy at cell crossings",
    .cite = "Sulsky, Chen, Schreyer 1994",
    .kind = BASIS_LINEAR,
    .support = 2,
    .reach = 0,
    .smoothness = 0,
    .weights = weights,
};
