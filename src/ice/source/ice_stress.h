/* Viscous stress and conduction through the faces of a cell (theory 2.6):
 *     tau = theta mu [grad u + grad u^T] + theta (zeta - 2/3 mu) (div u) 1,     q = theta k grad T,
 * two-point normal derivatives, four-cell transverse ones, the harmonic mean of theta on the face (mu and k are a
 * material's), and about an axis the hoop terms. Only this folder includes it. One always-inline body for each dimension and geometry. */
#ifndef ICE_ICE_STRESS_H
#define ICE_ICE_STRESS_H

#include "ice/ice_constants.h"
#include "ice/source/ice_source.h"

/* One fluid's velocities and temperatures, at whatever time. */
typedef struct diffusing {
    const double *u[3], *T, *theta; /* T: of any finite values where k is 0; theta NULL: one fluid */
    double mu, dilatation, k;       /* Pa s; zeta - 2/3 mu, Pa s; W/m/K */
    const double *radius;           /* m: of the lower face along axis 0 of local cell i; NULL in the plane */
    ptrdiff_t stride[3];
    double inv_h[3];
} diffusing;

/* On the lower face of `axis` at cell R. */
FLOE_ALWAYS_INLINE ice_face_diffusion diffusion_on(const diffusing *d, int axis, ptrdiff_t R, ptrdiff_t i,
                                                   const int dim, const bool radial)
{
    const ptrdiff_t L = R - d->stride[axis];
    double share = 1.0;
    if (d->theta) share = 2.0 * d->theta[L] * d->theta[R] / (d->theta[L] + d->theta[R] + ICE_TINY);
    double normal[3], across[3], div = 0.0;
    for (int a = 0; a < dim; ++a) {
        const ptrdiff_t st = d->stride[a];
        const double *u = d->u[a], *w = d->u[axis];
        normal[a] = (u[R] - u[L]) * d->inv_h[axis];
        across[a] = a == axis ? normal[a] : 0.25 * d->inv_h[a] * (w[R + st] - w[R - st] + w[L + st] - w[L - st]);
        div += a == axis ? normal[a] : 0.25 * d->inv_h[a] * (u[R + st] - u[R - st] + u[L + st] - u[L - st]);
    }
    if (radial) {
        const double r = axis == 0 ? d->radius[i] : 0.5 * (d->radius[i] + d->radius[i + 1]);
        div += r > 0.0 ? 0.5 * (d->u[0][L] + d->u[0][R]) / r : (d->u[0][R] - d->u[0][L]) * d->inv_h[0];
    }
    ice_face_diffusion f = {.power = share * d->k * (d->T[R] - d->T[L]) * d->inv_h[axis]};
    for (int a = 0; a < dim; ++a) {
        f.t[a] = share * (d->mu * (normal[a] + across[a]) + (a == axis ? d->dilatation * div : 0.0));
        f.power += f.t[a] * 0.5 * (d->u[a][L] + d->u[a][R]);
    }
    return f;
}

/* -tau_tt / r in axisymmetric scenes: the hoop stress acts towards the axis and does no work on faces. */
FLOE_ALWAYS_INLINE double diffusion_hoop(const diffusing *d, ptrdiff_t at, ptrdiff_t i, const int dim)
{
    const double r = 0.5 * (d->radius[i] + d->radius[i + 1]), rate = d->u[0][at] / r;
    double div = rate;
    for (int a = 0; a < dim; ++a) div += 0.5 * (d->u[a][at + d->stride[a]] - d->u[a][at - d->stride[a]]) * d->inv_h[a];
    return -(d->theta ? d->theta[at] : 1.0) * (2.0 * d->mu * rate + d->dilatation * div) / r;
}

/* Force on a cell and power into it, both per volume. */
typedef struct cell_diffusion {
    double force[3], power;
} cell_diffusion;

FLOE_ALWAYS_INLINE cell_diffusion diffusion_into(const diffusing *d, const ice_view *v, ptrdiff_t at, ptrdiff_t i,
                                                 const int dim, const bool radial)
{
    cell_diffusion c = {{0.0, 0.0, 0.0}, 0.0};
    for (int axis = 0; axis < dim; ++axis) {
        const ice_face_diffusion lower = diffusion_on(d, axis, at, i, dim, radial),
                                 upper =
                                     diffusion_on(d, axis, at + d->stride[axis], axis == 0 ? i + 1 : i, dim, radial);
        const double below = axis == 0 ? v->lower0[i] : d->inv_h[axis],
                     above = axis == 0 ? v->upper0[i] : d->inv_h[axis];
        for (int a = 0; a < dim; ++a) c.force[a] += above * upper.t[a] - below * lower.t[a];
        c.power += above * upper.power - below * lower.power;
    }
    if (radial) c.force[0] += diffusion_hoop(d, at, i, dim);
    return c;
}

/* Adds them to a fluid's Lagrangian values; per_mass: dt/rho, 0 where there is none of the fluid. */
FLOE_ALWAYS_INLINE void take_diffusion(const ice_fluid *m, ptrdiff_t at, double per_mass, const int dim,
                                       const cell_diffusion *c)
{
    double du[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < dim; ++a) du[a] = per_mass * c->force[a];
    ice_add_change(m, at, dim, du, per_mass * c->power);
}

#endif
