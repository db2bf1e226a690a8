#include "mpm/basis/basis_1d.h"

extern const basis_model basis_cubic;

static int weights(double xi, double half, double inv_h, double *w, double *dw)
{
    return basis_1d(BASIS_CUBIC, xi, half, inv_h, w, dw);
}

const basis_model basis_cubic = {
    .name = "cubic",
    .doc = "cubic B-splines; stress with a continuous slope at cell crossings",
    .cite = "Steffen, Kirby, Berzins 2008",
    .kind = BASIS_CUBIC,
    .support = 4,
    .reach = 1,
    .edge_penalty = 0.001,
    .smoothness = 2,
    .weights = weights,
};
