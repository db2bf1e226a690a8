/* The pressure increment: theory 2.3 with the centring of 2.5 and the bulk viscosity of 2.8 (iv); Guilkey et al. 2003,
 * eq. 11.
 *
 *     dP = -(dt/V) sum_f A_f F / S,     F = sum_r theta^r,f u*^r
 *     P  = p + phi dP - (1 - s) dt/2 (u . grad) p + q,     q = rho (c_q^2 du^2 + s c_l c |du|)
 *          - 0.6 rho c sum_a b_a (one fluid, limited)
 *
 * with du < 0 the jump of velocity over the cell, sum_a h_a du_a/dx_a, no larger than the largest h times div u: a shock has the
 * width of the spacing that it crosses, and what is compressed along one axis as it expands along another has none of it.
 * C_DP keeps the full-step dP by dilatation alone. The advective term is the other half of A in ice_face.c; b is that of `bend_of`. */
#include "ice/pressure/ice_pressure.h"

#include "ice/exchange/ice_exchange.h"
#include "ice/fraction/ice_fraction.h"
#include "ice/ice_constants.h"
#include "ice/points/ice_points.h"
#include "ice/shock/ice_shock.h"
#include "ice/sides/ice_sides.h"
#include "ice/source/ice_source.h"
#include "ice/state/ice_materials.h"

#include <math.h>

/* Where the velocity has a kink along an axis, at the foot of a fan or behind a shock: what its central difference over a cell exceeds the smaller of
 * the one-sided ones by (Christensen's limited viscosity). Centred in space and time, the step would ring there. A kink is where third differences
 * are as large as second ones; waves of more than 20 cells have none of it. It is in full from 0.5 % of the speed of sound a cell on, so
 * that sound and slow flow do without, and nothing at 17 %, where a strong fan is still two or three cells wide. Less is enough in
 * compression, where shocks have q. */
FLOE_ALWAYS_INLINE double bend_of(const double *restrict u, ptrdiff_t at, ptrdiff_t step, double inv_c)
{
    const double below = u[at] - u[at - step], above = u[at + step] - u[at], centre = 0.5 * (below + above);
    const double second = above - below, lower = below - (u[at - step] - u[at - 2 * step]),
                 upper = (u[at + 2 * step] - u[at + step]) - above;
    const double third = fabs(upper - second) + fabs(second - lower),
                 scale = fabs(lower) + 2.0 * fabs(second) + fabs(upper) + 0.25 * (fabs(below) + fabs(above));
    const double kink = least(most(ICE_KINK_STEEPNESS * (third / (scale + ICE_TINY) - ICE_KINK_FOOT), 0.0), 1.0);
    const double pace = 0.5 * fabs(centre) * inv_c,
                 strong = least(ICE_KINK_ONSET * pace, 1.0) * most(1.0 - ICE_KINK_END * pace, 0.0);
    const double limited = most(least(below, above), 0.0) + least(most(below, above), 0.0), excess = centre - limited;
    return kink * strong * (ICE_KINK_MEAN * excess + ICE_KINK_SIGNED * fabs(excess));
}

FLOE_ALWAYS_INLINE void increment_row(const ice_view *v, int j, int k, const int dim, const bool multi)
{
    const ptrdiff_t base = mesh_index(v->b, 0, j, k);
    const double *restrict F[3] = {v->flux[0], v->flux[1], v->flux[2]}, *restrict u[3] = {v->mean[0], v->mean[1],
                                                                                          v->mean[2]};
    const double *restrict p = v->p, *restrict rho = v->rho_sum, *restrict kappa = v->kappa_sum,
                           *restrict c = v->m[0].c;
    const double *restrict shock = v->shock, *restrict lower0 = v->lower0, *restrict upper0 = v->upper0;
    double *restrict dP = v->dP, *restrict P = v->P;
    const double dt = v->dt, length = v->length, viscous = ICE_KINK_VISCOSITY * (1.0 - v->limit_lo);
    double inv_h[3], share[3], quarter[3];
    ptrdiff_t st[3];
    for (int a = 0; a < dim; ++a) {
        inv_h[a] = v->inv_h[a];
        share[a] = v->share[a];
        quarter[a] = -0.25 * v->dt * v->inv_h[a] * v->limit_hi;
        st[a] = v->b->stride[a];
    }
#pragma omp simd
    for (int i = 0; i < v->b->n[0]; ++i) {
        const ptrdiff_t at = base + i;
        double div = upper0[i] * F[0][at + 1] - lower0[i] * F[0][at], jump = share[0] * div;
        for (int a = 1; a < dim; ++a) {
            const double rate = (F[a][at + st[a]] - F[a][at]) * inv_h[a];
            div += rate;
            jump += share[a] * rate;
        }
        double carried = 0.0;
        for (int a = 0; a < dim; ++a) carried += quarter[a] * u[a][at] * (p[at + st[a]] - p[at - st[a]]);
        const double stiffness = multi ? 1.0 / kappa[at] : rho[at] * c[at] * c[at];
        const double speed = multi ? sqrt(stiffness / rho[at]) : c[at];
        double bend = 0.0; /* beside another fluid it would smear the start of a fan */
        for (int a = 0; a < dim && !multi; ++a) bend += bend_of(u[a], at, st[a], 1.0 / speed);
        const double squeeze = length * ice_compression(div, jump), s = shock[at];
        const double increment = -dt * div * stiffness;
        /* Beside a vacuum the neighbour's pressure, carried, could be any multiple of the cell's own. */
        carried = least(most(carried, -ICE_CARRIED_PRESSURE * stiffness), ICE_CARRIED_PRESSURE * stiffness);
        dP[at] = increment;
        P[at] = p[at] + 0.5 * (1.0 + s) * increment + (1.0 - s) * carried +
                ice_bulk_pressure(rho[at], speed, squeeze, s) - viscous * rho[at] * speed * bend;
    }
}

#define INSTANCE(d, m)                                                         \
    FLOE_WIDE static void increment_##d##_##m(const ice_view *v, int j, int k) \
    {                                                                          \
        increment_row(v, j, k, d, m);                                          \
    }
ICE_EACH(INSTANCE)
static ice_row *const increment_rows[3][2] = ICE_TABLE(increment);

/* The volume that is missing or in excess is taken back at the rate beta (theory 5.5). */
static void relax_volume(const ice *s, const ice_view *v)
{
    const double beta = s->scene->method.volume_relaxation;
    const ice_rows q = ice_rows_of(v->b, -1, 0);
#pragma omp parallel for schedule(static)
    for (int row = 0; row < q.n; ++row) {
        const ptrdiff_t base = ice_row_start(v->b, q, row);
        for (ptrdiff_t at = base; at < base + v->b->n[0]; ++at) {
            if (!ice_holds_points(v, at)) continue;
            v->P[at] += 0.5 * (1.0 + v->shock[at]) * beta * (v->tmv[at] - 1.0) / v->kappa_sum[at];
        }
    }
}

/* Where points share cells: relaxes volumes, and constrains cells with extrapolated pressure. */
static void finish_beside_points(const ice *s, const ice_region *g)
{
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);) {
        relax_volume(s, &v);
        if (ice_some_pair_slips(s)) ice_relieve_slip(s, &v);
    }
    ice_constrain_continued(s, g);
}

void ice_finish_increment(const ice *s, const ice_region *g)
{
    if (s->with_points) finish_beside_points(s, g);
    ice_fill_increment(s, g);
}

void ice_fill_increment(const ice *s, const ice_region *g)
{
    ice_fill_ghosts(s, C_PRESSURE_ADVANCED, g->number, FILL_CURRENT, GHOST_EVEN);
    ice_fill_ghosts(s, C_DP, g->number, FILL_CURRENT, GHOST_ZERO_OPEN);
}

void ice_find_increment(const ice *s, const ice_region *g)
{
    const bool diffuses = ice_diffuses(s), reacts = ice_reaction_count(s) > 0;
    ice_view v;
    for (int id = 0; g->n > 1 && ice_next_view(s, g, &id, &v);) ice_face_fractions(&v);
    if (g->n > 1 && s->cut) s->cut->bound_outflow(s, g);
    for (int id = 0; ice_next_view(s, g, &id, &v);) {
        ice_run_cells(&v, 0, increment_rows[v.dim - 1][v.multi]);
        if (reacts) ice_created_pressure(s, &v, v.P);
        for (int r = 0; r < v.n_materials && diffuses; ++r) ice_diffusion_pressure(s, &v, r, v.P);
    }
}

floe_status ice_pressure_increment_of(ice *s, const ice_region *g)
{
    ice_find_increment(s, g);
    ice_finish_increment(s, g);
    return FLOE_OK;
}
