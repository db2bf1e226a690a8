/* Reacting solids: mass that reactions on cells consume of the points (step 4 of Guilkey et al. 2003).
 *
 * The cells determine the share s_c of their solid that reacts (coupling/node_cell_transfer.h). Averaged to nodes and
 * interpolated to the points, it is the share f_p of each point, so that the points together lose the mass that reacts
 * in the cells: sum_p f_p m_p = sum_c s_c m_c. The mass, momentum and energy that they lose, f_p m_p (1, v_p,
 * psi/rho_0 + v_p^2/2), go to the nodes and on to the cells as masses do; the rest of each point continues in the
 * step. All of this uses the velocities at the start of the step, before any force acts, so that the sums of mass and
 * momentum of points and cells do not change. Volumes are proportional to masses; the strain of a point does not change:
 * F, J and stress. */
#include "mpm/state/burn.h"

#include "base/threads.h"
#include "grid/tile_box.h"
#include "mpm/mpm_constants.h"
#include "mpm/nodes/ghosts.h"
#include "mpm/state/stress.h"
#include "mpm/transfer/kernels.h"
#include "mpm/transfer/point_arrays.h"
#include "mpm/transfer/scatter.h"
#include "mpm/transfer/scratch.h"
#include "mpm/transfer/spread.h"
#include "mpm/transfer/windows.h"

#include <string.h>

/* The shares of a tile's nodes; false where all are none. */
static bool load_shares(const mpm *s, int blk, const tile_box *box, int group, double *window)
{
    const double *node = field_get(s->domain->fields[blk], N_BURNT_SHARE, group, 0);
    memset(window, 0, (size_t)s->windows->window_nodes * sizeof *window); /* tiles that are cut short do not fill it */
    load_window(s, blk, box, &node, 1, window);
    for (int k = 0; k < s->windows->window_nodes; ++k)
        if (window[k] > 0.0) return true;
    return false;
}

/* Removes the share `taken` of points [start, end), whose state is in the batch. */
static void burn_points(const mpm *s, int blk, int body, const tile_box *box, size_t start, size_t end,
                        const double *taken, const solid_batch *batch, double *out)
{
    const fields *f = s->domain->fields[blk];
    const mpm_body *b = &s->body[body];
    const point_arrays p = points_of(s, blk, body, false, false);
    const double *share = field_get(f, P_SHARE, body, 0);
    double psi[SOLID_CHUNK] = {0}, *left = field_get(f, P_MASS_LEFT, body, 0);
    if (b->law->strain_energy) b->law->strain_energy(b->law_par, batch, psi);
    for (size_t k = start; k < end; ++k) {
        const double keep = 1.0 - taken[k - start];
        if (!(keep < 1.0)) continue;
        left[k] = share[k] * keep > MPM_BURNT_OUT ? p.mass[k] * keep : 0.0;
        const double lost = p.mass[k] - left[k];
        double number[2 + MESH_MAX_DIM] = {lost}, square = 0.0;
        for (int a = 0; a < s->mesh->dim; ++a) {
            number[1 + a] = lost * p.v[a][k];
            square += p.v[a][k] * p.v[a][k];
        }
        number[1 + s->mesh->dim] = lost * (0.5 * square + psi[k - start] * p.volume0[k] / p.mass[k]);
        spread_numbers(s, box, &p, k, number, 2 + s->mesh->dim, out);
    }
}

static void burn_body(const mpm *s, int blk, int body, const tile_box *box, const size_t range[2], const double *window,
                      double *out)
{
    const point_arrays p = points_of(s, blk, body, false, false);
    solid_batch *batch = &s->scratch->batch[thread_number()];
    for (size_t k = range[0]; k < range[1]; k += SOLID_CHUNK) {
        const size_t stop = k + SOLID_CHUNK < range[1] ? k + SOLID_CHUNK : range[1];
        double taken[SOLID_CHUNK];
        s->windows->kernel->sample(s->mesh, box, &p, k, stop, window, taken);
        load_batch(s, blk, body, k, stop, false, batch);
        burn_points(s, blk, body, box, k, stop, taken, batch, out);
    }
}

/* Whether some point of the tile burns; then its private sums are set. */
static bool burn_tile(const mpm *s, int blk, int tile, int group)
{
    const tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    double window[MPM_MAX_WINDOW], *out = domain_tile(s->domain, box.number);
    bool any = false;
    for (int body = 0; body < s->n_bodies; ++body) {
        const size_t *range = s->points[blk][body].tile_start + tile;
        if (s->body[body].group != group || range[0] == range[1]) continue;
        if (!any && !load_shares(s, blk, &box, group, window)) break;
        if (!any) memset(out, 0, (size_t)s->windows->window_nodes * (2 + (size_t)s->mesh->dim) * sizeof *out);
        any = true;
        burn_body(s, blk, body, &box, range, window, out);
    }
    s->windows->active[box.number] = any;
    return any;
}

static bool burns_group(const mpm *s, int group)
{
    for (int body = 0; body < s->n_bodies; ++body)
        if (s->body[body].group == group && s->body[body].burns) return true;
    return false;
}

/* All mass remains where nothing reacts. */
static void begin_masses(const mpm *s)
{
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int body = 0; body < s->n_bodies; ++body)
            if (s->body[body].burns)
                memcpy(field_get(s->domain->fields[b], P_MASS_LEFT, body, 0),
                       field_get(s->domain->fields[b], P_MASS, body, 0), s->points[b][body].n * sizeof(double));
}

floe_status mpm_burn(mpm *s)
{
    bool burns[MPM_MAX_GROUPS] = {false};
    begin_masses(s);
    for (int g = 0; g < s->n_groups; ++g) {
        if (!burns_group(s, g)) continue;
        int tiles = 0;
        extend_to_ghosts(s, g, N_BURNT_SHARE);
        for (int b = 0; b < s->mesh->n_blocks; ++b) {
#pragma omp parallel for schedule(dynamic, 4) reduction(+ : tiles)
            for (int t = 0; t < s->mesh->block[b].n_tiles; ++t) tiles += burn_tile(s, b, t, g);
        }
        burns[g] = tiles > 0;
        gather_numbers(s, g, (const field_id[]){N_BURNT, N_BURNT_MOMENTUM, N_BURNT_ENERGY}, 3);
    }
    s->burnt = true;
    for (int g = 0; g < s->n_groups; ++g)
        if (burns[g]) TRY(scatter_group(s, g, SCATTER_MOMENTUM, false, false));
    return FLOE_OK;
}

/* Counts the points of a tile that have been removed. */
static int commit_tile(const mpm *s, int blk, int body, const size_t range[2])
{
    const fields *f = s->domain->fields[blk];
    const double *left = field_get(f, P_MASS_LEFT, body, 0);
    double *mass = field_get(f, P_MASS, body, 0), *volume0 = field_get(f, P_VOLUME0, body, 0),
           *share = field_get(f, P_SHARE, body, 0);
    int gone = 0;
    for (size_t k = range[0]; k < range[1]; ++k) {
        if (left[k] == mass[k]) continue;
        const double kept = left[k] / mass[k];
        volume0[k] *= kept;
        share[k] *= kept;
        mass[k] = left[k];
        gone += left[k] == 0.0;
    }
    return gone;
}

void burn_commit(mpm *s)
{
    s->burnt = false;
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int body = 0; body < s->n_bodies; ++body)
            for (int t = 0; s->body[body].burns && t < s->mesh->block[b].n_tiles; ++t) {
                const int gone = commit_tile(s, b, body, s->points[b][body].tile_start + t);
                if (gone == 0) continue;
                s->moved[tile_box_of(s->mesh, &s->mesh->block[b], t).number] |= UINT32_C(1) << body;
                ledger_tally(s->ledger, COUNT_POINTS_BURNT, gone);
            }
}
