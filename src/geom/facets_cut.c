/* What of a surface lies beyond the mesh is cut off, side by side; the sides of facets that no other joins are its rims,
 * all on sides of the mesh. */
#include "geom/facets_internal.h"

#include "base/memory.h"

#include <math.h>
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

floe_status facets_cut_at_sides(lattice *l)
{
    for (int side = 0; side < 6; ++side) TRY(cut_at_side(l, side / 2, side % 2));
    TRY(drop_vertices(l));
    return find_rims(l);
}
