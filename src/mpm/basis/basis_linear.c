#include "mpm/basis/basis_1d.h"

extern const basis_model basis_linear;

static int linear_weights(double xi, double half, double inv_h, double *w, double *dw)
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
    .fact =
        {
            3,                    /* edge_taps */
            0.0,                  /* ghost_share */
            1.0 / 6.0,            /* axis_moment */
            1e-9,                 /* least_mass */
            10.0,                 /* most_bulk */
            0.5,                  /* usl_share */
            0.6,                  /* carried_share */
            {0.6, 0.6, 0.6, 0.6}, /* restored_share */
            true,                 /* hats */
            true,                 /* light_losses */
            false,                /* sized */
            false,                /* shaped */
        },
    .weights = linear_weights,
};
