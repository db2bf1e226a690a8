/* Scales the volumes of gas points to the free volume.
 *
 * Sums over points are not exact integrals: the volume of gas of uniform pressure changes by sum_p V_p div v, which is
 * not the change of the free volume, and the gas loses energy as its points move so that the sum grows. In a steel box
 * its volumes exceeded the free volume by a fifth after a blast had been reflected several times, and its pressure was
 * too low by as much. The share of a node that is empty, or overfull, is e_i = 1 - sum_p V_p S_ip/V_i, over all points.
 * A gas point that moves by d cells in the step changes its volume, V <- V (1 + a d sum_i S_ip e_i), a =
 * MPM_VOLUME_PACE, at constant energy, so that in the end p = (gamma - 1) e rho is the pressure of the free volume.
 * Points at rest do not change: seeding leaves e_i of a few per cent at walls that cut cells. Beside a node that is half
 * empty, as at a free surface, no volume grows. The work of a change of volume against the reference pressure, which
 * the nodes' forces do not contain, is taken from the energy, as in stress.c. */
#include "grid/tile_box.h"
#include "mpm/fluid/fluid.h"
#include "mpm/fluid/wetted.h"
#include "mpm/mpm_constants.h"
#include "mpm/nodes/ghosts.h"
#include "mpm/nodes/node.h"
#include "mpm/transfer/kernels.h"
#include "mpm/transfer/point_arrays.h"
#include "mpm/transfer/scratch.h"
#include "mpm/transfer/spread.h"
#include "mpm/transfer/windows.h"

#include <math.h>
#include <string.h>

/* Not for liquids: a change of their volume by a few per cent would be a huge pressure. */
static bool is_ideal_gas(const mpm_body *b)
{
    return b->fluid && strcmp(b->fluid_par.eos.model->name, "ideal") == 0;
}

bool settles_volumes(const mpm *s)
{
    for (int b = 0; b < s->n_bodies; ++b)
        if (is_ideal_gas(&s->body[b])) return s->wetted && !s->cell_mass;
    return false;
}

/* Volume of all points of a tile at its nodes. */
static void fill_nodes_of_tile(mpm *s, int group, int blk, int tile)
{
    (void)group;
    const tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    double *out = domain_tile(s->domain, box.number);
    bool any = false;
    for (int body = 0; body < s->n_bodies; ++body) {
        const size_t *range = s->points[blk][body].tile_start + tile;
        if (range[0] == range[1]) continue;
        if (!any) memset(out, 0, (size_t)s->windows->window_nodes * sizeof *out);
        any = true;
        const point_arrays p = points_of(s, blk, body, false, false);
        s->windows->kernel->fill(s->mesh, &box, &p, range[0], range[1], out);
    }
    s->windows->active[box.number] = any;
}

/* What the nodes of a block have left, of their volume; ghosts beyond sides are left to extend_to_ghosts. */
static void find_empty(const mpm *s, int blk)
{
    const int group = wetted_fluid(s);
    const mesh *m = s->mesh;
    const block *b = &m->block[blk];
    double *empty = field_get(s->domain->fields[blk], N_FILL, group, 0);
    int lo[MESH_MAX_DIM] = {0, 0, 0}, end[MESH_MAX_DIM] = {1, 1, 1};
    for (int a = 0; a < m->dim; ++a) {
        lo[a] = m->periodic[a] || !b->at_side[a][SIDE_LOWER] ? -1 : 0;
        end[a] = b->n[a] + (m->periodic[a] || !b->at_side[a][SIDE_UPPER] ? 2 : 1);
    }
    for (int k = lo[2]; k < end[2]; ++k)
        for (int j = lo[1]; j < end[1]; ++j)
            for (int i = lo[0]; i < end[0]; ++i) {
                const ptrdiff_t at = mesh_index(b, i, j, k);
                const int global[MESH_MAX_DIM] = {b->lo[0] + i, b->lo[1] + j, b->lo[2] + k};
                empty[at] = 1.0 - empty[at] / node_volume(s, group, global);
            }
}

static bool has_surface(const double *window, int n)
{
    for (int k = 0; k < n; ++k)
        if (window[k] > MPM_SURFACE_EMPTY) return true;
    return false;
}

/* Points [start, end) of a gas, of which `empty` is e at each; returns what their energies get (J). */
static double settle_points(const mpm *s, int blk, int body, size_t start, size_t end, const double *empty, bool swells)
{
    const fields *f = s->domain->fields[blk];
    const point_arrays p = points_of(s, blk, body, false, false);
    double *J = field_next(f, P_J, body, 0), *energy = field_next(f, P_ENERGY, body, 0), gained = 0.0;
    for (size_t k = start; k < end; ++k) {
        double crossed = 0.0;
        for (int a = 0; a < s->mesh->dim; ++a) crossed += fabs(p.v[a][k]) * s->dt / s->mesh->h[a];
        const double top = swells ? MPM_VOLUME_CHANGE : 0.0,
                     change = fmax(-MPM_VOLUME_CHANGE, fmin(top, MPM_VOLUME_PACE * crossed * empty[k - start]));
        const double gain = -s->scene->reference_pressure * change * J[k] * p.volume0[k];
        energy[k] += gain / p.mass[k];
        gained += gain;
        J[k] *= 1.0 + change;
    }
    return gained;
}

static void settle_volumes_in_tile(mpm *s, int group, int blk, int tile)
{
    const tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    double window[MPM_MAX_WINDOW] = {0.0}, empty[SOLID_CHUNK];
    const double *node = field_get(s->domain->fields[blk], N_FILL, group, 0);
    load_window(s, blk, &box, &node, 1, window);
    s->scratch->tile_sum[box.number] = 0.0;
    const bool swells = !has_surface(window, s->windows->window_nodes);
    for (int body = 0; body < s->n_bodies; ++body) {
        const size_t *range = s->points[blk][body].tile_start + tile;
        if (!is_ideal_gas(&s->body[body]) || range[0] == range[1]) continue;
        const point_arrays p = points_of(s, blk, body, false, false);
        for (size_t k = range[0]; k < range[1]; k += SOLID_CHUNK) {
            const size_t stop = k + SOLID_CHUNK < range[1] ? k + SOLID_CHUNK : range[1];
            s->windows->kernel->sample(s->mesh, &box, &p, k, stop, window, empty);
            s->scratch->tile_sum[box.number] += settle_points(s, blk, body, k, stop, empty, swells);
        }
    }
}

floe_status mpm_settle_volumes(mpm *s)
{
    const int group = wetted_fluid(s);
    visit_tiles(s, group, fill_nodes_of_tile);
    gather_numbers(s, group, (const field_id[]){N_FILL}, 1);
    for (int b = 0; b < s->mesh->n_blocks; ++b) find_empty(s, b);
    extend_to_ghosts(s, group, N_FILL);
    visit_tiles(s, group, settle_volumes_in_tile);
    double gained;
    domain_sum_tiles(s->mesh, s->scratch->tile_sum, 1, &gained);
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_BOUNDARY, gained);
    return FLOE_OK;
}
