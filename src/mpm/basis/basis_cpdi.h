/* CPDI: hat functions at the corners of the domain of a point. */
#ifndef MPM_BASIS_CPDI_H
#define MPM_BASIS_CPDI_H

#include "base/compiler.h"
#include "mpm/basis/basis.h"

#include <math.h>

/* CPDI (Sadeghirad, Brannon and Burghardt 2011) on a box along the axes: the mean of the hats at its two ends, and the mean of the slope
 * between them. */
FLOE_ALWAYS_INLINE double basis_hat(double d)
{
    const double a = fabs(d);
    return a < 1.0 ? 1.0 - a : 0.0;
}

FLOE_ALWAYS_INLINE int basis_cpdi_weights(double xi, double half, double inv_h, double *w, double *dw)
{
    for (int k = 0; k < 4; ++k) {
        const double d = xi - (k - 1), below = basis_hat(d - half), above = basis_hat(d + half);
        w[k] = 0.5 * (below + above);
        dw[k] = (above - below) / (2.0 * half) * inv_h;
    }
    return -1;
}

static const basis_model basis_cpdi = {
    .name = "cpdi",
    .doc = "hat functions at the corners of each point's domain, a parallelogram that deforms with the point",
    .cite = "Sadeghirad, Brannon, Burghardt 2011",
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
            0.03,                     /* load_mass */
            0.4,                      /* usl_share */
            0.55,                     /* carried_share */
            {0.55, 0.55, 0.55, 0.55}, /* restored_share */
            false,                    /* hats */
            true,                     /* light_losses */
            true,                     /* sized */
            true,                     /* shaped */
        },
    .weights = basis_cpdi_weights,
};

#endif
