#include "mpm/membrane/membrane_curve.h"

#include "base/memory.h"
#include "mpm/membrane/membrane_normal.h"
#include "mpm/nodes/sides.h"

#include <math.h>

static const uint64_t ordinal_mask = (UINT64_C(1) << 40) - 1; /* of a point's id (grid/field_list.h) */

size_t point_number(const mpm *s, int blk, int body, size_t k)
{
    return (size_t)((uint64_t)field_get(s->domain->fields[blk], P_ID, body, 0)[k] & ordinal_mask);
}

void membrane_curve_update(mpm *s, int body, bool next)
{
    membrane_curve *curve = &s->curve[body];
    for (size_t i = 0; i < 3 * curve->n; ++i) curve->x[i] = i % 3 < (size_t)s->mesh->dim ? (double)NAN : 0.0;
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int a = 0; a < s->mesh->dim; ++a) {
            const double *x = (next ? field_next : field_get)(s->domain->fields[b], P_POS, body, a);
            for (size_t k = 0; k < s->points[b][body].n; ++k)
                curve->x[3 * point_number(s, b, body, k) + (size_t)a] = x[k];
        }
}

/* Image of a point in a mirror. */
static void reflect_at_mirror(const curve_end *end, const double *from, double x[3])
{
    for (int a = 0; a < 3; ++a) x[a] = from[a];
    x[end->axis] = 2.0 * end->plane - x[end->axis];
}

curve_neighbour membrane_curve_neighbour(const membrane_curve *curve, size_t number, int step)
{
    if (curve->link) {
        const curve_link *l = &curve->link[2 * number + (step > 0)];
        return (curve_neighbour){l->of, l->mirror.axis < 0 ? NULL : &l->mirror};
    }
    const bool at_end = step < 0 ? number == 0 : number + 1 == curve->n;
    if (!at_end || curve->closed)
        return (curve_neighbour){(ptrdiff_t)((number + curve->n + (step < 0 ? curve->n - 1 : 1)) % curve->n), NULL};
    const curve_end *end = &curve->end[step > 0];
    if (end->axis < 0) return (curve_neighbour){-1, NULL};
    return (curve_neighbour){(ptrdiff_t)(end->of_itself ? number : step < 0 ? number + 1 : number - 1), end};
}

/* Position of the point before (step -1) or after (+1). False at a free end, or where the point is lost. */
static bool neighbour_position(const membrane_curve *curve, size_t number, int step, double x[3])
{
    const curve_neighbour side = membrane_curve_neighbour(curve, number, step);
    if (side.of < 0) return false;
    const double *from = curve->x + 3 * side.of;
    for (int a = 0; a < 3; ++a) x[a] = from[a];
    if (side.mirror) reflect_at_mirror(side.mirror, from, x);
    return !isnan(x[0]);
}

/* The vector from a to b, across a periodic side where that is shorter. */
static void chord_of(const mesh *m, const double *a, const double *b, double chord[3])
{
    for (int k = 0; k < 3; ++k) {
        chord[k] = b[k] - a[k];
        if (k >= m->dim || !m->periodic[k]) continue;
        const double period = m->upper[k] - m->lower[k];
        chord[k] -= period * round(chord[k] / period);
    }
}

/* The next point on a side, or the point itself where there is none; and half of what lies between them at rest. */
static double reach_of(const membrane_curve *curve, size_t number, int step, double x[3])
{
    const double *own = curve->x + 3 * number;
    if (neighbour_position(curve, number, step, x)) {
        const ptrdiff_t of = membrane_curve_neighbour(curve, number, step).of;
        return curve->rest ? 0.5 * (curve->rest[number] + curve->rest[of]) : 0.0;
    }
    for (int a = 0; a < 3; ++a) x[a] = own[a];
    return 0.0;
}

double membrane_curve_chord(const mpm *s, int body, size_t number, double chord[3], double *rest)
{
    const membrane_curve *curve = &s->curve[body];
    double before[3], after[3];
    *rest = reach_of(curve, number, -1, before) + reach_of(curve, number, 1, after);
    chord_of(s->mesh, before, after, chord);
    return sqrt(chord[0] * chord[0] + chord[1] * chord[1] + chord[2] * chord[2]);
}

bool membrane_curve_second_difference(const mpm *s, int body, size_t number, double bend[3])
{
    const membrane_curve *curve = &s->curve[body];
    const double *own = curve->x + 3 * number;
    double before[3], after[3], back[3], on[3];
    if (isnan(own[0]) || !neighbour_position(curve, number, -1, before) || !neighbour_position(curve, number, 1, after))
        return false;
    chord_of(s->mesh, own, before, back);
    chord_of(s->mesh, own, after, on);
    for (int a = 0; a < 3; ++a) bend[a] = back[a] + on[a];
    return true;
}

bool membrane_curve_tangent(const mpm *s, int body, size_t number, double t[3])
{
    double chord[3], rest;
    if (s->curve[body].n < 2) return false;
    const double length = membrane_curve_chord(s, body, number, chord, &rest);
    if (!(length > 0.0)) return false;
    for (int a = 0; a < 3; ++a) t[a] = chord[a] / length;
    return true;
}

/* The mirror that an end lies on: less than three quarters of a spacing away, with the line running into it. */
static curve_end find_mirror(const mpm *s, int group, const double *end, const double *next)
{
    double gap[3];
    chord_of(s->mesh, next, end, gap);
    const double spacing = sqrt(gap[0] * gap[0] + gap[1] * gap[1] + gap[2] * gap[2]);
    for (int axis = 0; axis < s->mesh->dim; ++axis)
        for (int side = 0; side < 2; ++side) {
            const double plane = side == SIDE_LOWER ? s->mesh->lower[axis] : s->mesh->upper[axis];
            const double distance = fabs(end[axis] - plane);
            const bool towards = (side == SIDE_LOWER ? -gap[axis] : gap[axis]) > 0.5 * spacing;
            if (s->mesh->periodic[axis] || !wall_mirrors(s, group, axis, side) || !towards) continue;
            if (distance < 0.75 * spacing) return (curve_end){axis, plane, distance > 0.25 * spacing};
        }
    return (curve_end){.axis = -1};
}

/* Neighbours by number lie within a cell of each other, as seeding sees to; only a list of points with normals of their
 * own may be in any order. */
static bool is_ordered(const mpm *s, const membrane_curve *curve)
{
    double chord[3];
    for (size_t i = 1; i < curve->n; ++i) {
        chord_of(s->mesh, curve->x + 3 * (i - 1), curve->x + 3 * i, chord);
        for (int a = 0; a < s->mesh->dim; ++a)
            if (fabs(chord[a]) > s->mesh->h[a] * (1.0 + 1e-9)) return false;
    }
    return true;
}

floe_status membrane_curve_make(mpm *s, int body)
{
    membrane_curve *curve = &s->curve[body];
    const scene_body *b = &s->scene->body[s->body[body].scene_body];
    *curve = (membrane_curve){.n = mpm_body_points(s, body), .closed = curve_is_closed(&b->membrane.curve)};
    curve->end[0].axis = curve->end[1].axis = -1;
    TRY(memory_new(s->ctx, &curve->x, 3 * curve->n, sizeof *curve->x));
    if (b->membrane.strain == STRAIN_BY_POSITIONS) {
        TRY(membrane_curve_measure(s, body));
        if (normals_are_free(s, body)) TRY(memory_new(s->ctx, &curve->link, 2 * curve->n, sizeof *curve->link));
    }
    membrane_curve_update(s, body, false);
    curve->ordered = is_ordered(s, curve);
    if (curve->n < 2 || curve->closed) return FLOE_OK;
    curve->end[0] = find_mirror(s, s->body[body].group, curve->x, curve->x + 3);
    curve->end[1] = find_mirror(s, s->body[body].group, curve->x + 3 * (curve->n - 1), curve->x + 3 * (curve->n - 2));
    return FLOE_OK;
}

void membrane_curve_free(context *ctx, membrane_curve *curve)
{
    memory_free(ctx, &curve->x);
    memory_free(ctx, &curve->rest);
    memory_free(ctx, &curve->link);
}

void mpm_membrane_end(const mpm *s, int body, bool last, double x[3])
{
    const size_t wanted = last ? s->curve[body].n - 1 : 0;
    for (int a = 0; a < 3; ++a) x[a] = NAN;
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (size_t k = 0; k < s->points[b][body].n; ++k) {
            if (point_number(s, b, body, k) != wanted) continue;
            for (int a = 0; a < s->mesh->dim; ++a) x[a] = field_get(s->domain->fields[b], P_POS, body, a)[k];
        }
}
