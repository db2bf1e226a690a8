#include "mpm/basis/basis_1d.h"

extern const basis_model basis_quadratic;

static int weights(double xi, double half, double inv_h, double *w, double *dw)
{
    return basis_1d(BASIS_QUADRATIC, xi, half, inv_h, w, dw);
}

const basis_model basis_quadratic = {
    .name = "quadratic",
    .doc = "quadratic B-splines; smooth stress at cell crossings",
    .cite = "Steffen, Kirby, Berzins 2008",
    .kind = BASIS_QUADRATIC,
    .support = 3,
    .reach = 1,
    .edge_penalty = 0.005,
    .smoothness = 1,
    .weights = weights,
};
