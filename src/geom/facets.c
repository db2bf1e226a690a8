/* Dual contouring (Ju, Losasso, Schaefer and Warren, ACM Trans. Graphics 21 (2002) 339): in each box of a lattice that the
 * surface passes lies one vertex, the point nearest to the planes that touch the surface where it crosses the box's
 * edges; so edges and corners of a shape are vertices. About each edge that is crossed the vertices of its four boxes are
 * two triangles. The lattice stands askew in the mesh, whose planes are where shapes like to have theirs. What lies
 * beyond the mesh is cut off. */
#include "geom/facets.h"

#include "base/memory.h"
#include "math/tensor.h"

#include <math.h>
#include <string.h>

enum {
    MARGIN = 2, /* boxes about the mesh */
    FINEST = 4  /* of the divisions that are asked for: walls of a cell have boxes that none of their sides share */
};

/* Where the lattice begins, in boxes. */
static const double askew[3] = {0.41, 0.37, 0.43};
/* Planes whose normals are all this near (their product), and which meet off the surface by more than this share of a
 * box, touch a curved side. */
static const double one_side = 0.5, off_surface = 1e-3;
/* Of a box: a corner this near to the surface is inside. */
static const double on_surface = 1e-9;
/* Directions in which planes of an edge differ less than this are one plane. */
static const double one_plane = 0.05;

typedef struct lattice {
    context *ctx;
    const shape *shape;
    const seed_spec *grid;
    double size[3];      /* m: of a box */
    int n[3];            /* boxes along each axis */
    signed char *inside; /* of each corner; owned */
    int *vertex;         /* of each box, -1: none; owned */
    double (*normal)[3]; /* of each vertex; of one on an edge none; owned */
    size_t capacity[3];  /* vertices, facets, normals */
    bool crowded;        /* some box is passed by more than one piece of surface */
    facet_surface *out;
} lattice;

static double level_at(const lattice *l, const double x[3])
{
    return l->shape->model->level(l->shape->par, 3, x);
}

static double corner_at(const lattice *l, int axis, int i)
{
    return l->grid->lower[axis] + (i - MARGIN + askew[axis]) * l->size[axis];
}

static size_t corner_number(const lattice *l, const int c[3])
{
    return ((size_t)c[2] * (size_t)(l->n[1] + 1) + (size_t)c[1]) * (size_t)(l->n[0] + 1) + (size_t)c[0];
}

static size_t box_number(const lattice *l, const int c[3])
{
    return ((size_t)c[2] * (size_t)l->n[1] + (size_t)c[1]) * (size_t)l->n[0] + (size_t)c[0];
}

static double shortest(const double v[3])
{
    return fmin(v[0], fmin(v[1], v[2]));
}

static bool is_inside(const lattice *l, const double x[3])
{
    return level_at(l, x) <= on_surface * shortest(l->size);
}

static void gradient_at(const lattice *l, const double x[3], double out[3])
{
    const double step = 1e-5 * shortest(l->size);
    double size = 0.0;
    for (int a = 0; a < 3; ++a) {
        double lo[3] = {x[0], x[1], x[2]}, hi[3] = {x[0], x[1], x[2]};
        lo[a] -= step;
        hi[a] += step;
        out[a] = level_at(l, hi) - level_at(l, lo);
        size += out[a] * out[a];
    }
    for (int a = 0; a < 3; ++a) out[a] = size > 0.0 ? out[a] / sqrt(size) : 0.0;
}

static void find_crossing(const lattice *l, const double inside[3], const double outside[3], double x[3])
{
    double lo = 0.0, hi = 1.0;
    for (int pass = 0; pass < 50; ++pass) {
        const double middle = 0.5 * (lo + hi);
        for (int a = 0; a < 3; ++a) x[a] = inside[a] + middle * (outside[a] - inside[a]);
        *(is_inside(l, x) ? &lo : &hi) = middle;
    }
}

/* Planes that touch the surface at its crossings of a box's edges. */
typedef struct touching {
    double x[12][3], normal[12][3];
    int n;
} touching;

static void add_crossing(const lattice *l, const int from[3], int axis, touching *t)
{
    int to[3] = {from[0], from[1], from[2]};
    double a[3], b[3];
    to[axis]++;
    const bool first = l->inside[corner_number(l, from)];
    if (first == (bool)l->inside[corner_number(l, to)]) return;
    for (int k = 0; k < 3; ++k) {
        a[k] = corner_at(l, k, from[k]);
        b[k] = corner_at(l, k, to[k]);
    }
    find_crossing(l, first ? a : b, first ? b : a, t->x[t->n]);
    gradient_at(l, t->x[t->n], t->normal[t->n]);
    t->n++;
}

static touching touch_box(const lattice *l, const int box[3])
{
    touching t = {.n = 0};
    for (int axis = 0; axis < 3; ++axis)
        for (int k = 0; k < 4; ++k) {
            int from[3] = {box[0], box[1], box[2]};
            from[(axis + 1) % 3] += k & 1;
            from[(axis + 2) % 3] += k >> 1;
            add_crossing(l, from, axis, &t);
        }
    return t;
}

static bool are_one_side(const touching *t)
{
    for (int i = 0; i < t->n; ++i)
        for (int k = 0; k < i; ++k) {
            const double *n = t->normal[i], *m = t->normal[k];
            if (!(n[0] * m[0] + n[1] * m[1] + n[2] * m[2] > one_side)) return false;
        }
    return true;
}

/* The place nearest to all planes, from the middle of their places on; how many planes they are. */
static int meet_planes(const lattice *l, const touching *t, double x[3])
{
    double middle[3] = {0.0}, A[6] = {0.0}, b[3] = {0.0}, value[3], vector[9];
    for (int k = 0; k < t->n; ++k)
        for (int a = 0; a < 3; ++a) middle[a] += t->x[k][a] / t->n;
    for (int k = 0; k < t->n; ++k) {
        const double *n = t->normal[k];
        double height = 0.0;
        for (int a = 0; a < 3; ++a) height += n[a] * (t->x[k][a] - middle[a]);
        for (int a = 0; a < 3; ++a) {
            b[a] += height * n[a];
            A[a] += n[a] * n[a];
        }
        A[3] += n[0] * n[1];
        A[4] += n[1] * n[2];
        A[5] += n[0] * n[2];
    }
    symmetric_eigen(A, value, vector);
    int planes = 0;
    double far = 0.0;
    for (int a = 0; a < 3; ++a) x[a] = middle[a];
    for (int k = 2; k >= 0; --k) {
        if (!(value[k] > one_plane * value[2])) continue;
        double along = 0.0;
        planes++;
        for (int a = 0; a < 3; ++a) along += vector[3 * a + k] * b[a] / value[k];
        for (int a = 0; a < 3; ++a) x[a] += along * vector[3 * a + k];
    }
    for (int a = 0; a < 3; ++a) far = fmax(far, fabs(x[a] - middle[a]) / l->size[a]);
    const bool curved = are_one_side(t) && fabs(level_at(l, x)) > off_surface * shortest(l->size);
    if (planes == 1 || (far <= 1.5 && !curved)) return planes;
    memcpy(x, middle, sizeof middle); /* planes that hardly meet, or touch a curved side */
    return 1;
}

static floe_status reserve_facets(lattice *l, int which, void *array, size_t n, size_t size)
{
    if (n < l->capacity[which]) return FLOE_OK;
    l->capacity[which] = n + n / 2 + 256;
    return memory_resize(l->ctx, array, l->capacity[which], size);
}

static floe_status add_vertex(lattice *l, const double x[3], const double normal[3], int *number)
{
    facet_surface *o = l->out;
    TRY(reserve_facets(l, 0, &o->x, (size_t)o->n, sizeof *o->x));
    TRY(reserve_facets(l, 2, &l->normal, (size_t)o->n, sizeof *l->normal));
    for (int a = 0; a < 3; ++a) {
        o->x[o->n][a] = x[a];
        l->normal[o->n][a] = normal[a];
    }
    *number = o->n++;
    return FLOE_OK;
}

static floe_status add_facet(lattice *l, int i, int j, int k)
{
    facet_surface *o = l->out;
    if (i == j || j == k || k == i) return FLOE_OK;
    TRY(reserve_facets(l, 1, &o->facet, (size_t)o->n_facets, sizeof *o->facet));
    o->facet[o->n_facets++] = (facet){{i, j, k}, 0};
    return FLOE_OK;
}

/* Whether the corners of a box on one side of the surface hang together over its edges. */
static bool hang_together(unsigned corners)
{
    unsigned met = corners & (~corners + 1), before = 0; /* from the lowest on */
    while (met != before) {
        before = met;
        for (int c = 0; c < 8; ++c)
            for (int a = 0; a < 3; ++a)
                if (met >> c & 1) met |= corners & 1u << (c ^ 1 << a);
    }
    return met == corners;
}

static bool is_passed_once(const lattice *l, const int box[3])
{
    unsigned inside = 0;
    for (int c = 0; c < 8; ++c) {
        const int at[3] = {box[0] + (c & 1), box[1] + (c >> 1 & 1), box[2] + (c >> 2)};
        if (l->inside[corner_number(l, at)]) inside |= 1u << c;
    }
    return hang_together(inside) && hang_together(~inside & 255u);
}

static floe_status put_vertex(lattice *l, const int box[3])
{
    double x[3], normal[3] = {0.0};
    const touching t = touch_box(l, box);
    int *number = &l->vertex[box_number(l, box)];
    if (t.n == 0) return FLOE_OK;
    l->crowded = l->crowded || !is_passed_once(l, box);
    if (meet_planes(l, &t, x) == 1)
        for (int pass = 0; pass < 3; ++pass) {
            gradient_at(l, x, normal);
            const double level = level_at(l, x);
            for (int a = 0; a < 3; ++a) x[a] -= level * normal[a];
        }
    return add_vertex(l, x, normal, number);
}

static double distance2(const double a[3], const double b[3])
{
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sum;
}

/* The vertices of the four boxes about an edge, as two triangles along the shorter diagonal. */
static floe_status put_facets(lattice *l, const int from[3], int axis)
{
    static const int around[4][2] = {{-1, -1}, {0, -1}, {0, 0}, {-1, 0}};
    int to[3] = {from[0], from[1], from[2]}, v[4];
    to[axis]++;
    const bool first = l->inside[corner_number(l, from)];
    if (first == (bool)l->inside[corner_number(l, to)]) return FLOE_OK;
    for (int k = 0; k < 4; ++k) {
        const int *step = around[first ? 3 - k : k]; /* seen from the inside */
        int box[3] = {from[0], from[1], from[2]};
        box[(axis + 1) % 3] += step[0];
        box[(axis + 2) % 3] += step[1];
        v[k] = l->vertex[box_number(l, box)];
    }
    const double(*x)[3] = (const double(*)[3])l->out->x;
    const bool turn = distance2(x[v[1]], x[v[3]]) < (1.0 - 1e-9) * distance2(x[v[0]], x[v[2]]);
    TRY(add_facet(l, v[turn], v[turn + 1], v[turn + 2]));
    return add_facet(l, v[turn + 2], v[(turn + 3) % 4], v[turn]);
}

typedef floe_status lattice_visitor(lattice *l, const int at[3]);

static floe_status visit_lattice(lattice *l, int first, int less, lattice_visitor *visitor)
{
    for (int k = first; k < l->n[2] - less; ++k)
        for (int j = first; j < l->n[1] - less; ++j)
            for (int i = first; i < l->n[0] - less; ++i) TRY(visitor(l, (const int[]){i, j, k}));
    return FLOE_OK;
}

static floe_status mark_corner(lattice *l, const int at[3])
{
    const double x[3] = {corner_at(l, 0, at[0]), corner_at(l, 1, at[1]), corner_at(l, 2, at[2])};
    l->inside[corner_number(l, at)] = is_inside(l, x);
    return FLOE_OK;
}

static floe_status no_vertex(lattice *l, const int at[3])
{
    l->vertex[box_number(l, at)] = -1;
    return FLOE_OK;
}

static floe_status put_facets_from(lattice *l, const int at[3])
{
    for (int axis = 0; axis < 3; ++axis) TRY(put_facets(l, at, axis));
    return FLOE_OK;
}

/* ---- volumes of curved sides ---- */

/* Twice the area of a facet. */
static double double_area(const facet_surface *o, const facet *f)
{
    const double *p = o->x[f->vertex[0]], *q = o->x[f->vertex[1]], *r = o->x[f->vertex[2]];
    double sum = 0.0;
    for (int a = 0; a < 3; ++a) {
        const int e = (a + 1) % 3, g = (a + 2) % 3;
        const double c = (q[e] - p[e]) * (r[g] - p[g]) - (q[g] - p[g]) * (r[e] - p[e]);
        sum += c * c;
    }
    return sqrt(sum);
}

/* Mean level over a facet whose corners lie on the surface: of the middles of its sides, exact to the second order. */
static double mean_level(const lattice *l, const facet *f)
{
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double *p = l->out->x[f->vertex[k]], *q = l->out->x[f->vertex[(k + 1) % 3]];
        sum += level_at(l, (const double[]){0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]), 0.5 * (p[2] + q[2])}) / 3.0;
    }
    return sum;
}

/* Vertices move off the surface by what the facets about them miss. */
static floe_status balance_volume(lattice *l)
{
    facet_surface *o = l->out;
    double(*sum)[2] = NULL;
    TRY(memory_new(l->ctx, &sum, (size_t)o->n + 1, sizeof *sum));
    for (int n = 0; n < o->n_facets; ++n) {
        const double area = double_area(o, &o->facet[n]), level = mean_level(l, &o->facet[n]);
        for (int k = 0; k < 3; ++k) {
            sum[o->facet[n].vertex[k]][0] += area;
            sum[o->facet[n].vertex[k]][1] += area * level;
        }
    }
    for (int v = 0; v < o->n; ++v)
        for (int a = 0; a < 3 && sum[v][0] > 0.0; ++a) o->x[v][a] -= sum[v][1] / sum[v][0] * l->normal[v][a];
    memory_free(l->ctx, &sum);
    return FLOE_OK;
}

/* ---- sides of the mesh ---- */

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
    TRY(add_vertex(c->l, x, none, out));
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
    for (int k = 1; k + 1 < n && inside; ++k) TRY(add_facet(c->l, kept[0], kept[k], kept[k + 1]));
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

static floe_status contour_lattice(lattice *l)
{
    size_t corners = 1, boxes = 1;
    for (int a = 0; a < 3; ++a) {
        corners *= (size_t)l->n[a] + 1;
        boxes *= (size_t)l->n[a];
    }
    TRY(memory_new(l->ctx, &l->inside, corners, sizeof *l->inside));
    TRY(memory_new(l->ctx, &l->vertex, boxes, sizeof *l->vertex));
    TRY(visit_lattice(l, 0, -1, mark_corner));
    TRY(visit_lattice(l, 0, 0, no_vertex));
    TRY(visit_lattice(l, 0, 0, put_vertex));
    TRY(visit_lattice(l, 1, 1, put_facets_from));
    TRY(balance_volume(l));
    for (int side = 0; side < 6; ++side) TRY(cut_at_side(l, side / 2, side % 2));
    TRY(drop_vertices(l));
    return find_rims(l);
}

/* With boxes of a size; crowded: some hold more than one piece of the surface. */
static floe_status make_with(facet_surface *out, context *ctx, const shape *s, const seed_spec *grid, int divide,
                             bool *crowded)
{
    lattice l = {.ctx = ctx, .shape = s, .grid = grid, .out = out};
    *out = (facet_surface){.n = 0};
    for (int a = 0; a < 3; ++a) {
        l.size[a] = grid->h[a] / divide;
        l.n[a] = grid->n[a] * divide + 2 * MARGIN;
    }
    const floe_status status = contour_lattice(&l);
    *crowded = l.crowded;
    memory_free(ctx, &l.inside);
    memory_free(ctx, &l.vertex);
    memory_free(ctx, &l.normal);
    if (status != FLOE_OK) facets_free(ctx, out);
    return status;
}

/* Edges sharper than boxes see stay crowded at any size. */
floe_status facets_make(facet_surface *out, context *ctx, const shape *s, const seed_spec *grid, int divide)
{
    bool crowded;
    TRY(make_with(out, ctx, s, grid, divide, &crowded));
    for (int finer = 2; finer <= FINEST && crowded; finer *= 2) {
        facets_free(ctx, out);
        TRY(make_with(out, ctx, s, grid, finer * divide, &crowded));
    }
    return FLOE_OK;
}

void facets_free(context *ctx, facet_surface *f)
{
    memory_free(ctx, &f->x);
    memory_free(ctx, &f->facet);
    *f = (facet_surface){.n = 0};
}
