/* What makes triangles the surface of a body: every side is that of two triangles which run along it in opposite ways, no triangle
 * passes another, and pieces within pieces are cavities. */
#include "geom/triangles.h"

#include "base/memory.h"
#include "math/tensor.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Of the extent: places this near are one; of a turn: pieces surround a point by whole ones. */
static const double round_off = 1e-12, half_a_turn = 0.5;

/* ---- sides ---- */

/* A side of a triangle by its lower vertex and its higher one. */
typedef struct triangle_side {
    int low, high, triangle, k;
    bool up; /* the triangle runs from the lower one to the higher */
} triangle_side;

static int by_vertices(const void *a, const void *b)
{
    const triangle_side *p = a, *q = b;
    if (p->low != q->low) return p->low < q->low ? -1 : 1;
    if (p->high != q->high) return p->high < q->high ? -1 : 1;
    return p->up != q->up ? (p->up ? -1 : 1) : p->triangle - q->triangle;
}

static floe_status sort_sides(const triangle_surface *t, context *ctx, triangle_side **out)
{
    TRY(memory_new(ctx, out, 3 * (size_t)t->n + 1, sizeof **out));
    for (int i = 0; i < 3 * t->n; i++) {
        const int *corner = t->triangle[i / 3].corner, a = corner[i % 3], b = corner[(i + 1) % 3];
        (*out)[i] = (triangle_side){a < b ? a : b, a < b ? b : a, i / 3, i % 3, a < b};
    }
    qsort(*out, 3 * (size_t)t->n, sizeof **out, by_vertices);
    return FLOE_OK;
}

static void refuse_side(const triangle_surface *t, const triangle_side *s, const char *what, char why[SHAPE_WHY])
{
    const double *a = t->x[s->low], *b = t->x[s->high];
    (void)snprintf(why, SHAPE_WHY, "%s at the side from (%.9g, %.9g, %.9g) to (%.9g, %.9g, %.9g)", what, a[0], a[1],
                   a[2], b[0], b[1], b[2]);
}

static bool is_same_side(const triangle_side *a, const triangle_side *b)
{
    return a->low == b->low && a->high == b->high;
}

static void check_pairs(const triangle_surface *t, const triangle_side *side, char why[SHAPE_WHY])
{
    for (int i = 0, n; i < 3 * t->n && !why[0]; i += n) {
        for (n = 1; i + n < 3 * t->n && is_same_side(&side[i], &side[i + n]);) n++;
        if (n == 1)
            refuse_side(t, &side[i], "it is open", why);
        else if (n > 2)
            refuse_side(t, &side[i], "more than two triangles meet", why);
        else if (side[i].up == side[i + 1].up)
            refuse_side(t, &side[i], "two triangles face opposite ways", why);
    }
}

floe_status triangles_find_side_normals(triangle_surface *t, context *ctx)
{
    triangle_side *side = NULL;
    TRY(sort_sides(t, ctx, &side));
    for (int i = 0; i < 3 * t->n; i++) {
        const triangle_side *s = &side[i], *other = &side[i ^ 1];
        for (int a = 0; a < 3; a++)
            t->triangle[s->triangle].normal[FEATURE_SIDE + s->k][a] =
                t->triangle[s->triangle].normal[FEATURE_FACE][a] + t->triangle[other->triangle].normal[FEATURE_FACE][a];
    }
    memory_free(ctx, &side);
    return FLOE_OK;
}

/* ---- pieces ---- */

static int find_root(int *up, int k)
{
    while (up[k] != k) k = up[k] = up[up[k]];
    return k;
}

/* The lowest triangle of the piece that each belongs to. */
static void join_pieces(const triangle_surface *t, const triangle_side *side, int *piece)
{
    for (int i = 0; i < t->n; i++) piece[i] = i;
    for (int i = 0; i < 3 * t->n; i += 2) {
        const int a = find_root(piece, side[i].triangle), b = find_root(piece, side[i + 1].triangle);
        piece[a > b ? a : b] = a < b ? a : b;
    }
    for (int i = 0; i < t->n; i++) piece[i] = find_root(piece, i);
}

/* Six times the volume between a triangle and a point. */
static double volume_from(const triangle_surface *t, const triangle *of, const double x[3])
{
    double r[3][3], across[3];
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++) r[k][a] = t->x[of->corner[k]][a] - x[a];
    vec_cross(r[1], r[2], across);
    return vec_dot(r[0], across);
}

/* The share of a turn that a triangle covers as seen from a point (A. van Oosterom, J. Strackee, IEEE Trans. Biomed. Eng. 30 (1983)
 * 125). */
static double share_of_turn(const triangle_surface *t, const triangle *of, const double x[3])
{
    double r[3][3], size[3];
    for (int k = 0; k < 3; k++) {
        for (int a = 0; a < 3; a++) r[k][a] = t->x[of->corner[k]][a] - x[a];
        size[k] = sqrt(vec_dot(r[k], r[k]));
    }
    const double below = size[0] * size[1] * size[2] + vec_dot(r[0], r[1]) * size[2] + vec_dot(r[1], r[2]) * size[0] +
                         vec_dot(r[2], r[0]) * size[1];
    return atan2(volume_from(t, of, x), below) / 6.283185307179586;
}

/* What surrounds a piece, in turns, but for itself; and its volume. */
static double turns_about(const triangle_surface *t, const int *piece, int of, double *volume)
{
    double turns = 0.0;
    const double *x = t->x[t->triangle[of].corner[0]];
    *volume = 0.0;
    for (int i = 0; i < t->n; i++)
        if (piece[i] == of)
            *volume += volume_from(t, &t->triangle[i], x) / 6.0;
        else
            turns += share_of_turn(t, &t->triangle[i], x);
    return turns;
}

static void turn_surface_over(triangle_surface *t)
{
    for (int i = 0; i < t->n; i++) {
        int *corner = t->triangle[i].corner, swap = corner[1];
        corner[1] = corner[2];
        corner[2] = swap;
    }
}

/* A piece within nothing faces out, one within another is a cavity and faces in: or all the other way round. */
static void check_pieces(triangle_surface *t, const int *piece, char why[SHAPE_WHY])
{
    double whole = 0.0, volume, turns;
    for (int i = 0; i < t->n; i++) whole += volume_from(t, &t->triangle[i], t->x[0]) / 6.0;
    if (whole < 0.0) turn_surface_over(t);
    for (int i = 0; i < t->n && !why[0]; i++) {
        if (piece[i] != i) continue;
        turns = turns_about(t, piece, i, &volume);
        const bool is_cavity = fabs(turns - 1.0) < half_a_turn, stands_alone = fabs(turns) < half_a_turn;
        const double *x = t->x[t->triangle[i].corner[0]];
        if ((volume > 0.0 && stands_alone) || (volume < 0.0 && is_cavity)) continue;
        (void)snprintf(why, SHAPE_WHY,
                       volume == 0.0 ? "the piece at (%.9g, %.9g, %.9g) has no volume"
                                     : "the piece at (%.9g, %.9g, %.9g) faces the wrong way: pieces within others are "
                                       "cavities, and face in",
                       x[0], x[1], x[2]);
    }
}

floe_status triangles_check_sides(const triangle_surface *t, context *ctx, char why[SHAPE_WHY])
{
    triangle_side *side = NULL;
    if (t->n == 0) (void)snprintf(why, SHAPE_WHY, "it has no triangle");
    TRY(sort_sides(t, ctx, &side));
    check_pairs(t, side, why);
    memory_free(ctx, &side);
    return FLOE_OK;
}

floe_status triangles_check_pieces(triangle_surface *t, context *ctx, char why[SHAPE_WHY])
{
    triangle_side *side = NULL;
    int *piece = NULL;
    floe_status status = sort_sides(t, ctx, &side);
    if (status == FLOE_OK) status = memory_new(ctx, &piece, (size_t)t->n, sizeof *piece);
    if (status == FLOE_OK) {
        join_pieces(t, side, piece);
        check_pieces(t, piece, why);
    }
    memory_free(ctx, &piece);
    memory_free(ctx, &side);
    return status;
}

/* ---- crossings ---- */

typedef struct crossing_search {
    const triangle_surface *t;
    double near; /* m: places that are one */
    double at[3];
} crossing_search;

/* The axes of the plane in which a triangle is seen the largest. */
static void largest_view(const double area[3], int axis[2])
{
    int across = 0;
    for (int k = 1; k < 3; k++)
        if (fabs(area[k]) > fabs(area[across])) across = k;
    axis[0] = (across + 1) % 3;
    axis[1] = (across + 2) % 3;
}

static double turn_in_view(const double *a, const double *b, const double *c, const int axis[2])
{
    return (b[axis[0]] - a[axis[0]]) * (c[axis[1]] - a[axis[1]]) -
           (b[axis[1]] - a[axis[1]]) * (c[axis[0]] - a[axis[0]]);
}

static bool sides_cross_in_view(const double *a, const double *b, const double *c, const double *d, const int axis[2])
{
    const double ac = turn_in_view(a, b, c, axis), ad = turn_in_view(a, b, d, axis), ca = turn_in_view(c, d, a, axis),
                 cb = turn_in_view(c, d, b, axis);
    return ((ac > 0.0 && ad < 0.0) || (ac < 0.0 && ad > 0.0)) && ((ca > 0.0 && cb < 0.0) || (ca < 0.0 && cb > 0.0));
}

/* A place of the plane of a triangle lies in it. */
static bool lies_in(const triangle_surface *t, const triangle *of, const double area[3], const double x[3])
{
    int axis[2];
    largest_view(area, axis);
    const double *a = t->x[of->corner[0]], *b = t->x[of->corner[1]], *c = t->x[of->corner[2]];
    const double p = turn_in_view(a, b, x, axis), q = turn_in_view(b, c, x, axis), r = turn_in_view(c, a, x, axis);
    return (p >= 0.0 && q >= 0.0 && r >= 0.0) || (p <= 0.0 && q <= 0.0 && r <= 0.0);
}

/* Whether the line from p to q meets the triangle; both in its plane. */
static bool meets_in_plane(const triangle_surface *t, const triangle *of, const double area[3], const double *p,
                           const double *q)
{
    int axis[2];
    largest_view(area, axis);
    if (lies_in(t, of, area, p) || lies_in(t, of, area, q)) return true;
    for (int k = 0; k < 3; k++)
        if (sides_cross_in_view(p, q, t->x[of->corner[k]], t->x[of->corner[(k + 1) % 3]], axis)) return true;
    return false;
}

static bool line_meets(crossing_search *s, const triangle *of, const double *p, const double *q)
{
    double area[3], height[2];
    const double *a = s->t->x[of->corner[0]];
    triangle_area(s->t, of, area);
    const double size = sqrt(vec_dot(area, area));
    if (!(size > 0.0)) return false;
    for (int e = 0; e < 2; e++) {
        const double *x = e ? q : p, from[3] = {x[0] - a[0], x[1] - a[1], x[2] - a[2]};
        height[e] = vec_dot(area, from) / size;
    }
    memcpy(s->at, p, sizeof s->at);
    if (fabs(height[0]) <= s->near && fabs(height[1]) <= s->near) return meets_in_plane(s->t, of, area, p, q);
    if ((height[0] > s->near && height[1] > s->near) || (height[0] < -s->near && height[1] < -s->near)) return false;
    const double share = fmin(fmax(height[0] / (height[0] - height[1]), 0.0), 1.0);
    for (int k = 0; k < 3; k++) s->at[k] = p[k] + share * (q[k] - p[k]);
    return lies_in(s->t, of, area, s->at);
}

static bool has_corner(const triangle *of, int vertex)
{
    return of->corner[0] == vertex || of->corner[1] == vertex || of->corner[2] == vertex;
}

/* Sides of one that do not end at the other. */
static bool triangle_sides_meet(crossing_search *s, const triangle *a, const triangle *b)
{
    for (int k = 0; k < 3; k++) {
        const int from = a->corner[k], to = a->corner[(k + 1) % 3];
        if (has_corner(b, from) || has_corner(b, to)) continue;
        if (line_meets(s, b, s->t->x[from], s->t->x[to])) return true;
    }
    return false;
}

/* Whether two triangles that share a side lie on each other. */
static bool fold_back(crossing_search *s, const triangle *a, const triangle *b)
{
    int shared = 0;
    for (int k = 0; k < 3; k++)
        if (has_corner(b, a->corner[k])) {
            shared++;
            memcpy(s->at, s->t->x[a->corner[k]], sizeof s->at);
        }
    return shared >= 2 && vec_dot(a->normal[FEATURE_FACE], b->normal[FEATURE_FACE]) < -1.0 + round_off;
}

static bool boxes_meet(const triangle_box *a, const triangle_box *b, double near)
{
    for (int k = 0; k < 3; k++)
        if (a->lo[k] > b->hi[k] + near || b->lo[k] > a->hi[k] + near) return false;
    return true;
}

static triangle_box box_of(const triangle_surface *t, const triangle *of)
{
    triangle_box b = {.n = 1};
    for (int k = 0; k < 3; k++) {
        b.lo[k] = fmin(t->x[of->corner[0]][k], fmin(t->x[of->corner[1]][k], t->x[of->corner[2]][k]));
        b.hi[k] = fmax(t->x[of->corner[0]][k], fmax(t->x[of->corner[1]][k], t->x[of->corner[2]][k]));
    }
    return b;
}

/* A triangle after the first that meets it; -1: none. */
static int find_meeting(crossing_search *s, int first, int at)
{
    const triangle *of = &s->t->triangle[first];
    const triangle_box own = box_of(s->t, of), *b = &s->t->box[at];
    if (!boxes_meet(&own, b, s->near)) return -1;
    for (int k = b->first; k < b->first + b->n; k++) {
        const triangle *other = &s->t->triangle[k];
        if (k <= first) continue;
        const triangle_box theirs = box_of(s->t, other);
        if (!boxes_meet(&own, &theirs, s->near)) continue;
        if (fold_back(s, of, other) || triangle_sides_meet(s, of, other) || triangle_sides_meet(s, other, of)) return k;
    }
    if (b->n > 0) return -1;
    const int found = find_meeting(s, first, at + 1);
    return found >= 0 ? found : find_meeting(s, first, b->second);
}

void triangles_check_crossings(const triangle_surface *t, char why[SHAPE_WHY])
{
    const triangle_box *all = &t->box[0];
    crossing_search s = {.t = t};
    for (int k = 0; k < 3; k++) s.near = fmax(s.near, round_off * (all->hi[k] - all->lo[k]));
    for (int i = 0; i < t->n && !why[0]; i++)
        if (find_meeting(&s, i, 0) >= 0)
            (void)snprintf(why, SHAPE_WHY, "it meets itself at (%.9g, %.9g, %.9g)", s.at[0], s.at[1], s.at[2]);
}
