/* Marching squares on a grid finer than the mesh's, with the crossings found by bisection instead of interpolation. */
#include "geom/contour.h"

#include "geom/contour_internal.h"
#include "geom/layer.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A crossing of the surface with a side of a sub-box, by the side's number in the whole grid. */
typedef struct crossing {
    size_t side;
    double x[2];
} crossing;

/* From where the surface enters the inside of a sub-box's border, going round it, to where it leaves it again. */
typedef struct piece {
    crossing end[2];
    bool used;
} piece;

typedef struct tracer {
    context *ctx;
    const shape *shape;
    const seed_spec *grid;
    int divide;
    double tolerance; /* m: a corner this near is on the surface, and counts as inside */
    piece *piece;     /* owned */
    size_t n, reserved;
} tracer;

static double plane_level_at(const tracer *t, const double x[2])
{
    return shape_level(t->shape, t->grid->dim, (const double[3]){x[0], x[1], 0.0});
}

static bool is_inside_shape(const tracer *t, const double x[2])
{
    return plane_level_at(t, x) <= t->tolerance;
}

/* Place of corner i of the sub-boxes along an axis: neighbours compute the same bits. */
static double corner_coordinate(const tracer *t, int axis, int i)
{
    const seed_spec *g = t->grid;
    const int cell = i / t->divide, part = i % t->divide;
    return g->lower[axis] + g->h[axis] * (cell + (double)part / t->divide);
}

/* Where the surface lies between a corner inside and one outside. Asked as corners are, so that a side along the
 * surface ends where it does. */
static void find_crossing(const tracer *t, const double inside[2], const double outside[2], double x[2])
{
    const double from[3] = {inside[0], inside[1], 0.0}, to[3] = {outside[0], outside[1], 0.0};
    double middle[3], lo = shape_crossing(t->shape, t->grid->dim, t->tolerance, from, to, 60, middle);
    if (lo < 1e-7) lo = 0.0; /* the corner itself, but for the tolerance */
    for (int a = 0; a < 2; ++a) x[a] = inside[a] + lo * (outside[a] - inside[a]);
}

static floe_status add_segment(tracer *t, const crossing *from, const crossing *to)
{
    if (t->n == t->reserved) {
        t->reserved = t->reserved ? 2 * t->reserved : 256;
        TRY(memory_resize(t->ctx, &t->piece, t->reserved, sizeof *t->piece));
    }
    t->piece[t->n++] = (piece){{*from, *to}, false};
    return FLOE_OK;
}

/* The sides of a sub-box in the order of going round it, left turns: corner k lies before side k. */
static const int corner_of[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

/* Number of side k of sub-box (i, j): of the lower left corner of the side, twice, and 1 more where it goes up. */
static size_t side_number(const tracer *t, int i, int j, int k)
{
    const size_t row = (size_t)t->grid->n[0] * (size_t)t->divide + 1;
    const int x = i + (k == 1), y = j + (k == 2);
    return 2 * ((size_t)y * row + (size_t)x) + (size_t)(k % 2);
}

static floe_status trace_surface_in_box(tracer *t, int i, int j)
{
    double corner[4][2];
    bool inside[4];
    crossing enters[2], leaves[2];
    int n_in = 0, n_out = 0;
    for (int k = 0; k < 4; ++k) {
        for (int a = 0; a < 2; ++a) corner[k][a] = corner_coordinate(t, a, (a == 0 ? i : j) + corner_of[k][a]);
        inside[k] = is_inside_shape(t, corner[k]);
    }
    for (int k = 0; k < 4; ++k) {
        const int next = (k + 1) % 4;
        if (inside[k] == inside[next]) continue;
        crossing *c = inside[next] ? &enters[n_in++] : &leaves[n_out++];
        c->side = side_number(t, i, j, k);
        find_crossing(t, corner[inside[k] ? k : next], corner[inside[k] ? next : k], c->x);
    }
    if (n_in == 0) return FLOE_OK;
    if (n_in == 1) return add_segment(t, &enters[0], &leaves[0]);
    /* Two opposite corners are inside: are they one? Going round, an entry is followed by the leave of the same
     * corner. */
    const double centre[2] = {0.5 * (corner[0][0] + corner[2][0]), 0.5 * (corner[0][1] + corner[2][1])};
    const bool one = is_inside_shape(t, centre), first = inside[0]; /* the first crossing met is a leave */
    for (int k = 0; k < 2; ++k) TRY(add_segment(t, &enters[k], &leaves[(one == first) ? k : 1 - k]));
    return FLOE_OK;
}

/* Sub-boxes of a cell, unless the surface is farther from its centre than its corners are. */
static floe_status trace_surface_in_cell(tracer *t, int i, int j)
{
    const seed_spec *g = t->grid;
    const double centre[2] = {g->lower[0] + (i + 0.5) * g->h[0], g->lower[1] + (j + 0.5) * g->h[1]};
    if (fabs(plane_level_at(t, centre)) > hypot(g->h[0], g->h[1])) return FLOE_OK;
    for (int y = 0; y < t->divide; ++y)
        for (int x = 0; x < t->divide; ++x) TRY(trace_surface_in_box(t, i * t->divide + x, j * t->divide + y));
    return FLOE_OK;
}

/* ---- from pieces to chains ---- */

typedef struct side_of_piece {
    size_t side, piece;
} side_of_piece;

static int by_side(const void *a, const void *b)
{
    const side_of_piece *p = a, *q = b;
    return p->side < q->side ? -1 : p->side > q->side;
}

/* The piece that goes on where another ends; t->n: none, on a side of the mesh. */
static size_t piece_after(const tracer *t, const side_of_piece *start, size_t side)
{
    size_t lo = 0, hi = t->n;
    while (lo < hi) {
        const size_t middle = lo + (hi - lo) / 2;
        if (start[middle].side < side)
            lo = middle + 1;
        else
            hi = middle;
    }
    return lo < t->n && start[lo].side == side ? start[lo].piece : t->n;
}

static void mark_followed(const tracer *t, const side_of_piece *start, bool *followed)
{
    for (size_t k = 0; k < t->n; ++k) {
        const size_t next = piece_after(t, start, t->piece[k].end[1].side);
        if (next < t->n) followed[next] = true;
    }
}

/* Unit normal, out of the shape. */
static void contour_normal_at(const tracer *t, const double x[2], double n[2])
{
    double out[3];
    shape_differences(t->shape, t->grid->dim, (const double[3]){x[0], x[1], 0.0}, 1e-6 * t->grid->h[0], out);
    const double length = hypot(out[0], out[1]);
    for (int a = 0; a < 2; ++a) n[a] = out[a] / (length > 0.0 ? length : 1.0);
}

/* A corner between two points: where the lines through them meet, if that is on the surface. */
static bool find_corner(const tracer *t, const double a[2], const double b[2], double out[2])
{
    double n[2], m[2];
    contour_normal_at(t, a, n);
    contour_normal_at(t, b, m);
    const double det = n[0] * m[1] - n[1] * m[0], near = t->grid->h[0] / t->divide;
    if (fabs(det) < 0.3) return false; /* it bends by less than 17 degrees: no corner, or none that matters */
    const double p = n[0] * a[0] + n[1] * a[1], q = m[0] * b[0] + m[1] * b[1];
    out[0] = (p * m[1] - q * n[1]) / det;
    out[1] = (q * n[0] - p * m[0]) / det;
    const double from = hypot(out[0] - a[0], out[1] - a[1]), to = hypot(out[0] - b[0], out[1] - b[1]);
    return fabs(plane_level_at(t, out)) < 1e-6 * near && fmin(from, to) > 1e-3 * near && fmax(from, to) < 3.0 * near;
}

/* Points closer than this share of a sub-box are one. */
static const double together = 0.05;

typedef struct chain_maker {
    contour *out;
    size_t reserved, chains_reserved;
} chain_maker;

static floe_status append_vertex(tracer *t, chain_maker *m, const double x[2])
{
    contour *o = m->out;
    if (o->n == m->reserved) {
        m->reserved = m->reserved ? 2 * m->reserved : 256;
        TRY(memory_resize(t->ctx, &o->x, m->reserved, sizeof *o->x));
    }
    memcpy(o->x[o->n++], x, sizeof *o->x);
    return FLOE_OK;
}

static double vertex_distance(const double a[2], const double b[2])
{
    return hypot(a[0] - b[0], a[1] - b[1]);
}

/* The next point of the chain in hand, and the corner before it. Ends are kept: a point too near to one goes. */
static floe_status put_next(tracer *t, chain_maker *m, const double x[2], bool end)
{
    contour *o = m->out;
    const contour_chain *c = &o->chain[o->n_chains - 1];
    const double near = together * t->grid->h[0] / t->divide;
    double corner[2];
    if (o->n > c->first && vertex_distance(o->x[o->n - 1], x) < near) {
        if (!end) return FLOE_OK;
        if (o->n > c->first + 1) o->n--;
    }
    if (o->n > c->first && find_corner(t, o->x[o->n - 1], x, corner)) TRY(append_vertex(t, m, corner));
    return append_vertex(t, m, x);
}

/* A chain is closed without its first point again. */
static floe_status close_chain(tracer *t, chain_maker *m)
{
    contour *o = m->out;
    contour_chain *c = &o->chain[o->n_chains - 1];
    const double near = together * t->grid->h[0] / t->divide;
    double corner[2];
    while (c->closed && o->n > c->first + 1 && vertex_distance(o->x[o->n - 1], o->x[c->first]) < near) o->n--;
    if (c->closed && find_corner(t, o->x[o->n - 1], o->x[c->first], corner)) TRY(append_vertex(t, m, corner));
    c->n = o->n - c->first;
    if (c->n < (c->closed ? 3 : 2)) { /* a touch of the grid, no area */
        o->n = c->first;
        o->n_chains--;
    }
    return FLOE_OK;
}

static floe_status begin_chain(tracer *t, chain_maker *m, bool closed)
{
    contour *o = m->out;
    if (o->n_chains == m->chains_reserved) {
        m->chains_reserved = m->chains_reserved ? 2 * m->chains_reserved : 8;
        TRY(memory_resize(t->ctx, &o->chain, m->chains_reserved, sizeof *o->chain));
    }
    o->chain[o->n_chains++] = (contour_chain){.first = o->n, .closed = closed};
    return FLOE_OK;
}

static floe_status follow_chain(tracer *t, chain_maker *m, const side_of_piece *start, size_t first, bool closed)
{
    TRY(begin_chain(t, m, closed));
    TRY(put_next(t, m, t->piece[first].end[0].x, false));
    for (size_t k = first; k < t->n && !t->piece[k].used;) {
        const size_t next = piece_after(t, start, t->piece[k].end[1].side);
        t->piece[k].used = true;
        TRY(put_next(t, m, t->piece[k].end[1].x, next == t->n));
        k = next;
    }
    return close_chain(t, m);
}

/* Open chains first, then what is left. */
static floe_status link_pieces(tracer *t, chain_maker *m, side_of_piece *start, bool *followed)
{
    for (size_t k = 0; k < t->n; ++k) start[k] = (side_of_piece){t->piece[k].end[0].side, k};
    qsort(start, t->n, sizeof *start, by_side);
    mark_followed(t, start, followed);
    for (size_t k = 0; k < t->n; ++k)
        if (!followed[k]) TRY(follow_chain(t, m, start, k, false));
    for (size_t k = 0; k < t->n; ++k)
        if (!t->piece[k].used) TRY(follow_chain(t, m, start, k, true));
    return FLOE_OK;
}

static floe_status trace_chains(tracer *t, contour *out)
{
    for (int j = 0; j < t->grid->n[1]; ++j)
        for (int i = 0; i < t->grid->n[0]; ++i) TRY(trace_surface_in_cell(t, i, j));
    if (t->n == 0) return FLOE_OK;
    side_of_piece *start = NULL;
    bool *followed = NULL;
    floe_status status = memory_new(t->ctx, &start, t->n, sizeof *start);
    if (status == FLOE_OK) status = memory_new(t->ctx, &followed, t->n, sizeof *followed);
    if (status == FLOE_OK) status = link_pieces(t, &(chain_maker){.out = out}, start, followed);
    memory_free(t->ctx, &start);
    memory_free(t->ctx, &followed);
    return status;
}

/* ---- on a line ---- */

static floe_status put_point(tracer *t, chain_maker *m, double x, int into)
{
    TRY(begin_chain(t, m, false));
    m->out->chain[m->out->n_chains - 1].n = 1;
    m->out->chain[m->out->n_chains - 1].into = into;
    return append_vertex(t, m, (const double[2]){x, 0.0});
}

/* The surface between two corners, unless it lies on a side of the mesh. */
static floe_status cut_interval(tracer *t, chain_maker *m, int i)
{
    const double corner[2][2] = {{corner_coordinate(t, 0, i), 0.0}, {corner_coordinate(t, 0, i + 1), 0.0}};
    const bool inside[2] = {is_inside_shape(t, corner[0]), is_inside_shape(t, corner[1])};
    double x[2];
    if (inside[0] == inside[1]) return FLOE_OK;
    find_crossing(t, corner[inside[1]], corner[inside[0]], x);
    const bool first = i == 0 && x[0] == corner[0][0];
    if (first || (i + 1 == t->grid->n[0] * t->divide && x[0] == corner[1][0])) return FLOE_OK;
    return put_point(t, m, x[0], inside[1] ? 1 : -1);
}

static floe_status trace_line(tracer *t, contour *out)
{
    const int last = t->grid->n[0] * t->divide;
    chain_maker m = {.out = out};
    const double lower[2] = {corner_coordinate(t, 0, 0), 0.0}, upper[2] = {corner_coordinate(t, 0, last), 0.0};
    if (is_inside_shape(t, lower)) TRY(put_point(t, &m, lower[0], 0));
    for (int i = 0; i < last; ++i) TRY(cut_interval(t, &m, i));
    return is_inside_shape(t, upper) ? put_point(t, &m, upper[0], 0) : FLOE_OK;
}

floe_status contour_trace(contour *out, context *ctx, const shape *s, const seed_spec *grid, int divide)
{
    tracer t = {.ctx = ctx, .shape = s, .grid = grid, .divide = divide, .tolerance = 1e-9 * grid->h[0]};
    *out = (contour){0};
    floe_status status = grid->dim == 1 ? trace_line(&t, out) : trace_chains(&t, out);
    memory_free(ctx, &t.piece);
    for (size_t k = 0; k < out->n; ++k) layer_snap(grid, out->x[k]);
    if (status == FLOE_OK && grid->dim == 2) status = contour_join_around(ctx, out, grid);
    if (status != FLOE_OK) contour_free(ctx, out);
    return status;
}

void contour_free(context *ctx, contour *o)
{
    memory_free(ctx, &o->x);
    memory_free(ctx, &o->chain);
    *o = (contour){0};
}
