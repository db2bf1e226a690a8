#include "mpm/basis/basis_1d.h"

extern const basis_model basis_cpdi;

static int weights(double xi, double half, double inv_h, double *w, double *dw)
{
    return basis_1d(BASIS_CPDI, xi, half, inv_h, w, dw);
}

const basis_model basis_cpdi = {
    .name = "cpdi",
    .doc = "hat functions at the corners of each point's domain, a parallelogram that deforms with the point",
    .cite = "Sadeghirad, Brannon, Burghardt 2011",
    .kind = BASIS_CPDI,
    .support = 4,
    .reach = 1,
    .smoothness = 1,
    .averaged = true,
    .weights = weights,
};
