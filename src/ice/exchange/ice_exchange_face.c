/* Exchange of momentum at faces (theory 2.2). */
#include "ice/exchange/ice_pairs.h"

#include "ice/ice_constants.h"
#include "ice/points/ice_points.h"

/* Momentum exchange at one face, normal component, with face masses mu = (rho_L + rho_R)/2 (theory 2.2). */
static void exchange_plain_face(const ice *s, const ice_view *v, int axis, double *const *value, ptrdiff_t R)
{
    const ptrdiff_t L = R - v->b->stride[axis];
    const int n = v->n_materials;
    double mass[EXCHANGE_MAX], theta[EXCHANGE_MAX], u[1][EXCHANGE_MAX];
    int present = 0;
    for (int r = 0; r < n; ++r) {
        const ice_fluid *m = &v->m[r];
        theta[r] = 0.5 * (m->theta[L] + m->theta[R]);
        mass[r] = theta[r] > 0.0 ? 0.5 * (m->rho[L] + m->rho[R]) : 0.0;
        u[0][r] = value[r][R];
        present += mass[r] > 0.0;
    }
    if (present < 2) return;
    exchange_matrix a;
    exchange_couple(n, ice_constants_of(s, v, ICE_NORMAL), theta, v->dt, a);
    if (s->pairs->unlike)
        exchange_relax_parts(n, mass, theta, a, 1, u);
    else
        exchange_relax(n, mass, a, 1, u);
    for (int r = 0; r < n; ++r) value[r][R] = u[0][r];
}

/* The same where the region has two materials. */
static void exchange_pairs(const ice *s, const ice_view *v, int axis, double *const *value, ptrdiff_t from,
                           ptrdiff_t to)
{
    const ice_fluid *m = v->m;
    const ptrdiff_t step = v->b->stride[axis];
    const double rate = 0.25 * v->dt * ice_constants_of(s, v, ICE_NORMAL)[0][1];
    for (ptrdiff_t R = from; R < to; ++R) {
        const double t0 = m[0].theta[R - step] + m[0].theta[R], t1 = m[1].theta[R - step] + m[1].theta[R];
        const double m0 = 0.5 * (m[0].rho[R - step] + m[0].rho[R]), m1 = 0.5 * (m[1].rho[R - step] + m[1].rho[R]);
        if (t0 > 0.0 && t1 > 0.0) exchange_relax_pair(m0, m1, rate * t0 * t1, &value[0][R], &value[1][R]);
    }
}

/* The velocity before exchange at a face: u* along its axis; across it the mean of both sides, with the kick of the pressure, so
 * that the whole vector is of one time and a kick along an oblique normal stays along it. */
static void face_vector(const ice *s, const ice_view *v, int r, int axis, ptrdiff_t R, double u[3][EXCHANGE_MAX])
{
    const ice_fluid *m = &v->m[r];
    const ptrdiff_t L = R - v->b->stride[axis];
    const double sum = m->rho[L] + m->rho[R], inverse = 1.0 / (sum + ICE_TINY);
    const double phi = 0.5 + 0.25 * (v->shock[L] + v->shock[R]), fractions = m->theta[L] + m->theta[R];
    for (int a = 0; a < v->dim; ++a) {
        if (a == axis) {
            u[a][r] = m->fu[a][R];
            continue;
        }
        const ptrdiff_t st = v->b->stride[a];
        const double rise = 0.25 * (v->p[L + st] - v->p[L - st] + v->p[R + st] - v->p[R - st]);
        const double mean =
            sum > 0.0 ? (m->rho[L] * m->u[a][L] + m->rho[R] * m->u[a][R]) * inverse : 0.5 * (m->u[a][L] + m->u[a][R]);
        u[a][r] = mean + phi * v->dt * (v->gravity[a] - rise * v->inv_h[a] * fractions * inverse);
        if (v->material[r].points) u[a][r] += ice_stress_kick(s, v, r, axis, a, R);
    }
}

/* The velocity of bodies with a prescribed motion, which nothing kicks. */
static void prescribed_vector(const ice_view *v, int r, ptrdiff_t step, ptrdiff_t R, double u[3][EXCHANGE_MAX])
{
    const ice_fluid *m = &v->m[r];
    const ptrdiff_t L = R - step;
    const double sum = m->rho[L] + m->rho[R];
    for (int a = 0; a < v->dim; ++a)
        u[a][r] = sum > 0.0 ? (m->rho[L] * m->u[a][L] + m->rho[R] * m->u[a][R]) / sum : 0.0;
}

/* Momentum exchange at one face where coefficients depend on the state or pairs slip, of value[r][R]: u*, or what the pressure adds
 * to it along the axis (the mobility of the implicit pressure). */
static void exchange_named_face(const ice *s, const ice_view *v, int axis, double *const *value, ptrdiff_t R)
{
    const ptrdiff_t L = R - v->b->stride[axis];
    double mass[EXCHANGE_MAX], u[3][EXCHANGE_MAX] = {{0.0}}, gradient[3], other[3];
    ice_spot spot;
    int present = 0;
    const bool velocity = value[0] == v->m[0].fu[axis];
    for (int r = 0; r < v->n_materials; ++r) present += v->m[r].rho[L] + v->m[r].rho[R] > 0.0;
    if (present < 2) return;
    present = 0;
    for (int r = 0; r < v->n_materials; ++r) {
        const ice_fluid *m = &v->m[r];
        spot.theta[r] = 0.5 * (m->theta[L] + m->theta[R]);
        spot.density[r] = 2.0 / (m->v[L] + m->v[R]);
        spot.sound[r] = 0.5 * (m->c[L] + m->c[R]);
        mass[r] = ice_inertia(v, r, spot.theta[r] > 0.0 ? 0.5 * (m->rho[L] + m->rho[R]) : 0.0);
        present += mass[r] > 0.0;
        if (v->material[r].prescribed)
            prescribed_vector(v, r, R - L, R, spot.u);
        else
            face_vector(s, v, r, axis, R, spot.u);
        for (int a = 0; a < v->dim && velocity; ++a) u[a][r] = spot.u[a][r];
        u[axis][r] = v->material[r].prescribed ? u[axis][r] : value[r][R];
    }
    if (present < 2) return;
    const bool slips = s->pairs->slips;
    if (slips) {
        ice_wall_gradient(v, L, gradient);
        ice_wall_gradient(v, R, other);
        for (int a = 0; a < 3; ++a) gradient[a] = 0.5 * (gradient[a] + other[a]);
        ice_pressure_slope(v, L, spot.slope);
        ice_pressure_slope(v, R, other);
        for (int a = 0; a < 3; ++a) spot.slope[a] = 0.5 * (spot.slope[a] + other[a]);
    }
    ice_relax_spot(s, v, mass, &spot, v->dt, slips ? gradient : NULL, u);
    for (int r = 0; r < v->n_materials; ++r) value[r][R] = u[axis][r];
}

void ice_exchange_faces(const ice *s, const ice_view *v, int axis, double *const *value)
{
    const ice_rows q = ice_rows_of(v->b, axis, 0);
    const bool plain = s->pairs->plain;
    void (*const exchange_one)(const ice *, const ice_view *, int, double *const *, ptrdiff_t) =
        plain ? exchange_plain_face : exchange_named_face;
#pragma omp parallel for schedule(static)
    for (int row = 0; row < q.n; ++row) {
        const ptrdiff_t base = ice_row_start(v->b, q, row);
        const ptrdiff_t end = base + v->b->n[0] + (axis == 0);
        if (plain && v->n_materials == 2) {
            exchange_pairs(s, v, axis, value, base, end);
            continue;
        }
        for (ptrdiff_t R = base; R < end; ++R) exchange_one(s, v, axis, value, R);
    }
}
