/* C_p of transfers that have one (transfer.h) belongs to the positions at the start of the step. The points move with that velocity field;
 * where they separate at the rate D, its symmetric part, the gradient of the velocity about them is D F^-1 afterwards, F = 1 + dt D: a
 * linear motion stays linear. With C unchanged, the ends of a body that grows n times would be wrong by a part n of a cell's motion,
 * whatever the step.
 *
 * The skew part does not change: rotation is maintained by forces, which the nodes have applied, and it has the moment of momentum. For the
 * same reason the change has no moment where cells are not square (second moments of splines are proportional to the squares of the sides). */
#include "mpm/transfer/carry.h"

#include "base/threads.h"
#include "math/tensor.h"
#include "mpm/mpm_constants.h"

/* Takes the part that has a moment out of a change. */
static void take_moment_out(const mesh *m, double change[9])
{
    for (int a = 0; a < m->dim; ++a)
        for (int b = 0; b < a; ++b) {
            const double ha = m->h[a] * m->h[a], hb = m->h[b] * m->h[b];
            const double mean = 0.5 * (change[3 * a + b] * hb + change[3 * b + a] * ha);
            change[3 * a + b] = mean / hb;
            change[3 * b + a] = mean / ha;
        }
}

/* C -= dt D F^-1 D, where more than `least` of a lump is left. */
static void stretch_gradient(const mesh *m, double dt, double least, double C[9])
{
    double D[9], F[9], inverse[9], slower[9], change[9];
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) {
            D[3 * a + b] = 0.5 * (C[3 * a + b] + C[3 * b + a]);
            F[3 * a + b] = dt * D[3 * a + b] + (a == b ? 1.0 : 0.0);
        }
    if (!(tensor_inverse(F, inverse) >= least)) return;
    tensor_multiply(inverse, D, slower);
    tensor_multiply(D, slower, change);
    take_moment_out(m, change);
    tensor_add_scaled(-dt, change, C);
}

/* A membrane that is crushed folds, and its points pass each other: that is no even motion, and would be fed in every step (bags of gas
 * thrown at a wall had a thousand times their energy). */
static double least_volume(const mpm_body *b)
{
    return b->membrane.model ? 1.0 : MPM_LEAST_LUMP_VOLUME;
}

static void stretch_body(const mpm *s, int blk, int body)
{
    const double least = least_volume(&s->body[body]);
    const fields *f = s->domain->fields[blk];
    const int dim = s->mesh->dim;
    double *row[9];
    for (int c = 0; c < 9; ++c) row[c] = field_next(f, P_AFFINE, body, c < dim * dim ? c : 0);
    const ptrdiff_t n = (ptrdiff_t)s->points[blk][body].n;
#pragma omp parallel for schedule(static)
    for (ptrdiff_t k = 0; k < n; ++k) {
        double C[9] = {0.0};
        for (int a = 0; a < dim; ++a)
            for (int b = 0; b < dim; ++b) C[3 * a + b] = row[dim * a + b][k];
        stretch_gradient(s->mesh, s->dt, least, C);
        for (int a = 0; a < dim; ++a)
            for (int b = 0; b < dim; ++b) row[dim * a + b][k] = C[3 * a + b];
    }
}

floe_status mpm_stretch_gradients(mpm *s)
{
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int body = 0; body < s->n_bodies; ++body)
            if (fields_has(s->domain->fields[b], P_AFFINE, body)) stretch_body(s, b, body);
    return FLOE_OK;
}
