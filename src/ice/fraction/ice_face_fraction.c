/* Volume fractions at faces, from the donor slabs, and the volume flux that follows (theory 2.3). */
#include "ice/fraction/ice_fraction.h"

#include "base/choice.h"
#include "ice/ice_constants.h"

#include <math.h>

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
        const double factor = reach > ICE_ROUND_OFF * fabs(x[at]) ? least(up, down) / (reach + ICE_TINY) : 1.0;
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

FLOE_ALWAYS_INLINE donors fraction_donors(const ice_view *v, const ice_fluid *m, int axis, const int dim)
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
FLOE_ALWAYS_INLINE double donated_fraction(const donors *d, ptrdiff_t R, const int dim)
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
    const ice_fluid *m = &v->m[r];
    const ptrdiff_t base = mesh_index(v->b, 0, j, k);
    double *restrict out = m->ft[axis], *restrict flux = v->flux[axis];
    const donors d = fraction_donors(v, m, axis, dim);
    const int n = v->b->n[0] + (axis == 0);
    const ice_span near = ice_near(v, m, j, k, axis == 0, 0, n);
    for (ptrdiff_t R = base; R < base + n; ++R) flux[R] = r == 0 ? 0.0 : flux[R];
    for (ptrdiff_t R = base; R < base + near.first; ++R) out[R] = 0.0;
    for (ptrdiff_t R = base + near.end; R < base + n; ++R) out[R] = 0.0;
#pragma omp simd
    for (ptrdiff_t R = base + near.first; R < base + near.end; ++R) {
        const double theta = donated_fraction(&d, R, dim);
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
static ice_row *const limiter_rows[3] = {limiter_1, limiter_2, limiter_3};
static ice_material_row *const theta_rows[3] = {theta_1, theta_2, theta_3};

/* Volume fractions at faces and the volume flux that they make. */
void ice_face_fractions(const ice_view *v)
{
    ice_run_cells(v, 1, limiter_rows[v->dim - 1]);
    if (v->sharp) ice_flatten_interfaces(v);
    for (int axis = 0; axis < v->dim; ++axis) {
        const ice_rows q = ice_rows_of(v->b, axis, 0);
        ice_material_row *theta = theta_rows[v->dim - 1];
#pragma omp parallel for schedule(static)
        for (int row = 0; row < q.n; ++row)
            for (int r = 0; r < v->n_materials; ++r) theta(v, r, axis, ice_row_j(q, row), ice_row_k(q, row));
    }
    if (v->sharp) ice_sharpen_faces(v);
}
