/* Quadratic B-splines. */
#ifndef MPM_BASIS_QUADRATIC_H
#define MPM_BASIS_QUADRATIC_H

#include "base/compiler.h"
#include "mpm/basis/basis.h"

/* Quadratic B-spline: 3/4 - d^2 within half a cell of the node, (3/2 - |d|)^2 / 2 to one and a half. */
FLOE_ALWAYS_INLINE int basis_quadratic_weights(double xi, double half, double inv_h, double *w, double *dw)
{
    (void)half;
    const int first = xi < 0.5 ? -1 : 0;
    const double d = xi - (first + 1);
    w[0] = 0.5 * (0.5 - d) * (0.5 - d);
    w[1] = 0.75 - d * d;
    w[2] = 0.5 * (0.5 + d) * (0.5 + d);
    dw[0] = (d - 0.5) * inv_h;
    dw[1] = -2.0 * d * inv_h;
    dw[2] = (d + 0.5) * inv_h;
    return first;
}

static const basis_model basis_quadratic = {
    .name = "quadratic",
    .doc = "quadratic B-splines; smooth stress at cell crossings",
    .cite = "Steffen, Kirby, Berzins 2008",
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
            3e-4,                  /* load_mass */
            0.6,                   /* usl_share */
            0.7,                   /* carried_share */
            {0.6, 0.4, 0.35, 0.2}, /* restored_share */
            false,                 /* hats */
            false,                 /* light_losses */
            false,                 /* sized */
            false,                 /* shaped */
        },
    .weights = basis_quadratic_weights,
};

#endif
