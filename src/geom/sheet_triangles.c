#include "geom/sheet_triangles.h"

#include "base/memory.h"
#include "math/tensor.h"

#include <math.h>

typedef struct joining {
    context *ctx;
    const sheet_rows *rows;
    const double *x;
    double lower[3], upper[3];
    sheet_triangles *out;
    size_t capacity[2];
} joining;

/* Vertices of a row: `n` from `first` on. */
typedef struct vertex_row {
    int first, n;
} vertex_row;

static unsigned side_bit(int axis, int side)
{
    return 1u << (2 * axis + side);
}

void sheet_vertex_at(const sheet_vertex *v, const double *x, const double lower[3], const double upper[3],
                     double out[3])
{
    for (int a = 0; a < 3; ++a) {
        out[a] = x[3 * (ptrdiff_t)v->point + a];
        if (v->sides & side_bit(a, 0)) out[a] = lower[a];
        if (v->sides & side_bit(a, 1)) out[a] = upper[a];
    }
}

static void corner_position(const joining *j, int vertex, double out[3])
{
    sheet_vertex_at(&j->out->vertex[vertex], j->x, j->lower, j->upper, out);
}

static double distance2(const joining *j, int a, int b)
{
    double p[3], q[3];
    corner_position(j, a, p);
    corner_position(j, b, q);
    return vec_distance2(p, q);
}

static floe_status reserve_one(joining *j, int which, void *array, int n, size_t size)
{
    if ((size_t)n < j->capacity[which]) return FLOE_OK;
    j->capacity[which] = (size_t)n + (size_t)n / 2 + 256;
    return memory_resize(j->ctx, array, j->capacity[which], size);
}

static floe_status add_vertex(joining *j, size_t point, unsigned sides)
{
    TRY(reserve_one(j, 0, &j->out->vertex, j->out->n, sizeof *j->out->vertex));
    j->out->vertex[j->out->n++] = (sheet_vertex){(int)point, sides};
    return FLOE_OK;
}

/* Sides that no other triangle joins lie on one side of the mesh. */
static floe_status add_triangle(joining *j, int a, int b, int c)
{
    const int v[3] = {a, b, c};
    facet out = {{a, b, c}, 0};
    for (int k = 0; k < 3; ++k)
        if (j->out->vertex[v[k]].sides & j->out->vertex[v[(k + 1) % 3]].sides) out.rim |= (unsigned char)(1u << k);
    TRY(reserve_one(j, 1, &j->out->facet, j->out->n_facets, sizeof *j->out->facet));
    j->out->facet[j->out->n_facets++] = out;
    return FLOE_OK;
}

/* A row of points, with its ends on sides; or all of its feet on another side. */
static floe_status add_row(joining *j, int number, unsigned foot, vertex_row *out)
{
    const sheet_rows *rows = j->rows;
    const size_t first = rows->first[number], last = rows->first[number + 1] - 1;
    out->first = j->out->n;
    if (!rows->closed) TRY(add_vertex(j, first, foot | rows->row_side[0]));
    for (size_t k = first; k <= last; ++k) TRY(add_vertex(j, k, foot));
    if (!rows->closed) TRY(add_vertex(j, last, foot | rows->row_side[1]));
    out->n = j->out->n - out->first;
    return FLOE_OK;
}

static int row_vertex(const vertex_row *r, int k)
{
    return r->n > 1 ? r->first + k % r->n : r->first;
}

static int nearest_in_row(const joining *j, const vertex_row *r, int vertex)
{
    int found = 0;
    for (int k = 1; k < r->n; ++k)
        if (distance2(j, vertex, r->first + k) < distance2(j, vertex, r->first + found)) found = k;
    return found;
}

/* Triangles between two rows: from both beginnings on, each time along the shorter diagonal. */
static floe_status join_rows(joining *j, const vertex_row *a, const vertex_row *b)
{
    const bool closed = j->rows->closed;
    const int last[2] = {closed ? a->n : a->n - 1, closed ? b->n : b->n - 1};
    const int turn = closed ? nearest_in_row(j, b, a->first) : 0;
    for (int i = 0, k = 0; i < last[0] || k < last[1];) {
        const int here[2] = {row_vertex(a, i), row_vertex(b, k + turn)},
                  next[2] = {row_vertex(a, i + 1), row_vertex(b, k + 1 + turn)};
        const bool first =
            k == last[1] || (i < last[0] && distance2(j, next[0], here[1]) <= distance2(j, here[0], next[1]));
        TRY(first ? add_triangle(j, here[0], next[0], here[1]) : add_triangle(j, here[0], next[1], here[1]));
        i += first;
        k += !first;
    }
    return FLOE_OK;
}

/* What a row surrounds at the axis. Where two sides of the mesh meet there the surface has a corner on both. */
static floe_status close_at_axis(joining *j, int number, const vertex_row *r, bool after)
{
    const sheet_rows *rows = j->rows;
    const bool corner = !rows->closed && rows->row_side[0] != rows->row_side[1];
    const int from = corner ? j->out->n : r->first;
    if (corner)
        TRY(add_vertex(j, (rows->first[number] + rows->first[number + 1]) / 2, rows->row_side[0] | rows->row_side[1]));
    for (int k = corner ? 0 : 1; k + 1 < r->n; ++k)
        TRY(after ? add_triangle(j, from, r->first + k, r->first + k + 1)
                  : add_triangle(j, from, r->first + k + 1, r->first + k));
    return FLOE_OK;
}

static floe_status finish_end(joining *j, int which, const vertex_row *r)
{
    const int number = which ? j->rows->n - 1 : 0;
    vertex_row foot;
    if (j->rows->end[which] == SHEET_ENDS_AT_AXIS) return close_at_axis(j, number, r, which);
    if (j->rows->end[which] != SHEET_ENDS_ON_SIDE) return FLOE_OK;
    TRY(add_row(j, number, j->rows->end_side[which], &foot));
    return which ? join_rows(j, r, &foot) : join_rows(j, &foot, r);
}

static floe_status join_all_cells(joining *j)
{
    vertex_row first, row, next;
    TRY(add_row(j, 0, 0, &first));
    TRY(finish_end(j, 0, &first));
    row = first;
    for (int k = 1; k < j->rows->n; ++k, row = next) {
        TRY(add_row(j, k, 0, &next));
        TRY(join_rows(j, &row, &next));
    }
    if (j->rows->end[1] == SHEET_ENDS_JOINED) return join_rows(j, &row, &first);
    return finish_end(j, 1, &row);
}

/* ---- which side is which ---- */

static void area_of(const sheet_triangles *t, const facet *f, const double *x, const double lower[3],
                    const double upper[3], double area[3], double middle[3])
{
    double p[3][3];
    for (int k = 0; k < 3; ++k) sheet_vertex_at(&t->vertex[f->vertex[k]], x, lower, upper, p[k]);
    triangle_normal(p[0], p[1], p[2], area);
    for (int a = 0; a < 3; ++a) {
        area[a] *= 0.5;
        middle[a] = (p[0][a] + p[1][a] + p[2][a]) / 3.0;
    }
}

/* An axis along which it ends on one side at most, and that side; -1: there is none. */
static int free_axis(const sheet_triangles *t, bool *on_upper)
{
    unsigned sides = 0;
    for (int k = 0; k < t->n; ++k) sides |= t->vertex[k].sides;
    for (int a = 0; a < 3; ++a) {
        *on_upper = sides & side_bit(a, 1);
        if (!*on_upper || !(sides & side_bit(a, 0))) return a;
    }
    return -1;
}

double sheet_triangles_volume(const sheet_triangles *t, const double *x, const double lower[3], const double upper[3])
{
    bool on_upper;
    const int axis = free_axis(t, &on_upper);
    double sum = 0.0;
    if (axis < 0) return NAN;
    for (int k = 0; k < t->n_facets; ++k) {
        double area[3], middle[3];
        area_of(t, &t->facet[k], x, lower, upper, area, middle);
        sum += area[axis] * (middle[axis] - (on_upper ? upper : lower)[axis]);
    }
    return sum;
}

static double along_outward(const joining *j)
{
    double sum = 0.0;
    for (int k = 0; k < j->out->n_facets; ++k) {
        double area[3], middle[3];
        area_of(j->out, &j->out->facet[k], j->x, j->lower, j->upper, area, middle);
        sum += vec_dot(area, j->rows->outward);
    }
    return sum;
}

static void turn_sheet_over(facet *f)
{
    const int last = f->vertex[2];
    const unsigned rim = f->rim;
    f->vertex[2] = f->vertex[1];
    f->vertex[1] = last;
    f->rim = (unsigned char)((rim & 2u) | (rim & 1u) << 2 | rim >> 2);
}

static void turn_outward(joining *j)
{
    const double *o = j->rows->outward;
    const bool plane = o[0] != 0.0 || o[1] != 0.0 || o[2] != 0.0;
    if ((plane ? along_outward(j) : sheet_triangles_volume(j->out, j->x, j->lower, j->upper)) >= 0.0) return;
    for (int k = 0; k < j->out->n_facets; ++k) turn_sheet_over(&j->out->facet[k]);
}

static floe_status check_ends(const joining *j)
{
    const sheet_rows *rows = j->rows;
    bool inside = !rows->closed && (rows->row_side[0] == 0 || rows->row_side[1] == 0);
    for (int k = 0; k < 2; ++k) inside = inside || rows->end[k] == SHEET_ENDS_INSIDE;
    if (!inside) return FLOE_OK;
    return fail(j->ctx, FLOE_BAD_INPUT,
                "the surface ends inside the domain: let it end on symmetry or slip sides, or close it");
}

floe_status sheet_triangles_make(sheet_triangles *out, context *ctx, const sheet_rows *rows, const double *x,
                                 const seed_spec *grid)
{
    joining j = {.ctx = ctx, .rows = rows, .x = x, .out = out};
    *out = (sheet_triangles){.n = 0};
    for (int a = 0; a < 3; ++a) {
        j.lower[a] = grid->lower[a];
        j.upper[a] = grid->lower[a] + grid->n[a] * grid->h[a];
    }
    floe_status status = check_ends(&j);
    if (status == FLOE_OK) status = join_all_cells(&j);
    if (status != FLOE_OK) {
        sheet_triangles_free(ctx, out);
        return status;
    }
    turn_outward(&j);
    return FLOE_OK;
}

void sheet_triangles_free(context *ctx, sheet_triangles *t)
{
    memory_free(ctx, &t->vertex);
    memory_free(ctx, &t->facet);
    *t = (sheet_triangles){.n = 0};
}
