#include "embedded/cut_internal.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

enum { CAPACITY_VERTICES, CAPACITY_CELLS, CAPACITY_PIECES, CAPACITY_CHAINS };

/* Shares this close to none or all are that: round-off of sums of passages. */
static const double snap = 1e-13;
/* Lines that cross hold more than all of a cell, or less than none, by more than this: bodies of a deck touch to some nine digits. */
static const double crossing = 1e-6;

floe_status cut_create(cut_surface *c, context *ctx, const mesh *m)
{
    *c = (cut_surface){.ctx = ctx, .mesh = m};
    TRY(memory_new(ctx, &c->at, (size_t)m->n[0] * (size_t)m->n[1], sizeof *c->at));
    return memory_new(ctx, &c->node, (size_t)(m->n[0] + 1) * (size_t)(m->n[1] + 1), sizeof *c->node);
}

void cut_destroy(cut_surface *c)
{
    if (!c->ctx) return;
    memory_free(c->ctx, &c->vertex);
    memory_free(c->ctx, &c->chain);
    memory_free(c->ctx, &c->cell);
    memory_free(c->ctx, &c->piece);
    memory_free(c->ctx, &c->at);
    memory_free(c->ctx, &c->node);
}

/* Space for one more than n items, growing by half. */
static floe_status grow(cut_surface *c, int which, void *array, size_t n, size_t size)
{
    if (n < c->capacity[which]) return FLOE_OK;
    const size_t wanted = n + n / 2 + 64;
    TRY(memory_resize(c->ctx, array, wanted, size));
    c->capacity[which] = wanted;
    return FLOE_OK;
}

floe_status cut_reserve(cut_surface *c, int vertices, int chains)
{
    c->n_vertices = vertices;
    c->n_chains = chains;
    TRY(grow(c, CAPACITY_CHAINS, &c->chain, (size_t)chains, sizeof *c->chain));
    return grow(c, CAPACITY_VERTICES, &c->vertex, (size_t)vertices, sizeof *c->vertex);
}

double cut_weight_to(const mesh *m, double x)
{
    return m->geometry == MESH_AXISYMMETRIC ? 0.5 * x * x : x;
}

floe_status cut_touch(cut_surface *c, const int cell[2], int *out)
{
    int *at = &c->at[cut_index(c->mesh, cell)];
    if (*at == CUT_NEW) {
        TRY(grow(c, CAPACITY_CELLS, &c->cell, (size_t)c->n_cells, sizeof *c->cell));
        *at = c->n_cells;
        c->cell[c->n_cells++] = (cut_cell){.cell = {cell[0], cell[1]}};
    }
    *out = *at;
    return FLOE_OK;
}

floe_status cut_add_piece(cut_surface *c, const int cell[2], const cut_piece *piece, const cut_part *part)
{
    int at;
    TRY(cut_touch(c, cell, &at));
    TRY(grow(c, CAPACITY_PIECES, &c->piece, (size_t)c->n_pieces, sizeof *c->piece));
    c->piece[c->n_pieces] = *piece;
    c->piece[c->n_pieces++].cell = at;
    c->cell[at].open += part->volume;
    for (int a = 0; a < 2; ++a) c->cell[at].moment[a] += part->moment[a];
    return FLOE_OK;
}

static int jump_of(const cut_surface *c, int i, int j, int axis, int side)
{
    const int at = c->at[cut_index(c->mesh, (const int[]){i, j})];
    return at >= 0 ? c->cell[at].jump[axis][side] : 0;
}

/* Numbers of all nodes, rising by one where a surface is passed into what it holds: from one corner of the mesh along its
 * lowest row and up the columns. Points on a line lie in its cells; of lines in the plane the passages through faces
 * tell. */
static void number_nodes(cut_surface *c)
{
    const int nx = c->mesh->n[0], ny = c->mesh->dim > 1 ? c->mesh->n[1] : 0, row = nx + 1;
    c->node[0] = 0;
    for (int i = 0; i < nx; ++i)
        c->node[i + 1] =
            (signed char)(c->node[i] - (c->mesh->dim > 1 ? jump_of(c, i, 0, 1, SIDE_LOWER) : jump_of(c, i, 0, 0, 0)));
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i <= nx; ++i) {
            const int jump = i < nx ? jump_of(c, i, j, 0, SIDE_LOWER) : jump_of(c, nx - 1, j, 0, SIDE_UPPER);
            c->node[(j + 1) * row + i] = (signed char)(c->node[j * row + i] + jump);
        }
}

static int node_of(const cut_surface *c, int k)
{
    return (int)c->node[k];
}

/* Least and most of the numbers. */
static void bound_nodes(const cut_surface *c, int n, int *least, int *most)
{
    *least = *most = node_of(c, 0);
    for (int k = 1; k < n; ++k) {
        *least = node_of(c, k) < *least ? node_of(c, k) : *least;
        *most = node_of(c, k) > *most ? node_of(c, k) : *most;
    }
}

/* Which nodes are inside: 1, or 0. In one dimension a node that lies in two bodies has -1. */
static floe_status mark_nodes(cut_surface *c)
{
    const int nodes = (c->mesh->n[0] + 1) * (c->mesh->dim > 1 ? c->mesh->n[1] + 1 : 1);
    const int overlap = c->mesh->dim == 1;
    int least, most;
    number_nodes(c);
    bound_nodes(c, nodes, &least, &most);
    if (most == least) { /* no boundary leaves its cell: they enclose the outside of themselves */
        double inside = 0.0;
        for (int k = 0; k < c->n_cells; ++k) inside += c->cell[k].open;
        most = least + (inside >= 0.0);
    }
    if (most - least > 1 + overlap)
        return fail(c->ctx, FLOE_RETRY, "a boundary of gas crosses itself or another: gas would lie on both its sides");
    for (int k = 0; k < nodes; ++k) c->node[k] = (signed char)(c->node[k] - most + 1);
    return overlap ? cut_join_points(c) : FLOE_OK;
}

static double snapped_share(double share, bool *sound)
{
    *sound = *sound && share >= -crossing && share <= 1.0 + crossing;
    return share < snap ? 0.0 : share > 1.0 - snap ? 1.0 : share;
}

/* Shares of a cell of the plane from what the walk has gathered. */
static bool finish_in_plane(const cut_surface *c, cut_cell *k)
{
    const mesh *m = c->mesh;
    const int row = m->n[0] + 1, *i = k->cell;
    const signed char *node = c->node + i[1] * row + i[0];
    const double across = cut_weight_to(m, mesh_node(m, 0, i[0] + 1)) - cut_weight_to(m, mesh_node(m, 0, i[0]));
    const double inside[2][2] = {{node[0], node[1]}, {node[0], node[row]}}; /* lower end of each face */
    bool sound = true;
    for (int axis = 0; axis < 2; ++axis)
        for (int side = 0; side < 2; ++side)
            k->face[axis][side] =
                snapped_share(inside[axis][side] + k->face[axis][side] / (axis == 0 ? m->h[1] : across), &sound);
    k->open = snapped_share(k->face[0][SIDE_UPPER] + k->open / (across * m->h[1]), &sound);
    k->moment[0] /= across * m->h[1];
    k->moment[1] = (k->upper + k->moment[1] / across) / m->h[1];
    return sound;
}

/* The same of a cell of a line: its faces are nodes. */
static bool finish_on_line(const cut_surface *c, cut_cell *k)
{
    const signed char *node = c->node + k->cell[0];
    bool sound = true;
    k->open = snapped_share(node[1] + k->open / c->mesh->h[0], &sound);
    k->moment[0] /= c->mesh->h[0];
    for (int side = 0; side < 2; ++side) k->face[0][side] = node[side] > 0 ? 1.0 : 0.0;
    return sound;
}

/* Gas on two sides of a solid in one cell would share it: so much is left of a solid that is pressed together. */
static floe_status check_thickness(const cut_surface *c, const cut_cell *k)
{
    if (c->mesh->dim > 1 || k->open == 1.0 || !(k->face[0][SIDE_LOWER] * k->face[0][SIDE_UPPER] > 0.0)) return FLOE_OK;
    return fail(
        c->ctx, FLOE_RETRY,
        "a solid lies inside one cell, at %g, where the gas of its two sides would share it: refine domain.cell",
        mesh_centre(c->mesh, 0, k->cell[0]));
}

static floe_status finish_cell(cut_surface *c, cut_cell *k)
{
    if (c->mesh->dim == 1 ? finish_on_line(c, k) : finish_in_plane(c, k)) return check_thickness(c, k);
    return fail(c->ctx, FLOE_RETRY, "a boundary of gas crosses itself or another in cell (%d, %d)", k->cell[0],
                k->cell[1]);
}

/* A cell that no surface cuts: of it a node below none lies in two bodies, by more than round-off. */
static floe_status finish_whole(const cut_surface *c, int i, int j, int *out)
{
    const int node = node_of(c, j * (c->mesh->n[0] + 1) + i);
    *out = node > 0 ? CUT_INSIDE : CUT_OUTSIDE;
    if (node >= 0) return FLOE_OK;
    return fail(c->ctx, FLOE_RETRY, "a boundary of gas crosses another at cell %d", i);
}

floe_status cut_find(cut_surface *c)
{
    const mesh *m = c->mesh;
    const size_t cells = (size_t)m->n[0] * (size_t)m->n[1];
    c->n_cells = c->n_pieces = 0;
    for (size_t k = 0; k < cells; ++k) c->at[k] = CUT_NEW;
    for (int k = 0; k < c->n_chains; ++k)
        TRY(c->mesh->dim == 1 ? cut_point(c, &c->chain[k]) : cut_walk(c, &c->chain[k]));
    TRY(mark_nodes(c));
    for (int k = 0; k < c->n_cells; ++k) TRY(finish_cell(c, &c->cell[k]));
    for (int j = 0; j < m->n[1]; ++j)
        for (int i = 0; i < m->n[0]; ++i) {
            int *at = &c->at[cut_index(m, (const int[]){i, j})];
            if (*at == CUT_NEW) TRY(finish_whole(c, i, j, at));
        }
    return FLOE_OK;
}

/* On an axis whose side an end lies on, it stays there. */
static bool is_on_side(const mesh *m, double x, int axis)
{
    return x == m->lower[axis] || x == m->upper[axis];
}

static void hold_end(const cut_surface *from, int vertex, cut_surface *out)
{
    for (int a = 0; a < 2; ++a)
        if (is_on_side(from->mesh, from->vertex[vertex].x[a], a)) out->vertex[vertex].x[a] = from->vertex[vertex].x[a];
}

floe_status cut_ahead(const cut_surface *from, const double *velocity, double time, cut_surface *out)
{
    TRY(cut_reserve(out, from->n_vertices, from->n_chains));
    memcpy(out->chain, from->chain, (size_t)from->n_chains * sizeof *out->chain);
    for (int k = 0; k < from->n_vertices; ++k) {
        out->vertex[k].point = from->vertex[k].point;
        for (int a = 0; a < 2; ++a) out->vertex[k].x[a] = from->vertex[k].x[a] + time * velocity[2 * k + a];
    }
    for (int c = 0; c < from->n_chains; ++c) {
        const cut_chain *chain = &from->chain[c];
        if (chain->closed) continue;
        hold_end(from, chain->first, out);
        hold_end(from, chain->first + chain->n - 1, out);
    }
    return cut_find(out);
}
