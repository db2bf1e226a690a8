/* Kinetic energy that points lose to their nodes becomes heat of the fluid points near them.
 *
 * A step accelerates point p by a_p = sum_i S_ip a_i, kick = dt, and blends the result with v^L_p = sum_i S_ip v^L_i. With d_p the
 * FLIP velocity less v^L_p and f the share of FLIP, the kinetic energies of points and nodes differ over the step by
 *
 *   m_p (1 - f) [(1 - (1 - f)/2) |d_p|^2 + Var_p(v)] + (USL) m_p dt^2 Var_p(a),   Var_p(v) = sum_i S_ip |v_i|^2 - |sum_i S_ip v_i|^2
 *
 * summed over the points: the motion that the nodes do not resolve and blending removes, the motion that interpolation smooths, and in USL
 * the work of the stress on v^L, while the points have v_p + dt a_p. (USF and MUSL strain with the velocities at the start of the next
 * step, and have no such term.) Every term is positive. The loss of a fluid point becomes its own heat. The losses of other points, the
 * strain energy that a membrane loses (membrane_strain.c; it may gain some) and the energy that damping removes from the nodes go to
 * the nodes, and from each to the fluid points near it by their mass; losses at nodes without fluid are shared by all fluid points by
 * mass. Where a membrane encloses gas of the cells there are no fluid points: the sum is heat of that gas. */
#include "base/threads.h"
#include "grid/tile_box.h"
#include "mpm/fluid/fluid.h"
#include "mpm/fluid/wetted.h"
#include "mpm/membrane/membrane_curve.h"
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

bool has_fluid_points(const mpm *s)
{
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->body[b].fluid) return true;
    return false;
}

bool losses_are_heat(const mpm *s)
{
    return s->scene->method.losses == LOSSES_HEAT && s->cells != CELLS_SMEARED &&
           (has_fluid_points(s) || s->cells == CELLS_CUT);
}

/* What other transfers than FLIP lose is not known, nor of points that forget their own velocities. With hat functions, also at the corners of
 * CPDI, accelerations of nodes of little mass make losses of nothing: the gradient does not see them (kernels_gather.h). */
bool fluids_keep_losses(const mpm *s)
{
    const bool known = isnan(s->transfer->share) && s->share > 0.0 && !s->basis->fact.light_losses;
    return s->scene->method.losses == LOSSES_OWN && known && s->cells != CELLS_SMEARED && has_fluid_points(s);
}

/* (1 - f) |v_i|^2 + (USL) dt^2 |a_i|^2 into N_LOSS, v_i = v^L_i - dt a_i. */
static void square_nodes(const mpm *s, int blk, int group)
{
    const fields *f = s->domain->fields[blk];
    const double kick = s->kick, blend = 1.0 - s->share,
                 usl = s->scene->method.stress == STRESS_USL ? kick * kick : 0.0;
    double *restrict out = field_get(f, N_LOSS, group, 0);
    const size_t n = s->mesh->block[blk].size;
    memset(out, 0, n * sizeof *out);
    for (int c = 0; c < s->mesh->dim; ++c) {
        const double *restrict v = field_get(f, N_VEL_L, group, c), *restrict a = field_get(f, N_ACCEL, group, c);
#pragma omp parallel for simd schedule(static)
        for (size_t k = 0; k < n; ++k) {
            const double before = v[k] - kick * a[k];
            out[k] += blend * before * before + usl * a[k] * a[k];
        }
    }
}

/* And what lines across walls lost, as if the fluid's nodes had it of their own. */
static floe_status square_all(mpm *s)
{
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int g = 0; g < s->n_groups; ++g) square_nodes(s, b, g);
    return s->wetted ? wetted_add_losses(s) : FLOE_OK;
}

/* What damping took (J) of the motion of the nodes at a place. */
static double damped_at(const mpm *s, int blk, ptrdiff_t at)
{
    const fields *f = s->domain->fields[blk];
    const double taken = 1.0 - damping_left(s);
    double sum = 0.0;
    for (int g = 0; taken > 0.0 && g < s->n_groups; ++g) {
        const double mass = field_get(f, N_MASS, g, 0)[at];
        for (int c = 0; c < s->mesh->dim; ++c) {
            const double before = field_get(f, N_VEL_L, g, c)[at] - s->kick * field_get(f, N_ACCEL, g, c)[at];
            sum += 0.5 * mass * taken * (2.0 - taken) * before * before;
        }
    }
    return sum;
}

/* A body's points over the step. */
typedef struct body_step {
    point_arrays now;
    double *x_next[3], *v_next[3];
    const membrane_curve *line; /* that smoothing may have moved; NULL */
} body_step;

static body_step step_of(const mpm *s, int blk, int body)
{
    const fields *f = s->domain->fields[blk];
    body_step b = {.now = points_of(s, blk, body, false, false)};
    for (int a = 0; a < s->mesh->dim; ++a) {
        b.x_next[a] = field_next(f, P_POS, body, a);
        b.v_next[a] = field_next(f, P_VEL, body, a);
    }
    if (s->curve && s->curve[body].rest) b.line = &s->curve[body];
    return b;
}

/* What point k has lost (J), `squares` being the nodes' squares at the point. */
static double loss_of(const mpm *s, const body_step *b, size_t k, size_t number, double squares)
{
    const double kick = s->kick, f = s->share, usl = s->scene->method.stress == STRESS_USL ? kick * kick : 0.0;
    double loss = squares;
    for (int a = 0; a < s->mesh->dim; ++a) {
        const double shift = b->line ? b->line->shift[3 * number + (size_t)a] : 0.0;
        const double v = (b->x_next[a][k] + shift - b->now.x[a][k]) / s->dt;
        const double unseen = (b->v_next[a][k] - v) / f;
        const double acceleration = (v + unseen - b->now.v[a][k]) / kick, before = v - kick * acceleration;
        loss += (1.0 - f) * ((1.0 - 0.5 * (1.0 - f)) * unseen * unseen - before * before) -
                usl * acceleration * acceleration;
    }
    return b->now.mass[k] * loss + (b->line ? b->line->lost[number] : 0.0);
}

/* Fluid points take their own losses; those of others go into the window. */
static void settle_body(const mpm *s, int blk, int body, const tile_box *t, const size_t range[2],
                        const double *squares, double *at_points, double *window)
{
    const body_step b = step_of(s, blk, body);
    double *energy = s->body[body].fluid ? field_next(s->domain->fields[blk], P_ENERGY, body, 0) : NULL;
    for (size_t k = range[0]; k < range[1]; k += SOLID_CHUNK) {
        const size_t stop = k + SOLID_CHUNK < range[1] ? k + SOLID_CHUNK : range[1];
        s->windows->kernel->sample(s->mesh, t, &b.now, k, stop, squares, at_points);
        for (size_t i = k; i < stop; ++i) {
            const double loss = loss_of(s, &b, i, b.line ? point_number(s, blk, body, i) : 0, at_points[i - k]);
            if (energy) {
                energy[i] += loss / b.now.mass[i];
                continue;
            }
            spread_numbers(s, t, &b.now, i, (const double[]){loss, b.now.mass[i]}, 2, window);
        }
    }
}

/* Settles the points of one tile; what others than fluids lose, and their masses, go into its private sums. */
static void settle_losses_in_tile(mpm *s, int unused, int blk, int tile)
{
    (void)unused;
    const tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    double squares[MPM_MAX_WINDOW], *out = domain_tile(s->domain, box.number);
    int loaded = -1;
    bool any = false;
    for (int body = 0; body < s->n_bodies; ++body) {
        const size_t *range = s->points[blk][body].tile_start + tile;
        const int group = s->body[body].group;
        if (range[0] == range[1]) continue;
        if (!any && !s->body[body].fluid) {
            memset(out, 0, 2 * (size_t)s->windows->window_nodes * sizeof *out);
            any = true;
        }
        if (loaded != group) {
            const double *node = field_get(s->domain->fields[blk], N_LOSS, group, 0);
            load_window(s, blk, &box, &node, 1, squares);
        }
        loaded = group;
        settle_body(s, blk, body, &box, range, squares, s->scratch->batch[thread_number()].energy, out);
    }
    s->windows->active[box.number] = any;
}

/* Mass (kg) of fluid points at a node; 0 where it is but round-off. */
static double fluid_at(const mpm *s, int blk, ptrdiff_t at)
{
    const fields *f = s->domain->fields[blk];
    double all = 0.0;
    for (int g = 0; g < s->n_groups; ++g) all += field_get(f, N_MASS, g, 0)[at];
    const double fluid = all - field_get(f, N_DRY_MASS, 0, 0)[at];
    return fluid > MPM_DRY_NODE * all ? fluid : 0.0;
}

enum { SUM_DAMPED, SUM_LEFT, SUM_FLUID, HEAT_SUMS };

/* Adds the energy that damping has removed to the losses of a tile's nodes; sums it, and the losses of nodes without fluid. */
static void close_tile(mpm *s, int unused, int blk, int tile)
{
    (void)unused;
    const block *b = &s->mesh->block[blk];
    const tile_box t = tile_box_of(s->mesh, b, tile);
    const fields *f = s->domain->fields[blk];
    const double *loss = field_get(f, N_LOSS, 0, 0);
    double *sum = s->scratch->tile_sum + (size_t)t.number * HEAT_SUMS;
    int end[MESH_MAX_DIM];
    tile_nodes(s->mesh, &t, end);
    sum[SUM_DAMPED] = sum[SUM_LEFT] = sum[SUM_FLUID] = 0.0;
    for (int k = 0; k < end[2]; ++k)
        for (int j = 0; j < end[1]; ++j)
            for (int i = 0; i < end[0]; ++i) {
                const ptrdiff_t at =
                    mesh_index(b, t.first[0] - b->lo[0] + i, t.first[1] - b->lo[1] + j, t.first[2] - b->lo[2] + k);
                const double damped = damped_at(s, blk, at), fluid = fluid_at(s, blk, at);
                sum[SUM_DAMPED] += damped;
                sum[SUM_FLUID] += fluid;
                if (!(fluid > 0.0)) sum[SUM_LEFT] += loss[at] + damped;
            }
}

/* Losses become energy per kilogram of fluid, and each point also gets `all` (J/kg). */
static void share_losses_by_mass(const mpm *s, int blk, double all)
{
    const fields *f = s->domain->fields[blk];
    double *restrict loss = field_get(f, N_LOSS, 0, 0);
    const ptrdiff_t n = (ptrdiff_t)s->mesh->block[blk].size;
#pragma omp parallel for schedule(static)
    for (ptrdiff_t k = 0; k < n; ++k) {
        const double fluid = fluid_at(s, blk, k);
        loss[k] = all + (fluid > 0.0 ? (loss[k] + damped_at(s, blk, k)) / fluid : 0.0);
    }
}

static bool is_zero(const double *window, int n)
{
    for (int k = 0; k < n; ++k)
        if (window[k] != 0.0) return false;
    return true;
}

/* Fluid points of a tile get their shares of the losses of its nodes. */
static void heat_tile(mpm *s, int unused, int blk, int tile)
{
    (void)unused;
    const fields *f = s->domain->fields[blk];
    const tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    const double *node = field_get(f, N_LOSS, 0, 0);
    double window[MPM_MAX_WINDOW] = {0}, *gain = s->scratch->batch[thread_number()].energy;
    load_window(s, blk, &box, &node, 1, window);
    if (is_zero(window, s->windows->window_nodes)) return;
    for (int body = 0; body < s->n_bodies; ++body) {
        const size_t *range = s->points[blk][body].tile_start + tile;
        if (!s->body[body].fluid) continue;
        const point_arrays p = points_of(s, blk, body, false, false);
        double *energy = field_next(f, P_ENERGY, body, 0);
        for (size_t k = range[0]; k < range[1]; k += SOLID_CHUNK) {
            const size_t stop = k + SOLID_CHUNK < range[1] ? k + SOLID_CHUNK : range[1];
            s->windows->kernel->sample(s->mesh, &box, &p, k, stop, window, gain);
            for (size_t i = k; i < stop; ++i) energy[i] += gain[i - k];
        }
    }
}

floe_status mpm_give_heat(mpm *s)
{
    double sum[HEAT_SUMS];
    TRY(square_all(s));
    visit_tiles(s, 0, settle_losses_in_tile);
    gather_numbers(s, 0, (const field_id[]){N_LOSS, N_DRY_MASS}, 2);
    visit_tiles(s, 0, close_tile);
    domain_sum_tiles(s->mesh, s->scratch->tile_sum, HEAT_SUMS, sum);
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_DAMPING, sum[SUM_DAMPED]);
    s->lost = (s->substep > 0 ? s->lost : 0.0) + sum[SUM_LEFT];
    if (s->cells == CELLS_CUT) return FLOE_OK;
    for (int b = 0; b < s->mesh->n_blocks; ++b) share_losses_by_mass(s, b, sum[SUM_LEFT] / sum[SUM_FLUID]);
    extend_to_ghosts(s, 0, N_LOSS);
    visit_tiles(s, 0, heat_tile);
    return FLOE_OK;
}

/* Fluid points of a tile take their own losses. */
static void save_tile(mpm *s, int unused, int blk, int tile)
{
    (void)unused;
    const tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    double squares[MPM_MAX_WINDOW], *at_points = s->scratch->batch[thread_number()].energy;
    int loaded = -1;
    for (int body = 0; body < s->n_bodies; ++body) {
        const size_t *range = s->points[blk][body].tile_start + tile;
        const int group = s->body[body].group;
        if (!s->body[body].fluid || range[0] == range[1]) continue;
        const double *node = field_get(s->domain->fields[blk], N_LOSS, group, 0);
        if (loaded != group) load_window(s, blk, &box, &node, 1, squares);
        loaded = group;
        settle_body(s, blk, body, &box, range, squares, at_points, NULL);
    }
}

floe_status mpm_keep_losses(mpm *s)
{
    TRY(square_all(s));
    visit_tiles(s, 0, save_tile);
    return FLOE_OK;
}
