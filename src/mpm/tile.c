/* Sums from points to nodes: private sums in tiles, then nodes from tiles in global tile order (docs/structure.md, Tiles). */
#include "mpm/lanes.h"
#include "mpm/membrane/enclosed_gas.h"
#include "mpm/spring.h"
#include "mpm/surface/surface_markers.h"
#include "mpm/surface/traction.h"
#include "mpm/wall.h"

#include <math.h>
#include <string.h>

tile_box tile_box_of(const mesh *m, const block *b, int tile_in_block)
{
    tile_box t = {.cells = {1, 1, 1}};
    int rest = tile_in_block;
    for (int a = 0; a < MESH_MAX_DIM; ++a) {
        const int tile = b->tile_lo[a] + rest % b->tiles[a];
        rest /= b->tiles[a];
        t.first[a] = tile * m->tile[a];
        t.cells[a] = t.first[a] + m->tile[a] <= m->n[a] ? m->tile[a] : m->n[a] - t.first[a];
    }
    t.number = mesh_tile_of(m, t.first);
    return t;
}

void tile_nodes(const mesh *m, const tile_box *t, int end[MESH_MAX_DIM])
{
    for (int a = 0; a < MESH_MAX_DIM; ++a)
        end[a] = a < m->dim ? t->cells[a] + (t->first[a] + t->cells[a] == m->n[a] && !m->periodic[a] ? 1 : 0) : 1;
}

uint64_t cell_bit(const mesh *m, const tile_box *t, const point_arrays *p, size_t k)
{
    int bit = 0, row = 1;
    for (int a = 0; a < m->dim; ++a) {
        const int cell = mesh_cell_of(m, a, p->x[a][k]) - t->first[a];
        bit += row * (cell < 0 ? 0 : cell >= t->cells[a] ? t->cells[a] - 1 : cell);
        row *= mesh_tile_width(m->dim);
    }
    return UINT64_C(1) << bit;
}

uint64_t shared_cells(const mpm *s, int blk, int tile, const tile_box *t)
{
    bool any[2] = {false, false};
    for (int body = 0; body < s->n_bodies; ++body) {
        const size_t *at = s->points[blk][body].tile_start;
        if (at[tile] < at[tile + 1]) any[s->body[body].fluid] = true;
    }
    uint64_t shared = 0;
    for (int body = 0; any[0] && any[1] && body < s->n_bodies; ++body) {
        if (s->body[body].fluid) continue;
        const size_t *at = s->points[blk][body].tile_start;
        const point_arrays p = points_of(s, blk, body, false, false);
        for (size_t k = at[tile]; k < at[tile + 1]; ++k) shared |= cell_bit(s->mesh, t, &p, k);
    }
    return shared;
}

/* Sides beyond which velocities are extrapolated. */
static void set_sides(const mpm *s, int group, point_arrays *p)
{
    const mesh *m = s->mesh;
    for (int a = 0; a < m->dim; ++a) {
        const bool around = m->periodic[a];
        p->linear_side[a][SIDE_LOWER] =
            around || wall_mirrors(s, group, a, SIDE_LOWER) ? (double)-INFINITY : m->lower[a];
        p->linear_side[a][SIDE_UPPER] =
            around || wall_mirrors(s, group, a, SIDE_UPPER) ? (double)INFINITY : m->upper[a];
    }
}

/* What shapes the domains of points. */
static void set_domains(const mpm *s, const fields *f, int body, point_arrays *p)
{
    p->domain_limit = s->scene->method.domain_limit;
    for (int c = 0; keeps_shape(s, body) && c < field_component_count(FIELD_DEFORM, s->mesh->dim); ++c)
        p->deform[c] = field_get(f, P_F, body, c);
}

point_arrays points_of(const mpm *s, int blk, int body, bool next_stress, bool next_velocity)
{
    const fields *f = s->domain->fields[blk];
    point_arrays p = {0};
    for (int a = 0; a < s->mesh->dim; ++a) {
        p.x[a] = field_get(f, P_POS, body, a);
        p.v[a] = next_velocity ? field_next(f, P_VEL, body, a) : field_get(f, P_VEL, body, a);
        p.half[a] = field_get(f, keeps_box(s, body) ? P_BOX : P_HALF, body, a);
    }
    for (int c = 0; c < field_component_count(FIELD_STRESS, s->mesh->dim); ++c)
        p.stress[c] = next_stress ? field_next(f, P_STRESS, body, c) : field_get(f, P_STRESS, body, c);
    p.mass = field_get(f, s->work->burnt && s->body[body].burns ? P_MASS_LEFT : P_MASS, body, 0);
    p.volume0 = field_get(f, P_VOLUME0, body, 0);
    p.J = next_stress ? field_next(f, P_J, body, 0) : field_get(f, P_J, body, 0);
    p.q = next_stress ? field_next(f, P_VISCOUS_PRESSURE, body, 0) : field_get(f, P_VISCOUS_PRESSURE, body, 0);
    p.centred = s->body[body].fluid && s->basis->smoothness == 0;
    for (int c = 0; s->transfer->carry && c < s->mesh->dim * s->mesh->dim; ++c)
        p.affine[c] = next_velocity ? field_next(f, P_AFFINE, body, c) : field_get(f, P_AFFINE, body, c);
    if (s->basis->fact.shaped) set_domains(s, f, body, &p);
    set_sides(s, s->body[body].group, &p);
    p.enclosed_pressure = is_enclosed_gas(s, body) ? s->work->enclosure.pressure : 0.0;
    for (int a = 0; s->driven && a < s->mesh->dim; ++a) p.drive[a] = field_get(f, P_DRIVE, body, a);
    p.grid_pressure = field_get(f, P_GRID_PRESSURE, body, 0);
    memcpy(p.acceleration, s->work->acceleration[body], sizeof p.acceleration);
    return p;
}

/* Doubles that a scatter has for a node. */
static int record_of(scatter_mode mode, int dim)
{
    return (mode == SCATTER_FORCE ? 0 : lanes_of(1 + dim)) + (mode == SCATTER_MOMENTUM ? 0 : lanes_of(dim));
}

/* One tile's private sums. */
static void scatter_tile_sums(mpm *s, int group, int blk, int tile, scatter_mode mode, bool next_stress,
                              bool next_velocity)
{
    tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    box.shared = shared_cells(s, blk, tile, &box);
    double *out = domain_tile(s->domain, box.number);
    const size_t size = (size_t)s->work->window_nodes * (size_t)record_of(mode, s->mesh->dim);
    bool any = false;
    for (int body = 0; body < s->n_bodies; ++body) {
        const size_t *start = s->points[blk][body].tile_start;
        if (s->body[body].group != group || start[tile] == start[tile + 1]) continue;
        if (!any) memset(out, 0, size * sizeof(double));
        any = true;
        const point_arrays p = points_of(s, blk, body, next_stress, next_velocity);
        s->work->kernel.scatter[mode](s->mesh, &box, &p, start[tile], start[tile + 1], out);
    }
    s->work->active[box.number] = any;
}

/* Tiles whose windows hold global node index g along an axis: at most two; none where first > last. */
static void tiles_about(const mesh *m, int reach, int axis, int g, int *first, int *last)
{
    const int width = m->tile[axis];
    if (axis >= m->dim) {
        *first = *last = 0;
        return;
    }
    const int above = g - width - reach;
    *first = above <= 0 ? 0 : (above + width - 1) / width;
    *last = g + reach < 0 ? -1 : (g + reach) / width;
    if (*last > m->tiles[axis] - 1) *last = m->tiles[axis] - 1;
}

static node_target target_of(const mpm *s, int blk, int group, scatter_mode mode)
{
    const fields *f = s->domain->fields[blk];
    const int dim = s->mesh->dim;
    node_target t = {.components = record_of(mode, dim), .reach = s->work->reach};
    memcpy(t.window, s->work->window, sizeof t.window);
    double **force = t.array;
    if (mode != SCATTER_FORCE) {
        t.array[0] = field_get(f, N_MASS, group, 0);
        for (int a = 0; a < dim; ++a) t.array[1 + a] = field_get(f, N_MOMENTUM, group, a);
        force += lanes_of(1 + dim);
    }
    for (int a = 0; mode != SCATTER_MOMENTUM && a < dim; ++a) force[a] = field_get(f, N_FORCE, group, a);
    return t;
}

/* Adds the part of a tile's window row (global node j, k) that lies in a block's nodes. */
static void add_row(const mpm *s, const block *b, const node_target *out, const int tile[3], int j, int k)
{
    const mesh *m = s->mesh;
    const int reach = out->reach, *window = out->window;
    const int x0 = tile[0] * m->tile[0] - reach;
    const int lo = x0 > b->lo[0] - 1 ? x0 : b->lo[0] - 1;
    const int end = x0 + window[0], top = b->lo[0] + b->n[0] + 2;
    const int hi = end < top ? end : top;
    const int row_j = m->dim > 1 ? j - (tile[1] * m->tile[1] - reach) : 0;
    const int row_k = m->dim > 2 ? k - (tile[2] * m->tile[2] - reach) : 0;
    const int number = tile[0] + m->tiles[0] * (tile[1] + m->tiles[1] * tile[2]);
    if (!s->work->active[number]) return;
    const double *from = domain_tile(s->domain, number) +
                         ((ptrdiff_t)(row_k * window[1] + row_j) * window[0] + (lo - x0)) * (ptrdiff_t)out->components;
    const ptrdiff_t to = mesh_index(b, lo - b->lo[0], j - b->lo[1], k - b->lo[2]);
    for (int c = 0; c < out->components; ++c) {
        if (!out->array[c]) continue;
        double *restrict a = out->array[c] + to;
        if (out->largest)
            for (int i = 0; i < hi - lo; ++i) a[i] = fmax(a[i], from[i * out->components + c]);
        else
            for (int i = 0; i < hi - lo; ++i) a[i] += from[i * out->components + c];
    }
}

static void gather_row(const mpm *s, const block *b, const node_target *out, int j, int k)
{
    const mesh *m = s->mesh;
    const int reach = out->reach;
    int y0, y1, z0, z1, x0, x1, unused;
    tiles_about(m, reach, 1, j, &y0, &y1);
    tiles_about(m, reach, 2, k, &z0, &z1);
    tiles_about(m, reach, 0, b->lo[0] - 1, &x0, &unused);
    tiles_about(m, reach, 0, b->lo[0] + b->n[0] + 1, &unused, &x1);
    const ptrdiff_t at = mesh_index(b, -1, j - b->lo[1], k - b->lo[2]);
    for (int c = 0; c < out->components; ++c)
        for (int i = 0; out->array[c] && i < b->n[0] + 3; ++i)
            out->array[c][at + i] = out->largest ? (double)-INFINITY : 0.0;
    for (int z = z0; z <= z1; ++z)
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) add_row(s, b, out, (const int[]){x, y, z}, j, k);
}

node_target node_target_of(const mpm *s, int blk, int group, const field_id *id, int count)
{
    node_target to = {.reach = s->work->reach};
    for (int k = 0; k < count; ++k)
        for (int c = 0; c < field_component_count(field_describe(id[k])->components, s->mesh->dim); ++c)
            to.array[to.components++] = field_get(s->domain->fields[blk], id[k], group, c);
    memcpy(to.window, s->work->window, sizeof to.window);
    return to;
}

void visit_tiles(mpm *s, int group, tile_visitor *visit)
{
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
#pragma omp parallel for schedule(dynamic, 4)
        for (int t = 0; t < s->mesh->block[b].n_tiles; ++t) visit(s, group, b, t);
    }
}

void gather_nodes(const mpm *s, int blk, const node_target *out)
{
    const mesh *m = s->mesh;
    const block *b = &m->block[blk];
    const int rows = m->dim > 1 ? b->n[1] + 3 : 1, planes = m->dim > 2 ? b->n[2] + 3 : 1;
#pragma omp parallel for schedule(static) collapse(2)
    for (int k = 0; k < planes; ++k)
        for (int j = 0; j < rows; ++j)
            gather_row(s, b, out, m->dim > 1 ? b->lo[1] + j - 1 : 0, m->dim > 2 ? b->lo[2] + k - 1 : 0);
}

floe_status scatter_group(mpm *s, int group, scatter_mode mode, bool next_stress, bool next_velocity)
{
    const mesh *m = s->mesh;
    for (int b = 0; b < m->n_blocks; ++b) {
#pragma omp parallel for schedule(dynamic, 4)
        for (int t = 0; t < m->block[b].n_tiles; ++t)
            scatter_tile_sums(s, group, b, t, mode, next_stress, next_velocity);
    }
    domain_share_partials(s->domain);
    for (int b = 0; b < m->n_blocks; ++b) {
        const node_target out = target_of(s, b, group, mode);
        gather_nodes(s, b, &out);
    }
    if (mode != SCATTER_FORCE) {
        domain_fold_periodic(s->domain, N_MASS, group);
        domain_fold_periodic(s->domain, N_MOMENTUM, group);
        fold_walls(s, group, true, false);
    }
    if (mode != SCATTER_MOMENTUM) scatter_loads(s, group);
    return FLOE_OK;
}

void scatter_loads(mpm *s, int group)
{
    scatter_surfaces(s, group); /* they look at the masses */
    scatter_springs(s, group);
    scatter_membrane_force(s, group);
    if (!s->implicit) scatter_markers(s, group, s->work->markers.force);
    scatter_enclosed_pressure(s, group);
    fold_forces(s, group);
}

void fold_forces(mpm *s, int group)
{
    domain_fold_periodic(s->domain, N_FORCE, group);
    fold_walls(s, group, false, true);
}

/* to[i count + c] = node[c][from + i] for n nodes and a literal count of components. */
FLOE_ALWAYS_INLINE void copy_nodes(const double *const *node, ptrdiff_t from, double *restrict to, int n,
                                   const int count)
{
    const double *a[MPM_MAX_RECORD];
    for (int c = 0; c < count; ++c) a[c] = node[c] + from;
    for (int i = 0; i < n; ++i, to += count)
        for (int c = 0; c < count; ++c) to[c] = a[c][i];
}

void load_window(const mpm *s, int blk, const tile_box *t, const double *const *node, int count, double *window)
{
    const mesh *m = s->mesh;
    const block *b = &m->block[blk];
    const int reach = s->work->reach, *size = s->work->window;
    int nodes[MESH_MAX_DIM] = {1, 1, 1}, first[MESH_MAX_DIM] = {0, 0, 0};
    for (int a = 0; a < m->dim; ++a) {
        nodes[a] = t->cells[a] + 1 + 2 * reach;
        first[a] = t->first[a] - reach - b->lo[a];
    }
    for (int k = 0; k < nodes[2]; ++k)
        for (int j = 0; j < nodes[1]; ++j) {
            const ptrdiff_t from = mesh_index(b, first[0], first[1] + j, first[2] + k);
            double *to = window + (ptrdiff_t)((k * size[1] + j) * size[0]) * count;
            if (count == 1) copy_nodes(node, from, to, nodes[0], 1);
            if (count == 2) copy_nodes(node, from, to, nodes[0], 2);
            if (count == 4) copy_nodes(node, from, to, nodes[0], 4);
            if (count == 8) copy_nodes(node, from, to, nodes[0], 8);
        }
}
