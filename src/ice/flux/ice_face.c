/* Face velocities: theory 2.2 with the centring of 2.5; Guilkey et al. 2003, step 3.
 *
 *     u* = [rho_L (u + A)_L + rho_R (u + A)_R] / (rho_L + rho_R) - phi dt v (p_R - p_L)/h + phi dt g
 *        + (1 - s)/8 (u_L + u_R - u_LL - u_RR)
 *
 * with v = 2 theta_f / (rho_L + rho_R), which holds hydrostatic columns exactly (2.4), also of locked materials. A is the
 * advective half step -dt/2 (u . grad) u, without which velocities of flows with |u| ~ c are first order in time; the last
 * term gives the mean the accuracy of a linear reconstruction from both sides. Both vanish at shocks (s = 1). */
#include "ice/flux/ice_flux.h"

#include "ice/exchange/ice_exchange.h"
#include "ice/ice_constants.h"
#include "ice/points/ice_points.h"
#include "ice/shock/ice_shock.h"
#include "ice/sides/ice_sides.h"
#include "ice/source/ice_source.h"
#include "ice/state/ice_lean.h"
#include "ice/state/ice_materials.h"
#include "ice/state/ice_traced.h"
#include "ice/trace/ice_trace.h"

#include <math.h>

/* Share of a strong fan at a face: nothing below an expansion of 1 % of the speed of sound a cell, all from 11 % on. There the last term counts up to
 * 2.5 times, twice beside other fluids, once if nothing is limited: the mean then makes up for the dispersion of the step. Sound would grow by it (det G = 1 + 2 lambda^2 s^4
 * (n - 1 - n s^2), n the times, s the sine of half the wave's angle a cell); a fan draws waves out, and is soon too weak. */
FLOE_ALWAYS_INLINE double fan_share(double stretch, double both)
{
    const double share = ICE_FAN_STEEPNESS * (stretch / both - ICE_FAN_FOOT);
    return least(most(share, 0.0), 1.0);
}

FLOE_ALWAYS_INLINE void face_velocity_row(const ice_view *v, int r, int axis, int j, int k, const int dim,
                                          const bool multi, const bool uneven)
{
    const ice_fluid *m = &v->m[r];
    const ptrdiff_t base = mesh_index(v->b, 0, j, k), n = v->b->n[0] + (axis == 0), step = v->b->stride[axis];
    const double *restrict u[3] = {m->u[0], m->u[1], m->u[2]}, *restrict w = m->u[axis];
    const double *restrict rho = m->rho, *restrict p = v->p, *restrict shock = v->shock, *restrict theta = m->theta,
                           *restrict c = m->c;
    double *restrict face = m->fu[axis];
    const double pressure_impulse = v->dt * v->inv_h[axis], gravity_impulse = v->dt * v->gravity[axis],
                 sharpen = 0.125 * v->limit_hi,
                 drawn = (multi ? ICE_FAN_BESIDE_OTHERS : ICE_FAN_ALONE) * (1.0 - v->limit_lo);
    const double *restrict all = multi ? v->rho_sum : m->rho, *restrict open = v->m[0].open;
    double quarter[3];
    ptrdiff_t st[3];
    for (int a = 0; a < dim; ++a) {
        quarter[a] = -0.25 * v->dt * v->inv_h[a] * v->limit_hi * v->advance;
        st[a] = v->b->stride[a];
    }
    const ice_span near = multi ? ice_near(v, m, j, k, axis == 0, 0, (int)n) : (ice_span){0, (int)n};
    for (ptrdiff_t i = 0; i < near.first; ++i) face[base + i] = 0.0;
    for (ptrdiff_t i = near.end; i < n; ++i) face[base + i] = 0.0;
#pragma omp simd
    for (ptrdiff_t i = near.first; i < near.end; ++i) {
        const ptrdiff_t R = base + i, L = R - step;
        const double sum = rho[L] + rho[R], inverse = 1.0 / (multi ? sum + ICE_TINY : sum);
        double left = 0.0, right = 0.0;
        for (int a = 0; a < dim; ++a) {
            left += quarter[a] * u[a][L] * (w[L + st[a]] - w[L - st[a]]);
            right += quarter[a] * u[a][R] * (w[R + st[a]] - w[R - st[a]]);
        }
        const double phi = 0.5 + 0.25 * (shock[L] + shock[R]),
                     smooth = 1.0 - (shock[L] > shock[R] ? shock[L] : shock[R]);
        const double mean = rho[L] * (w[L] + (1.0 - shock[L]) * left) + rho[R] * (w[R] + (1.0 - shock[R]) * right);
        const double fractions = multi ? theta[L] + theta[R] : 2.0;
        const double here = multi ? sum * inverse : 1.0; /* what is absent has no velocity of its own */
        const double weight = uneven ? ice_weight_on_face(all, open, R, step) : 1.0;
        face[R] = (mean - phi * pressure_impulse * fractions * (p[R] - p[L])) * inverse +
                  here * phi * gravity_impulse * weight +
                  here * sharpen * smooth * (1.0 + drawn * fan_share(w[R] - w[L], c[L] + c[R])) *
                      (w[L] + w[R] - w[L - step] - w[R + step]);
    }
}

#define INSTANCE(d, m)                                                                              \
    FLOE_WIDE static void face_velocity_##d##_##m(const ice_view *v, int r, int axis, int j, int k) \
    {                                                                                               \
        if (m && ice_weight_is_uneven(v, axis))                                                     \
            face_velocity_row(v, r, axis, j, k, d, m, true);                                        \
        else                                                                                        \
            face_velocity_row(v, r, axis, j, k, d, m, false);                                       \
    }
ICE_EACH(INSTANCE)
static ice_material_row *const face_velocity_rows[3][2] = ICE_TABLE(face_velocity);

void ice_find_cell_sensors(const ice *s, const ice_region *g)
{
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);) ice_find_sensors(&v);
}

static void find_axis_velocity(const ice *s, const ice_view *v, int axis)
{
    const bool diffuses = ice_diffusion_moves_faces(s);
    double *velocity[ICE_MAX_MATERIALS];
    for (int r = 0; r < v->n_materials; ++r) {
        ice_run_faces(v, r, axis, face_velocity_rows[v->dim - 1][v->multi]);
        if (v->material[r].points) ice_stress_face_velocity(s, v, r, axis);
        if (diffuses) ice_diffusion_face_velocity(s, v, r, axis);
        velocity[r] = v->m[r].fu[axis];
    }
    if (v->multi) ice_exchange_faces(s, v, axis, velocity);
}

void ice_find_face_velocity(const ice *s, const ice_region *g)
{
    ice_fill_ghosts(s, C_SHOCK, g->number, FILL_CURRENT, GHOST_EVEN);
    if (ice_sharpens_contacts(s)) ice_fill_ghosts(s, C_CONTACT, g->number, FILL_CURRENT, GHOST_EVEN);
    const bool traced = ice_is_traced(s, g), centred = !traced || ice_traces_in_part(s);
    ice_view v;
    for (int id = 0; centred && ice_next_view(s, g, &id, &v);)
        for (int axis = 0; axis < v.dim; ++axis) find_axis_velocity(s, &v, axis);
    if (traced) ice_trace_faces(s, g);
    for (int id = 0; ice_next_view(s, g, &id, &v);) {
        for (int r = 0; r < v.n_materials; ++r) ice_boundary_face_velocity(s, &v, r);
        if (v.traced) ice_trace_follow(s, &v);
    }
    for (int r = g->first; g->n > 1 && r < g->first + g->n; ++r) ice_fill_faces(s, F_VEL, r);
}

floe_status ice_face_velocity_of(ice *s, const ice_region *g)
{
    ice_find_cell_sensors(s, g);
    ice_find_face_velocity(s, g);
    return FLOE_OK;
}

/* P* = (P_L/rho_L + P_R/rho_R) / (1/rho_L + 1/rho_R) (theory 2.4; Guilkey et al. 2003, step 6). */
FLOE_ALWAYS_INLINE void mean_pressure_row(const ice_view *v, int axis, int j, int k, const bool uneven)
{
    const ptrdiff_t base = mesh_index(v->b, 0, j, k), n = v->b->n[0] + (axis == 0), step = v->b->stride[axis];
    const double *restrict P = v->P, *restrict rho = v->rho_sum;
    double *restrict face = v->fp[axis];
    const double *alone = v->traced ? v->alone : NULL;
    const double weight = v->gravity[axis] * v->h[axis], *restrict open = v->m[0].open;
#pragma omp simd
    for (ptrdiff_t i = 0; i < n; ++i) {
        const ptrdiff_t R = base + i, L = R - step;
        const double found = face[R];
        /* P_L plus a part of the difference: exact where P is uniform */
        const double share = rho[L] / (rho[L] + rho[R]), even = P[L] + share * (P[R] - P[L]);
        /* at rest P_L and the weight of the upper half of the lower cell */
        const double centred = !uneven ? even
                                       : even - weight * ((1.0 - share) * ice_lean_open(rho, open, L, step) +
                                                          share * ice_lean_open(rho, open, R, step));
        face[R] = alone && alone[R] > 0.0 && alone[L] > 0.0 ? found : centred;
    }
}

FLOE_WIDE static void face_pressure_row(const ice_view *v, int r, int axis, int j, int k)
{
    (void)r;
    if (ice_weight_is_uneven(v, axis))
        mean_pressure_row(v, axis, j, k, true);
    else
        mean_pressure_row(v, axis, j, k, false);
}

floe_status ice_face_pressure_of(ice *s, const ice_region *g)
{
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);) {
        for (int axis = 0; axis < v.dim && !(v.traced && !v.alone); ++axis)
            ice_run_faces(&v, 0, axis, face_pressure_row);
        ice_boundary_face_pressure(s, &v);
    }
    return FLOE_OK;
}
