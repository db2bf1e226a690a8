/* Cubic B-splines. */
#ifndef MPM_BASIS_CUBIC_H
#define MPM_BASIS_CUBIC_H

#include "base/compiler.h"
#include "mpm/basis/basis.h"

/* Cubic B-spline: 2/3 - d^2 + |d|^3/2 within a cell of the node, (2 - |d|)^3/6 to two. */
FLOE_ALWAYS_INLINE int basis_cubic_weights(double xi, double half, double inv_h, double *w, double *dw)
{
    (void)half;
    const double from = xi, to = 1.0 - xi; /* distances to the nodes of the cell */
    w[0] = to * to * to / 6.0;
    w[1] = 2.0 / 3.0 - from * from + 0.5 * from * from * from;
    w[2] = 2.0 / 3.0 - to * to + 0.5 * to * to * to;
    w[3] = from * from * from / 6.0;
    dw[0] = -0.5 * to * to * inv_h;
    dw[1] = from * (1.5 * from - 2.0) * inv_h;
    dw[2] = to * (2.0 - 1.5 * to) * inv_h;
    dw[3] = 0.5 * from * from * inv_h;
    return -1;
}

static const basis_model basis_cubic = {
    .name = "cubic",
    .doc = "cubic B-splines; stress with a continuous slope at cell crossings",
    .cite = "Steffen, Kirby, Berzins 2008",
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
            3e-4,                   /* load_mass */
            1.0,                    /* usl_share */
            1.0,                    /* carried_share */
            {1.0, 0.75, 0.7, 0.35}, /* restored_share */
            false,                  /* hats */
            false,                  /* light_losses */
            false,                  /* sized */
            false,                  /* shaped */
        },
    .weights = basis_cubic_weights,
};

#endif
