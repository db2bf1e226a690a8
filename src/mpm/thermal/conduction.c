/* Conduction of heat in solids on the nodes, explicit (theory 12.3): C_i dT_i/dt = -sum_p V_p k grad S_ip . grad T(x_p), and what
 * sides give. The flows of each point sum to zero over its nodes, so that heat is kept to round-off whatever the basis. */
#include "grid/tile_box.h"
#include "mpm/nodes/ghosts.h"
#include "mpm/surface/boundary.h"
#include "mpm/surface/surface_markers.h"
#include "mpm/thermal/temperature_gradient.h"
#include "mpm/thermal/thermal.h"
#include "mpm/transfer/kernels.h"
#include "mpm/transfer/point_arrays.h"
#include "mpm/transfer/scratch.h"
#include "mpm/transfer/spread.h"
#include "mpm/transfer/windows.h"
#include "scene/formula.h"
#include "scene/solid_heat.h"

#include <math.h>
#include <string.h>

/* Of the largest stable step by Gershgorin's circles in the worst place, a point of GIMP at the edge of its domain. */
static const double SAFE_SHARE = 0.25;

static const double RELAXATION = 1.0;

/* Of the square of a cell over the diffusivity that a solid would have with the conductivity of the fluid beside it. */
static const double WALL_SHARE = 0.125;

/* ---- steps ---- */

/* m2/s: at rest. */
static double diffusivity_of(const mpm *s, const mpm_body *b)
{
    return b->conductivity / (s->scene->material[b->scene_material].density * b->specific_heat);
}

bool takes_wall_heat(const mpm *s)
{
    return scene_heat_passes_walls(s->scene);
}

/* The fluid that conducts best, over a quarter of a cell, warms the half cell of a solid behind its surface: no further than itself. */
double mpm_wall_heat_step(const mpm *s)
{
    double best = 0.0, least = INFINITY, inverse_square = 0.0;
    if (!takes_wall_heat(s)) return INFINITY;
    for (int m = 0; m < s->scene->n_materials; ++m)
        if (s->scene->material[m].kind == MATERIAL_FLUID) best = fmax(best, s->scene->material[m].conductivity);
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->body[b].conductivity > 0.0)
            least = fmin(least, s->scene->material[s->body[b].scene_material].density * s->body[b].specific_heat);
    for (int a = 0; a < s->mesh->dim; ++a) inverse_square += 1.0 / (s->mesh->h[a] * s->mesh->h[a]);
    return WALL_SHARE * least / (best * inverse_square);
}

double conduction_step(const mpm *s, int *body)
{
    double fastest = 0.0, inverse_square = 0.0;
    for (int a = 0; a < s->mesh->dim; ++a) inverse_square += 1.0 / (s->mesh->h[a] * s->mesh->h[a]);
    for (int b = 0; b < s->n_bodies; ++b) {
        const mpm_body *m = &s->body[b];
        const double diffusivity = m->warms ? diffusivity_of(s, m) : 0.0;
        if (diffusivity > fastest) *body = m->scene_body;
        fastest = fmax(fastest, diffusivity);
    }
    return fastest > 0.0 ? SAFE_SHARE / (fastest * inverse_square) : (double)INFINITY;
}

/* Differences between points that nodes do not see decay as the shortest waves that they do see: dT/dt = -4 a dT/h^2, a the diffusivity. The
 * least of the group is taken, and all its points share it. */
double conduction_relaxation(const mpm *s, int group)
{
    double least = INFINITY, inverse_square = 0.0;
    for (int a = 0; a < s->mesh->dim; ++a) inverse_square += 1.0 / (s->mesh->h[a] * s->mesh->h[a]);
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->body[b].group == group && heat_goes_to_nodes(s, b)) least = fmin(least, diffusivity_of(s, &s->body[b]));
    return isinf(least) ? 0.0 : fmin(1.0, RELAXATION * least * inverse_square * s->dt);
}

/* ---- inside ---- */

/* Heat that flows in at the nodes of point k (W). */
static void conduct_at_point(const mpm *s, const tile_frame *frame, const point_arrays *p, size_t k,
                             double conductivity, const double *T, double *out)
{
    const int dim = s->mesh->dim, basis = basis_number(s->basis);
    const double scale = -conductivity * p->volume0[k] * p->J[k];
    double g[3];
    stencils at;
    locate(&at, s->mesh, frame, p, k, 1, dim, basis);
    temperature_gradient(&at, T, dim, basis, g);
    for (int a = 0; a < 3; ++a) g[a] *= scale;
    FOR_PIECES(j, 0, dim, basis)
    FOR_ROWS(at, j, dim, basis, {
        double across = 0.0;
        if (dim > 1) across += g[1] * at.dw[1][y_][j] * (dim > 2 ? at.w[2][z_][j] : 1.0);
        if (dim > 2) across += g[2] * at.w[1][y_][j] * at.dw[2][z_][j];
        for (int x = 0; x < basis_support(basis); ++x)
            out[row + x] += g[0] * W * at.dw[0][x][j] + across * at.w[0][x][j];
    });
}

/* ---- walls with a heat flux ---- */

/* Whether cell `cell` of a tile is the last before a side. */
static bool is_before_side(const mesh *m, int axis, int side, int cell)
{
    return !m->periodic[axis] && cell == (side == SIDE_LOWER ? 0 : m->n[axis] - 1);
}

/* Area (m2) of a side that point k covers: its volume over the width of its cell; about an axis at the side's radius. */
static double covered_area(const mesh *m, const point_arrays *p, size_t k, int axis, const double wall[3])
{
    const double area = p->volume0[k] * p->J[k] / m->h[axis];
    return m->geometry == MESH_AXISYMMETRIC && axis == 0 ? area * wall[0] / p->x[0][k] : area;
}

/* What a point in the last cell before a wall gets, at the nodes of its place on the wall. Returns the heat (W). */
static floe_status heat_by_wall(const mpm *s, const tile_box *box, const point_arrays *p, size_t k, int axis, int side,
                                double *out, double *sum)
{
    const mesh *m = s->mesh;
    double x[3] = {0.0, 0.0, 0.0}, flux;
    for (int a = 0; a < m->dim; ++a) x[a] = p->x[a][k];
    x[axis] = side == SIDE_LOWER ? m->lower[axis] : m->upper[axis];
    const bc_side *wall = wall_with_heat_flux(s, axis, side, x);
    if (!wall) return FLOE_OK;
    TRY(scene_number(s->scene, &wall->heat_flux, x, s->time + 0.5 * s->dt, &flux));
    point_arrays at = *p;
    for (int a = 0; a < m->dim; ++a) {
        at.x[a] = &x[a];
        at.half[a] = p->half[a] ? p->half[a] + k : NULL;
    }
    for (int c = 0; c < 9; ++c) at.deform[c] = p->deform[c] ? p->deform[c] + k : NULL;
    const double power = flux * covered_area(m, p, k, axis, x);
    spread_numbers(s, box, &at, 0, &power, 1, out);
    *sum += power;
    return FLOE_OK;
}

static floe_status heat_by_walls(const mpm *s, const tile_box *box, const point_arrays *p, size_t k, double *out,
                                 double *sum)
{
    for (int a = 0; a < s->mesh->dim; ++a) {
        const int cell = mesh_cell_of(s->mesh, a, p->x[a][k]);
        for (int side = 0; side < 2; ++side)
            if (is_before_side(s->mesh, a, side, cell)) TRY(heat_by_wall(s, box, p, k, a, side, out, sum));
    }
    return FLOE_OK;
}

/* ---- the stage ---- */

static void conduct_in_tile(mpm *s, int group, int blk, int tile)
{
    const tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    const tile_frame frame = frame_of(s->mesh, &box, s->mesh->dim);
    const double *node = field_get(s->domain->fields[blk], N_TEMP, group, 0);
    const bool walls = some_wall_gives_heat(s);
    double T[MPM_MAX_WINDOW], *out = domain_tile(s->domain, box.number), *sum = s->scratch->tile_sum + 2 * box.number;
    bool any = false;
    for (int body = 0; body < s->n_bodies; ++body) {
        const size_t *range = s->points[blk][body].tile_start + tile;
        const mpm_body *b = &s->body[body];
        if (b->group != group || !(b->conductivity > 0.0) || range[0] == range[1]) continue;
        if (!any) {
            load_window(s, blk, &box, &node, 1, T);
            memset(out, 0, (size_t)s->windows->window_nodes * sizeof *out);
        }
        any = true;
        const point_arrays p = points_of(s, blk, body, false, false);
        for (size_t k = range[0]; k < range[1]; ++k) {
            conduct_at_point(s, &frame, &p, k, b->conductivity, T, out);
            if (walls && heat_by_walls(s, &box, &p, k, out, &sum[0]) != FLOE_OK) sum[1] = 1.0;
        }
    }
    s->windows->active[box.number] = any;
}

/* dT_i = dt Q_i / C_i. */
static void warm_nodes(const mpm *s, int blk, int group)
{
    const fields *f = s->domain->fields[blk];
    const double *restrict capacity = field_get(f, N_CAPACITY, group, 0);
    double *restrict change = field_get(f, N_TEMP_CHANGE, group, 0);
    for (size_t k = 0; k < s->mesh->block[blk].size; ++k)
        change[k] = capacity[k] > 0.0 ? s->dt * change[k] / capacity[k] : 0.0;
}

floe_status mpm_conduct(mpm *s)
{
    double sum[2];
    memset(s->scratch->tile_sum, 0, 2 * mesh_tiles(s->mesh) * sizeof *s->scratch->tile_sum);
    for (int g = 0; g < s->n_groups; ++g) {
        if (!group_gives_heat(s, g)) continue;
        TRY(set_side_temperatures(s, g, s->time));
        extend_to_ghosts(s, g, N_TEMP);
        visit_tiles(s, g, conduct_in_tile);
        gather_unfolded(s, g, (const field_id[]){N_TEMP_CHANGE}, 1);
        if (takes_wall_heat(s)) scatter_marker_heat(s, g);
        if (s->windows->reach > 0) fold_numbers(s, g, N_TEMP_CHANGE);
        for (int b = 0; b < s->mesh->n_blocks; ++b) warm_nodes(s, b, g);
    }
    domain_sum_tiles(s->mesh, s->scratch->tile_sum, 2, sum);
    if (sum[1] > 0.0) return FLOE_BAD_INPUT; /* a formula without a value: the message stands */
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_BOUNDARY, s->dt * sum[0]);
    return FLOE_OK;
}
