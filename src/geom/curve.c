#include "geom/curve.h"

#include "geom/layer.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

bool curve_is_closed(const curve_line *c)
{
    return c->kind == CURVE_CIRCLE || c->closed;
}

static double curve_distance(int dim, const double *a, const double *b)
{
    double square = 0.0;
    for (int k = 0; k < dim; k++) square += (b[k] - a[k]) * (b[k] - a[k]);
    return sqrt(square);
}

/* Pieces between vertices: one fewer than vertices, unless it is closed. */
static int curve_segments(const curve_line *c)
{
    return c->closed ? c->n_vertices : c->n_vertices - 1;
}

static const double *curve_vertex_at(const curve_line *c, int i)
{
    return c->vertex + 3 * (ptrdiff_t)(i % c->n_vertices);
}

double curve_length(const curve_line *c, int dim)
{
    double sum = 0.0;
    switch (c->kind) {
    case CURVE_SEGMENT: return curve_distance(dim, c->from, c->to);
    case CURVE_ARC: return c->radius * fabs(c->angle_to - c->angle_from);
    case CURVE_CIRCLE: return 2.0 * pi * c->radius;
    default: break;
    }
    for (int i = 0; i < curve_segments(c); i++)
        sum += curve_distance(dim, curve_vertex_at(c, i), curve_vertex_at(c, i + 1));
    return sum;
}

/* The place at a share (0 to 1) of the way from a to b. */
static void interpolate_vertices(const double *a, const double *b, double share, double x[3])
{
    for (int k = 0; k < 3; k++) x[k] = a[k] + share * (b[k] - a[k]);
}

static void place_on_polyline(const curve_line *c, int dim, double length_along, double x[3])
{
    for (int i = 0; i < curve_segments(c); i++) {
        const double *a = curve_vertex_at(c, i), *b = curve_vertex_at(c, i + 1);
        const double piece = curve_distance(dim, a, b);
        const bool last = i == curve_segments(c) - 1;
        if (length_along > piece && !last) {
            length_along -= piece;
            continue;
        }
        interpolate_vertices(a, b, piece > 0.0 ? length_along / piece : 0.0, x);
        return;
    }
}

/* The place after a share (0 to 1) of the length. */
static void place_on(const curve_line *c, int dim, double share, double x[3])
{
    const double whole = c->kind == CURVE_CIRCLE ? 2.0 * pi : c->angle_to - c->angle_from;
    const double angle = (c->kind == CURVE_CIRCLE ? 0.0 : c->angle_from) + share * whole;
    switch (c->kind) {
    case CURVE_SEGMENT: interpolate_vertices(c->from, c->to, share, x); return;
    case CURVE_ARC:
    case CURVE_CIRCLE:
        x[0] = c->centre[0] + c->radius * cos(angle);
        x[1] = c->centre[1] + c->radius * sin(angle);
        x[2] = c->centre[2];
        return;
    default: place_on_polyline(c, dim, share * curve_length(c, dim), x);
    }
}

/* Length that belongs to a point that the deck gives: half the way to each neighbour. */
static double share_of_vertex(const curve_line *c, int dim, int i)
{
    const int n = c->n_vertices;
    double sum = 0.0;
    if (n < 2) return 0.0;
    if (i > 0 || c->closed)
        sum += 0.5 * curve_distance(dim, curve_vertex_at(c, (i + n - 1) % n), curve_vertex_at(c, i));
    if (i < n - 1 || c->closed) sum += 0.5 * curve_distance(dim, curve_vertex_at(c, i), curve_vertex_at(c, i + 1));
    return sum;
}

static void point_of(const curve_line *c, const curve_seeding *how, int dim, int i, double x[3], double *length)
{
    if (c->kind == CURVE_POINTS) {
        for (int k = 0; k < 3; k++) x[k] = curve_vertex_at(c, i)[k];
        *length = isnan(how->length) ? share_of_vertex(c, dim, i) : how->length / c->n_vertices;
        return;
    }
    place_on(c, dim, (i + 0.5) / how->number, x);
    *length = curve_length(c, dim) / how->number;
}

int curve_count(const curve_line *c, int asked, int per_cell, const seed_spec *grid)
{
    if (c->kind == CURVE_POINTS) return c->n_vertices;
    if (asked > 0) return asked;
    const double n = ceil(curve_length(c, grid->dim) * per_cell / layer_cell(grid) - 1e-9);
    return (int)fmin(n, LAYER_POINTS_MOST + 1.0); /* too many: seed_curve says so */
}

/* Neighbours in the same cell or in adjacent ones feel each other; farther apart the membrane is torn (York 1997,
 * section 5.4.4). */
static floe_status check_gap(const seed_list *list, context *ctx, const seed_spec *grid, size_t i, size_t j)
{
    for (int k = 0; k < grid->dim; k++) {
        const double gap = fabs(list->x[k][j] - list->x[k][i]);
        if (gap <= grid->h[k] * (1.0 + 1e-9)) continue;
        return fail(ctx, FLOE_BAD_INPUT,
                    "points %zu and %zu, about (%g, %g), are %g m apart along axis %d, more than a cell of %g m: the "
                    "membrane would be torn; give it more points",
                    i + 1, j + 1, list->x[0][i], grid->dim > 1 ? list->x[1][i] : 0.0, gap, k + 1, grid->h[k]);
    }
    return FLOE_OK;
}

static floe_status place_curve_points(seed_list *list, context *ctx, const curve_line *c, const curve_seeding *how,
                                      const seed_spec *grid)
{
    const int number = c->kind == CURVE_POINTS ? c->n_vertices : how->number;
    const bool ordered = c->kind != CURVE_POINTS || !how->any_order;
    TRY(layer_check_number(ctx, number));
    TRY(layer_reserve(list, ctx, (size_t)number, grid->dim));
    for (int i = 0; i < number; i++) {
        double x[3] = {0.0}, length;
        point_of(c, how, grid->dim, i, x, &length);
        TRY(layer_put_point(list, ctx, grid, (size_t)i, x));
        list->volume[i] = length * how->thickness * (grid->axisymmetric ? x[0] : 1.0);
        if (i > 0 && ordered) TRY(check_gap(list, ctx, grid, (size_t)i - 1, (size_t)i));
    }
    return curve_is_closed(c) && ordered && number > 1 ? check_gap(list, ctx, grid, (size_t)number - 1, 0) : FLOE_OK;
}

floe_status seed_curve(seed_list *out, context *ctx, const curve_line *c, const curve_seeding *how,
                       const seed_spec *grid)
{
    *out = (seed_list){0};
    const floe_status status = place_curve_points(out, ctx, c, how, grid);
    if (status != FLOE_OK) seed_list_free(ctx, out);
    return status;
}
