/* The shock sensor of numerics 2.5: where flow is compressed by more than half a percent of the sound speed a cell, time
 * centring goes from 1/2 to 1 and the linear bulk viscosity comes in. Smooth compression falls below that as the mesh is
 * refined, so that smooth flow stays second order. */
#include "ice/ice_internal.h"

#include <math.h>

static const double threshold = 0.005, steepness = 20.0;

FLOE_ALWAYS_INLINE void sensor_row(const ice_view *v, int j, int k, const int dim, const bool multi)
{
    const ptrdiff_t base = mesh_index(v->b, 0, j, k);
    const double *restrict u[3] = {v->mean[0], v->mean[1], v->mean[2]};
    const double *restrict c = v->m[0].c, *restrict rho = v->rho_sum, *restrict kappa = v->kappa_sum,
                           *restrict mixed = v->mixed;
    double *restrict shock = v->shock;
    const double slope = v->slope, least = v->base, half = 0.5 * v->length;
    double inv_h[3];
    ptrdiff_t st[3];
    for (int a = 0; a < dim; ++a) {
        inv_h[a] = v->inv_h[a];
        st[a] = v->b->stride[a];
    }
#pragma omp simd
    for (int i = 0; i < v->b->n[0]; ++i) {
        const ptrdiff_t at = base + i;
        double div = 0.0;
        for (int a = 0; a < dim; ++a) div += (u[a][at + st[a]] - u[a][at - st[a]]) * inv_h[a];
        /* Wood's speed in a mixture */
        const double inv_c = multi ? sqrt(rho[at] * kappa[at]) : 1.0 / c[at];
        const double raw = steepness * (-half * div * inv_c - threshold);
        const double sensor = raw < 0.0 ? 0.0 : raw > 1.0 ? 1.0 : raw;
        const double points = multi && mixed[at] >= ICE_WITH_POINTS ? 1.0 : 0.0;
        const double s = least + slope * sensor;
        shock[at] = s > points ? s : points;
    }
}

#define INSTANCE(d, m)                                            \
    static void sensor_##d##_##m(const ice_view *v, int j, int k) \
    {                                                             \
        sensor_row(v, j, k, d, m);                                \
    }
ICE_EACH(INSTANCE)
ice_row *const ice_sensor_row[3][2] = ICE_TABLE(sensor);
