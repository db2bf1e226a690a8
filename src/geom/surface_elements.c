#include "geom/surface_elements.h"

#include "math/tensor.h"

#include <math.h>
#include <string.h>

typedef struct cutter {
    const shape *shape;
    const seed_spec *grid;
    surface_visitor *visit;
    void *user;
    double step; /* m, of differences */
} cutter;

static double element_level_at(const cutter *c, const double x[3])
{
    return shape_level(c->shape, c->grid->dim, x);
}

static void level_gradient(const cutter *c, const double x[3], double g[3])
{
    for (int a = 0; a < 3; ++a) {
        g[a] = 0.0;
        if (a >= c->grid->dim) continue;
        double up[3] = {x[0], x[1], x[2]}, down[3] = {x[0], x[1], x[2]};
        up[a] += c->step;
        down[a] -= c->step;
        g[a] = (element_level_at(c, up) - element_level_at(c, down)) / (2.0 * c->step);
    }
}

/* Brings the element's centre onto the surface, and gives it its normal. */
static void emit_element(const cutter *c, const double *const corner[3], int corners, double area)
{
    surface_element e = {.corners = corners};
    double g[3];
    for (int k = 0; k < corners; ++k) {
        memcpy(e.corner[k], corner[k], sizeof e.corner[k]);
        for (int a = 0; a < 3; ++a) e.x[a] += corner[k][a] / corners;
    }
    for (int pass = 0; pass < 3; ++pass) {
        level_gradient(c, e.x, g);
        const double square = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
        if (!(square > 0.0)) return;
        const double move = element_level_at(c, e.x) / square;
        for (int a = 0; a < 3; ++a) e.x[a] -= move * g[a];
    }
    level_gradient(c, e.x, g);
    const double length = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    for (int a = 0; a < 3; ++a) e.normal[a] = g[a] / length;
    e.area = c->grid->axisymmetric ? area * e.x[0] : area;
    c->visit(c->user, &e);
}

enum { CROSSING_PASSES = 20 };

/* Where the surface crosses an edge from a, inside, to b: by regula falsi, an end that stays being given half of its level (Illinois). */
static void edge_crossing(const cutter *c, const double *a, const double *b, double la, double lb, double x[3])
{
    double low = 0.0, high = 1.0;
    int stayed = 0;
    memcpy(x, b, 3 * sizeof *x);
    for (int pass = lb == 0.0 ? CROSSING_PASSES : 0; pass < CROSSING_PASSES; ++pass) {
        const double t = low + (high - low) * la / (la - lb);
        for (int d = 0; d < 3; ++d) x[d] = a[d] + t * (b[d] - a[d]);
        const double level = element_level_at(c, x);
        if (fabs(level) <= 1e-9 * c->step) return; /* round-off */
        if (level < 0.0) {
            low = t;
            la = level;
            if (stayed < 0) lb *= 0.5;
            stayed = -1;
        } else {
            high = t;
            lb = level;
            if (stayed > 0) la *= 0.5;
            stayed = 1;
        }
    }
}

/* `out`: a direction out of the shape. */
static void emit_triangle(const cutter *c, const double *p, const double *q, const double *r, const double out[3])
{
    double normal[3];
    triangle_normal(p, q, r, normal);
    const double area = 0.5 * vec_norm(normal);
    const bool turned = vec_dot(normal, out) < 0.0;
    if (area > 0.0) emit_element(c, (const double *const[3]){p, turned ? r : q, turned ? q : r}, 3, area);
}

static void emit_segment(const cutter *c, const double *p, const double *q, const double out[3])
{
    const double normal[2] = {q[1] - p[1], p[0] - q[0]}, length = hypot(normal[0], normal[1]);
    const bool turned = normal[0] * out[0] + normal[1] * out[1] < 0.0;
    if (length > 0.0) emit_element(c, (const double *const[3]){turned ? q : p, turned ? p : q}, 2, length);
}

/* The cut of a simplex: a point, a segment, a triangle or two of a quadrilateral through the edges whose ends differ in
 * sign. */
static void emit_cut(const cutter *c, double cut[4][3], int n, const double out[3])
{
    if (n == 1) {
        emit_element(c, (const double *const[3]){cut[0]}, 1, 1.0);
    } else if (n == 2) {
        emit_segment(c, cut[0], cut[1], out);
    } else if (n == 3) {
        emit_triangle(c, cut[0], cut[1], cut[2], out);
    } else { /* edges come as ab, ac | bd, cd, so that 0, 1, 3, 2 goes around; the shorter diagonal, as an image has it */
        const bool across = vec_distance2(cut[1], cut[2]) < vec_distance2(cut[0], cut[3]);
        emit_triangle(c, cut[0], cut[1], across ? cut[2] : cut[3], out);
        emit_triangle(c, across ? cut[1] : cut[0], cut[3], cut[2], out);
    }
}

/* Cuts a simplex of dim + 1 corners. Corners inside come first, so that edges inside-outside are met in a fixed
 * order. */
static void emit_simplex_cut(const cutter *c, const double corner[4][3])
{
    const int corners = c->grid->dim + 1;
    double l[4], cut[4][3], out[3] = {0.0};
    int inside[4], outside[4], n_in = 0, n_out = 0, n = 0;
    for (int k = 0; k < corners; ++k) {
        l[k] = element_level_at(c, corner[k]);
        if (l[k] < 0.0)
            inside[n_in++] = k;
        else
            outside[n_out++] = k;
    }
    for (int i = 0; i < n_in; ++i)
        for (int o = 0; o < n_out; ++o)
            edge_crossing(c, corner[inside[i]], corner[outside[o]], l[inside[i]], l[outside[o]], cut[n++]);
    for (int a = 0; a < 3 && n > 0; ++a) {
        for (int i = 0; i < n_in; ++i) out[a] -= corner[inside[i]][a] / n_in;
        for (int o = 0; o < n_out; ++o) out[a] += corner[outside[o]][a] / n_out;
    }
    if (n > 0) emit_cut(c, cut, n, out);
}

/* The orders of a line's, a plane's and space's axes. */
static const int order[3][6][3] = {
    {{0}}, {{0, 1}, {1, 0}}, {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
static const int orders[3] = {1, 2, 6};

/* The simplex on the way from the middle along the axes in an order, to the upper side where `upper` has the bit of the
 * axis' turn, and then along a whole edge. */
static void cut_along(const cutter *c, const double lo[3], const double hi[3], const double from[3], const int axis[3],
                      int upper)
{
    const int last = c->grid->dim - 1;
    double corner[4][3], at[3] = {from[0], from[1], from[2]};
    for (int k = 0; k < last; ++k) {
        memcpy(corner[k], at, sizeof at);
        at[axis[k]] = ((upper >> k) & 1) != 0 ? hi[axis[k]] : lo[axis[k]];
    }
    for (int end = 0; end < 2; ++end) {
        at[axis[last]] = end ? hi[axis[last]] : lo[axis[last]];
        memcpy(corner[last + end], at, sizeof at);
    }
    emit_simplex_cut(c, (const double(*)[3])corner);
}

/* lo and hi: opposite corners. */
static void cut_elements_of_box(const cutter *c, const double lo[3], const double hi[3])
{
    const int dim = c->grid->dim, ways = 1 << (dim - 1);
    double from[3];
    for (int a = 0; a < 3; ++a) from[a] = 0.5 * (lo[a] + hi[a]);
    for (int k = 0; k < orders[dim - 1]; ++k)
        for (int upper = 0; upper < ways; ++upper) cut_along(c, lo, hi, from, order[dim - 1][k], upper);
}

/* Place of a face of the sub-boxes: neighbours compute the same bits, in whichever cell they are, so that a surface
 * along a face is met once. */
static double sub_box_face(const seed_spec *g, int axis, int cell, int at, int divide)
{
    return g->lower[axis] + g->h[axis] * (cell + (double)at / divide);
}

/* Sub-boxes of a cell, unless the surface is farther from its centre than its corners are. */
static void cut_elements_of_cell(const cutter *c, const int cell[3], int divide)
{
    const seed_spec *g = c->grid;
    double centre[3] = {0}, reach = 0.0;
    for (int a = 0; a < g->dim; ++a) {
        centre[a] = g->lower[a] + (cell[a] + 0.5) * g->h[a];
        reach += g->h[a] * g->h[a];
    }
    if (fabs(element_level_at(c, centre)) > sqrt(reach)) return;
    const int ny = g->dim > 1 ? divide : 1, nz = g->dim > 2 ? divide : 1;
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < divide; ++i) {
                const int at[3] = {i, j, k};
                double lo[3] = {0}, hi[3] = {0};
                for (int a = 0; a < g->dim; ++a) {
                    lo[a] = sub_box_face(g, a, cell[a], at[a], divide);
                    hi[a] = sub_box_face(g, a, cell[a], at[a] + 1, divide);
                }
                cut_elements_of_box(c, lo, hi);
            }
}

void surface_visit(const shape *s, const seed_spec *grid, int divide, surface_visitor *visit, void *user)
{
    cutter c = {s, grid, visit, user, 1e-6 * grid->h[0]};
    for (int k = 0; k < grid->n[2]; ++k)
        for (int j = 0; j < grid->n[1]; ++j)
            for (int i = 0; i < grid->n[0]; ++i) cut_elements_of_cell(&c, (const int[]){i, j, k}, divide);
}
