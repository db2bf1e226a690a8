/* Velocities less what points would smooth: the transfer of affine FMPM (Nairn and Hammerquist 2021, with points that carry the moments of
 * the velocity about them, Jiang et al. 2015).
 *
 * Points that take a velocity v of the nodes, and its moments, and return both to the nodes, return P v. P preserves uniform and rotating
 * motion, momentum and moment of momentum; of shorter waves 1 - lambda is lost in every step, lambda an eigenvalue of P between 0 and 1.
 * The points therefore take
 *
 *     v* = v + r_1 + ... + r_(k-1),   r_0 = v,   r_j = r_(j-1) - P r_(j-1),
 *
 * of which (1 - lambda)^k is lost, and move and strain with that one velocity: positions and deformation are consistent. Unless the deck
 * gives k, the terms have weights of their own (restored_shares): four of them lose no more than six equal ones. No r_j has momentum
 * or moment of momentum. Walls and supports prescribe v, so that r vanishes there; of bodies in contact r has no part that separates
 * them. */
#include "base/memory.h"
#include "grid/tile_box.h"
#include "mpm/contact/contact.h"
#include "mpm/edge/edge.h"
#include "mpm/motion/motion.h"
#include "mpm/nodes/ghosts.h"
#include "mpm/nodes/light_nodes.h"
#include "mpm/nodes/supports.h"
#include "mpm/nodes/wall.h"
#include "mpm/transfer/kernels.h"
#include "mpm/transfer/lanes.h"
#include "mpm/transfer/point_arrays.h"
#include "mpm/transfer/windows.h"

#include <string.h>

static void load_residuals(const mpm *s, int blk, int group, const tile_box *t, double *window)
{
    const double *node[MPM_MAX_RECORD];
    for (int c = 0; c < MPM_MAX_RECORD; ++c)
        node[c] = field_get(s->domain->fields[blk], N_RESIDUAL, group, c < s->mesh->dim ? c : 0); /* padding */
    load_window(s, blk, t, node, lanes_of(s->mesh->dim), window);
}

/* One tile's private sums of the momenta that its points return. */
static void project_tile(mpm *s, int group, int blk, int tile)
{
    _Alignas(MEMORY_ALIGNMENT) double window[MPM_MAX_WINDOW * 4];
    const tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    double *out = domain_tile(s->domain, box.number);
    bool any = false;
    for (int body = 0; body < s->n_bodies; ++body) {
        const size_t *start = s->points[blk][body].tile_start;
        if (s->body[body].group != group || start[tile] == start[tile + 1]) continue;
        if (!any) {
            load_residuals(s, blk, group, &box, window);
            memset(out, 0, (size_t)(s->windows->window_nodes * lanes_of(s->mesh->dim)) * sizeof *out);
        }
        any = true;
        const point_arrays p = points_of(s, blk, body, false, false);
        s->windows->kernel->project(s->mesh, &box, &p, start[tile], start[tile + 1], window, out);
    }
    s->windows->active[box.number] = any;
}

void project_residuals(mpm *s, int group, bool velocities)
{
    const mesh *m = s->mesh;
    visit_tiles(s, group, project_tile);
    domain_share_partials(s->domain);
    for (int b = 0; b < m->n_blocks; ++b) {
        node_target out = {.components = lanes_of(m->dim), .reach = s->windows->reach};
        memcpy(out.window, s->windows->window, sizeof out.window);
        for (int a = 0; a < m->dim; ++a) out.array[a] = field_get(s->domain->fields[b], N_MOMENTUM, group, a);
        gather_nodes(s, b, &out);
    }
    domain_fold_periodic(s->domain, N_MOMENTUM, group);
    if (s->windows->reach > 0) fold_field(s, group, N_MOMENTUM);
    fold_supported_residuals(s, group, velocities);
}

/* r -= P r. */
static void subtract_projection(mpm *s, int group)
{
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        const fields *f = s->domain->fields[b];
        const double *restrict mass = field_get(f, N_MASS, group, 0);
        const size_t n = s->mesh->block[b].size;
        for (int c = 0; c < s->mesh->dim; ++c) {
            const double *restrict momentum = field_get(f, N_MOMENTUM, group, c);
            double *restrict r = field_get(f, N_RESIDUAL, group, c);
#pragma omp parallel for simd schedule(static)
            for (size_t k = 0; k < n; ++k) r[k] = mass[k] > 0.0 ? r[k] - momentum[k] / mass[k] : 0.0;
        }
    }
}

static void start_velocity_residuals(mpm *s, int group)
{
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int c = 0; c < s->mesh->dim; ++c)
            memcpy(field_get(s->domain->fields[b], N_RESIDUAL, group, c),
                   field_get(s->domain->fields[b], N_VEL_L, group, c), s->mesh->block[b].size * sizeof(double));
}

/* Of (1 - lambda)^2 (1 - lambda/0.6)^2, which is lost with these shares of v, r_1, r_2 and r_3: smooth motion as by two terms, what lies
 * between rest and it, lambda of 0.3 to 1, as by six, and the nodes with the least mass react as by five (the slope at lambda = 0). */
static const double restored_shares[] = {1.0, 1.0, 5.0 / 9.0, 25.0 / 9.0};

static double share_of_residual(const mpm *s, int j)
{
    return s->scene->method.filter_order > 0 || s->basis->fact.hats ? 1.0 : restored_shares[j];
}

static void add_residuals(mpm *s, int group, double share)
{
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        const size_t n = s->mesh->block[b].size;
        for (int c = 0; c < s->mesh->dim; ++c) {
            const double *restrict r = field_get(s->domain->fields[b], N_RESIDUAL, group, c);
            double *restrict v = field_get(s->domain->fields[b], N_VEL_L, group, c);
#pragma omp parallel for simd schedule(static)
            for (size_t k = 0; k < n; ++k) v[k] += share * r[k];
        }
    }
}

/* The next residual from the last, of which the first are the velocities, on all nodes that points reach; `share` of what walls take of it goes into the ledger. */
static void next_residuals(mpm *s, double share, bool velocities)
{
    for (int g = 0; g < s->n_deforming_groups; ++g) {
        project_residuals(s, g, velocities);
        enter_mirrored_change(s, g, N_RESIDUAL, -share, true);
        subtract_projection(s, g);
        constrain_change(s, g, N_RESIDUAL, share);
    }
    motions_still(s, N_RESIDUAL);
    if (s->contact) contact_velocities(s, CONTACT_RESTORE);
    motions_constrain(s, N_RESIDUAL, share);
    for (int g = 0; g < s->n_deforming_groups; ++g) {
        enter_mirrored_change(s, g, N_RESIDUAL, share, false);
        extend_to_ghosts(s, g, N_RESIDUAL);
    }
}

static void restore_accelerations(mpm *s)
{
    for (int g = 0; g < s->n_deforming_groups; ++g) start_velocity_residuals(s, g);
    for (int j = 1; j < s->order; ++j) {
        const double share = share_of_residual(s, j);
        next_residuals(s, share, j == 1);
        for (int g = 0; g < s->n_deforming_groups; ++g) add_residuals(s, g, share);
    }
}

floe_status mpm_restore_velocities(mpm *s)
{
    restore_accelerations(s);
    for (int g = 0; s->edges && s->scene->method.stress == STRESS_USL && g < s->n_deforming_groups; ++g)
        TRY(edges_strain(s, g, N_VEL_L));
    return FLOE_OK;
}
