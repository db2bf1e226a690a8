#include "mpm/basis/basis_1d.h"

extern const basis_model basis_gimp;

static int weights(double xi, double half, double inv_h, double *w, double *dw)
{
    return basis_1d(BASIS_GIMP, xi, half, inv_h, w, dw);
}

const basis_model basis_gimp = {
    .name = "gimp",
    .doc = "hat functions averaged over each point's domain",
    .cite = "Bardenhagen, Kober 2004",
    .kind = BASIS_GIMP,
    .support = 3,
    .reach = 1,
    .edge_penalty = 0.0005,
    .smoothness = 1,
    .weights = weights,
};
