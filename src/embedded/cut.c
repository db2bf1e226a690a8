#include "embedded/cut.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CUT_NEW = -3 };
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

/* Room for one more than n items, growing by half. */
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

/* Integral of the weight of an area along axis 0: x, or about an axis r^2/2. */
static double weight_to(const mesh *m, double x)
{
    return m->geometry == MESH_AXISYMMETRIC ? 0.5 * x * x : x;
}

/* The cut cell at a global cell, made where it is new. */
static floe_status touch(cut_surface *c, const int cell[2], int *out)
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

static floe_status add_piece(cut_surface *c, const int cell[2], const int vertex[2], const double from[2],
                             const double to[2], double share)
{
    int at;
    TRY(touch(c, cell, &at));
    TRY(grow(c, CAPACITY_PIECES, &c->piece, (size_t)c->n_pieces, sizeof *c->piece));
    const double radius = c->mesh->geometry == MESH_AXISYMMETRIC ? 0.5 * (from[0] + to[0]) : 1.0;
    c->piece[c->n_pieces++] = (cut_piece){.cell = at,
                                          .vertex = {vertex[0], vertex[1]},
                                          .share = share,
                                          .area = {radius * (to[1] - from[1]), -radius * (to[0] - from[0])}};
    /* Green's theorem: the piece's part of the held volume, right of the cell's lower side. */
    const double left = weight_to(c->mesh, mesh_node(c->mesh, 0, cell[0])), middle = 0.5 * (from[0] + to[0]);
    const double mean =
        (weight_to(c->mesh, from[0]) + 4.0 * weight_to(c->mesh, middle) + weight_to(c->mesh, to[0])) / 6.0;
    c->cell[at].open += (mean - left) * (to[1] - from[1]);
    return FLOE_OK;
}

/* The line passes through the face on a side of a cell, at x, upwards along the axis or (direction -1) downwards. Held
 * is what lies on its left: of a face across axis 0 the part above x, of one across axis 1 the part below. */
static void pass(cut_surface *c, int at, int axis, int side, const double x[2], int direction)
{
    const mesh *m = c->mesh;
    cut_cell *k = &c->cell[at];
    k->jump[axis][side] += direction;
    if (axis == 0) {
        k->face[0][side] += direction * (mesh_node(m, 1, k->cell[1] + 1) - x[1]);
    } else {
        k->face[1][side] -= direction * (weight_to(m, mesh_node(m, 0, k->cell[0] + 1)) - weight_to(m, x[0]));
    }
}

static void cell_of(const mesh *m, const double x[2], int cell[2])
{
    for (int a = 0; a < 2; ++a) {
        const int i = mesh_cell_of(m, a, x[a]);
        cell[a] = i < 0 ? 0 : i >= m->n[a] ? m->n[a] - 1 : i;
    }
}

/* Share of the way from a to b at which the side of a cell towards b lies. */
static double way_to(const mesh *m, const double a[2], const double b[2], int axis, int node)
{
    const double t = (mesh_node(m, axis, node) - a[axis]) / (b[axis] - a[axis]);
    return t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
}

/* Kept on the sides of a cell, so that passages lie on their faces whatever round-off does. */
static double within(const mesh *m, int axis, int cell, double x)
{
    return fmin(fmax(x, mesh_node(m, axis, cell)), mesh_node(m, axis, cell + 1));
}

/* From one vertex to the next, cell by cell. */
static floe_status walk(cut_surface *c, const int vertex[2])
{
    const mesh *m = c->mesh;
    const double *a = c->vertex[vertex[0]].x, *b = c->vertex[vertex[1]].x;
    int cell[2], last[2];
    double from[2] = {a[0], a[1]}, before = 0.0;
    cell_of(m, a, cell);
    cell_of(m, b, last);
    while (cell[0] != last[0] || cell[1] != last[1]) {
        double t = INFINITY;
        int axis = 0;
        for (int k = 0; k < 2; ++k) {
            if (cell[k] == last[k]) continue;
            const double to = way_to(m, a, b, k, last[k] > cell[k] ? cell[k] + 1 : cell[k]);
            if (!(to < t)) continue;
            t = to;
            axis = k;
        }
        const int step = last[axis] > cell[axis] ? 1 : -1, other = 1 - axis;
        double x[2];
        x[axis] = mesh_node(m, axis, step > 0 ? cell[axis] + 1 : cell[axis]);
        x[other] = within(m, other, cell[other], a[other] + t * (b[other] - a[other]));
        TRY(add_piece(c, cell, vertex, from, x, 0.5 * (before + t)));
        int at;
        TRY(touch(c, cell, &at));
        pass(c, at, axis, step > 0 ? SIDE_UPPER : SIDE_LOWER, x, step);
        cell[axis] += step;
        TRY(touch(c, cell, &at));
        pass(c, at, axis, step > 0 ? SIDE_LOWER : SIDE_UPPER, x, step);
        from[0] = x[0];
        from[1] = x[1];
        before = t;
    }
    return add_piece(c, cell, vertex, from, b, 0.5 * (before + 1.0));
}

/* An end of an open line passes through the side of the mesh on which it lies; inward at the first vertex. */
static floe_status pass_side(cut_surface *c, int vertex, int inward)
{
    const mesh *m = c->mesh;
    const double *x = c->vertex[vertex].x;
    int cell[2], at;
    cell_of(m, x, cell);
    TRY(touch(c, cell, &at));
    for (int axis = 0; axis < 2; ++axis)
        for (int side = 0; side < 2; ++side) {
            if (x[axis] != (side == SIDE_LOWER ? m->lower[axis] : m->upper[axis])) continue;
            pass(c, at, axis, side, x, side == SIDE_LOWER ? inward : -inward);
            return FLOE_OK;
        }
    return fail(
        c->ctx, FLOE_BAD_INPUT,
        "a line that holds gas back ends at (%g, %g), inside the domain: let it end on a symmetry or slip side, or "
        "close it",
        x[0], x[1]);
}

static floe_status walk_chain(cut_surface *c, const cut_chain *chain)
{
    const int last = chain->first + chain->n - 1;
    for (int k = chain->first; k < last; ++k) TRY(walk(c, (const int[]){k, k + 1}));
    if (chain->closed) return walk(c, (const int[]){last, chain->first});
    TRY(pass_side(c, chain->first, 1));
    return pass_side(c, last, -1);
}

static int jump_of(const cut_surface *c, int i, int j, int axis, int side)
{
    const int at = c->at[cut_index(c->mesh, (const int[]){i, j})];
    return at >= 0 ? c->cell[at].jump[axis][side] : 0;
}

/* Which nodes are held, from one corner of the mesh along its lowest row and up the columns. */
static floe_status mark_nodes(cut_surface *c)
{
    const int nx = c->mesh->n[0], ny = c->mesh->n[1], row = nx + 1;
    int least = 0, most = 0;
    c->node[0] = 0;
    for (int i = 0; i < nx; ++i) c->node[i + 1] = (signed char)(c->node[i] - jump_of(c, i, 0, 1, SIDE_LOWER));
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i <= nx; ++i) {
            const int jump = i < nx ? jump_of(c, i, j, 0, SIDE_LOWER) : jump_of(c, nx - 1, j, 0, SIDE_UPPER);
            c->node[(j + 1) * row + i] = (signed char)(c->node[j * row + i] + jump);
        }
    for (int k = 0; k < row * (ny + 1); ++k) {
        least = c->node[k] < least ? c->node[k] : least;
        most = c->node[k] > most ? c->node[k] : most;
    }
    if (most == least) { /* no line leaves its cell: they hold what they go round the other way */
        double inside = 0.0;
        for (int k = 0; k < c->n_cells; ++k) inside += c->cell[k].open;
        least -= inside < 0.0;
    }
    if (most - least > 1)
        return fail(c->ctx, FLOE_RETRY,
                    "a line that holds gas back crosses itself or another: gas would lie on both its sides");
    for (int k = 0; k < row * (ny + 1); ++k) c->node[k] = (signed char)(c->node[k] - least);
    return FLOE_OK;
}

static double snapped(double share, bool *sound)
{
    *sound = *sound && share >= -crossing && share <= 1.0 + crossing;
    return share < snap ? 0.0 : share > 1.0 - snap ? 1.0 : share;
}

/* Shares of a cell from what the walk has gathered. */
static floe_status finish_cell(cut_surface *c, cut_cell *k)
{
    const mesh *m = c->mesh;
    const int row = m->n[0] + 1, *i = k->cell;
    const signed char *node = c->node + i[1] * row + i[0];
    const double across = weight_to(m, mesh_node(m, 0, i[0] + 1)) - weight_to(m, mesh_node(m, 0, i[0]));
    const double held[2][2] = {{node[0], node[1]}, {node[0], node[row]}}; /* lower end of each face */
    bool sound = true;
    for (int axis = 0; axis < 2; ++axis)
        for (int side = 0; side < 2; ++side)
            k->face[axis][side] =
                snapped(held[axis][side] + k->face[axis][side] / (axis == 0 ? m->h[1] : across), &sound);
    k->open = snapped(k->face[0][SIDE_UPPER] + k->open / (across * m->h[1]), &sound);
    if (sound) return FLOE_OK;
    return fail(c->ctx, FLOE_RETRY, "a line that holds gas back crosses itself or another in cell (%d, %d)", i[0],
                i[1]);
}

floe_status cut_find(cut_surface *c)
{
    const mesh *m = c->mesh;
    const size_t cells = (size_t)m->n[0] * (size_t)m->n[1];
    c->n_cells = c->n_pieces = 0;
    for (size_t k = 0; k < cells; ++k) c->at[k] = CUT_NEW;
    for (int k = 0; k < c->n_chains; ++k) TRY(walk_chain(c, &c->chain[k]));
    TRY(mark_nodes(c));
    for (int k = 0; k < c->n_cells; ++k) TRY(finish_cell(c, &c->cell[k]));
    for (int j = 0; j < m->n[1]; ++j)
        for (int i = 0; i < m->n[0]; ++i) {
            int *at = &c->at[cut_index(m, (const int[]){i, j})];
            if (*at == CUT_NEW) *at = c->node[j * (m->n[0] + 1) + i] ? CUT_HELD : CUT_OUTSIDE;
        }
    return FLOE_OK;
}

/* On an axis whose side an end lies on, it stays there. */
static bool is_held(const mesh *m, double x, int axis)
{
    return x == m->lower[axis] || x == m->upper[axis];
}

static void hold_end(const cut_surface *from, int vertex, cut_surface *out)
{
    for (int a = 0; a < 2; ++a)
        if (is_held(from->mesh, from->vertex[vertex].x[a], a)) out->vertex[vertex].x[a] = from->vertex[vertex].x[a];
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

static void middle_of(const cut_surface *c, const cut_piece *q, double x[2])
{
    for (int a = 0; a < 2; ++a)
        x[a] = (1.0 - q->share) * c->vertex[q->vertex[0]].x[a] + q->share * c->vertex[q->vertex[1]].x[a];
}

/* Pieces of neighbouring sides meet at a corner, however sharp. */
static bool is_near_along(const cut_piece *q, const cut_piece *r)
{
    return abs(q->vertex[0] - r->vertex[0]) <= 2 || q->vertex[0] == r->vertex[1] || q->vertex[1] == r->vertex[0];
}

/* Each has the other ahead, on the side that is not held. */
static bool are_back_to_back(const cut_surface *c, const cut_piece *q, const cut_piece *r)
{
    double from[2], to[2];
    middle_of(c, q, from);
    middle_of(c, r, to);
    const double way[2] = {to[0] - from[0], to[1] - from[1]}, least = 1e-6 * c->mesh->h[0];
    const double length_q = hypot(q->area[0], q->area[1]), length_r = hypot(r->area[0], r->area[1]);
    return q->area[0] * r->area[0] + q->area[1] * r->area[1] < -0.1 * length_q * length_r &&
           way[0] * q->area[0] + way[1] * q->area[1] > least * length_q &&
           way[0] * r->area[0] + way[1] * r->area[1] < -least * length_r;
}

bool cut_is_thin(const cut_surface *c, double x[2])
{
    for (int n = 0; n < c->n_pieces; ++n)
        for (int k = n + 1; k < c->n_pieces; ++k) {
            const cut_piece *q = &c->piece[n], *r = &c->piece[k];
            if (q->cell != r->cell || is_near_along(q, r) || !are_back_to_back(c, q, r)) continue;
            middle_of(c, q, x);
            return true;
        }
    return false;
}
