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
#include "ice/ice_internal.h"
#include "ice/ice_slip.h"

#include "base/choice.h"

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
    const double dt = v->dt, length = v->length, viscous = 0.6 * (1.0 - v->limit_lo);
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
        carried = least(most(carried, -0.25 * stiffness), 0.25 * stiffness);
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
ice_row *const ice_increment_row[3][2] = ICE_TABLE(increment);

/* Lowers the factor of a cell to what keeps one array inside its neighbours' values at the corners of the cell. */
FLOE_ALWAYS_INLINE void lower_factor(const ice_view *v, const double *restrict x, ptrdiff_t base, ice_span near,
                                     const int dim)
{
    double *restrict limiter = v->limiter;
    const double lo = v->limit_lo;
    ptrdiff_t st[3];
    for (int a = 0; a < dim; ++a) st[a] = v->b->stride[a];
#pragma omp simd
    for (int i = near.first; i < near.end; ++i) {
        const ptrdiff_t at = base + i;
        double reach = 0.0, up = 0.0, down = 0.0;
        for (int a = 0; a < dim; ++a) {
            const double below = x[at - st[a]] - x[at], above = x[at + st[a]] - x[at];
            reach += 0.25 * fabs(above - below);
            up = most(up, most(below, above));
            down = most(down, most(-below, -above));
        }
        /* A difference of round-off limits nothing. */
        const double factor = reach > 1e-14 * fabs(x[at]) ? least(up, down) / (reach + ICE_TINY) : 1.0;
        limiter[at] = least(limiter[at], most(lo, factor));
    }
}

/* The common factor on the gradients of all volume fractions and partial densities (theory 2.11): the smallest of all
 * materials, so that the fractions of a slab add up to one, and where pure densities are uniform, the volumes too. */
FLOE_ALWAYS_INLINE void limiter_row(const ice_view *v, int j, int k, const int dim)
{
    const ptrdiff_t base = mesh_index(v->b, 0, j, k);
    for (int i = -1; i <= v->b->n[0]; ++i) v->limiter[base + i] = v->limit_hi;
    for (int r = 0; r < v->n_materials; ++r) {
        const ice_span near = ice_near(v, &v->m[r], j, k, 0, -1, v->b->n[0] + 1);
        lower_factor(v, v->m[r].theta, base, near, dim);
        if (v->m[r].ul[0]) lower_factor(v, v->m[r].rho, base, near, dim); /* not of materials carried by points */
    }
}

/* What theta at the faces of a row is made of: along the faces' normal, and along the axes beside it. */
typedef struct donors {
    const double *theta, *limiter, *velocity, *beside[2]; /* the last: of the cells */
    double courant, drift[2];                             /* of unit velocity; of the flow aside */
    ptrdiff_t step, aside[2];
} donors;

FLOE_ALWAYS_INLINE donors donors_of(const ice_view *v, const ice_arrays *m, int axis, const int dim)
{
    donors d = {.theta = m->theta,
                .limiter = v->limiter,
                .velocity = m->fu[axis],
                .courant = v->dt * v->inv_h[axis],
                .step = v->b->stride[axis]};
    for (int a = 0, n = 0; a < dim; ++a) {
        if (a == axis) continue;
        d.beside[n] = m->u[a];
        d.drift[n] = 0.25 * v->dt * v->inv_h[a];
        d.aside[n++] = v->b->stride[a];
    }
    return d;
}

/* theta of the donor slab at a face: its value at the slab's centroid, offset by the flow (theory 2.3). Both cells are read, one is taken. */
FLOE_ALWAYS_INLINE double donated(const donors *d, ptrdiff_t R, const int dim)
{
    const ptrdiff_t L = R - d->step;
    const double *theta = d->theta, w = d->velocity[R];
    const choice upwind = choice_of(w > 0.0);
    const double rise = chosen(upwind, theta[R] - theta[L - d->step], theta[R + d->step] - theta[L]);
    double offset = 0.5 * (chosen(upwind, 0.5, -0.5) - 0.5 * w * d->courant) * rise;
    for (int b = 0; b < dim - 1; ++b) {
        const ptrdiff_t st = d->aside[b];
        offset -= d->drift[b] * chosen(upwind, d->beside[b][L], d->beside[b][R]) *
                  chosen(upwind, theta[L + st] - theta[L - st], theta[R + st] - theta[R - st]);
    }
    const double value = chosen(upwind, theta[L], theta[R]) + chosen(upwind, d->limiter[L], d->limiter[R]) * offset;
    return value < 0.0 ? 0.0 : value > 1.0 ? 1.0 : value;
}

FLOE_ALWAYS_INLINE void theta_row(const ice_view *v, int r, int axis, int j, int k, const int dim)
{
    const ice_arrays *m = &v->m[r];
    const ptrdiff_t base = mesh_index(v->b, 0, j, k);
    double *restrict out = m->ft[axis], *restrict flux = v->flux[axis];
    const donors d = donors_of(v, m, axis, dim);
    const int n = v->b->n[0] + (axis == 0);
    const ice_span near = ice_near(v, m, j, k, axis == 0, 0, n);
    for (ptrdiff_t R = base; R < base + n; ++R) flux[R] = r == 0 ? 0.0 : flux[R];
    for (ptrdiff_t R = base; R < base + near.first; ++R) out[R] = 0.0;
    for (ptrdiff_t R = base + near.end; R < base + n; ++R) out[R] = 0.0;
#pragma omp simd
    for (ptrdiff_t R = base + near.first; R < base + near.end; ++R) {
        const double theta = donated(&d, R, dim);
        out[R] = theta;
        flux[R] += theta * d.velocity[R];
    }
}

#define THETA(d)                                                                      \
    FLOE_WIDE static void limiter_##d(const ice_view *v, int j, int k)                \
    {                                                                                 \
        limiter_row(v, j, k, d);                                                      \
    }                                                                                 \
    FLOE_WIDE static void theta_##d(const ice_view *v, int r, int axis, int j, int k) \
    {                                                                                 \
        theta_row(v, r, axis, j, k, d);                                               \
    }
THETA(1)
THETA(2)
THETA(3)
ice_row *const ice_limiter_row[3] = {limiter_1, limiter_2, limiter_3};
ice_material_row *const ice_face_theta_row[3] = {theta_1, theta_2, theta_3};

/* Volume fractions at faces and the volume flux that they make. */
void ice_face_fractions(const ice *s, const ice_view *v)
{
    const ice_rows cells = ice_rows_of(v->b, -1, 1);
#pragma omp parallel for schedule(static)
    for (int row = 0; row < cells.n; ++row) s->work->kernels.limiter(v, ice_row_j(cells, row), ice_row_k(cells, row));
    if (v->sharp) ice_flatten_interfaces(v);
    for (int axis = 0; axis < v->dim; ++axis) {
        const ice_rows q = ice_rows_of(v->b, axis, 0);
#pragma omp parallel for schedule(static)
        for (int row = 0; row < q.n; ++row)
            for (int r = 0; r < s->n_materials; ++r)
                s->work->kernels.face_theta(v, r, axis, ice_row_j(q, row), ice_row_k(q, row));
    }
    if (v->sharp) ice_sharpen_faces(v);
}

/* The volume that is missing or in excess is taken back at the rate beta (theory 5.5). */
static void relax_volume(const ice *s, const ice_view *v)
{
    const double beta = s->scene->method.volume_relaxation;
    const ice_rows q = ice_rows_of(v->b, -1, 0);
#pragma omp parallel for schedule(static)
    for (int row = 0; row < q.n; ++row) {
        const ptrdiff_t base = mesh_index(v->b, 0, ice_row_j(q, row), ice_row_k(q, row));
        for (ptrdiff_t at = base; at < base + v->b->n[0]; ++at) {
            if (!ice_holds_points(v, at)) continue;
            v->P[at] += 0.5 * (1.0 + v->shock[at]) * beta * (v->tmv[at] - 1.0) / v->kappa_sum[at];
        }
    }
}

void ice_finish_increment(const ice *s)
{
    for (int id = 0; id < s->mesh->n_blocks && s->with_points; ++id) {
        ice_view v;
        ice_view_make(s, id, &v);
        relax_volume(s, &v);
        if (s->work->pairs.slips) ice_relieve_slip(s, &v);
    }
    if (s->with_points) ice_constrain_continued(s);
    if (s->sealed) ice_merged_increment(s);
    ice_fill_ghosts(s, C_PRESSURE_ADVANCED, ice_instance(s), FILL_CURRENT, GHOST_EVEN);
    ice_fill_ghosts(s, C_DP, ice_instance(s), FILL_CURRENT, GHOST_ZERO_OPEN);
}

floe_status ice_pressure_increment(ice *s)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        ice_view v;
        ice_view_make(s, id, &v);
        if (s->multi) ice_face_fractions(s, &v);
        const ice_rows q = ice_rows_of(v.b, -1, 0);
#pragma omp parallel for schedule(static)
        for (int row = 0; row < q.n; ++row) s->work->kernels.increment(&v, ice_row_j(q, row), ice_row_k(q, row));
        if (s->work->reactions.n > 0) ice_created_pressure(s, &v, v.P);
        for (int r = 0; r < s->n_materials && s->diffuses; ++r) ice_diffusion_pressure(s, &v, r, v.P);
    }
    ice_finish_increment(s);
    return FLOE_OK;
}
