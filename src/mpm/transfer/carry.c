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
#include "mpm/transfer/crowd.h"

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

typedef struct stretch {
    double *row[9]; /* C_p, by rows of the scene's axes */
    double least;   /* volume of a lump */
} stretch;

static void stretch_point(const mpm *s, const stretch *now, size_t k, bool crowded)
{
    const int dim = s->mesh->dim;
    double C[9] = {0.0}, growth = 0.0;
    for (int a = 0; a < dim; ++a) {
        for (int b = 0; b < dim; ++b) C[3 * a + b] = now->row[dim * a + b][k];
        growth += C[4 * a];
    }
    if (crowded && growth < 0.0) return;
    stretch_gradient(s->mesh, s->dt, now->least, C);
    for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b) now->row[dim * a + b][k] = C[3 * a + b];
}

/* Where an axis is free of stress a body may be crushed as far as it thickens: its points then fold over each other within a cell, which is no even motion
 * either. The kinetic energy that a point carries goes with C^2 and the cell, however little of the cell the points still fill, and would grow
 * in every step. */
static void stretch_tile(const mpm *s, int body, int blk, int tile, const stretch *now)
{
    const bool thickens = s->scene->stress_state != STRESS_FULL;
    const size_t *start = s->points[blk][body].tile_start;
    bool crowded[SOLID_CHUNK] = {false};
    for (size_t k = start[tile]; k < start[tile + 1]; k += SOLID_CHUNK) {
        const size_t range[2] = {k, k + SOLID_CHUNK < start[tile + 1] ? k + SOLID_CHUNK : start[tile + 1]};
        if (thickens) find_crowded(s, body, blk, tile, range, crowded);
        for (size_t i = k; i < range[1]; ++i) stretch_point(s, now, i, crowded[i - k]);
    }
}

static void stretch_body(const mpm *s, int blk, int body)
{
    stretch now = {.least = least_volume(&s->body[body])};
    const int dim = s->mesh->dim;
    for (int c = 0; c < 9; ++c) now.row[c] = field_next(s->domain->fields[blk], P_AFFINE, body, c < dim * dim ? c : 0);
#pragma omp parallel for schedule(dynamic, 4)
    for (int t = 0; t < s->mesh->block[blk].n_tiles; ++t) stretch_tile(s, body, blk, t, &now);
}

floe_status mpm_stretch_gradients(mpm *s)
{
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int body = 0; body < s->n_bodies; ++body)
            if (fields_has(s->domain->fields[b], P_AFFINE, body)) stretch_body(s, b, body);
    return FLOE_OK;
}
