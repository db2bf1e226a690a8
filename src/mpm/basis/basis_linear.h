/* Hat functions. */
#ifndef MPM_BASIS_LINEAR_H
#define MPM_BASIS_LINEAR_H

#include "base/compiler.h"
#include "mpm/basis/basis.h"

/* Linear: N = 1 - |xi|. */
FLOE_ALWAYS_INLINE int basis_linear_weights(double xi, double half, double inv_h, double *w, double *dw)
{
    (void)half;
    w[0] = 1.0 - xi;
    w[1] = xi;
    dw[0] = -inv_h;
    dw[1] = inv_h;
    return 0;
}

static const basis_model basis_linear = {
    .name = "linear",
    .doc = "hat functions; cheapest, noisy at cell crossings",
    .cite = "Sulsky, Chen, Schreyer 1994",
    .support = 2,
    .reach = 0,
    .smoothness = 0,
    .fact =
        {
            3,                    /* edge_taps */
            0.0,                  /* ghost_share */
            1.0 / 6.0,            /* axis_moment */
            1e-9,                 /* least_mass */
            3e-4,                 /* load_mass */
            0.5,                  /* usl_share */
            0.6,                  /* carried_share */
            {0.6, 0.6, 0.6, 0.6}, /* restored_share */
            true,                 /* hats */
            true,                 /* light_losses */
            false,                /* sized */
            false,                /* shaped */
        },
    .weights = basis_linear_weights,
};

#endif
