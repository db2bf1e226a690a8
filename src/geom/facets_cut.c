/* What of a surface lies beyond the mesh is cut off, side by side; the sides of facets that no other joins are its rims,
 * all on sides of the mesh. */
#include "geom/facets_internal.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Sides of facets by their lower vertex: what lies between them and the higher one. */
typedef struct edge_table {
    int *first; /* of each vertex, -1: none; owned */
    int *next, *other, *value;
    int n, capacity;
} edge_table;

static void free_edges(context *ctx, edge_table *t)
{
    memory_free(ctx, &t->first);
    memory_free(ctx, &t->next);
    memory_free(ctx, &t->other);
    memory_free(ctx, &t->value);
}

static floe_status make_edges(context *ctx, int vertices, int edges, edge_table *t)
{
    *t = (edge_table){.capacity = edges};
    TRY(memory_new(ctx, &t->first, (size_t)vertices + 1, sizeof *t->first));
    for (int k = 0; k < vertices; ++k) t->first[k] = -1;
    TRY(memory_new(ctx, &t->next, (size_t)edges + 1, sizeof *t->next));
    TRY(memory_new(ctx, &t->other, (size_t)edges + 1, sizeof *t->other));
    return memory_new(ctx, &t->value, (size_t)edges + 1, sizeof *t->value);
}

/* The value between two vertices, `start` where it is new. */
static int *edge_value(edge_table *t, int i, int j, int start)
{
    const int low = i < j ? i : j, high = i < j ? j : i;
    for (int k = t->first[low]; k >= 0; k = t->next[k])
        if (t->other[k] == high) return &t->value[k];
    const int k = t->n++;
    t->other[k] = high;
    t->value[k] = start;
    t->next[k] = t->first[low];
    t->first[low] = k;
    return &t->value[k];
}

typedef struct side_cut {
    lattice *l;
    edge_table edges;
    int axis;
    double plane, inward; /* m; +1 where the mesh lies above it */
} side_cut;

static double height(const side_cut *c, int v)
{
    return c->inward * (c->l->out->x[v][c->axis] - c->plane);
}

static floe_status vertex_between(side_cut *c, int i, int j, int *out)
{
    facet_surface *o = c->l->out;
    int *known = edge_value(&c->edges, i, j, -1);
    *out = *known;
    if (*known >= 0) return FLOE_OK;
    const int low = i < j ? i : j, high = i < j ? j : i;
    const double t = height(c, low) / (height(c, low) - height(c, high));
    static const double none[3] = {0.0};
    double x[3];
    for (int a = 0; a < 3; ++a) {
        const double p = o->x[low][a], q = o->x[high][a];
        x[a] = p == q ? p : p + t * (q - p);
    }
    x[c->axis] = c->plane;
    TRY(facets_add_vertex(c->l, x, none, out));
    *known = *out;
    return FLOE_OK;
}

/* The part of a facet inside, as a fan. */
static floe_status cut_facet(side_cut *c, facet f)
{
    int kept[4], n = 0;
    bool inside = false;
    for (int k = 0; k < 3; ++k) {
        const int i = f.vertex[k], j = f.vertex[(k + 1) % 3];
        const double here = height(c, i), there = height(c, j);
        if (here >= 0.0) kept[n++] = i;
        inside = inside || here > 0.0;
        if (here * there < 0.0) TRY(vertex_between(c, i, j, &kept[n++]));
    }
    for (int k = 1; k + 1 < n && inside; ++k) TRY(facets_add_facet(c->l, kept[0], kept[k], kept[k + 1]));
    return FLOE_OK;
}

static floe_status cut_at_side(lattice *l, int axis, int side)
{
    facet_surface *o = l->out;
    const double lower = l->grid->lower[axis], h = l->grid->h[axis];
    side_cut c = {
        .l = l, .axis = axis, .plane = side ? lower + l->grid->n[axis] * h : lower, .inward = side ? -1.0 : 1.0};
    const int facets = o->n_facets;
    facet *old = o->facet;
    for (int v = 0; v < o->n; ++v)
        if (fabs(height(&c, v)) < 1e-9 * h) o->x[v][axis] = c.plane;
    floe_status status = make_edges(l->ctx, o->n, 3 * facets, &c.edges);
    o->facet = NULL;
    o->n_facets = 0;
    l->capacity[1] = 0;
    for (int n = 0; n < facets && status == FLOE_OK; ++n) status = cut_facet(&c, old[n]);
    memory_free(l->ctx, &old);
    free_edges(l->ctx, &c.edges);
    return status;
}

static bool on_one_side(const lattice *l, const double x[3], const double y[3])
{
    for (int a = 0; a < 3; ++a) {
        const double lower = l->grid->lower[a], upper = lower + l->grid->n[a] * l->grid->h[a];
        if ((x[a] == lower && y[a] == lower) || (x[a] == upper && y[a] == upper)) return true;
    }
    return false;
}

/* Marks the sides of facets that no other joins. */
static floe_status find_rims(lattice *l)
{
    facet_surface *o = l->out;
    edge_table t;
    floe_status status = make_edges(l->ctx, o->n, 3 * o->n_facets, &t);
    for (int n = 0; n < 3 * o->n_facets && status == FLOE_OK; ++n) {
        const int i = o->facet[n / 3].vertex[n % 3], j = o->facet[n / 3].vertex[(n % 3 + 1) % 3];
        *edge_value(&t, i, j, 0) += i < j ? 1 : -1;
    }
    for (int n = 0; n < 3 * o->n_facets && status == FLOE_OK; ++n) {
        const int i = o->facet[n / 3].vertex[n % 3], j = o->facet[n / 3].vertex[(n % 3 + 1) % 3];
        if (*edge_value(&t, i, j, 0) == 0) continue;
        o->facet[n / 3].rim |= (unsigned char)(1u << n % 3);
        if (!on_one_side(l, o->x[i], o->x[j]))
            status =
                fail(l->ctx, FLOE_BAD_INPUT, "the surface of the shape has a hole at (%g, %g, %g): refine domain.cell",
                     o->x[i][0], o->x[i][1], o->x[i][2]);
    }
    free_edges(l->ctx, &t);
    return status;
}

/* Vertices that no facet has are left out. */
static floe_status drop_vertices(lattice *l)
{
    facet_surface *o = l->out;
    int *number = NULL, n = 0;
    TRY(memory_new(l->ctx, &number, (size_t)o->n + 1, sizeof *number));
    for (int k = 0; k < 3 * o->n_facets; ++k) number[o->facet[k / 3].vertex[k % 3]] = 1;
    for (int v = 0; v < o->n; ++v) {
        if (!number[v]) continue;
        memmove(o->x[n], o->x[v], sizeof *o->x);
        number[v] = n++;
    }
    o->n = n;
    for (int k = 0; k < 3 * o->n_facets; ++k) o->facet[k / 3].vertex[k % 3] = number[o->facet[k / 3].vertex[k % 3]];
    memory_free(l->ctx, &number);
    return FLOE_OK;
}

/* ---- around periodic axes ---- */

/* A vertex on the sides across an axis. */
typedef struct side_vertex {
    double x[2]; /* m: along the two other axes */
    int vertex;
    bool upper;
} side_vertex;

/* Of a cell: vertices this near are one. */
static const double one_place = 1e-6;

static int by_first_axis(const void *a, const void *b)
{
    const side_vertex *p = a, *q = b;
    return p->x[0] < q->x[0] ? -1 : p->x[0] > q->x[0];
}

static int list_side_vertices(const lattice *l, int axis, side_vertex *list)
{
    const facet_surface *o = l->out;
    const double lower = l->grid->lower[axis], upper = lower + l->grid->n[axis] * l->grid->h[axis];
    int n = 0;
    for (int v = 0; v < o->n; ++v)
        if (o->x[v][axis] == lower || o->x[v][axis] == upper)
            list[n++] = (side_vertex){{o->x[v][(axis + 1) % 3], o->x[v][(axis + 2) % 3]}, v, o->x[v][axis] == upper};
    qsort(list, (size_t)n, sizeof *list, by_first_axis);
    return n;
}

/* The vertex on the lower side of which that on the upper one is the image; -1: none. */
static int image_below(const lattice *l, int axis, const side_vertex *list, int n, int of)
{
    const double *h = l->grid->h, near[2] = {one_place * h[(axis + 1) % 3], one_place * h[(axis + 2) % 3]};
    int first = of;
    while (first > 0 && list[of].x[0] - list[first - 1].x[0] < near[0]) --first;
    for (int k = first; k < n && list[k].x[0] - list[of].x[0] < near[0]; ++k)
        if (!list[k].upper && fabs(list[k].x[1] - list[of].x[1]) < near[1]) return list[k].vertex;
    return -1;
}

/* Vertices on the upper side become those on the lower one, if each has one there. */
static floe_status join_around(lattice *l, int axis)
{
    facet_surface *o = l->out;
    side_vertex *list = NULL;
    int *number = NULL, lower = 0, joined = 0;
    if (!l->grid->periodic[axis]) return FLOE_OK;
    floe_status status = memory_new(l->ctx, &list, (size_t)o->n + 1, sizeof *list);
    if (status == FLOE_OK) status = memory_new(l->ctx, &number, (size_t)o->n + 1, sizeof *number);
    if (status == FLOE_OK) {
        const int n = list_side_vertices(l, axis, list);
        for (int v = 0; v < o->n; ++v) number[v] = v;
        for (int k = 0; k < n; ++k) {
            const int below = list[k].upper ? image_below(l, axis, list, n, k) : -1;
            lower += !list[k].upper;
            joined += below >= 0;
            if (below >= 0) number[list[k].vertex] = below;
        }
        for (int k = 0; k < 3 * o->n_facets && joined == lower && n == 2 * lower; ++k)
            o->facet[k / 3].vertex[k % 3] = number[o->facet[k / 3].vertex[k % 3]];
        status = drop_vertices(l);
    }
    memory_free(l->ctx, &list);
    memory_free(l->ctx, &number);
    return status;
}

floe_status facets_cut_at_sides(lattice *l)
{
    for (int side = 0; side < 6; ++side) TRY(cut_at_side(l, side / 2, side % 2));
    TRY(drop_vertices(l));
    for (int axis = 0; axis < 3; ++axis) TRY(join_around(l, axis));
    return find_rims(l);
}
