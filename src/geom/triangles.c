/* Distances by a tree of boxes, signed by the normals of what is nearest: of a face, the sum of two at a side, at a corner the
 * sum weighted by the angles (J. A. Baerentzen, H. Aanaes, IEEE Trans. Vis. Comput. Graph. 11 (2005) 243). */
#include "geom/triangles.h"

#include "base/memory.h"
#include "math/tensor.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEAF = 4, STACK = 128 };

static void difference_of(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++) out[k] = a[k] - b[k];
}

void triangle_area(const triangle_surface *t, const triangle *of, double out[3])
{
    triangle_normal(t->x[of->corner[0]], t->x[of->corner[1]], t->x[of->corner[2]], out);
}

/* ---- the nearest point ---- */

static int on_side(const double *a, const double *b, double share, int feature, double nearest[3])
{
    for (int k = 0; k < 3; k++) nearest[k] = a[k] + share * (b[k] - a[k]);
    return feature;
}

/* Nearest point of a triangle to x, and the feature that it lies on: by the regions of its plane (C. Ericson, Real-Time Collision Detection (2005), section 5.1.5). */
static int triangle_nearest(const triangle_surface *t, const triangle *of, const double x[3], double nearest[3])
{
    const double *a = t->x[of->corner[0]], *b = t->x[of->corner[1]], *c = t->x[of->corner[2]];
    double ab[3], ac[3], from_a[3], from_b[3], from_c[3];
    difference_of(b, a, ab);
    difference_of(c, a, ac);
    difference_of(x, a, from_a);
    difference_of(x, b, from_b);
    difference_of(x, c, from_c);
    const double d1 = vec_dot(ab, from_a), d2 = vec_dot(ac, from_a), d3 = vec_dot(ab, from_b), d4 = vec_dot(ac, from_b),
                 d5 = vec_dot(ab, from_c), d6 = vec_dot(ac, from_c);
    if (d1 <= 0.0 && d2 <= 0.0) return on_side(a, a, 0.0, FEATURE_CORNER, nearest);
    if (d3 >= 0.0 && d4 <= d3) return on_side(b, b, 0.0, FEATURE_CORNER + 1, nearest);
    if (d6 >= 0.0 && d5 <= d6) return on_side(c, c, 0.0, FEATURE_CORNER + 2, nearest);
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return on_side(a, b, d1 / (d1 - d3), FEATURE_SIDE, nearest);
    if (va <= 0.0 && d4 >= d3 && d5 >= d6)
        return on_side(b, c, (d4 - d3) / (d4 - d3 + d5 - d6), FEATURE_SIDE + 1, nearest);
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return on_side(a, c, d2 / (d2 - d6), FEATURE_SIDE + 2, nearest);
    const double v = vb / (va + vb + vc), w = vc / (va + vb + vc);
    for (int k = 0; k < 3; k++) nearest[k] = a[k] + v * ab[k] + w * ac[k];
    return FEATURE_FACE;
}

static double box_distance2(const triangle_box *b, const double x[3])
{
    double sum = 0.0;
    for (int k = 0; k < 3; k++) {
        const double d = fmax(fmax(b->lo[k] - x[k], x[k] - b->hi[k]), 0.0);
        sum += d * d;
    }
    return sum;
}

/* What is nearest to a point so far. */
typedef struct nearest_feature {
    double distance2, from[3]; /* m2, m: from the surface to the point */
    const double *normal;
} nearest_feature;

static void look_at_triangles(const triangle_surface *t, const triangle_box *b, const double x[3],
                              nearest_feature *best)
{
    for (int k = b->first; k < b->first + b->n; k++) {
        double nearest[3], from[3];
        const int feature = triangle_nearest(t, &t->triangle[k], x, nearest);
        difference_of(x, nearest, from);
        const double distance2 = vec_dot(from, from);
        if (!(distance2 < best->distance2)) continue;
        best->distance2 = distance2;
        best->normal = t->triangle[k].normal[feature];
        memcpy(best->from, from, sizeof from);
    }
}

double triangles_level(const triangle_surface *t, const double x[3])
{
    int stack[STACK], depth = 0;
    nearest_feature best = {.distance2 = HUGE_VAL, .normal = t->triangle[0].normal[0]}; /* none is empty */
    stack[depth++] = 0;
    while (depth > 0) {
        const int at = stack[--depth];
        const triangle_box *b = &t->box[at];
        if (box_distance2(b, x) >= best.distance2) continue;
        if (b->n > 0) {
            look_at_triangles(t, b, x, &best);
            continue;
        }
        const bool second_first = box_distance2(&t->box[b->second], x) < box_distance2(&t->box[at + 1], x);
        stack[depth++] = second_first ? at + 1 : b->second;
        stack[depth++] = second_first ? b->second : at + 1;
    }
    return vec_dot(best.from, best.normal) < 0.0 ? -sqrt(best.distance2) : sqrt(best.distance2);
}

/* ---- the tree ---- */

static void enclose_triangles(const triangle_surface *t, triangle_box *b, int first, int n)
{
    for (int k = 0; k < 3; k++) {
        b->lo[k] = HUGE_VAL;
        b->hi[k] = -HUGE_VAL;
    }
    for (int i = 3 * first; i < 3 * (first + n); i++)
        for (int k = 0; k < 3; k++) {
            const double x = t->x[t->triangle[i / 3].corner[i % 3]][k];
            b->lo[k] = fmin(b->lo[k], x);
            b->hi[k] = fmax(b->hi[k], x);
        }
}

static double middle_along(const triangle_surface *t, int number, int axis)
{
    const int *corner = t->triangle[number].corner;
    return t->x[corner[0]][axis] + t->x[corner[1]][axis] + t->x[corner[2]][axis];
}

/* Hoare's selection: those before the middle one lie before it along the axis. */
static void split_triangles(triangle_surface *t, int first, int n, int axis)
{
    int lo = first, hi = first + n - 1;
    const int middle = first + n / 2;
    while (lo < hi) {
        const double pivot = middle_along(t, lo + (hi - lo) / 2, axis);
        int i = lo, j = hi;
        while (i <= j) {
            while (middle_along(t, i, axis) < pivot) i++;
            while (middle_along(t, j, axis) > pivot) j--;
            if (i > j) break;
            const triangle swap = t->triangle[i];
            t->triangle[i++] = t->triangle[j];
            t->triangle[j--] = swap;
        }
        if (middle <= j)
            hi = j;
        else if (middle >= i)
            lo = i;
        else
            return;
    }
}

static int longest_axis(const triangle_box *b)
{
    int axis = 0;
    for (int k = 1; k < 3; k++)
        if (b->hi[k] - b->lo[k] > b->hi[axis] - b->lo[axis]) axis = k;
    return axis;
}

/* The box of some triangles, and all below it; as deep as the logarithm of their number. */
static void grow_tree(triangle_surface *t, int first, int n)
{
    triangle_box *b = &t->box[t->n_boxes++];
    *b = (triangle_box){.first = first, .n = n <= LEAF ? n : 0};
    enclose_triangles(t, b, first, n);
    if (n <= LEAF) return;
    split_triangles(t, first, n, longest_axis(b));
    grow_tree(t, first, n / 2);
    b->second = t->n_boxes;
    grow_tree(t, first + n / 2, n - n / 2);
}

/* ---- normals ---- */

static double angle_at(const triangle_surface *t, const triangle *of, int k)
{
    double u[3], v[3];
    difference_of(t->x[of->corner[(k + 1) % 3]], t->x[of->corner[k]], u);
    difference_of(t->x[of->corner[(k + 2) % 3]], t->x[of->corner[k]], v);
    const double size = sqrt(vec_dot(u, u) * vec_dot(v, v));
    return size > 0.0 ? acos(fmin(fmax(vec_dot(u, v) / size, -1.0), 1.0)) : 0.0;
}

static void find_corner_normals(triangle_surface *t, double (*sum)[3])
{
    for (int i = 0; i < t->n; i++)
        for (int k = 0; k < 3; k++) {
            const double angle = angle_at(t, &t->triangle[i], k);
            for (int a = 0; a < 3; a++)
                sum[t->triangle[i].corner[k]][a] += angle * t->triangle[i].normal[FEATURE_FACE][a];
        }
    for (int i = 0; i < t->n; i++)
        for (int k = 0; k < 3; k++)
            memcpy(t->triangle[i].normal[FEATURE_CORNER + k], sum[t->triangle[i].corner[k]], sizeof *sum);
}

static void find_face_normals(triangle_surface *t)
{
    for (int i = 0; i < t->n; i++) {
        double area[3];
        triangle_area(t, &t->triangle[i], area);
        const double size = sqrt(vec_dot(area, area));
        for (int a = 0; a < 3; a++) t->triangle[i].normal[FEATURE_FACE][a] = size > 0.0 ? area[a] / size : 0.0;
    }
}

/* ---- from corners to a surface ---- */

/* A corner by its position. */
typedef struct placed_corner {
    double x[3];
    int number;
} placed_corner;

static int by_position(const void *a, const void *b)
{
    const placed_corner *p = a, *q = b;
    for (int k = 0; k < 3; k++)
        if (p->x[k] != q->x[k]) return p->x[k] < q->x[k] ? -1 : 1;
    return p->number - q->number;
}

/* By value: a zero with a sign is at the same place as one without. */
static bool is_same_place(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* Corners at one position are one vertex. Triangles of which two corners are one are left out: nothing ends at them. */
static void join_corners(triangle_surface *t, placed_corner *sorted, int n, double (*x)[3])
{
    qsort(sorted, 3 * (size_t)n, sizeof *sorted, by_position);
    for (int i = 0; i < 3 * n; i++) {
        const bool same = i > 0 && is_same_place(sorted[i].x, sorted[i - 1].x);
        if (!same) memcpy(x[t->n_vertices++], sorted[i].x, sizeof *x);
        t->triangle[sorted[i].number / 3].corner[sorted[i].number % 3] = t->n_vertices - 1;
    }
    t->x = (const double(*)[3])x;
    t->n = 0;
    for (int i = 0; i < n; i++) {
        const int *c = t->triangle[i].corner;
        if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0]) t->triangle[t->n++] = t->triangle[i];
    }
}

static floe_status join_all(triangle_surface *t, const double (*corner)[3], int n, const shape_memory *memory)
{
    placed_corner *sorted = NULL;
    double(*x)[3];
    const size_t corners = 3 * (size_t)n;
    TRY(memory->allocate(memory->owner, &x, corners * sizeof *x));
    TRY(memory->allocate(memory->owner, &t->triangle, (size_t)n * sizeof *t->triangle));
    TRY(memory->allocate(memory->owner, &t->box, (size_t)n * sizeof *t->box));
    TRY(memory_new(memory->ctx, &sorted, corners, sizeof *sorted));
    for (int i = 0; i < 3 * n; i++) {
        for (int k = 0; k < 3; k++) sorted[i].x[k] = corner[i][k] + 0.0; /* one zero */
        sorted[i].number = i;
    }
    join_corners(t, sorted, n, x);
    memory_free(memory->ctx, &sorted);
    return FLOE_OK;
}

floe_status triangles_make(triangle_surface *out, const double (*corner)[3], int n, const shape_memory *memory,
                           char why[SHAPE_WHY])
{
    triangle_surface t = {.n = 0};
    double(*sum)[3] = NULL;
    TRY(join_all(&t, corner, n, memory));
    TRY(triangles_check_sides(&t, memory->ctx, why));
    if (why[0]) return FLOE_OK;
    grow_tree(&t, 0, t.n);
    find_face_normals(&t);
    triangles_check_crossings(&t, why);
    if (!why[0]) TRY(triangles_check_pieces(&t, memory->ctx, why));
    if (why[0]) return FLOE_OK;
    find_face_normals(&t); /* it may have been turned over */
    TRY(triangles_find_side_normals(&t, memory->ctx));
    TRY(memory_new(memory->ctx, &sum, (size_t)t.n_vertices, sizeof *sum));
    find_corner_normals(&t, sum);
    memory_free(memory->ctx, &sum);
    *out = t;
    return FLOE_OK;
}
