/* Stages that loop over the points, tile by tile. */
#include "base/memory.h"
#include "base/threads.h"
#include "grid/tile_box.h"
#include "mpm/edge/edge.h"
#include "mpm/loads/point_loads.h"
#include "mpm/loads/spring.h"
#include "mpm/membrane/membrane_points.h"
#include "mpm/motion/motion.h"
#include "mpm/mpm_constants.h"
#include "mpm/nodes/ghosts.h"
#include "mpm/nodes/light_nodes.h"
#include "mpm/nodes/support_points.h"
#include "mpm/nodes/wall.h"
#include "mpm/state/mean_strain.h"
#include "mpm/state/stress.h"
#include "mpm/step.h"
#include "mpm/surface/surface_markers.h"
#include "mpm/surface/traction.h"
#include "mpm/transfer/crowd.h"
#include "mpm/transfer/kernels.h"
#include "mpm/transfer/lanes.h"
#include "mpm/transfer/point_arrays.h"
#include "mpm/transfer/scatter.h"
#include "mpm/transfer/scratch.h"
#include "mpm/transfer/windows.h"

#include <math.h>
#include <string.h>

/* What a pass reads of the nodes of a tile. */
typedef struct pass_window {
    _Alignas(MEMORY_ALIGNMENT) double record[MPM_MAX_WINDOW * MPM_MAX_RECORD];
    double mass[MPM_MAX_WINDOW];
} pass_window;

floe_status mpm_points_to_nodes(mpm *s)
{
    const bool all = forces_at_once(s);
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
    field_id velocity; /* node field of which L is the gradient */
    bool motion, stress;
    bool sample; /* motion: v_p becomes that velocity, and nothing moves */
    bool carry;  /* C_p (transfer.h) from that velocity */
} tile_pass;

static void node_arrays(const mpm *s, int blk, int group, field_id id, const double *array[MESH_MAX_DIM])
{
    for (int c = 0; c < s->mesh->dim; ++c) array[c] = field_get(s->domain->fields[blk], id, group, c);
}

/* Rates that the kernel does not set: a stress state may have solved for them in the batch before. */
static void clear_free_rates(const mpm *s, solid_batch *batch)
{
    if (s->mesh->dim == 3 || s->scene->stress_state == STRESS_FULL) return;
    memset(batch->L[8], 0, sizeof batch->L[8]);
    if (s->mesh->dim == 1) memset(batch->L[4], 0, sizeof batch->L[4]);
}

/* Loads what a pass reads of the nodes, in the order that the kernels expect. */
static void load_pass(const mpm *s, int blk, int group, const tile_box *t, tile_pass pass, pass_window *window)
{
    const int dim = s->mesh->dim;
    const double *node[MPM_MAX_RECORD];
    for (int c = 0; c < MPM_MAX_RECORD; ++c)
        node[c] = field_get(s->domain->fields[blk], pass.velocity, group, 0); /* padding */
    node_arrays(s, blk, group, pass.velocity, node);
    if (pass.motion) node_arrays(s, blk, group, N_ACCEL, node + dim);
    load_window(s, blk, t, node, lanes_reserved(lanes_of(pass.motion ? 2 * dim : dim)), window->record);
    if (!gather_needs_mass(s->basis->smoothness == 0, pass.motion, pass.stress || pass.carry)) return;
    const double *mass = field_get(s->domain->fields[blk], N_MASS, group, 0);
    load_window(s, blk, t, &mass, 1, window->mass);
    mirror_masses(s, group, t, window->mass);
}

static gather_result result_of(const mpm *s, int blk, int body, tile_pass pass, solid_batch *batch)
{
    gather_result out = {.L = {0}};
    for (int a = 0; pass.motion && a < s->mesh->dim; ++a) {
        out.x_next[a] = field_next(s->domain->fields[blk], P_POS, body, a);
        out.v_next[a] = field_next(s->domain->fields[blk], P_VEL, body, a);
    }
    for (int c = 0; c < 9; ++c) out.L[c] = batch->L[c];
    return out;
}

/* Whether a chunk's points have changed cell; CELLS_FAR where one has moved farther than a cell, which no stable step
 * does (theory 4.6), or is a NaN. Cells are those of mesh_cell_of: x is in the mesh, so that truncation is floor. */
typedef enum chunk_motion { CELLS_KEPT, CELLS_CHANGED, CELLS_FAR } chunk_motion;

FLOE_WIDE static chunk_motion motion_of(const mesh *m, size_t start, size_t end, const point_arrays *p,
                                        const gather_result *out)
{
    long long far = 0, changed = 0; /* as wide as a double, so that the loop is vectorised */
    for (int a = 0; a < m->dim; ++a) {
        const double *restrict x = p->x[a], *restrict next = out->x_next[a];
        const double h = m->h[a], lower = m->lower[a], upper = m->upper[a];
        for (size_t k = start; k < end; ++k) far += !(fabs(next[k] - x[k]) <= h);
        for (size_t k = start; k < end && far == 0; ++k)
            changed +=
                ((int)((next[k] - lower) / h) != (int)((x[k] - lower) / h)) | (next[k] < lower) | (next[k] > upper);
    }
    return far ? CELLS_FAR : changed ? CELLS_CHANGED : CELLS_KEPT;
}

static floe_status check_motion(const mpm *s, int body, int tile, chunk_motion motion)
{
    if (motion == CELLS_CHANGED) s->moved[tile] |= UINT32_C(1) << body;
    if (motion != CELLS_FAR) return FLOE_OK;
    return fail(s->ctx, FLOE_RETRY, "at t = %.6g s a point of body '%s' would cross more than a cell in one step",
                s->time, s->scene->body[s->body[body].scene_body].name);
}

/* Moment of the impulse of a body force along an axis, on a chunk's points. */
static void add_fall_moment(const mpm *s, const point_arrays *p, int axis, size_t start, size_t end, double moment[3])
{
    const double *drive = p->drive[axis];
    double arm[MESH_MAX_DIM] = {0.0};
    for (size_t k = start; k < end; ++k) {
        const double force = p->mass[k] * (p->acceleration[axis] + (drive ? drive[k] : 0.0));
        for (int a = 0; a < s->mesh->dim; ++a) arm[a] += p->x[a][k] * force;
    }
    add_moment(moment, arm, axis, s->kick);
}

/* Impulse and work of a body force on a chunk's points. */
static void add_fall(const mpm *s, const point_arrays *p, const gather_result *out, size_t start, size_t end,
                     double gain[MPM_GAINS])
{
    for (int a = 0; a < s->mesh->dim; ++a) {
        const double b = p->acceleration[a], *restrict x = p->x[a], *restrict next = out->x_next[a];
        const double *drive = p->drive[a];
        if (b == 0.0 && !drive) continue;
        double impulse = 0.0, work = 0.0;
        for (size_t k = start; k < end; ++k) {
            const double force = p->mass[k] * (b + (drive ? drive[k] : 0.0));
            impulse += force;
            work += force * (next[k] - x[k]);
        }
        gain[GAIN_IMPULSE + a] += s->kick * impulse;
        add_fall_moment(s, p, a, start, end, gain + GAIN_MOMENT);
        gain[GAIN_BODY_FORCE] += work;
    }
}

/* With the linear basis the moments are the gradient, which is then taken with corrections for nodes of small mass
 * (kernels_gather.h). */
bool carries_gradient(const mpm *s)
{
    const transfer_carry carry = s->transfer->carry;
    return carry == CARRY_GRADIENT || (carry == CARRY_MOMENTS && s->basis->smoothness == 0);
}

static gather_kernel *kernel_of(const mpm *s, tile_pass pass)
{
    const bool gradient = pass.stress || (pass.carry && carries_gradient(s));
    const gather_mode mode = gradient      ? (pass.motion ? GATHER_BOTH : GATHER_GRADIENT)
                             : pass.motion ? GATHER_MOTION
                                           : GATHER_MOMENTS;
    return s->windows->kernel->gather[mode];
}

static void store_affine(const mpm *s, int blk, int body, size_t start, size_t end, const solid_batch *batch)
{
    const int dim = s->mesh->dim;
    for (int a = 0; a < dim; ++a)
        for (int c = 0; c < dim; ++c)
            memcpy(field_next(s->domain->fields[blk], P_AFFINE, body, dim * a + c) + start, batch->L[3 * a + c],
                   (end - start) * sizeof(double));
}

/* How a pass gathers from the nodes of a tile. */
typedef struct tile_gather {
    gather_kernel *kernel;
    const double *window;
    gather_step step;
    gather_result out;
} tile_gather;

static tile_gather gather_of(const mpm *s, int blk, int body, tile_pass pass, const pass_window *window,
                             solid_batch *batch)
{
    const double kick = spares_light_nodes(s) ? 0.0 : s->kick; /* gradients then see all of the acceleration */
    tile_gather g = {kernel_of(s, pass), window->record, {.mass = window->mass}, result_of(s, blk, body, pass, batch)};
    if (!pass.sample) g.step = (gather_step){kick, s->dt, s->share, window->mass};
    return g;
}

/* Rates of volume of points that share them over patches of cells: what is gathered here is gathered again, when all of a patch are known. */
static void find_shared_rates(mpm *s, int blk, int body, const tile_box *t, const size_t range[2], const tile_gather *g,
                              solid_batch *batch)
{
    const point_arrays p = points_of(s, blk, body, false, false);
    double *rate = field_get(s->domain->fields[blk], P_VOLUME_RATE, body, 0);
    gather_result out = g->out; /* a filter has left velocities in the next state */
    memcpy(out.v_next, out.x_next, sizeof out.v_next);
    for (size_t k = range[0], stop; k < range[1]; k = stop) {
        stop = mean_strain_chunk(s, body, p.x, k, range[1]);
        batch->n = stop - k;
        g->kernel(s->mesh, t, &p, k, stop, g->window, &g->step, &out);
        rates_of_volume(s, batch, rate + k);
    }
    share_rates(s, blk, body, t, range);
}

static bool has_supported_points(const mpm *s, int blk, int body)
{
    return fields_has(s->domain->fields[blk], P_FREE_MASS, body);
}

/* Points that a support holds do not strain. */
static void still_supported(const point_arrays *p, size_t start, size_t end, solid_batch *batch)
{
    for (size_t k = start; k < end; ++k)
        for (int c = 0; p->mass[k] == 0.0 && c < 9; ++c) batch->L[c][k - start] = 0.0;
}

/* They move with it; the first time it makes them. */
static void carry_supported(const mpm *s, const point_arrays *p, const gather_result *out, size_t start, size_t end,
                            double gain[MPM_GAINS])
{
    for (size_t k = start; k < end; ++k) {
        double x[MESH_MAX_DIM] = {0.0};
        if (p->mass[k] != 0.0) continue;
        for (int a = 0; a < s->mesh->dim; ++a) x[a] = p->x[a][k];
        const double *v = s->scene->support[support_with(s, x)].velocity;
        for (int a = 0; a < s->mesh->dim; ++a) {
            const double impulse = p->all_mass[k] * (v[a] - p->v[a][k]);
            gain[GAIN_SUPPORT + a] += impulse;
            gain[GAIN_SUPPORT_WORK] += impulse * v[a];
            add_moment(gain + GAIN_SUPPORT_MOMENT, x, a, impulse);
            out->v_next[a][k] = v[a];
            out->x_next[a][k] = x[a] + s->dt * v[a];
        }
    }
}

/* One body's points in one tile, by chunks that stay in the first cache from the nodes to the stress. */
static floe_status pass_body(mpm *s, int blk, int body, const tile_box *t, const size_t range[2], tile_pass pass,
                             const pass_window *window, solid_batch *batch, double *gain)
{
    const point_arrays p = points_of(s, blk, body, false, pass.motion && !pass.sample && s->transfer->filter);
    const tile_gather g = gather_of(s, blk, body, pass, window, batch);
    const bool supported = has_supported_points(s, blk, body);
    if (pass.stress && shares_over_patches(s, body)) find_shared_rates(s, blk, body, t, range, &g, batch);
    for (size_t k = range[0], stop; k < range[1]; k = stop) {
        stop = mean_strain_chunk(s, body, p.x, k, range[1]);
        if (pass.stress) clear_free_rates(s, batch);
        g.kernel(s->mesh, t, &p, k, stop, g.window, &g.step, &g.out);
        if (supported && (pass.carry || pass.stress)) still_supported(&p, k, stop, batch);
        if (pass.carry) store_affine(s, blk, body, k, stop, batch);
        if (pass.sample) continue;
        if (pass.motion && supported) carry_supported(s, &p, &g.out, k, stop, gain);
        if (pass.motion) add_fall(s, &p, &g.out, k, stop, gain);
        if (pass.motion) TRY(check_motion(s, body, t->number, motion_of(s->mesh, k, stop, &p, &g.out)));
        if (!pass.stress) continue;
        if (s->body[body].membrane.model)
            TRY(strain_membrane(s, blk, body, k, stop, batch));
        else
            TRY(update_stress(s, blk, body, k, stop, batch, gain));
    }
    return FLOE_OK;
}

static floe_status pass_tile(mpm *s, int blk, int tile, tile_pass pass, solid_batch *batch)
{
    pass_window window;
    int loaded = -1;
    tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    if (pass.stress) box.shared = shared_cells(s, blk, tile, &box);
    double *gain = s->scratch->tile_sum + (size_t)box.number * MPM_GAINS; /* zeroed by pass_points */
    for (int body = 0; body < s->n_deforming; ++body) {
        const size_t *range = s->points[blk][body].tile_start + tile;
        const int group = s->body[body].group;
        if (range[0] == range[1]) continue;
        if (loaded != group) load_pass(s, blk, group, &box, pass, &window);
        loaded = group;
        TRY(pass_body(s, blk, body, &box, range, pass, &window, batch, gain));
    }
    return FLOE_OK;
}

static void enter_gains(mpm *s)
{
    double sum[MPM_GAINS];
    domain_sum_tiles(s->mesh, s->scratch->tile_sum, MPM_GAINS, sum);
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_SOURCE, sum[GAIN_HEAT] + sum[GAIN_BODY_FORCE]);
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_BOUNDARY, sum[GAIN_REFERENCE]);
    for (int a = 0; a < s->mesh->dim; ++a)
        ledger_add(s->ledger, (ledger_quantity)(LEDGER_MOMENTUM_X + a), LEDGER_SOURCE, sum[GAIN_IMPULSE + a]);
    ledger_turn(s->ledger, LEDGER_SOURCE, sum + GAIN_MOMENT, 1.0);
    for (int a = 0; a < s->mesh->dim; ++a)
        ledger_add(s->ledger, (ledger_quantity)(LEDGER_MOMENTUM_X + a), LEDGER_BOUNDARY, sum[GAIN_SUPPORT + a]);
    ledger_turn(s->ledger, LEDGER_BOUNDARY, sum + GAIN_SUPPORT_MOMENT, 1.0);
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_BOUNDARY, sum[GAIN_SUPPORT_WORK]);
}

/* Runs a pass over every tile; the first failure wins, and the others stop early. */
static floe_status pass_points(mpm *s, tile_pass pass)
{
    floe_status worst = FLOE_OK;
    const size_t tiles = mesh_tiles(s->mesh);
    memset(s->scratch->tile_sum, 0, tiles * MPM_GAINS * sizeof(double));
    if (pass.motion) memset(s->moved, 0, tiles * sizeof *s->moved);
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
#pragma omp parallel for schedule(dynamic, 4)
        for (int t = 0; t < s->mesh->block[b].n_tiles; ++t) {
            floe_status status;
#pragma omp atomic read
            status = worst;
            if (status != FLOE_OK) continue;
            status = pass_tile(s, b, t, pass, &s->scratch->batch[thread_number()]);
            if (status != FLOE_OK) {
#pragma omp atomic write
                worst = status;
            }
        }
    }
    if (worst == FLOE_OK) enter_gains(s);
    if (pass.stress || pass.carry) motions_keep(s);
    return worst;
}

floe_status sample_velocities(mpm *s, field_id velocity)
{
    return pass_points(s, (tile_pass){.velocity = velocity, .motion = true, .sample = true});
}

floe_status mpm_carry_moments(mpm *s)
{
    return pass_points(s, (tile_pass){.velocity = N_VEL_L, .carry = true});
}

floe_status mpm_stress_first(mpm *s)
{
    TRY(set_heating(s));
    return pass_points(s, (tile_pass){.velocity = N_VEL, .stress = true});
}

floe_status mpm_nodes_to_points(mpm *s)
{
    const bool usl = s->scene->method.stress == STRESS_USL && !s->cell_mass;
    if (usl) TRY(set_heating(s));
    TRY(pass_points(s, (tile_pass){.velocity = N_VEL_L, .motion = true, .stress = usl, .carry = carries_gradient(s)}));
    TRY(motions_move(s));
    enter_dashpots(s);
    for (int g = 0; g < s->n_groups; ++g) {
        move_surfaces(s, g);
        move_markers(s, g);
    }
    return FLOE_OK;
}

floe_status mpm_stress_last(mpm *s)
{
    TRY(set_heating(s));
    return pass_points(s, (tile_pass){.velocity = N_VEL_L, .stress = true});
}

floe_status mpm_remap_stress(mpm *s)
{
    TRY(set_heating(s));
    for (int g = 0; g < s->n_groups; ++g) TRY(scatter_group(s, g, SCATTER_MOMENTUM, false, true));
    TRY(mpm_node_velocity(s));
    for (int g = 0; s->edges && g < s->n_deforming_groups; ++g) TRY(edges_strain(s, g, N_VEL));
    return pass_points(s, (tile_pass){.velocity = N_VEL, .stress = true});
}

floe_status mpm_grid_pressure(mpm *s)
{
    extend_to_ghosts(s, 0, N_PRESSURE); /* one for all groups */
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
#pragma omp parallel for schedule(dynamic, 4)
        for (int t = 0; t < s->mesh->block[b].n_tiles; ++t) {
            double window[MPM_MAX_WINDOW];
            const tile_box box = tile_box_of(s->mesh, &s->mesh->block[b], t);
            const double *node = field_get(s->domain->fields[b], N_PRESSURE, 0, 0);
            load_window(s, b, &box, &node, 1, window);
            for (int body = 0; body < s->n_bodies; ++body) {
                const size_t *at = s->points[b][body].tile_start;
                if (at[t] == at[t + 1]) continue;
                const point_arrays p = points_of(s, b, body, false, false);
                double *pressure = field_get(s->domain->fields[b], P_GRID_PRESSURE, body, 0);
                s->windows->kernel->sample(s->mesh, &box, &p, at[t], at[t + 1], window, pressure + at[t]);
            }
        }
    }
    return FLOE_OK;
}

/* Adds the mass of a velocity field per volume of the plane, or per length, at points. */
static void add_crowd(const mpm *s, int group, int blk, const tile_box *t, const point_arrays *p, const size_t range[2],
                      double density[SOLID_CHUNK])
{
    double window[MPM_MAX_WINDOW], at[SOLID_CHUNK];
    const double volume = mesh_box_volume(s->mesh);
    const double *mass = field_get(s->domain->fields[blk], N_MASS, group, 0);
    load_window(s, blk, t, &mass, 1, window);
    mirror_masses(s, group, t, window);
    s->windows->kernel->sample(s->mesh, t, p, range[0], range[1], window, at);
    for (size_t k = 0; k < range[1] - range[0]; ++k) density[k] += at[k] / volume;
}

void find_crowded(const mpm *s, int body, int blk, int tile, const size_t range[2], bool *crowded)
{
    const tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    const point_arrays p = points_of(s, blk, body, false, false);
    double density[SOLID_CHUNK] = {0.0};
    for (int g = 0; g < s->n_groups; ++g) add_crowd(s, g, blk, &box, &p, range, density);
    for (size_t k = range[0]; k < range[1]; ++k)
        crowded[k - range[0]] = density[k - range[0]] * p.volume0[k] > MPM_CROWD * p.mass[k];
}
