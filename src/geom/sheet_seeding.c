#include "geom/sheet_seeding.h"

#include "base/memory.h"
#include "geom/layer.h"
#include "math/tensor.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/* A piece of what is turned about the axis: distance from the axis and place along it. */
typedef struct profile_piece {
    bool arc;
    double r[2], z[2];                  /* m: ends of a straight piece */
    double centre[2], radius, angle[2]; /* m, rad: arc; r = centre + radius cos, z = centre + radius sin */
} profile_piece;

/* The share of the full circle that lies in the mesh, and its middle. */
typedef struct sector {
    double width, middle; /* rad, from axis + 1 towards axis + 2 */
} sector;

/* A band of a surface of revolution. */
typedef struct band {
    long first, n; /* of all points; its own */
    double r, z;   /* m, of its points */
    double width;  /* m, along the curve */
    double turn;   /* of its points, in spacings */
} band;

/* Which part of an axis the mesh has, of what is cut at `centre`: 1 that above, -1 that below, 0 both. */
static int half_of(const seed_spec *grid, int axis, double centre)
{
    const double tiny = 1e-9 * grid->h[axis], upper = grid->lower[axis] + grid->n[axis] * grid->h[axis];
    return fabs(grid->lower[axis] - centre) < tiny ? 1 : fabs(upper - centre) < tiny ? -1 : 0;
}

static sector sector_of(const sheet_surface *s, const seed_spec *grid)
{
    const int b = (s->axis + 1) % 3, c = (s->axis + 2) % 3;
    const int halves[2] = {half_of(grid, b, s->centre[b]), half_of(grid, c, s->centre[c])};
    return (sector){2.0 * pi / ((halves[0] ? 2 : 1) * (halves[1] ? 2 : 1)), atan2(halves[1], halves[0])};
}

/* ---- profiles ---- */

static int count_pieces(const sheet_surface *s)
{
    const bool vertices =
        s->kind == SHEET_REVOLVED && (s->curve.kind == CURVE_POLYLINE || s->curve.kind == CURVE_POINTS);
    return vertices ? s->curve.n_vertices - (s->curve.closed ? 0 : 1) : 1;
}

static profile_piece sphere_piece(const sheet_surface *s, const seed_spec *grid)
{
    const int half = half_of(grid, s->axis, s->centre[s->axis]);
    return (profile_piece){.arc = true,
                           .centre = {0.0, s->centre[s->axis]},
                           .radius = s->radius,
                           .angle = {half == 1 ? 0.0 : -0.5 * pi, half == -1 ? 0.0 : 0.5 * pi}};
}

/* The two coordinates of a place. */
static void sheet_coordinates(const sheet_surface *s, const double *x, double *r, double *z)
{
    const int b = (s->axis + 1) % 3, c = (s->axis + 2) % 3;
    *r = hypot(x[b] - s->centre[b], x[c] - s->centre[c]);
    *z = x[s->axis];
}

static profile_piece straight_piece(const sheet_surface *s, const double *from, const double *to)
{
    profile_piece p = {.arc = false};
    sheet_coordinates(s, from, &p.r[0], &p.z[0]);
    sheet_coordinates(s, to, &p.r[1], &p.z[1]);
    return p;
}

static profile_piece arc_piece(const sheet_surface *s)
{
    const curve_line *c = &s->curve;
    const bool whole = c->kind == CURVE_CIRCLE,
               swap = s->axis == 0; /* about the first axis sine and cosine change places */
    const double from = whole ? 0.0 : c->angle_from, to = whole ? 2.0 * pi : c->angle_to;
    profile_piece p = {.arc = true, .radius = c->radius};
    p.centre[0] = swap ? c->centre[1] - s->centre[1] : c->centre[0] - s->centre[0];
    p.centre[1] = swap ? c->centre[0] : c->centre[1];
    p.angle[0] = swap ? 0.5 * pi - from : from;
    p.angle[1] = swap ? 0.5 * pi - to : to;
    return p;
}

static profile_piece profile_segment(const sheet_surface *s, const seed_spec *grid, int i)
{
    const curve_line *c = &s->curve;
    if (s->kind == SHEET_SPHERE) return sphere_piece(s, grid);
    if (s->kind == SHEET_CYLINDER) return (profile_piece){.r = {s->radius, s->radius}, .z = {s->from, s->to}};
    if (c->kind == CURVE_SEGMENT) return straight_piece(s, c->from, c->to);
    if (c->kind == CURVE_ARC || c->kind == CURVE_CIRCLE) return arc_piece(s);
    return straight_piece(s, c->vertex + 3 * (ptrdiff_t)i, c->vertex + 3 * (ptrdiff_t)((i + 1) % c->n_vertices));
}

static double piece_length(const profile_piece *p)
{
    return p->arc ? p->radius * fabs(p->angle[1] - p->angle[0]) : hypot(p->r[1] - p->r[0], p->z[1] - p->z[0]);
}

/* Area (m2 per radian) of the share (0 to 1) of a piece, from its start. */
static double piece_area(const profile_piece *p, double share)
{
    if (!p->arc) return piece_length(p) * share * (p->r[0] + 0.5 * share * (p->r[1] - p->r[0]));
    const double length_along = share * (p->angle[1] - p->angle[0]);
    const double sines = sin(p->angle[0] + length_along) - sin(p->angle[0]);
    return copysign(1.0, length_along) * p->radius * (p->centre[0] * length_along + p->radius * sines);
}

static void piece_place(const profile_piece *p, double share, double *r, double *z)
{
    const double angle = p->angle[0] + share * (p->angle[1] - p->angle[0]);
    *r = p->arc ? p->centre[0] + p->radius * cos(angle) : p->r[0] + share * (p->r[1] - p->r[0]);
    *z = p->arc ? p->centre[1] + p->radius * sin(angle) : p->z[0] + share * (p->z[1] - p->z[0]);
}

/* The share of a piece with a given area from its start; the area grows with the share. */
static double share_with(const profile_piece *p, double area)
{
    double lo = 0.0, hi = 1.0;
    for (int i = 0; i < 60; i++) {
        const double mid = 0.5 * (lo + hi);
        if (piece_area(p, mid) < area)
            lo = mid;
        else
            hi = mid;
    }
    return 0.5 * (lo + hi);
}

static double profile_length(const sheet_surface *s, const seed_spec *grid)
{
    double sum = 0.0;
    for (int i = 0; i < count_pieces(s); i++) {
        const profile_piece p = profile_segment(s, grid, i);
        sum += piece_length(&p);
    }
    return sum;
}

/* Area (m2 per radian) after `length_along` (m) along the profile. */
static double area_after(const sheet_surface *s, const seed_spec *grid, double length_along)
{
    double sum = 0.0;
    for (int i = 0; i < count_pieces(s) && length_along > 0.0; i++) {
        const profile_piece p = profile_segment(s, grid, i);
        const double length = piece_length(&p);
        sum += piece_area(&p, length_along < length ? length_along / length : 1.0);
        length_along -= length;
    }
    return sum;
}

/* Place and way (m) along the profile after an area (m2 per radian). */
static double place_after(const sheet_surface *s, const seed_spec *grid, double area, double *r, double *z)
{
    double length_along = 0.0;
    const int n = count_pieces(s);
    for (int i = 0;; i++) {
        const profile_piece p = profile_segment(s, grid, i);
        const double whole = piece_area(&p, 1.0);
        if (area <= whole || i == n - 1) {
            const double share = share_with(&p, area);
            piece_place(&p, share, r, z);
            return length_along + share * piece_length(&p);
        }
        area -= whole;
        length_along += piece_length(&p);
    }
}

/* ---- number and size ---- */

static double plane_area(const sheet_surface *s)
{
    double n[3];
    vec_cross(s->first, s->second, n);
    return vec_norm(n);
}

double sheet_area(const sheet_surface *s, const seed_spec *grid)
{
    if (s->kind == SHEET_PLANE) return plane_area(s);
    if (s->kind == SHEET_POINTS) return s->area;
    return sector_of(s, grid).width * area_after(s, grid, 2.0 * profile_length(s, grid));
}

/* The number of points that the deck gives, or that its number per cell makes on the area of the surface. */
static double requested_points(const sheet_surface *s, const sheet_seeding *how, const seed_spec *grid)
{
    const double per_length = how->per_cell / layer_cell(grid);
    return how->number > 0 ? how->number : sheet_area(s, grid) * per_length * per_length;
}

/* Neighbours in the same cell or in adjacent ones feel each other; farther apart the membrane is torn (York 1997,
 * section 5.4.4). */
static floe_status check_point_spacing(context *ctx, const seed_spec *grid, const double x[3], double side,
                                       double other)
{
    const double h = layer_cell(grid), wider = fmax(side, other);
    if (wider <= h * (1.0 + 1e-9)) return FLOE_OK;
    return fail(
        ctx, FLOE_BAD_INPUT,
        "points about (%g, %g, %g) are %g m apart, more than a cell of %g m: the membrane would be torn; give it "
        "more points",
        x[0], x[1], x[2], wider, h);
}

/* ---- surfaces of revolution ---- */

/* A profile, and how many bands it is cut into; fills in a band by its number. */
typedef struct banding {
    const sheet_surface *s;
    const seed_spec *grid;
    sector sector;
    double length, area; /* m; m2 per radian */
    double asked;        /* points */
    int bands, least;    /* points of a band, at least: a full circle of fewer has no direction */
} banding;

static banding banding_of(const sheet_surface *s, const sheet_seeding *how, const seed_spec *grid)
{
    banding b = {.s = s, .grid = grid, .sector = sector_of(s, grid), .length = profile_length(s, grid)};
    b.area = area_after(s, grid, 2.0 * b.length);
    b.asked = requested_points(s, how, grid);
    const double spacing = sqrt(b.sector.width * b.area / b.asked);
    b.bands = (int)fmin(fmax(1.0, round(b.length / spacing)), LAYER_POINTS_MOST + 1.0);
    b.least = b.sector.width > 1.5 * pi ? 3 : 1;
    return b;
}

/* Points of bands of the same width, in proportion to their areas. */
static long band_count(const banding *b, int k)
{
    const double share = b->asked / b->area, width = b->length / b->bands;
    const double upto = round(share * area_after(b->s, b->grid, (k + 1) * width));
    const long n = (long)(upto - round(share * area_after(b->s, b->grid, k * width)));
    return n < b->least ? b->least : n;
}

static band band_at(const banding *b, int k, long first, long n, long all)
{
    double r, z;
    band out = {.first = first, .n = n};
    const double each = b->area / (double)all;
    const double from = place_after(b->s, b->grid, each * (double)first, &r, &z);
    const double to = place_after(b->s, b->grid, each * (double)(first + n), &r, &z);
    (void)place_after(b->s, b->grid, each * ((double)first + 0.5 * (double)n), &out.r, &out.z);
    out.width = to - from;
    out.turn = b->least > 1 && k % 2 == 1 ? 0.5 : 0.0; /* where no mirror asks for none, bands are staggered */
    return out;
}

static floe_status put_band(seed_list *list, context *ctx, const banding *b, const band *at)
{
    const int axis = b->s->axis, one = (axis + 1) % 3, two = (axis + 2) % 3;
    for (long i = 0; i < at->n; i++) {
        const double share = ((double)i + 0.5 + at->turn) / (double)at->n - 0.5;
        const double angle = b->sector.middle + share * b->sector.width;
        double x[3];
        x[axis] = at->z;
        x[one] = b->s->centre[one] + at->r * cos(angle);
        x[two] = b->s->centre[two] + at->r * sin(angle);
        if (i == 0) TRY(check_point_spacing(ctx, b->grid, x, at->width, at->r * b->sector.width / (double)at->n));
        TRY(layer_put_point(list, ctx, b->grid, (size_t)(at->first + i), x));
    }
    return FLOE_OK;
}

static floe_status check_profile(context *ctx, const sheet_surface *s, const seed_spec *grid)
{
    for (int i = 0; i < count_pieces(s); i++) {
        const profile_piece p = profile_segment(s, grid, i);
        for (int k = 0; k <= 64; k++) {
            double r, z;
            piece_place(&p, k / 64.0, &r, &z);
            if (r < -1e-12 * (fabs(p.centre[0]) + p.radius))
                return fail(ctx, FLOE_BAD_INPUT,
                            "its curve crosses the axis about which it is turned, at %g m along it", z);
        }
    }
    return FLOE_OK;
}

static floe_status fill_bands(seed_list *list, context *ctx, const banding *b, double thickness)
{
    long all = 0, first = 0;
    for (int k = 0; k < b->bands; k++) all += band_count(b, k);
    TRY(layer_reserve(list, ctx, (size_t)all, 3));
    for (int k = 0; k < b->bands; k++) {
        const long n = band_count(b, k);
        const band at = band_at(b, k, first, n, all);
        TRY(put_band(list, ctx, b, &at));
        first += n;
    }
    for (long i = 0; i < all; i++) list->volume[i] = b->sector.width * b->area / (double)all * thickness;
    return FLOE_OK;
}

/* ---- planes ---- */

/* Points of a row, and rows. */
static void plane_counts(const sheet_surface *s, const sheet_seeding *how, const seed_spec *grid, double count[2])
{
    const double first = vec_norm(s->first), second = vec_norm(s->second);
    const double along = sqrt(requested_points(s, how, grid) * first / second);
    count[0] = fmax(1.0, round(along));
    count[1] = fmax(1.0, round(along * second / first));
}

static floe_status fill_plane(seed_list *list, context *ctx, const sheet_surface *s, const sheet_seeding *how,
                              const seed_spec *grid)
{
    const double area = plane_area(s), first = vec_norm(s->first), second = vec_norm(s->second);
    double count[2];
    plane_counts(s, how, grid, count);
    TRY(layer_check_number(ctx, count[0] * count[1]));
    const long n = (long)count[0], m = (long)count[1];
    TRY(layer_reserve(list, ctx, (size_t)(n * m), 3));
    for (long i = 0; i < n * m; i++) {
        const long row = i / n;
        const double u = ((double)(i % n) + 0.5) / (double)n, v = ((double)row + 0.5) / (double)m;
        double x[3];
        for (int k = 0; k < 3; k++) x[k] = s->corner[k] + u * s->first[k] + v * s->second[k];
        if (i == 0) TRY(check_point_spacing(ctx, grid, x, first / (double)n, second / (double)m));
        TRY(layer_put_point(list, ctx, grid, (size_t)i, x));
        list->volume[i] = area / (double)(n * m) * how->thickness;
    }
    return FLOE_OK;
}

/* ---- points as they are listed ---- */

static floe_status fill_points(seed_list *list, context *ctx, const sheet_surface *s, double thickness,
                               const seed_spec *grid)
{
    const long n = s->curve.n_vertices;
    const double each = s->area / (double)n, side = sqrt(each);
    TRY(layer_reserve(list, ctx, (size_t)n, 3));
    for (long i = 0; i < n; i++) {
        const double *x = s->curve.vertex + 3 * (ptrdiff_t)i;
        if (i == 0) TRY(check_point_spacing(ctx, grid, x, side, side));
        TRY(layer_put_point(list, ctx, grid, (size_t)i, x));
        list->volume[i] = each * thickness;
    }
    return FLOE_OK;
}

static floe_status place_sheet_points(seed_list *list, context *ctx, const sheet_surface *s, const sheet_seeding *how,
                                      const seed_spec *grid)
{
    if (s->kind == SHEET_REVOLVED) TRY(check_profile(ctx, s, grid));
    if (!(sheet_area(s, grid) > 0.0)) return fail(ctx, FLOE_BAD_INPUT, "the surface has no area");
    if (s->kind == SHEET_PLANE) return fill_plane(list, ctx, s, how, grid);
    if (s->kind == SHEET_POINTS) return fill_points(list, ctx, s, how->thickness, grid);
    const banding b = banding_of(s, how, grid);
    TRY(layer_check_number(ctx, fmax(b.asked, b.bands)));
    return fill_bands(list, ctx, &b, how->thickness);
}

floe_status seed_sheet(seed_list *out, context *ctx, const sheet_surface *s, const sheet_seeding *how,
                       const seed_spec *grid)
{
    *out = (seed_list){0};
    const floe_status status = place_sheet_points(out, ctx, s, how, grid);
    if (status != FLOE_OK) seed_list_free(ctx, out);
    return status;
}

/* ---- rows ---- */

/* Sides of the mesh on which a coordinate lies. */
static unsigned sides_at(const seed_spec *grid, int axis, double x)
{
    const int half = half_of(grid, axis, x);
    return half == 0 ? 0 : 1u << (2 * axis + (half < 0));
}

/* Where a profile ends. */
static void end_profile(const sheet_surface *s, const seed_spec *grid, int which, sheet_rows *out)
{
    const profile_piece p = profile_segment(s, grid, which ? count_pieces(s) - 1 : 0);
    double r, z;
    piece_place(&p, which, &r, &z);
    out->end_side[which] = sides_at(grid, s->axis, z);
    out->end[which] = out->end_side[which]          ? SHEET_ENDS_ON_SIDE
                      : r < 1e-9 * layer_cell(grid) ? SHEET_ENDS_AT_AXIS
                                                    : SHEET_ENDS_INSIDE;
}

/* The side on which rows of a part of the circle begin or end, at an angle. */
static unsigned side_at_angle(const sheet_surface *s, const seed_spec *grid, double angle)
{
    const int axis = (s->axis + (fabs(cos(angle)) > 0.5 ? 2 : 1)) % 3;
    return sides_at(grid, axis, s->centre[axis]);
}

static bool is_profile_closed(const sheet_surface *s)
{
    return s->kind == SHEET_REVOLVED && curve_is_closed(&s->curve);
}

static void list_bands(const banding *b, sheet_rows *out)
{
    const sector *of = &b->sector;
    out->closed = of->width > 1.5 * pi;
    for (int k = 0; k < b->bands; k++) out->first[k + 1] = out->first[k] + (size_t)band_count(b, k);
    for (int end = 0; end < 2; end++) {
        end_profile(b->s, b->grid, end, out);
        if (is_profile_closed(b->s)) out->end[end] = SHEET_ENDS_JOINED;
        if (!out->closed)
            out->row_side[end] = side_at_angle(b->s, b->grid, of->middle + (end ? 0.5 : -0.5) * of->width);
    }
}

/* Side of the mesh on which an edge of a plane lies, from a corner on. */
static unsigned side_of_edge(const seed_spec *grid, const double corner[3], const double along[3])
{
    for (int a = 0; a < 3; a++)
        if (sides_at(grid, a, corner[a]) && sides_at(grid, a, corner[a]) == sides_at(grid, a, corner[a] + along[a]))
            return sides_at(grid, a, corner[a]);
    return 0;
}

static void list_plane_rows(const sheet_surface *s, const seed_spec *grid, size_t n, sheet_rows *out)
{
    double beyond[2][3];
    for (int k = 0; k < out->n; k++) out->first[k + 1] = out->first[k] + n;
    for (int a = 0; a < 3; a++) {
        beyond[0][a] = s->corner[a] + s->first[a];
        beyond[1][a] = s->corner[a] + s->second[a];
    }
    out->row_side[0] = side_of_edge(grid, s->corner, s->second);
    out->row_side[1] = side_of_edge(grid, beyond[0], s->second);
    out->end_side[0] = side_of_edge(grid, s->corner, s->first);
    out->end_side[1] = side_of_edge(grid, beyond[1], s->first);
    for (int end = 0; end < 2; end++) out->end[end] = out->end_side[end] ? SHEET_ENDS_ON_SIDE : SHEET_ENDS_INSIDE;
    vec_cross(s->first, s->second, out->outward);
}

floe_status sheet_rows_make(sheet_rows *out, context *ctx, const sheet_surface *s, const sheet_seeding *how,
                            const seed_spec *grid)
{
    double count[2] = {0.0, 0.0};
    *out = (sheet_rows){.n = 0};
    if (s->kind == SHEET_POINTS)
        return fail(ctx, FLOE_BAD_INPUT,
                    "listed points have no neighbours, between which it could keep gas: give a sphere, a cylinder, a "
                    "plane or what a curve turns out");
    if (s->kind == SHEET_PLANE) {
        plane_counts(s, how, grid, count);
        out->n = (int)count[1];
    } else {
        out->n = banding_of(s, how, grid).bands;
    }
    TRY(memory_new(ctx, &out->first, (size_t)out->n + 1, sizeof *out->first));
    if (s->kind == SHEET_PLANE) {
        list_plane_rows(s, grid, (size_t)count[0], out);
        return FLOE_OK;
    }
    const banding b = banding_of(s, how, grid);
    list_bands(&b, out);
    return FLOE_OK;
}

void sheet_rows_free(context *ctx, sheet_rows *rows)
{
    memory_free(ctx, &rows->first);
}
