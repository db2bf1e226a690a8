/* GIMP: hat functions averaged over the domain of a point. */
#ifndef MPM_BASIS_GIMP_H
#define MPM_BASIS_GIMP_H

#include "base/compiler.h"
#include "mpm/basis/basis.h"

#include <math.h>

/* GIMP (Bardenhagen and Kober 2004): the linear hat averaged over the point's domain of half width l: by the distance a = |d| of the node
 * the domain holds the hat's tip (a < l), lies on one side of it (a < 1 - l), or holds its foot (a < 1 + l). Chosen among, not branched to,
 * so that many points are worked out at once. */
FLOE_ALWAYS_INLINE void basis_gimp_node(double d, double l, double over_l, double inv_h, double *w, double *dw)
{
    const double a = fabs(d), sign = d < 0.0 ? -1.0 : 1.0, foot = 1.0 + l - a;
    const double outer = a < 1.0 + l ? 0.25 * foot * foot * over_l : 0.0, side = a < 1.0 - l ? 1.0 - a : outer;
    const double outer_slope = a < 1.0 + l ? 0.5 * foot * over_l : 0.0, slope = a < 1.0 - l ? 1.0 : outer_slope;
    *w = a < l ? 1.0 - 0.5 * (a * a * over_l + l) : side;
    *dw = (a < l ? -d * over_l : -sign * slope) * inv_h;
}

FLOE_ALWAYS_INLINE int basis_gimp_weights(double xi, double half, double inv_h, double *w, double *dw)
{
    const int first = xi < 0.5 ? -1 : 0;
    const double over = 1.0 / half;
    for (int k = 0; k < 3; ++k) basis_gimp_node(xi - (first + k), half, over, inv_h, &w[k], &dw[k]);
    return first;
}

static const basis_model basis_gimp = {
    .name = "gimp",
    .doc = "hat functions averaged over each point's domain",
    .cite = "Bardenhagen, Kober 2004",
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
            3e-4,                     /* load_mass */
            0.4,                      /* usl_share */
            0.45,                     /* carried_share */
            {0.45, 0.45, 0.45, 0.45}, /* restored_share */
            true,                     /* hats */
            false,                    /* light_losses */
            true,                     /* sized */
            false,                    /* shaped */
        },
    .weights = basis_gimp_weights,
};

#endif
