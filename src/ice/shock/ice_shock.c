/* Sensors. The shock sensor of theory 2.5: where flow is compressed by more than half a percent of the sound speed a
 * cell, time centring goes from 1/2 to 1 and the linear bulk viscosity comes in. Smooth compression falls below that as
 * the mesh is refined, so that smooth flow stays second order. */
#include "ice/shock/ice_shock.h"

#include <math.h>

FLOE_ALWAYS_INLINE void sensor_row(const ice_view *v, int j, int k, const int dim, const bool multi)
{
    const ptrdiff_t base = mesh_index(v->b, 0, j, k);
    const double *restrict u[3] = {v->mean[0], v->mean[1], v->mean[2]};
    const double *restrict c = v->m[0].c, *restrict rho = v->rho_sum, *restrict kappa = v->kappa_sum,
                           *restrict mixed = v->mixed;
    double *restrict shock = v->shock;
    const double slope = v->slope, least = v->base, half = 0.5 * v->length;
    double inv_h[3], share[3];
    ptrdiff_t st[3];
    for (int a = 0; a < dim; ++a) {
        inv_h[a] = v->inv_h[a];
        share[a] = v->share[a];
        st[a] = v->b->stride[a];
    }
#pragma omp simd
    for (int i = 0; i < v->b->n[0]; ++i) {
        const ptrdiff_t at = base + i;
        double div = 0.0, jump = 0.0;
        for (int a = 0; a < dim; ++a) {
            const double rate = (u[a][at + st[a]] - u[a][at - st[a]]) * inv_h[a];
            div += rate;
            jump += share[a] * rate;
        }
        /* Wood's speed in a mixture */
        const double inv_c = multi ? sqrt(rho[at] * kappa[at]) : 1.0 / c[at];
        const double raw = ICE_SHOCK_STEEPNESS * (half * ice_compression(div, jump) * inv_c - ICE_SHOCK_FOOT);
        const double sensor = raw < 0.0 ? 0.0 : raw > 1.0 ? 1.0 : raw;
        const double points = multi && mixed[at] >= ICE_WITH_POINTS ? 1.0 : 0.0;
        const double s = least + slope * sensor;
        shock[at] = s > points ? s : points;
    }
}

#define INSTANCE(d, m)                                                      \
    FLOE_WIDE static void sensor_##d##_##m(const ice_view *v, int j, int k) \
    {                                                                       \
        sensor_row(v, j, k, d, m);                                          \
    }
ICE_EACH(INSTANCE)
static ice_row *const sensor_rows[3][2] = ICE_TABLE(sensor);

/* The contact sensor: how much of a contact lies across a cell, along the axis that shows most of it. Two signs must be
 * there: a change of density over two cells, from 5 % of it on, which ten times the isentrope's for the change of
 * pressure does not explain; and an inflection, (D_lower - D_upper)/(6 change) > 0 with the second differences D on
 * either side (Colella and Woodward 1984, J. Comput. Phys. 54, 174, eq. 1.16), which a smooth profile of entropy behind
 * a blast has not. */
FLOE_ALWAYS_INLINE void contact_row(const ice_view *v, int j, int k, const int dim)
{
    const ptrdiff_t base = mesh_index(v->b, 0, j, k);
    const double *restrict rho = v->m[0].rho, *restrict p = v->p, *restrict c = v->m[0].c;
    double *restrict contact = v->contact;
    ptrdiff_t st[3];
    for (int a = 0; a < dim; ++a) st[a] = v->b->stride[a];
#pragma omp simd
    for (int i = 0; i < v->b->n[0]; ++i) {
        const ptrdiff_t at = base + i;
        const double inverse = 1.0 / rho[at], still = ICE_CONTACT_COMPRESSION / (c[at] * c[at]);
        double found = 0.0;
        for (int a = 0; a < dim; ++a) {
            const double below = rho[at - st[a]], above = rho[at + st[a]], change = above - below;
            const double jump =
                (fabs(change) - still * fabs(p[at + st[a]] - p[at - st[a]])) * inverse - ICE_CONTACT_FOOT;
            const double lower = rho[at] - 2.0 * below + rho[at - 2 * st[a]],
                         upper = rho[at + 2 * st[a]] - 2.0 * above + rho[at];
            const double bend =
                lower * upper < 0.0 ? (lower - upper) * change / (6.0 * change * change + ICE_TINY) : 0.0;
            const double share = least(most(ICE_CONTACT_STEEPNESS * jump, 0.0), 1.0) *
                                 least(most(ICE_INFLECTION_STEEPNESS * (bend - ICE_INFLECTION_FOOT), 0.0), 1.0);
            found = most(found, share);
        }
        contact[at] = found;
    }
}

#define CONTACT(d)                                                     \
    FLOE_WIDE static void contact_##d(const ice_view *v, int j, int k) \
    {                                                                  \
        contact_row(v, j, k, d);                                       \
    }
CONTACT(1)
CONTACT(2)
CONTACT(3)
static ice_row *const contact_rows[3] = {contact_1, contact_2, contact_3};

void ice_find_sensors(const ice_view *v)
{
    ice_run_cells(v, 0, sensor_rows[v->dim - 1][v->multi]);
    if (v->contact) ice_run_cells(v, 0, contact_rows[v->dim - 1]);
}
