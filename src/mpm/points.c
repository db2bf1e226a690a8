/* The stages that pass over the points, tile by tile. */
#include "mpm/locate.h"
#include "mpm/work.h"

#include <string.h>

enum { WINDOW_DOUBLES = 1331 * 2 * MESH_MAX_DIM }; /* the largest window (7^3, 11^2 or 67 nodes) fits with room */

floe_status mpm_points_to_nodes(mpm *s)
{
    const bool all = !s->coupled && s->scene->method.stress != STRESS_USF;
    for (int g = 0; g < s->n_groups; ++g) TRY(scatter_group(s, g, all ? SCATTER_ALL : SCATTER_MOMENTUM, false, false));
    return FLOE_OK;
}

floe_status mpm_node_force(mpm *s)
{
    const bool next = s->scene->method.stress == STRESS_USF;
    for (int g = 0; g < s->n_groups; ++g) TRY(scatter_group(s, g, SCATTER_FORCE, next, false));
    return FLOE_OK;
}

/* What a pass does with each tile. */
typedef struct tile_pass {
    field_id velocity; /* node field that L is taken from */
    bool motion, stress;
} tile_pass;

static void node_arrays(const mpm *s, int blk, int group, field_id id, const double *array[MESH_MAX_DIM])
{
    for (int c = 0; c < s->mesh->dim; ++c) array[c] = field_get(s->domain->fields[blk], id, group, c);
}

static void move_tile(mpm *s, int blk, int body, const tile_box *t, size_t start, size_t end, double *window)
{
    const int dim = s->mesh->dim, group = s->body[body].group;
    const double *node[2 * MESH_MAX_DIM];
    node_arrays(s, blk, group, N_VEL_L, node);
    node_arrays(s, blk, group, N_ACCEL, node + dim);
    load_window(s, blk, t, node, 2 * dim, window);
    const point_arrays p = points_of(s, blk, body, false, false);
    gather_result out = {.L = {0}};
    for (int a = 0; a < dim; ++a) {
        out.x_next[a] = field_next(s->domain->fields[blk], P_POS, body, a);
        out.v_next[a] = field_next(s->domain->fields[blk], P_VEL, body, a);
    }
    s->work->kernel.gather_motion(s->mesh, t, &p, start, end, window, s->work->kick, s->dt, s->scene->method.flip,
                                  &out);
}

/* Rates that the kernel does not set: a stress state may have solved for them in the batch before. */
static void clear_free_rates(const mpm *s, solid_batch *batch)
{
    if (s->mesh->dim == 3) return;
    memset(batch->L[8], 0, sizeof batch->L[8]);
    if (s->mesh->dim == 1) memset(batch->L[4], 0, sizeof batch->L[4]);
}

static floe_status strain_tile(mpm *s, int blk, int body, const tile_box *t, size_t start, size_t end,
                               field_id velocity, double *window, solid_batch *batch, double *heat)
{
    const double *node[MESH_MAX_DIM];
    node_arrays(s, blk, s->body[body].group, velocity, node);
    load_window(s, blk, t, node, s->mesh->dim, window);
    const point_arrays p = points_of(s, blk, body, false, false);
    gather_result out = {.L = {0}};
    for (int c = 0; c < 9; ++c) out.L[c] = batch->L[c];
    for (size_t k = start; k < end; k += SOLID_CHUNK) {
        const size_t stop = k + SOLID_CHUNK < end ? k + SOLID_CHUNK : end;
        clear_free_rates(s, batch);
        s->work->kernel.gather_gradient(s->mesh, t, &p, k, stop, window, 0.0, 0.0, 0.0, &out);
        TRY(update_stress(s, blk, body, k, stop, batch, heat));
    }
    return FLOE_OK;
}

static floe_status pass_tile(mpm *s, int blk, int tile, tile_pass pass, solid_batch *batch)
{
    double window[WINDOW_DOUBLES];
    int global;
    tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile, &global);
    if (pass.stress) box.shared = shared_cells(s, blk, tile, &box);
    double *heat = s->work->tile_sum + (size_t)global * MPM_TILE_SUMS;
    *heat = 0.0;
    for (int body = 0; body < s->n_bodies; ++body) {
        const size_t *at = s->points[blk][body].tile_start;
        if (at[tile] == at[tile + 1]) continue;
        if (pass.motion) move_tile(s, blk, body, &box, at[tile], at[tile + 1], window);
        if (pass.stress)
            TRY(strain_tile(s, blk, body, &box, at[tile], at[tile + 1], pass.velocity, window, batch, heat));
    }
    return FLOE_OK;
}

/* Runs a pass over every tile; the first failure wins, and the others stop early. */
static floe_status pass_points(mpm *s, tile_pass pass)
{
    floe_status worst = FLOE_OK;
    memset(s->work->tile_sum, 0,
           (size_t)(s->mesh->tiles[0] * s->mesh->tiles[1] * s->mesh->tiles[2]) * MPM_TILE_SUMS * sizeof(double));
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
#pragma omp parallel for schedule(dynamic, 4)
        for (int t = 0; t < s->mesh->block[b].n_tiles; ++t) {
            floe_status status;
#pragma omp atomic read
            status = worst;
            if (status != FLOE_OK) continue;
            status = pass_tile(s, b, t, pass, &s->work->batch[mpm_thread()]);
            if (status != FLOE_OK) {
#pragma omp atomic write
                worst = status;
            }
        }
    }
    if (pass.stress && worst == FLOE_OK) {
        double sum[MPM_TILE_SUMS];
        domain_sum_tiles(s->mesh, s->work->tile_sum, MPM_TILE_SUMS, sum);
        ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_SOURCE, sum[0]);
    }
    return worst;
}

floe_status mpm_stress_first(mpm *s)
{
    TRY(set_heating(s));
    return pass_points(s, (tile_pass){.velocity = N_VEL, .stress = true});
}

floe_status mpm_nodes_to_points(mpm *s)
{
    const bool usl = s->scene->method.stress == STRESS_USL;
    if (usl) TRY(set_heating(s));
    TRY(pass_points(s, (tile_pass){.velocity = N_VEL_L, .motion = true, .stress = usl}));
    for (int g = 0; g < s->n_groups; ++g) move_surfaces(s, g);
    return FLOE_OK;
}

floe_status mpm_remap_stress(mpm *s)
{
    TRY(set_heating(s));
    for (int g = 0; g < s->n_groups; ++g) TRY(scatter_group(s, g, SCATTER_MOMENTUM, false, true));
    TRY(mpm_node_velocity(s));
    return pass_points(s, (tile_pass){.velocity = N_VEL, .stress = true});
}

floe_status mpm_grid_pressure(mpm *s)
{
    for (int g = 0; g < s->n_groups; ++g) extend_to_ghosts(s, g, N_PRESSURE);
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
#pragma omp parallel for schedule(dynamic, 4)
        for (int t = 0; t < s->mesh->block[b].n_tiles; ++t) {
            double window[WINDOW_DOUBLES];
            int global;
            const tile_box box = tile_box_of(s->mesh, &s->mesh->block[b], t, &global);
            const double *node = field_get(s->domain->fields[b], N_PRESSURE, 0, 0);
            load_window(s, b, &box, &node, 1, window);
            for (int body = 0; body < s->n_bodies; ++body) {
                const size_t *at = s->points[b][body].tile_start;
                const point_arrays p = points_of(s, b, body, false, false);
                s->work->kernel.sample(s->mesh, &box, &p, at[t], at[t + 1], window,
                                       field_get(s->domain->fields[b], P_GRID_PRESSURE, body, 0));
            }
        }
    }
    return FLOE_OK;
}
