/* Embedded boundaries in the plane: polylines, split at the lines of the mesh, cell by cell. */
#include "embedded/cut_internal.h"

#include <math.h>

/* Integral of the weight of areas times the distance from the cell's centroid, along axis 0 from its lower side. */
static double moment_to(const mesh *m, int cell, double x)
{
    if (m->geometry != MESH_AXISYMMETRIC) {
        const double across = x - mesh_centre(m, 0, cell), half = 0.5 * m->h[0];
        return 0.5 * (across * across - half * half);
    }
    const double low = mesh_node(m, 0, cell), high = mesh_node(m, 0, cell + 1);
    const double centroid = 2.0 / 3.0 * (low * low + low * high + high * high) / (low + high);
    return (x * x * x - low * low * low) / 3.0 - 0.5 * centroid * (x * x - low * low);
}

/* Green's theorem, by Simpson's rule, which is exact for what is cubic along a straight piece. */
static cut_part part_of(const mesh *m, const int cell[3], const double from[2], const double to[2])
{
    static const double weight[3] = {1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0};
    const double left = cut_weight_to(m, mesh_node(m, 0, cell[0])), up = to[1] - from[1];
    cut_part p = {0.0, {0.0}};
    for (int k = 0; k < 3; ++k) {
        const double x = from[0] + 0.5 * k * (to[0] - from[0]), y = from[1] + 0.5 * k * up;
        p.moment[0] += weight[k] * up * moment_to(m, cell[0], x);
        p.moment[1] += weight[k] * up * (cut_weight_to(m, x) - left) * (y - mesh_centre(m, 1, cell[1]));
    }
    const double middle = 0.5 * (from[0] + to[0]);
    const double mean = (cut_weight_to(m, from[0]) + 4.0 * cut_weight_to(m, middle) + cut_weight_to(m, to[0])) / 6.0;
    p.volume = (mean - left) * up;
    return p;
}

static floe_status add_piece(cut_surface *c, const int cell[3], const int vertex[2], const double from[2],
                             const double to[2], double share)
{
    const double radius = c->mesh->geometry == MESH_AXISYMMETRIC ? 0.5 * (from[0] + to[0]) : 1.0;
    const cut_piece piece = {.vertex = {vertex[0], vertex[1]},
                             .weight = {1.0 - share, share},
                             .area = {radius * (to[1] - from[1]), -radius * (to[0] - from[0])}};
    const cut_part part = part_of(c->mesh, cell, from, to);
    return cut_add_piece(c, cell, &piece, &part);
}

/* The line passes through the face on a side of a cell, at x, upwards along the axis or (direction -1) downwards. Enclosed
 * is what lies on its left: of a face across axis 0 the part above x, of one across axis 1 the part below. */
static void pass(cut_surface *c, int at, int axis, int side, const double x[2], int direction)
{
    const mesh *m = c->mesh;
    cut_cell *k = &c->cell[at];
    k->jump[axis][side] += direction;
    k->crossed |= (unsigned char)(1 << (2 * axis + side));
    if (axis == 0) {
        k->face[0][side] += direction * (mesh_node(m, 1, k->cell[1] + 1) - x[1]);
        const double half = 0.5 * m->h[1], above = x[1] - mesh_centre(m, 1, k->cell[1]);
        if (side == SIDE_UPPER) k->upper += direction * 0.5 * (half * half - above * above);
    } else {
        k->face[1][side] -= direction * (cut_weight_to(m, mesh_node(m, 0, k->cell[0] + 1)) - cut_weight_to(m, x[0]));
    }
}

static void cell_of(const mesh *m, const double x[2], int cell[3])
{
    cell[2] = 0;
    for (int a = 0; a < 2; ++a) {
        const int i = mesh_cell_of(m, a, x[a]);
        cell[a] = i < 0 ? 0 : i >= m->n[a] ? m->n[a] - 1 : i;
    }
}

/* Share of the segment from a to b at which it crosses the side of a cell towards b. Both may lie on it where it is a
 * periodic side: of the two cells beside it either holds one. */
static double share_to(const mesh *m, const double a[2], const double b[2], int axis, int node)
{
    if (b[axis] == a[axis]) return 0.0;
    const double t = (mesh_node(m, axis, node) - a[axis]) / (b[axis] - a[axis]);
    return t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
}

/* Kept on the sides of a cell, so that passages lie on their faces whatever round-off does. */
static double within(const mesh *m, int axis, int cell, double x)
{
    return fmin(fmax(x, mesh_node(m, axis, cell)), mesh_node(m, axis, cell + 1));
}

/* What is left of a segment: from `a` to `b`, as seen from the cell that is reached (images of its vertices, where it
 * goes around periodic sides), and the cells along each axis to that of `b`. */
typedef struct segment {
    double a[2], b[2];
    int cell[3], steps[2];
} segment;

static segment segment_between(const cut_surface *c, const int vertex[2])
{
    const mesh *m = c->mesh;
    const double *a = c->vertex[vertex[0]].x, *b = c->vertex[vertex[1]].x;
    segment s;
    int last[3];
    cell_of(m, a, s.cell);
    cell_of(m, b, last);
    for (int k = 0; k < 2; ++k) {
        const double image = mesh_to_image(m, k, b[k], a[k]);
        s.a[k] = a[k];
        s.b[k] = b[k] + image;
        s.steps[k] = last[k] - s.cell[k] + (image > 0.0 ? m->n[k] : image < 0.0 ? -m->n[k] : 0);
    }
    return s;
}

/* Share of the segment at which it leaves the cell, and the axis across the face through which it does. */
static double next_passage(const mesh *m, const segment *s, int *axis)
{
    double t = INFINITY;
    for (int k = 0; k < 2; ++k) {
        if (s->steps[k] == 0) continue;
        const double to = share_to(m, s->a, s->b, k, s->steps[k] > 0 ? s->cell[k] + 1 : s->cell[k]);
        if (!(to < t)) continue;
        t = to;
        *axis = k;
    }
    return t;
}

/* On to the next cell, through its face at x. */
static void step_on(const mesh *m, segment *s, int axis, double x[2])
{
    const int step = s->steps[axis] > 0 ? 1 : -1, before = s->cell[axis];
    (void)mesh_step(m, s->cell, axis, step);
    s->steps[axis] -= step;
    if (s->cell[axis] == before + step) return;
    const double length = m->upper[axis] - m->lower[axis];
    s->a[axis] -= step * length;
    s->b[axis] -= step * length;
    x[axis] = mesh_node(m, axis, step > 0 ? 0 : m->n[axis]);
}

/* From one vertex to the next, cell by cell. */
static floe_status trace_segment(cut_surface *c, const int vertex[2])
{
    const mesh *m = c->mesh;
    segment s = segment_between(c, vertex);
    double from[2] = {s.a[0], s.a[1]}, before = 0.0;
    while (s.steps[0] != 0 || s.steps[1] != 0) {
        int axis = 0, at;
        const double t = next_passage(m, &s, &axis);
        const int step = s.steps[axis] > 0 ? 1 : -1, other = 1 - axis;
        double x[2];
        x[axis] = mesh_node(m, axis, step > 0 ? s.cell[axis] + 1 : s.cell[axis]);
        x[other] = within(m, other, s.cell[other], s.a[other] + t * (s.b[other] - s.a[other]));
        TRY(add_piece(c, s.cell, vertex, from, x, 0.5 * (before + t)));
        TRY(cut_touch(c, s.cell, &at));
        pass(c, at, axis, step > 0 ? SIDE_UPPER : SIDE_LOWER, x, step);
        step_on(m, &s, axis, x);
        TRY(cut_touch(c, s.cell, &at));
        pass(c, at, axis, step > 0 ? SIDE_LOWER : SIDE_UPPER, x, step);
        from[0] = x[0];
        from[1] = x[1];
        before = t;
    }
    return add_piece(c, s.cell, vertex, from, c->vertex[vertex[1]].x, 0.5 * (before + 1.0));
}

/* An end of an open line passes through the side of the mesh on which it lies; inward at the first vertex. */
static floe_status pass_side(cut_surface *c, int vertex, int inward)
{
    const mesh *m = c->mesh;
    const double *x = c->vertex[vertex].x;
    int cell[3], at;
    cell_of(m, x, cell);
    TRY(cut_touch(c, cell, &at));
    for (int axis = 0; axis < 2; ++axis)
        for (int side = 0; side < 2; ++side) {
            if (x[axis] != (side == SIDE_LOWER ? m->lower[axis] : m->upper[axis])) continue;
            pass(c, at, axis, side, x, side == SIDE_LOWER ? inward : -inward);
            return FLOE_OK;
        }
    return fail(c->ctx, FLOE_BAD_INPUT,
                "a boundary of gas ends at (%g, %g), inside the domain: let it end on a symmetry or slip side, or "
                "close it",
                x[0], x[1]);
}

floe_status cut_walk(cut_surface *c, const cut_chain *chain)
{
    const int last = chain->first + chain->n - 1;
    for (int k = chain->first; k < last; ++k) TRY(trace_segment(c, (const int[]){k, k + 1}));
    if (chain->closed) return trace_segment(c, (const int[]){last, chain->first});
    TRY(pass_side(c, chain->first, 1));
    return pass_side(c, last, -1);
}
