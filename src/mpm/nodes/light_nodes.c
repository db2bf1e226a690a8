/* Light nodes, with the linear basis and GIMP and points that carry the gradient of the velocity about them.
 *
 * Such points give back to a node the velocity that they took from it: a node that one point reaches with the weight S keeps its velocity, and is a mass S
 * m_p on a spring of the whole stiffness of the point. With hat functions no step is small enough for all S (theory 4.4). So accelerations a are replaced by
 *
 *     a - (1 - Q) W (1 - Q) a,
 *
 * with Q v the velocities that points give back of v, W = max(0, 1 - m_i/m) and m the mean mass of the node's points: a light node is accelerated as its
 * points are. With hat functions Q excludes the gradient, with which one point gives back everything. (1 - Q) v has no momentum and vanishes for uniform
 * motion; Q and W are symmetric with respect to the nodal masses, so that no step creates energy. */
#include "mpm/nodes/light_nodes.h"

#include "grid/tile_box.h"
#include "mpm/contact/contact.h"
#include "mpm/motion/motion.h"
#include "mpm/nodes/ghosts.h"
#include "mpm/nodes/wall.h"
#include "mpm/transfer/kernels.h"
#include "mpm/transfer/point_arrays.h"
#include "mpm/transfer/spread.h"
#include "mpm/transfer/windows.h"

#include <math.h>
#include <string.h>

bool spares_light_nodes(const mpm *s)
{
    return s->basis->fact.hats && s->transfer->carry != CARRY_NOTHING;
}

/* What points give to the nodes: of their masses m v, v the residuals at their positions, or m^2. */
typedef enum light_gift { GIVE_RESIDUAL, GIVE_MASS } light_gift;

static void give_points(const mpm *s, const tile_box *t, const point_arrays *p, const size_t range[2], light_gift gift,
                        double window[][MPM_MAX_WINDOW], double *out)
{
    const int count = gift == GIVE_RESIDUAL ? s->mesh->dim : 1;
    double at[3][SOLID_CHUNK], number[3 * SOLID_CHUNK];
    for (size_t k = range[0]; k < range[1]; k += SOLID_CHUNK) {
        const size_t stop = k + SOLID_CHUNK < range[1] ? k + SOLID_CHUNK : range[1];
        for (int c = 0; gift == GIVE_RESIDUAL && c < count; ++c)
            s->windows->kernel->sample(s->mesh, t, p, k, stop, window[c], at[c]);
        for (size_t i = 0; i < stop - k; ++i)
            for (int c = 0; c < count; ++c)
                number[i * (size_t)count + (size_t)c] =
                    p->mass[k + i] * (gift == GIVE_RESIDUAL ? at[c][i] : p->mass[k + i]);
        s->windows->kernel->spread(s->mesh, t, p, k, stop, number, count, out);
    }
}

static void give_tile(const mpm *s, int group, int blk, int tile, light_gift gift)
{
    const tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    const int count = gift == GIVE_RESIDUAL ? s->mesh->dim : 1;
    double *out = domain_tile(s->domain, box.number), window[3][MPM_MAX_WINDOW];
    bool any = false;
    for (int body = 0; body < s->n_bodies; ++body) {
        const size_t *range = s->points[blk][body].tile_start + tile;
        if (s->body[body].group != group || range[0] == range[1]) continue;
        for (int c = 0; !any && gift == GIVE_RESIDUAL && c < count; ++c) {
            const double *node = field_get(s->domain->fields[blk], N_RESIDUAL, group, c);
            load_window(s, blk, &box, &node, 1, window[c]);
        }
        if (!any) memset(out, 0, (size_t)(s->windows->window_nodes * count) * sizeof *out);
        any = true;
        const point_arrays p = points_of(s, blk, body, false, false);
        give_points(s, &box, &p, range, gift, window, out);
    }
    s->windows->active[box.number] = any;
}

static void give_group(mpm *s, int group, light_gift gift)
{
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
#pragma omp parallel for schedule(dynamic, 4)
        for (int t = 0; t < s->mesh->block[b].n_tiles; ++t) give_tile(s, group, b, t, gift);
    }
    gather_numbers(s, group, (const field_id[]){gift == GIVE_RESIDUAL ? N_MOMENTUM : N_FILL}, 1);
}

/* r = kick a. */
static void start_light_residuals(mpm *s, int group)
{
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int c = 0; c < s->mesh->dim; ++c) {
            const double *a = field_get(s->domain->fields[b], N_ACCEL, group, c);
            double *r = field_get(s->domain->fields[b], N_RESIDUAL, group, c);
            for (size_t k = 0; k < s->mesh->block[b].size; ++k) r[k] = s->kick * a[k];
        }
}

/* r -= Q r, on all nodes that points reach; `share` of what walls take of it goes into the ledger. */
static void subtract_mean(mpm *s, int group, double share)
{
    if (s->basis->smoothness == 0)
        give_group(s, group, GIVE_RESIDUAL);
    else
        project_residuals(s, group, false);
    enter_mirrored_change(s, group, N_RESIDUAL, -share, true);
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        const fields *f = s->domain->fields[b];
        const double *mass = field_get(f, N_MASS, group, 0);
        for (int c = 0; c < s->mesh->dim; ++c) {
            const double *momentum = field_get(f, N_MOMENTUM, group, c);
            double *r = field_get(f, N_RESIDUAL, group, c);
            for (size_t k = 0; k < s->mesh->block[b].size; ++k)
                r[k] = mass[k] > 0.0 ? r[k] - momentum[k] / mass[k] : 0.0;
        }
    }
    constrain_change(s, group, N_RESIDUAL, share);
}

/* r = W r; ghosts then have what their nodes have. */
static void keep_light(mpm *s, int group)
{
    give_group(s, group, GIVE_MASS);
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        const fields *f = s->domain->fields[b];
        const double *mass = field_get(f, N_MASS, group, 0), *square = field_get(f, N_FILL, group, 0);
        for (size_t k = 0; k < s->mesh->block[b].size; ++k) {
            const double light = mass[k] > 0.0 ? 1.0 - mass[k] * mass[k] / square[k] : 0.0;
            for (int c = 0; c < s->mesh->dim; ++c) field_get(f, N_RESIDUAL, group, c)[k] *= fmax(light, 0.0);
        }
    }
    extend_to_ghosts(s, group, N_RESIDUAL);
}

/* v^L -= r, a -= r/kick. */
static void take_residuals(mpm *s, int group)
{
    const double per_kick = 1.0 / s->kick;
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int c = 0; c < s->mesh->dim; ++c) {
            const fields *f = s->domain->fields[b];
            const double *r = field_get(f, N_RESIDUAL, group, c);
            double *v = field_get(f, N_VEL_L, group, c), *a = field_get(f, N_ACCEL, group, c);
            for (size_t k = 0; k < s->mesh->block[b].size; ++k) {
                v[k] -= r[k];
                a[k] -= per_kick * r[k];
            }
        }
}

floe_status mpm_spare_light_nodes(mpm *s)
{
    for (int g = 0; g < s->n_deforming_groups; ++g) {
        start_light_residuals(s, g);
        subtract_mean(s, g, 0.0);
        keep_light(s, g);
        subtract_mean(s, g, -1.0);
    }
    motions_still(s, N_RESIDUAL);
    if (s->contact) contact_velocities(s, CONTACT_RESTORE);
    motions_constrain(s, N_RESIDUAL, -1.0);
    for (int g = 0; g < s->n_deforming_groups; ++g) {
        enter_mirrored_change(s, g, N_RESIDUAL, -1.0, false);
        extend_to_ghosts(s, g, N_RESIDUAL);
        take_residuals(s, g);
    }
    return FLOE_OK;
}
