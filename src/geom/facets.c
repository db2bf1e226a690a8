/* Dual contouring (Ju, Losasso, Schaefer and Warren, ACM Trans. Graphics 21 (2002) 339): in each box of a lattice that the
 * surface passes lies one vertex, the point nearest to the planes that touch the surface where it crosses the box's
 * edges; so edges and corners of a shape are vertices. About each edge that is crossed the vertices of its four boxes are
 * two triangles. The lattice stands askew in the mesh, whose planes are where shapes like to have theirs. What lies
 * beyond the mesh is cut off. */
#include "geom/facets_internal.h"
#include "geom/layer.h"

#include "base/memory.h"
#include "math/tensor.h"

#include <math.h>
#include <string.h>

enum {
    MARGIN = 2, /* boxes about the mesh; around a periodic axis one more, so that all about both its sides is alike */
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

static double lattice_level_at(const lattice *l, const double x[3])
{
    return shape_level(l->shape, 3, x);
}

static double lattice_corner(const lattice *l, int axis, int i)
{
    return l->grid->lower[axis] + (i - l->margin[axis] + askew[axis]) * l->size[axis];
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
    return lattice_level_at(l, x) <= on_surface * shortest(l->size);
}

/* Unit normal, out of the shape. */
static void normal_at(const lattice *l, const double x[3], double out[3])
{
    shape_differences(l->shape, 3, x, 1e-5 * shortest(l->size), out);
    vec_normalize(out);
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
        a[k] = lattice_corner(l, k, from[k]);
        b[k] = lattice_corner(l, k, to[k]);
    }
    shape_crossing(l->shape, 3, on_surface * shortest(l->size), first ? a : b, first ? b : a, 50, t->x[t->n]);
    normal_at(l, t->x[t->n], t->normal[t->n]);
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

static bool normals_agree(const touching *t)
{
    for (int i = 0; i < t->n; ++i)
        for (int k = 0; k < i; ++k)
            if (!(vec_dot(t->normal[i], t->normal[k]) > one_side)) return false;
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
    const bool curved = normals_agree(t) && fabs(lattice_level_at(l, x)) > off_surface * shortest(l->size);
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

floe_status facets_add_vertex(lattice *l, const double x[3], const double normal[3], int *number)
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

floe_status facets_add_facet(lattice *l, int i, int j, int k)
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
            normal_at(l, x, normal);
            const double level = lattice_level_at(l, x);
            for (int a = 0; a < 3; ++a) x[a] -= level * normal[a];
        }
    return facets_add_vertex(l, x, normal, number);
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
    const bool turn = vec_distance2(x[v[1]], x[v[3]]) < (1.0 - 1e-9) * vec_distance2(x[v[0]], x[v[2]]);
    TRY(facets_add_facet(l, v[turn], v[turn + 1], v[turn + 2]));
    return facets_add_facet(l, v[turn + 2], v[(turn + 3) % 4], v[turn]);
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
    const double x[3] = {lattice_corner(l, 0, at[0]), lattice_corner(l, 1, at[1]), lattice_corner(l, 2, at[2])};
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

/* Mean level over a facet whose corners lie on the surface: of the middles of its sides, exact to the second order. */
static double mean_level(const lattice *l, const facet *f)
{
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double *p = l->out->x[f->vertex[k]], *q = l->out->x[f->vertex[(k + 1) % 3]];
        sum +=
            lattice_level_at(l, (const double[]){0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]), 0.5 * (p[2] + q[2])}) / 3.0;
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
        const int *v = o->facet[n].vertex;
        double normal[3];
        triangle_normal(o->x[v[0]], o->x[v[1]], o->x[v[2]], normal);
        const double area = vec_norm(normal), level = mean_level(l, &o->facet[n]);
        for (int k = 0; k < 3; ++k) {
            sum[v[k]][0] += area;
            sum[v[k]][1] += area * level;
        }
    }
    for (int v = 0; v < o->n; ++v)
        for (int a = 0; a < 3 && sum[v][0] > 0.0; ++a) o->x[v][a] -= sum[v][1] / sum[v][0] * l->normal[v][a];
    memory_free(l->ctx, &sum);
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
    return facets_cut_at_sides(l);
}

/* With boxes of a size; crowded: some hold more than one piece of the surface. */
static floe_status make_with(facet_surface *out, context *ctx, const shape *s, const seed_spec *grid, int divide,
                             bool *crowded)
{
    lattice l = {.ctx = ctx, .shape = s, .grid = grid, .out = out};
    *out = (facet_surface){.n = 0};
    for (int a = 0; a < 3; ++a) {
        l.size[a] = grid->h[a] / divide;
        l.margin[a] = MARGIN + grid->periodic[a];
        l.n[a] = grid->n[a] * divide + 2 * l.margin[a];
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
    for (int k = 0; k < out->n; ++k) layer_snap(grid, out->x[k]);
    return FLOE_OK;
}

void facets_free(context *ctx, facet_surface *f)
{
    memory_free(ctx, &f->x);
    memory_free(ctx, &f->facet);
    *f = (facet_surface){.n = 0};
}
