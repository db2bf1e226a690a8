#include "mpm/basis/basis_1d.h"

extern const basis_model basis_cubic;

static int cubic_weights(double xi, double half, double inv_h, double *w, double *dw)
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
    .fact =
        {
            5,                      /* edge_taps */
            1.0 / 24.0,             /* ghost_share */
            7.0 / 30.0,             /* axis_moment */
            1e-14,                  /* least_mass */
            100.0,                  /* most_bulk */
            1.0,                    /* usl_share */
            1.0,                    /* carried_share */
            {1.0, 0.75, 0.7, 0.35}, /* restored_share */
            false,                  /* hats */
            false,                  /* light_losses */
            false,                  /* sized */
            false,                  /* shaped */
        },
    .weights = cubic_weights,
};
