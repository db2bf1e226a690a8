#include "mpm/basis/basis_1d.h"

extern const basis_model basis_quadratic;

static int quadratic_weights(double xi, double half, double inv_h, double *w, double *dw)
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
    .fact =
        {
            4,                     /* edge_taps */
            1.0 / 48.0,            /* ghost_share */
            13.0 / 64.0,           /* axis_moment */
            1e-9,                  /* least_mass */
            100.0,                 /* most_bulk */
            0.6,                   /* usl_share */
            0.7,                   /* carried_share */
            {0.6, 0.4, 0.35, 0.2}, /* restored_share */
            false,                 /* hats */
            false,                 /* light_losses */
            false,                 /* sized */
            false,                 /* shaped */
        },
    .weights = quadratic_weights,
};
