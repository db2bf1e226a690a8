#include "mpm/basis/basis_1d.h"

extern const basis_model basis_gimp;

static int gimp_weights(double xi, double half, double inv_h, double *w, double *dw)
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
    .fact =
        {
            3,                        /* edge_taps */
            0.0,                      /* ghost_share */
            1.0 / 6.0,                /* axis_moment */
            1e-9,                     /* least_mass */
            10.0,                     /* most_bulk */
            0.4,                      /* usl_share */
            0.45,                     /* carried_share */
            {0.45, 0.45, 0.45, 0.45}, /* restored_share */
            true,                     /* hats */
            false,                    /* light_losses */
            true,                     /* sized */
            false,                    /* shaped */
        },
    .weights = gimp_weights,
};
