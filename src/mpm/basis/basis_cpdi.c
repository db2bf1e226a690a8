#include "mpm/basis/basis_1d.h"

extern const basis_model basis_cpdi;

static int cpdi_weights(double xi, double half, double inv_h, double *w, double *dw)
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
    .fact =
        {
            3,                        /* edge_taps */
            0.0,                      /* ghost_share */
            1.0 / 6.0,                /* axis_moment */
            1e-9,                     /* least_mass */
            10.0,                     /* most_bulk */
            0.4,                      /* usl_share */
            0.55,                     /* carried_share */
            {0.55, 0.55, 0.55, 0.55}, /* restored_share */
            false,                    /* hats */
            true,                     /* light_losses */
            true,                     /* sized */
            true,                     /* shaped */
        },
    .weights = cpdi_weights,
};
