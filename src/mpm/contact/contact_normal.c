/* Normals of bodies at the nodes where they meet. */
#include "grid/tile_box.h"
#include "mpm/contact/contact.h"
#include "mpm/nodes/ghosts.h"
#include "mpm/transfer/point_arrays.h"
#include "mpm/transfer/windows.h"

#include <string.h>

/* Calls `visit` for the nodes of a tile, its upper ones included, at which two groups have mass; true if there are
 * any. */
typedef void node_visitor(const mpm *s, const int node[MESH_MAX_DIM]);

static bool visit_meetings(const mpm *s, int blk, const tile_box *t, node_visitor *visit)
{
    const mesh *m = s->mesh;
    const block *b = &m->block[blk];
    bool any = false;
    const int nodes[MESH_MAX_DIM] = {t->cells[0] + 1, m->dim > 1 ? t->cells[1] + 1 : 1,
                                     m->dim > 2 ? t->cells[2] + 1 : 1};
    for (int k = 0; k < nodes[2]; ++k)
        for (int j = 0; j < nodes[1]; ++j)
            for (int i = 0; i < nodes[0]; ++i) {
                const int node[MESH_MAX_DIM] = {t->first[0] + i, t->first[1] + j, t->first[2] + k};
                const ptrdiff_t at = mesh_index(b, node[0] - b->lo[0], node[1] - b->lo[1], node[2] - b->lo[2]);
                int groups = 0;
                for (int g = 0; g < s->n_groups; ++g)
                    groups += field_get(s->domain->fields[blk], N_MASS, g, 0)[at] > 0.0;
                if (groups < 2) continue;
                any = true;
                if (visit) visit(s, node);
            }
    return any;
}

/* Marks the cells from which points reach a node: those from two below it to one above. */
static void mark_cells(const mpm *s, const int node[MESH_MAX_DIM])
{
    const mesh *m = s->mesh;
    int lo[MESH_MAX_DIM] = {0, 0, 0}, hi[MESH_MAX_DIM] = {0, 0, 0};
    for (int a = 0; a < m->dim; ++a) {
        lo[a] = node[a] - 2;
        hi[a] = node[a] + 1;
    }
    for (int k = lo[2]; k <= hi[2]; ++k)
        for (int j = lo[1]; j <= hi[1]; ++j)
            for (int i = lo[0]; i <= hi[0]; ++i) {
                int cell[MESH_MAX_DIM] = {i, j, k}, bit = 0, row = 1;
                bool inside = true;
                for (int a = 0; a < m->dim; ++a) {
                    cell[a] = mesh_index_around(m, a, cell[a]);
                    inside = inside && cell[a] >= 0 && cell[a] < m->n[a];
                    bit += row * (cell[a] % m->tile[a]);
                    row *= mesh_tile_width(m->dim);
                }
                if (inside) s->contact->near[mesh_tile_of(m, cell)] |= UINT64_C(1) << bit;
            }
}

static void find_meetings(mpm *s)
{
    const mesh *m = s->mesh;
    memset(s->contact->near, 0, mesh_tiles(m) * sizeof *s->contact->near);
    for (int b = 0; b < m->n_blocks; ++b) {
#pragma omp parallel for schedule(dynamic, 8)
        for (int t = 0; t < m->block[b].n_tiles; ++t) {
            const tile_box box = tile_box_of(m, &m->block[b], t);
            s->windows->active[box.number] = visit_meetings(s, b, &box, NULL);
        }
        for (int t = 0; t < m->block[b].n_tiles; ++t) {
            const tile_box box = tile_box_of(m, &m->block[b], t);
            if (s->windows->active[box.number]) visit_meetings(s, b, &box, mark_cells);
        }
    }
}

bool contact_is_near(const mpm *s, const tile_box *t, const point_arrays *p, size_t k)
{
    return (s->contact->near[t->number] & cell_bit(s->mesh, t, p, k)) != 0;
}

/* Adds what one point gives to the window of its tile. */
static void scatter_normal_of_point(const mpm *s, const tile_box *t, const point_arrays *p, size_t k, double *window)
{
    const mesh *m = s->mesh;
    const struct mpm_contact *c = s->contact;
    normal_weights w[MESH_MAX_DIM];
    int first[MESH_MAX_DIM] = {0, 0, 0};
    for (int a = 0; a < MESH_MAX_DIM; ++a) w[a] = (normal_weights){.n = 1, .w = {1.0}};
    for (int a = 0; a < m->dim; ++a) {
        const double inv_h = 1.0 / m->h[a], at = (p->x[a][k] - m->lower[a]) * inv_h - t->first[a];
        int cell = (int)at;
        cell = cell < 0 ? 0 : cell >= t->cells[a] ? t->cells[a] - 1 : cell;
        w[a] = c->normal->weights(s->basis, at - cell, p->half[a] ? p->half[a][k] * inv_h : 0.5, inv_h);
        first[a] = cell + w[a].first + c->normal->reach;
    }
    for (int z = 0; z < w[2].n; ++z)
        for (int y = 0; y < w[1].n; ++y)
            for (int x = 0; x < w[0].n; ++x) {
                const int node = first[0] + x + c->window[0] * (first[1] + y + c->window[1] * (first[2] + z));
                const double slope[MESH_MAX_DIM] = {w[0].dw[x] * w[1].w[y] * w[2].w[z],
                                                    w[0].w[x] * w[1].dw[y] * w[2].w[z],
                                                    w[0].w[x] * w[1].w[y] * w[2].dw[z]};
                double *out = window + (ptrdiff_t)node * (1 + m->dim);
                out[0] += p->volume0[k] * w[0].w[x] * w[1].w[y] * w[2].w[z];
                for (int a = 0; a < m->dim; ++a) out[1 + a] += p->volume0[k] * slope[a];
            }
}

static void scatter_normals_of_tile(mpm *s, int group, int blk, int tile)
{
    const tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    double *out = domain_tile(s->domain, box.number);
    bool any = false;
    for (int body = 0; s->contact->near[box.number] != 0 && body < s->n_bodies; ++body) {
        const size_t *start = s->points[blk][body].tile_start;
        if (s->body[body].group != group || start[tile] == start[tile + 1]) continue;
        if (!any) memset(out, 0, contact_partials(s) * sizeof *out);
        any = true;
        const point_arrays p = points_of(s, blk, body, false, false);
        for (size_t k = start[tile]; k < start[tile + 1]; ++k)
            if (contact_is_near(s, &box, &p, k)) scatter_normal_of_point(s, &box, &p, k, out);
    }
    s->windows->active[box.number] = any;
}

static void gather_normals(const mpm *s, int group)
{
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        node_target to = {.components = 1 + s->mesh->dim, .reach = s->contact->normal->reach};
        memcpy(to.window, s->contact->window, sizeof to.window);
        to.array[0] = field_get(s->domain->fields[b], N_COLOUR, group, 0);
        for (int a = 0; a < s->mesh->dim; ++a) to.array[1 + a] = field_get(s->domain->fields[b], N_NORMAL, group, a);
        gather_nodes(s, b, &to);
    }
}

/* -grad phi/phi. */
static void divide_by_colour(const mpm *s, int blk, int group)
{
    const fields *f = s->domain->fields[blk];
    const double *restrict colour = field_get(f, N_COLOUR, group, 0);
    const size_t n = s->mesh->block[blk].size;
    for (int a = 0; a < s->mesh->dim; ++a) {
        double *restrict normal = field_get(f, N_NORMAL, group, a);
#pragma omp parallel for simd schedule(static)
        for (size_t k = 0; k < n; ++k) normal[k] = colour[k] > 0.0 ? normal[k] / colour[k] : 0.0;
    }
}

floe_status mpm_contact_normals(mpm *s)
{
    find_meetings(s);
    for (int g = 0; g < s->n_groups; ++g) {
        visit_tiles(s, g, scatter_normals_of_tile);
        domain_share_partials(s->domain);
        gather_normals(s, g);
        domain_fold_periodic(s->domain, N_COLOUR, g);
        domain_fold_periodic(s->domain, N_NORMAL, g);
        fold_field(s, g, N_COLOUR);
        fold_field(s, g, N_NORMAL);
        for (int b = 0; b < s->mesh->n_blocks; ++b) divide_by_colour(s, b, g);
    }
    return FLOE_OK;
}
