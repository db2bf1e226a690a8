/* Sums from tiles to nodes: private sums in tiles, then nodes from tiles in global tile order (docs/structure.md, Tiles). */
#include "mpm/transfer/windows.h"

#include "base/memory.h"
#include "grid/tile_box.h"
#include "mpm/transfer/kernels.h"
#include "mpm/transfer/lanes.h"

#include <math.h>
#include <string.h>

floe_status windows_create(mpm *s)
{
    const mesh *m = s->mesh;
    TRY(memory_new(s->ctx, &s->windows, 1, sizeof *s->windows));
    struct mpm_windows *w = s->windows;
    w->kernel = kernels_of(m->dim, m->geometry, s->basis);
    w->reach = s->basis->reach;
    w->window_nodes = 1;
    for (int a = 0; a < MESH_MAX_DIM; ++a) {
        w->window[a] = a < m->dim ? m->tile[a] + 1 + 2 * w->reach : 1;
        w->window_nodes *= w->window[a];
    }
    return memory_new(s->ctx, &w->active, mesh_tiles(m), sizeof *w->active);
}

void windows_free(mpm *s)
{
    if (s->windows) memory_free(s->ctx, &s->windows->active);
    memory_free(s->ctx, &s->windows);
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

/* Adds the part of a tile's window row (global node j, k) that lies in a block's nodes. */
static void add_window_row(const mpm *s, const block *b, const node_target *out, const int tile[3], int j, int k)
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
    if (!s->windows->active[number]) return;
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
            for (int x = x0; x <= x1; ++x) add_window_row(s, b, out, (const int[]){x, y, z}, j, k);
}

node_target node_target_of(const mpm *s, int blk, int group, const field_id *id, int count)
{
    node_target to = {.reach = s->windows->reach};
    for (int k = 0; k < count; ++k)
        for (int c = 0; c < field_component_count(field_describe(id[k])->components, s->mesh->dim); ++c)
            to.array[to.components++] = field_get(s->domain->fields[blk], id[k], group, c);
    memcpy(to.window, s->windows->window, sizeof to.window);
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
    const int reach = s->windows->reach, *size = s->windows->window;
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
