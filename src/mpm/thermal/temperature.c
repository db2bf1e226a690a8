/* Temperatures from points to nodes and back (theory 12.2). A point gives its nodes the linear field T_p + g_p (x_i - x_p), which without
 * conduction is T_p alone, and takes the change of the nodes: sum_p m_p c dT_p = sum_i C_i dT_i to round-off. */
#include "base/threads.h"
#include "grid/tile_box.h"
#include "mpm/nodes/ghosts.h"
#include "mpm/thermal/temperature_gradient.h"
#include "mpm/thermal/thermal.h"
#include "mpm/transfer/kernels.h"
#include "mpm/transfer/locate.h"
#include "mpm/transfer/point_arrays.h"
#include "mpm/transfer/scratch.h"
#include "mpm/transfer/spread.h"
#include "mpm/transfer/windows.h"

#include <math.h>
#include <string.h>

bool has_temperature(const mpm *s)
{
    return s->carries[P_TEMP];
}

bool conducts(const mpm *s)
{
    return s->carries[P_TEMP_GRADIENT];
}

bool dissipates_heat(const mpm *s, int body)
{
    const mpm_body *b = &s->body[body];
    return b->warms && (b->law->needs & SOLID_HAS_ENERGY) && !motion_is_given(&s->scene->body[b->scene_body].motion);
}

bool heat_goes_to_nodes(const mpm *s, int body)
{
    return s->body[body].warms && (s->body[body].conductivity > 0.0 || s->cells == CELLS_SMEARED);
}

bool group_gives_heat(const mpm *s, int group)
{
    for (int b = 0; b < s->n_bodies; ++b)
        if ((group < 0 || s->body[b].group == group) && heat_goes_to_nodes(s, b)) return true;
    return false;
}

/* ---- from points to nodes ---- */

/* What point k gives its nodes: capacity, heat, and heat times the gradient where the body conducts; `count` numbers a node. */
static void give_heat(const mpm *s, const tile_frame *frame, const point_arrays *p, size_t k, double capacity,
                      double temperature, const double gradient[3], int count, double *window)
{
    const int dim = s->mesh->dim, basis = basis_number(s->basis);
    const double *h = s->mesh->h;
    stencils at;
    locate(&at, s->mesh, frame, p, k, 1, dim, basis);
    FOR_PIECES(j, 0, dim, basis)
    FOR_ROWS(at, j, dim, basis, {
        double level = temperature + gradient[0] * at.offset[0][j];
        if (dim > 1) level += gradient[1] * (at.offset[1][j] + y_ * h[1]);
        if (dim > 2) level += gradient[2] * (at.offset[2][j] + z_ * h[2]);
        for (int x = 0; x < basis_support(basis); ++x) {
            const double share = capacity * W * at.w[0][x][j];
            double *node = window + count * (ptrdiff_t)(row + x);
            node[0] += share;
            node[1] += share * (level + gradient[0] * (x * h[0]));
            for (int c = 2; c < count; ++c) node[c] += share * gradient[c - 2];
        }
    });
}

static int numbers_of(const mpm *s)
{
    return conducts(s) ? 2 + s->mesh->dim : 2;
}

static void give_heat_of_tile(mpm *s, int group, int blk, int tile)
{
    const tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    const tile_frame frame = frame_of(s->mesh, &box, s->mesh->dim);
    const fields *f = s->domain->fields[blk];
    const int count = numbers_of(s);
    double *out = domain_tile(s->domain, box.number);
    bool any = false;
    for (int body = 0; body < s->n_bodies; ++body) {
        const size_t *range = s->points[blk][body].tile_start + tile;
        if (s->body[body].group != group || !heat_goes_to_nodes(s, body) || range[0] == range[1]) continue;
        if (!any) memset(out, 0, (size_t)count * (size_t)s->windows->window_nodes * sizeof *out);
        any = true;
        const point_arrays p = points_of(s, blk, body, false, false);
        const double *T = field_get(f, P_TEMP, body, 0);
        for (size_t k = range[0]; k < range[1]; ++k) {
            double gradient[3] = {0.0, 0.0, 0.0};
            for (int a = 0; a < s->mesh->dim && s->body[body].conductivity > 0.0; ++a)
                gradient[a] = field_get(f, P_TEMP_GRADIENT, body, a)[k];
            give_heat(s, &frame, &p, k, p.all_mass[k] * s->body[body].specific_heat, T[k], gradient, count, out);
        }
    }
    s->windows->active[box.number] = any;
}

/* T_i = (C_i T_i) / C_i; no change so far. */
static void divide_heat(const mpm *s, int blk, int group)
{
    const fields *f = s->domain->fields[blk];
    const double *restrict capacity = field_get(f, N_CAPACITY, group, 0), *restrict heat =
                                                                              field_get(f, N_HEAT, group, 0);
    double *restrict T = field_get(f, N_TEMP, group, 0), *restrict change = field_get(f, N_TEMP_CHANGE, group, 0);
    for (size_t k = 0; k < s->mesh->block[blk].size; ++k) {
        T[k] = capacity[k] > 0.0 ? heat[k] / capacity[k] : 0.0;
        change[k] = 0.0;
    }
}

floe_status mpm_heat_to_nodes(mpm *s)
{
    static const field_id id[] = {N_CAPACITY, N_HEAT, N_HEAT_GRADIENT};
    for (int g = 0; g < s->n_groups; ++g) {
        visit_tiles(s, g, give_heat_of_tile);
        gather_unfolded(s, g, id, conducts(s) ? 3 : 2);
        if (s->windows->reach > 0) fold_field(s, g, N_CAPACITY);
        if (conducts(s))
            fold_linear(s, g, N_HEAT, N_HEAT_GRADIENT);
        else if (s->windows->reach > 0)
            fold_field(s, g, N_HEAT);
        for (int b = 0; b < s->mesh->n_blocks; ++b) divide_heat(s, b, g);
    }
    return FLOE_OK;
}

/* ---- from nodes to points ---- */

/* Nodes of a tile: dT, and T at the end of the step. */
typedef struct heat_window {
    double change[MPM_MAX_WINDOW], end[MPM_MAX_WINDOW];
} heat_window;

/* Points take the changes of their nodes, and a share of what they differ from them by: differences that nodes do not see are
 * conducted away as well. All points of the group do, so that the sum of their heat is that of the nodes. */
static void warm_points(const mpm *s, int blk, int body, const tile_box *box, const size_t range[2],
                        const point_arrays *p, const heat_window *w, double *scratch)
{
    const fields *f = s->domain->fields[blk];
    const double *T = field_get(f, P_TEMP, body, 0);
    double *next = field_next(f, P_TEMP, body, 0);
    const double relaxed = conduction_relaxation(s, s->body[body].group);
    s->windows->kernel->sample(s->mesh, box, p, range[0], range[1], w->change, next + range[0]);
    for (size_t k = range[0]; k < range[1]; ++k) next[k] += T[k];
    for (size_t k = range[0], stop; relaxed > 0.0 && k < range[1]; k = stop) {
        stop = k + SOLID_CHUNK < range[1] ? k + SOLID_CHUNK : range[1];
        s->windows->kernel->sample(s->mesh, box, p, k, stop, w->end, scratch);
        for (size_t i = k; i < stop; ++i) next[i] += relaxed * (scratch[i - k] - next[i]);
    }
}

static void take_gradients(const mpm *s, int blk, int body, const tile_box *box, const size_t range[2],
                           const point_arrays *p, const heat_window *w)
{
    const int dim = s->mesh->dim, basis = basis_number(s->basis);
    const fields *f = s->domain->fields[blk];
    const tile_frame frame = frame_of(s->mesh, box, dim);
    for (size_t k = range[0]; k < range[1]; ++k) {
        double gradient[3];
        stencils at;
        locate(&at, s->mesh, &frame, p, k, 1, dim, basis);
        temperature_gradient(&at, w->end, dim, basis, gradient);
        for (int a = 0; a < dim; ++a) field_next(f, P_TEMP_GRADIENT, body, a)[k] = gradient[a];
    }
}

static void take_heat_of_tile(mpm *s, int group, int blk, int tile)
{
    const tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    const fields *f = s->domain->fields[blk];
    const double *change = field_get(f, N_TEMP_CHANGE, group, 0), *end = field_get(f, N_TEMP, group, 0);
    heat_window w;
    bool loaded = false;
    for (int body = 0; body < s->n_bodies; ++body) {
        const size_t *range = s->points[blk][body].tile_start + tile;
        if (s->body[body].group != group || !heat_goes_to_nodes(s, body) || range[0] == range[1]) continue;
        if (!loaded) {
            load_window(s, blk, &box, &change, 1, w.change);
            load_window(s, blk, &box, &end, 1, w.end);
        }
        loaded = true;
        const point_arrays p = points_of(s, blk, body, false, false);
        warm_points(s, blk, body, &box, range, &p, &w, s->scratch->batch[thread_number()].energy);
        if (s->body[body].conductivity > 0.0) take_gradients(s, blk, body, &box, range, &p, &w);
    }
}

/* The heat of a body's own stress, and what it had where nodes do not change it. */
static void add_own_heat(const mpm *s, int blk, int body)
{
    const fields *f = s->domain->fields[blk];
    const double *made = field_get(f, P_DISSIPATED, body, 0), over_c = 1.0 / s->body[body].specific_heat;
    double *next = field_next(f, P_TEMP, body, 0);
    const size_t n = s->points[blk][body].n;
    if (!heat_goes_to_nodes(s, body)) memcpy(next, field_get(f, P_TEMP, body, 0), n * sizeof *next);
    for (size_t k = 0; made && k < n; ++k) next[k] += made[k] * over_c;
}

/* T_i at the end of the step: that of the points and the change, whatever a side's temperature was at its start. */
static void advance_nodes(const mpm *s, int blk, int group)
{
    const fields *f = s->domain->fields[blk];
    const double *restrict capacity = field_get(f, N_CAPACITY, group, 0),
                           *restrict heat = field_get(f, N_HEAT, group, 0),
                           *restrict change = field_get(f, N_TEMP_CHANGE, group, 0);
    double *restrict T = field_get(f, N_TEMP, group, 0);
    for (size_t k = 0; k < s->mesh->block[blk].size; ++k)
        T[k] = capacity[k] > 0.0 ? heat[k] / capacity[k] + change[k] : 0.0;
}

static floe_status take_heat_of_group(mpm *s, int group)
{
    if (!group_gives_heat(s, group)) return FLOE_OK;
    if (conducts(s)) TRY(impose_side_temperatures(s, group));
    for (int b = 0; b < s->mesh->n_blocks; ++b) advance_nodes(s, b, group);
    extend_to_ghosts(s, group, N_TEMP);
    extend_to_ghosts(s, group, N_TEMP_CHANGE);
    visit_tiles(s, group, take_heat_of_tile);
    return FLOE_OK;
}

floe_status mpm_heat_to_points(mpm *s)
{
    for (int g = 0; g < s->n_groups; ++g) TRY(take_heat_of_group(s, g));
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int body = 0; body < s->n_bodies; ++body)
            if (s->body[body].warms) add_own_heat(s, b, body);
    return FLOE_OK;
}
