#include "embedded/cut_internal.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

/* Shares this close to none or all are that: round-off of sums of passages. */
static const double snap = 1e-13;

/* Solids that may overlap in a node of the mesh. */
enum { MOST_IN_A_NODE = 8 };

floe_status cut_create(cut_surface *c, context *ctx, const mesh *m)
{
    *c = (cut_surface){.ctx = ctx, .mesh = m};
    TRY(memory_new(ctx, &c->at, mesh_cells(m), sizeof *c->at));
    return memory_new(ctx, &c->node, (size_t)cut_nodes(m), sizeof *c->node);
}

void cut_destroy(cut_surface *c)
{
    if (!c->ctx) return;
    memory_free(c->ctx, &c->vertex);
    memory_free(c->ctx, &c->chain);
    memory_free(c->ctx, &c->triangle);
    memory_free(c->ctx, &c->cell);
    memory_free(c->ctx, &c->piece);
    memory_free(c->ctx, &c->at);
    memory_free(c->ctx, &c->node);
}

floe_status cut_grow(cut_surface *c, int which, void *array, size_t n, size_t size)
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
    TRY(cut_grow(c, CAPACITY_CHAINS, &c->chain, (size_t)chains, sizeof *c->chain));
    return cut_grow(c, CAPACITY_VERTICES, &c->vertex, (size_t)vertices, sizeof *c->vertex);
}

floe_status cut_reserve_triangles(cut_surface *c, int triangles)
{
    c->n_triangles = triangles;
    return cut_grow(c, CAPACITY_TRIANGLES, &c->triangle, (size_t)triangles, sizeof *c->triangle);
}

double cut_weight_to(const mesh *m, double x)
{
    return m->geometry == MESH_AXISYMMETRIC ? 0.5 * x * x : x;
}

floe_status cut_touch(cut_surface *c, const int cell[3], int *out)
{
    int *at = &c->at[cut_index(c->mesh, cell)];
    if (*at == CUT_NEW) {
        TRY(cut_grow(c, CAPACITY_CELLS, &c->cell, (size_t)c->n_cells, sizeof *c->cell));
        *at = c->n_cells;
        c->cell[c->n_cells++] = (cut_cell){.cell = {cell[0], cell[1], cell[2]}};
    }
    *out = *at;
    return FLOE_OK;
}

floe_status cut_add_piece(cut_surface *c, const int cell[3], const cut_piece *piece, const cut_part *part)
{
    int at;
    TRY(cut_touch(c, cell, &at));
    TRY(cut_grow(c, CAPACITY_PIECES, &c->piece, (size_t)c->n_pieces, sizeof *c->piece));
    c->piece[c->n_pieces] = *piece;
    c->piece[c->n_pieces++].cell = at;
    c->cell[at].open += part->volume;
    for (int a = 0; a < c->mesh->dim; ++a) c->cell[at].moment[a] += part->moment[a];
    return FLOE_OK;
}

static int jump_of(const cut_surface *c, int i, int j, int k, int axis, int which)
{
    const int at = c->at[cut_index(c->mesh, (const int[]){i, j, k})];
    return at >= 0 ? c->cell[at].jump[axis][which] : 0;
}

/* Numbers of all nodes, rising by one where a surface is passed into what it holds: from one corner of the mesh along its
 * lowest row and up the columns. Points on a line lie in its cells; of lines in the plane the passages through faces
 * tell. */
static void number_nodes(cut_surface *c)
{
    const int nx = c->mesh->n[0], ny = c->mesh->dim > 1 ? c->mesh->n[1] : 0, row = nx + 1;
    c->node[0] = 0;
    for (int i = 0; i < nx; ++i)
        c->node[i + 1] = (signed char)(c->node[i] - (c->mesh->dim > 1 ? jump_of(c, i, 0, 0, 1, SIDE_LOWER)
                                                                      : jump_of(c, i, 0, 0, 0, 0)));
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i <= nx; ++i) {
            const int jump = i < nx ? jump_of(c, i, j, 0, 0, SIDE_LOWER) : jump_of(c, nx - 1, j, 0, 0, SIDE_UPPER);
            c->node[(j + 1) * row + i] = (signed char)(c->node[j * row + i] + jump);
        }
}

/* Crossings of the edge that runs along an axis from a node. */
static int along_edge(const cut_surface *c, const int node[3], int axis)
{
    int cell[3], which = 0;
    for (int a = 0; a < 3; ++a) {
        const bool last = node[a] == c->mesh->n[a];
        cell[a] = last ? node[a] - 1 : node[a];
        if (last) which += a == (axis + 1) % 3 ? 1 : 2;
    }
    return jump_of(c, cell[0], cell[1], cell[2], axis, which);
}

/* The same in space: along one edge of the mesh, from there over one of its sides, and from there through it. */
static void number_nodes_in_space(cut_surface *c)
{
    const int *n = c->mesh->n;
    const ptrdiff_t row = n[0] + 1, layer = row * (n[1] + 1);
    c->node[0] = 0;
    for (int i = 0; i < n[0]; ++i)
        c->node[i + 1] = (signed char)(c->node[i] + along_edge(c, (const int[]){i, 0, 0}, 0));
    for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i <= n[0]; ++i)
            c->node[(j + 1) * row + i] = (signed char)(c->node[j * row + i] + along_edge(c, (const int[]){i, j, 0}, 1));
    for (int k = 0; k < n[2]; ++k)
        for (int j = 0; j <= n[1]; ++j)
            for (int i = 0; i <= n[0]; ++i) {
                const ptrdiff_t at = k * layer + j * row + i;
                c->node[at + layer] = (signed char)(c->node[at] + along_edge(c, (const int[]){i, j, k}, 2));
            }
}

int cut_nodes(const mesh *m)
{
    int nodes = 1;
    for (int a = 0; a < m->dim; ++a) nodes *= m->n[a] + 1;
    return nodes;
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

/* The volume inside surfaces that contain no node of the mesh; without its size. */
static double enclosed_volume(const cut_surface *c)
{
    double inside = 0.0;
    for (int k = 0; k < c->n_cells && c->mesh->dim < 3; ++k) inside += c->cell[k].open;
    for (int k = 0; k < c->n_pieces && c->mesh->dim == 3; ++k)
        inside += c->piece[k].area[0] * (cut_at_middle(c, &c->piece[k], 0) - c->mesh->lower[0]);
    return inside;
}

/* Whether nodes are inside: 1 or 0. In one dimension a node in two bodies has -1. */
static floe_status mark_nodes(cut_surface *c)
{
    const int nodes = cut_nodes(c->mesh);
    const int overlap = c->overlap > 0.0 ? MOST_IN_A_NODE : c->mesh->dim == 1;
    int least, most;
    if (c->mesh->dim == 3)
        number_nodes_in_space(c);
    else
        number_nodes(c);
    bound_nodes(c, nodes, &least, &most);
    if (most == least) { /* no boundary leaves its cell: they enclose the outside of themselves */
        most = least + (enclosed_volume(c) >= 0.0);
    }
    if (most - least > 1 + overlap)
        return fail(c->ctx, FLOE_RETRY, "a boundary of gas crosses itself or another: gas would lie on both its sides");
    for (int k = 0; k < nodes; ++k) c->node[k] = (signed char)(c->node[k] - most + 1);
    return c->mesh->dim == 1 ? cut_join_points(c) : FLOE_OK;
}

static double snapped(double share, double beyond, cut_shares *of)
{
    of->sound = of->sound && share >= -beyond && share <= 1.0 + beyond;
    of->overlap = of->overlap || share < -cut_crossing || share > 1.0 + cut_crossing;
    return share < snap ? 0.0 : share > 1.0 - snap ? 1.0 : share;
}

double cut_snapped_volume(const cut_surface *c, double share, cut_shares *of)
{
    return snapped(share, fmax(cut_crossing, c->overlap), of);
}

double cut_snapped_face(const cut_surface *c, double share, cut_shares *of)
{
    return snapped(share, c->overlap > 0.0 ? HUGE_VAL : cut_crossing, of);
}

/* Apertures and open fraction of a cell in the plane, from the sums over the pieces in it (Green; theory 7.1). */
static cut_shares finish_in_plane(const cut_surface *c, cut_cell *k)
{
    const mesh *m = c->mesh;
    const int row = m->n[0] + 1, *i = k->cell;
    const signed char *node = c->node + i[1] * row + i[0];
    const double across = cut_weight_to(m, mesh_node(m, 0, i[0] + 1)) - cut_weight_to(m, mesh_node(m, 0, i[0]));
    const double inside[2][2] = {{node[0], node[1]}, {node[0], node[row]}}; /* lower end of each face */
    cut_shares found = {.sound = true};
    double upper = 0.0;
    for (int axis = 0; axis < 2; ++axis)
        for (int side = 0; side < 2; ++side) {
            const double share = inside[axis][side] + k->face[axis][side] / (axis == 0 ? m->h[1] : across);
            k->face[axis][side] = cut_snapped_face(c, share, &found);
            if (axis == 0 && side == SIDE_UPPER)
                upper = fabs(share - k->face[axis][side]) > cut_crossing ? share : k->face[axis][side];
        }
    k->open = cut_snapped_volume(c, upper + k->open / (across * m->h[1]), &found);
    k->moment[0] /= across * m->h[1];
    k->moment[1] = (k->upper + k->moment[1] / across) / m->h[1];
    return found;
}

/* The same of a cell of a line: its faces are nodes. */
static cut_shares finish_on_line(const cut_surface *c, cut_cell *k)
{
    const signed char *node = c->node + k->cell[0];
    cut_shares found = {.sound = true};
    k->open = cut_snapped_volume(c, node[1] + k->open / c->mesh->h[0], &found);
    k->moment[0] /= c->mesh->h[0];
    for (int side = 0; side < 2; ++side) k->face[0][side] = node[side] > 0 ? 1.0 : 0.0;
    return found;
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
    const cut_shares found = c->mesh->dim == 1 ? finish_on_line(c, k) : finish_in_plane(c, k);
    k->overlap = found.overlap;
    if (found.sound) return check_thickness(c, k);
    return fail(c->ctx, FLOE_RETRY, "a boundary of gas crosses itself or another in cell (%d, %d), at (%g, %g)",
                k->cell[0], k->cell[1], mesh_centre(c->mesh, 0, k->cell[0]), mesh_centre(c->mesh, 1, k->cell[1]));
}

/* Checks a cell that no surface cuts: a node with a negative number lies in two bodies, by more than round-off. */
static floe_status finish_whole(const cut_surface *c, int i, int j, int k, int *out)
{
    const int node = node_of(c, (int)cut_node(c->mesh, (const int[]){i, j, k}));
    *out = node > 0 ? CUT_INSIDE : CUT_OUTSIDE;
    if (node >= 0) return FLOE_OK;
    return fail(c->ctx, FLOE_RETRY, "a boundary of gas crosses another at cell %d", i);
}

/* Around a periodic axis the last face of a row of cells is the first one again. */
static floe_status check_row_around(const cut_surface *c, int axis, int j, int k)
{
    int first[3] = {0, 0, 0}, last[3];
    double x[3] = {0.0};
    first[(axis + 1) % 3] = j;
    first[(axis + 2) % 3] = k;
    memcpy(last, first, sizeof last);
    last[axis] = c->mesh->n[axis] - 1;
    if (fabs(cut_face(c, first, axis, SIDE_LOWER) - cut_face(c, last, axis, SIDE_UPPER)) <= cut_crossing)
        return FLOE_OK;
    for (int a = 0; a < c->mesh->dim; ++a) x[a] = mesh_centre(c->mesh, a, first[a]);
    x[axis] = c->mesh->lower[axis];
    return fail(c->ctx, FLOE_RETRY,
                "a sharp surface does not go on across the periodic sides at (%g, %g, %g): let bodies end within the "
                "domain, or "
                "reach across it as wide on both sides",
                x[0], x[1], x[2]);
}

static floe_status check_around(const cut_surface *c)
{
    const int *n = c->mesh->n;
    for (int axis = 0; axis < c->mesh->dim; ++axis)
        for (int k = 0; c->mesh->periodic[axis] && k < n[(axis + 2) % 3]; ++k)
            for (int j = 0; j < n[(axis + 1) % 3]; ++j) TRY(check_row_around(c, axis, j, k));
    return FLOE_OK;
}

static void bring_around(cut_surface *c)
{
    for (int a = 0; a < c->mesh->dim; ++a)
        for (int k = 0; c->mesh->periodic[a] && k < c->n_vertices; ++k)
            c->vertex[k].x[a] = mesh_brought_around(c->mesh, a, c->vertex[k].x[a]);
}

floe_status cut_find(cut_surface *c)
{
    const mesh *m = c->mesh;
    const size_t cells = mesh_cells(m);
    bring_around(c);
    c->n_cells = c->n_pieces = 0;
    for (size_t k = 0; k < cells; ++k) c->at[k] = CUT_NEW;
    if (m->dim == 3) TRY(cut_triangles(c));
    for (int k = 0; k < c->n_chains; ++k)
        TRY(c->mesh->dim == 1 ? cut_point(c, &c->chain[k]) : cut_walk(c, &c->chain[k]));
    TRY(mark_nodes(c));
    if (m->dim == 3) TRY(cut_finish_in_space(c));
    for (int k = 0; k < c->n_cells && m->dim < 3; ++k) TRY(finish_cell(c, &c->cell[k]));
    if (c->overlap > 0.0 && m->dim == 2) {
        TRY(cut_free_corners(c, finish_cell));
        TRY(cut_shade_corners(c, finish_cell));
    }
    for (int k = 0; k < m->n[2]; ++k)
        for (int j = 0; j < m->n[1]; ++j)
            for (int i = 0; i < m->n[0]; ++i) {
                int *at = &c->at[cut_index(m, (const int[]){i, j, k})];
                if (*at == CUT_NEW) TRY(finish_whole(c, i, j, k, at));
            }
    if (c->overlap > 0.0) TRY(cut_close_contacts(c));
    return check_around(c);
}

static void hold_end(const cut_surface *from, int vertex, cut_surface *out)
{
    for (int a = 0; a < from->mesh->dim; ++a)
        if (cut_is_on_side(from->mesh, from->vertex[vertex].x[a], a))
            out->vertex[vertex].x[a] = from->vertex[vertex].x[a];
}

/* The same of the ends of a triangle's sides that no other joins. */
static void hold_rims(const cut_surface *from, const cut_triangle *t, cut_surface *out)
{
    for (int k = 0; k < 3; ++k) {
        if (!(t->rim >> k & 1)) continue;
        hold_end(from, t->vertex[k], out);
        hold_end(from, t->vertex[(k + 1) % 3], out);
    }
}

floe_status cut_ahead(const cut_surface *from, const double *velocity, double time, cut_surface *out)
{
    TRY(cut_reserve(out, from->n_vertices, from->n_chains));
    if (from->n_triangles > 0) TRY(cut_reserve_triangles(out, from->n_triangles));
    if (from->n_chains > 0) memcpy(out->chain, from->chain, (size_t)from->n_chains * sizeof *out->chain);
    if (from->n_triangles > 0) memcpy(out->triangle, from->triangle, (size_t)from->n_triangles * sizeof *out->triangle);
    for (int k = 0; k < from->n_vertices; ++k) {
        out->vertex[k].point = from->vertex[k].point;
        for (int a = 0; a < 3; ++a) out->vertex[k].x[a] = from->vertex[k].x[a] + time * velocity[3 * k + a];
    }
    for (int c = 0; c < from->n_chains; ++c) {
        const cut_chain *chain = &from->chain[c];
        if (chain->closed) continue;
        hold_end(from, chain->first, out);
        hold_end(from, chain->first + chain->n - 1, out);
    }
    for (int k = 0; k < from->n_triangles; ++k) hold_rims(from, &from->triangle[k], out);
    return cut_find(out);
}
