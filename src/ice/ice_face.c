/* Face velocities: theory 2.2 with the centring of 2.5; Guilkey et al. 2003, step 3.
 *
 *     u* = [rho_L (u + A)_L + rho_R (u + A)_R] / (rho_L + rho_R) - phi dt v (p_R - p_L)/h + phi dt g
 *        + (1 - s)/8 (u_L + u_R - u_LL - u_RR)
 *
 * with v = 2 theta_f / (rho_L + rho_R), which holds hydrostatic columns exactly (2.4), also of locked materials. A is the
 * advective half step -dt/2 (u . grad) u, without which velocities of flows with |u| ~ c are first order in time; the last
 * term gives the mean the accuracy of a linear reconstruction from both sides. Both vanish at shocks (s = 1). */
#include "ice/ice_internal.h"

#include <math.h>

/* Share of a strong fan at a face: nothing below an expansion of 1 % of the speed of sound a cell, all from 11 % on. There the last term counts up to
 * 2.5 times, twice beside other fluids, once if nothing is limited: the mean then makes up for the dispersion of the step. Sound would grow by it (det G = 1 + 2 lambda^2 s^4
 * (n - 1 - n s^2), n the times, s the sine of half the wave's angle a cell); a fan draws waves out, and is soon too weak. */
FLOE_ALWAYS_INLINE double fan(double stretch, double both)
{
    const double from = 0.005, slope = 20.0, share = slope * (stretch / both - from);
    return least(most(share, 0.0), 1.0);
}

FLOE_ALWAYS_INLINE void face_velocity_row(const ice_view *v, int r, int axis, int j, int k, const int dim,
                                          const bool multi)
{
    const ice_arrays *m = &v->m[r];
    const ptrdiff_t base = mesh_index(v->b, 0, j, k), n = v->b->n[0] + (axis == 0), step = v->b->stride[axis];
    const double *restrict u[3] = {m->u[0], m->u[1], m->u[2]}, *restrict w = m->u[axis];
    const double *restrict rho = m->rho, *restrict p = v->p, *restrict shock = v->shock, *restrict theta = m->theta,
                           *restrict c = m->c;
    double *restrict face = m->fu[axis];
    const double pressure_impulse = v->dt * v->inv_h[axis], gravity_impulse = v->dt * v->gravity[axis],
                 sharpen = 0.125 * v->limit_hi, drawn = (multi ? 1.0 : 1.5) * (1.0 - v->limit_lo);
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
        face[R] = (mean - phi * pressure_impulse * fractions * (p[R] - p[L])) * inverse + here * phi * gravity_impulse +
                  here * sharpen * smooth * (1.0 + drawn * fan(w[R] - w[L], c[L] + c[R])) *
                      (w[L] + w[R] - w[L - step] - w[R + step]);
    }
}

#define INSTANCE(d, m)                                                                              \
    FLOE_WIDE static void face_velocity_##d##_##m(const ice_view *v, int r, int axis, int j, int k) \
    {                                                                                               \
        face_velocity_row(v, r, axis, j, k, d, m);                                                  \
    }
ICE_EACH(INSTANCE)
ice_material_row *const ice_face_velocity_row[3][2] = ICE_TABLE(face_velocity);

/* Momentum exchange at one face, normal component, with face masses mu = (rho_L + rho_R)/2 (theory 2.2). */
static void exchange_face(const ice *s, const ice_view *v, int axis, double *const *value, ptrdiff_t R)
{
    const ptrdiff_t L = R - v->b->stride[axis];
    const int n = v->n_materials;
    double mass[EXCHANGE_MAX], theta[EXCHANGE_MAX], u[1][EXCHANGE_MAX];
    int present = 0;
    for (int r = 0; r < n; ++r) {
        const ice_arrays *m = &v->m[r];
        theta[r] = 0.5 * (m->theta[L] + m->theta[R]);
        mass[r] = theta[r] > 0.0 ? 0.5 * (m->rho[L] + m->rho[R]) : 0.0;
        u[0][r] = value[r][R];
        present += mass[r] > 0.0;
    }
    if (present < 2) return;
    exchange_matrix a;
    exchange_couple(n, s->work->pairs.table[ICE_NORMAL], theta, v->dt, a);
    if (s->work->pairs.unlike)
        exchange_relax_parts(n, mass, theta, a, 1, u);
    else
        exchange_relax(n, mass, a, 1, u);
    for (int r = 0; r < n; ++r) value[r][R] = u[0][r];
}

/* The same where the scene has two materials. */
static void exchange_pairs(const ice *s, const ice_view *v, int axis, double *const *value, ptrdiff_t from,
                           ptrdiff_t to)
{
    const ice_arrays *m = v->m;
    const ptrdiff_t step = v->b->stride[axis];
    const double rate = 0.25 * v->dt * s->exchange.K[0][1];
    for (ptrdiff_t R = from; R < to; ++R) {
        const double t0 = m[0].theta[R - step] + m[0].theta[R], t1 = m[1].theta[R - step] + m[1].theta[R];
        const double m0 = 0.5 * (m[0].rho[R - step] + m[0].rho[R]), m1 = 0.5 * (m[1].rho[R - step] + m[1].rho[R]);
        if (t0 > 0.0 && t1 > 0.0) exchange_relax_pair(m0, m1, rate * t0 * t1, &value[0][R], &value[1][R]);
    }
}

void ice_exchange_faces(const ice *s, const ice_view *v, int axis, double *const *value)
{
    const ice_rows q = ice_rows_of(v->b, axis, 0);
    const bool plain = s->work->pairs.plain;
    void (*const exchange_one)(const ice *, const ice_view *, int, double *const *, ptrdiff_t) =
        plain ? exchange_face : ice_exchange_face;
#pragma omp parallel for schedule(static)
    for (int row = 0; row < q.n; ++row) {
        const ptrdiff_t base = mesh_index(v->b, 0, ice_row_j(q, row), ice_row_k(q, row));
        const ptrdiff_t end = base + v->b->n[0] + (axis == 0);
        if (plain && s->n_materials == 2) {
            exchange_pairs(s, v, axis, value, base, end);
            continue;
        }
        for (ptrdiff_t R = base; R < end; ++R) exchange_one(s, v, axis, value, R);
    }
}

static void velocity_rows(const ice *s, const ice_view *v, int r, int axis)
{
    const ice_rows q = ice_rows_of(v->b, axis, 0);
    ice_material_row *row_kernel = s->work->kernels.face_velocity;
#pragma omp parallel for schedule(static)
    for (int row = 0; row < q.n; ++row) row_kernel(v, r, axis, ice_row_j(q, row), ice_row_k(q, row));
}

static void sensor_rows(const ice *s, const ice_view *v)
{
    const ice_rows q = ice_rows_of(v->b, -1, 0);
#pragma omp parallel for schedule(static)
    for (int row = 0; row < q.n; ++row) {
        s->work->kernels.sensor(v, ice_row_j(q, row), ice_row_k(q, row));
        if (v->contact) s->work->kernels.contact(v, ice_row_j(q, row), ice_row_k(q, row));
    }
}

floe_status ice_face_velocity(ice *s)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        ice_view v;
        ice_view_make(s, id, &v);
        sensor_rows(s, &v);
    }
    if (s->sealed) ice_merged_centring(s);
    ice_fill_ghosts(s, C_SHOCK, ice_instance(s), FILL_CURRENT, GHOST_EVEN);
    if (ice_sharpens(s)) ice_fill_ghosts(s, C_CONTACT, 0, FILL_CURRENT, GHOST_EVEN);
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        ice_view v;
        ice_view_make(s, id, &v);
        for (int axis = 0; axis < v.dim; ++axis) {
            double *velocity[ICE_MAX_MATERIALS];
            for (int r = 0; r < v.n_materials; ++r) {
                velocity_rows(s, &v, r, axis);
                if (s->material[r].points) ice_stress_face_velocity(s, &v, r, axis);
                if (s->diffuses) ice_diffusion_face_velocity(s, &v, r, axis);
                velocity[r] = v.m[r].fu[axis];
            }
            if (s->multi) ice_exchange_faces(s, &v, axis, velocity);
        }
        for (int r = 0; r < v.n_materials; ++r) ice_boundary_face_velocity(s, &v, r);
    }
    for (int r = 0; s->multi && r < s->n_materials; ++r) ice_fill_faces(s, F_VEL, r);
    return FLOE_OK;
}

/* P* = (P_L/rho_L + P_R/rho_R) / (1/rho_L + 1/rho_R) (theory 2.4; Guilkey et al. 2003, step 6). */
FLOE_WIDE static void face_pressure_row(const ice_view *v, int axis, int j, int k)
{
    const ptrdiff_t base = mesh_index(v->b, 0, j, k), n = v->b->n[0] + (axis == 0), step = v->b->stride[axis];
    const double *restrict P = v->P, *restrict rho = v->rho_sum;
    double *restrict face = v->fp[axis];
#pragma omp simd
    for (ptrdiff_t i = 0; i < n; ++i) {
        const ptrdiff_t R = base + i, L = R - step;
        /* P_L plus a part of the difference: exact where P is uniform */
        face[R] = P[L] + rho[L] / (rho[L] + rho[R]) * (P[R] - P[L]);
    }
}

floe_status ice_face_pressure(ice *s)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        ice_view v;
        ice_view_make(s, id, &v);
        for (int axis = 0; axis < v.dim; ++axis) {
            const ice_rows q = ice_rows_of(v.b, axis, 0);
#pragma omp parallel for schedule(static)
            for (int row = 0; row < q.n; ++row) face_pressure_row(&v, axis, ice_row_j(q, row), ice_row_k(q, row));
        }
        ice_boundary_face_pressure(s, &v);
    }
    return FLOE_OK;
}
