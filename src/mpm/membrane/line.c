#include "base/memory.h"
#include "mpm/membrane/membrane_normal.h"
#include "mpm/wall.h"

#include <math.h>

static const uint64_t ordinal_mask = (UINT64_C(1) << 40) - 1; /* of a point's id (grid/field_list.h) */

size_t point_number(const mpm *s, int blk, int body, size_t k)
{
    return (size_t)((uint64_t)field_get(s->domain->fields[blk], P_ID, body, 0)[k] & ordinal_mask);
}

void line_update(mpm *s, int body, bool next)
{
    membrane_line *line = &s->work->line[body];
    for (size_t i = 0; i < 3 * line->n; ++i) line->x[i] = i % 3 < (size_t)s->mesh->dim ? (double)NAN : 0.0;
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int a = 0; a < s->mesh->dim; ++a) {
            const double *x = (next ? field_next : field_get)(s->domain->fields[b], P_POS, body, a);
            for (size_t k = 0; k < s->points[b][body].n; ++k)
                line->x[3 * point_number(s, b, body, k) + (size_t)a] = x[k];
        }
}

/* The point's image behind a mirror. */
static void reflect(const line_end *end, const double *from, double x[3])
{
    for (int a = 0; a < 3; ++a) x[a] = from[a];
    x[end->axis] = 2.0 * end->plane - x[end->axis];
}

line_side line_side_of(const membrane_line *line, size_t number, int step)
{
    if (line->link) {
        const line_link *l = &line->link[2 * number + (step > 0)];
        return (line_side){l->of, l->mirror.axis < 0 ? NULL : &l->mirror};
    }
    const bool at_end = step < 0 ? number == 0 : number + 1 == line->n;
    if (!at_end || line->closed)
        return (line_side){(ptrdiff_t)((number + line->n + (step < 0 ? line->n - 1 : 1)) % line->n), NULL};
    const line_end *end = &line->end[step > 0];
    if (end->axis < 0) return (line_side){-1, NULL};
    return (line_side){(ptrdiff_t)(end->of_itself ? number : step < 0 ? number + 1 : number - 1), end};
}

/* The place of the point before (step -1) or after (+1). False at a free end, or where the point is lost. */
static bool neighbour(const membrane_line *line, size_t number, int step, double x[3])
{
    const line_side side = line_side_of(line, number, step);
    if (side.of < 0) return false;
    const double *from = line->x + 3 * side.of;
    for (int a = 0; a < 3; ++a) x[a] = from[a];
    if (side.mirror) reflect(side.mirror, from, x);
    return !isnan(x[0]);
}

/* The way from a to b, around the mesh where that is shorter. */
static void way_of(const mesh *m, const double *a, const double *b, double way[3])
{
    for (int k = 0; k < 3; ++k) {
        way[k] = b[k] - a[k];
        if (k >= m->dim || !m->periodic[k]) continue;
        const double period = m->upper[k] - m->lower[k];
        way[k] -= period * round(way[k] / period);
    }
}

/* The next point on a side, or the point itself where there is none; and half of what lies between them at rest. */
static double reach_of(const membrane_line *line, size_t number, int step, double x[3])
{
    const double *own = line->x + 3 * number;
    if (neighbour(line, number, step, x)) {
        const ptrdiff_t of = line_side_of(line, number, step).of;
        return line->rest ? 0.5 * (line->rest[number] + line->rest[of]) : 0.0;
    }
    for (int a = 0; a < 3; ++a) x[a] = own[a];
    return 0.0;
}

double line_way(const mpm *s, int body, size_t number, double way[3], double *rest)
{
    const membrane_line *line = &s->work->line[body];
    double before[3], after[3];
    *rest = reach_of(line, number, -1, before) + reach_of(line, number, 1, after);
    way_of(s->mesh, before, after, way);
    return sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
}

bool line_bend(const mpm *s, int body, size_t number, double bend[3])
{
    const membrane_line *line = &s->work->line[body];
    const double *own = line->x + 3 * number;
    double before[3], after[3], back[3], on[3];
    if (isnan(own[0]) || !neighbour(line, number, -1, before) || !neighbour(line, number, 1, after)) return false;
    way_of(s->mesh, own, before, back);
    way_of(s->mesh, own, after, on);
    for (int a = 0; a < 3; ++a) bend[a] = back[a] + on[a];
    return true;
}

bool line_tangent(const mpm *s, int body, size_t number, double t[3])
{
    double way[3], rest;
    if (s->work->line[body].n < 2) return false;
    const double length = line_way(s, body, number, way, &rest);
    if (!(length > 0.0)) return false;
    for (int a = 0; a < 3; ++a) t[a] = way[a] / length;
    return true;
}

/* The mirror that an end lies on: less than three quarters of a spacing away, with the line running into it. */
static line_end find_mirror(const mpm *s, int group, const double *end, const double *next)
{
    double gap[3];
    way_of(s->mesh, next, end, gap);
    const double spacing = sqrt(gap[0] * gap[0] + gap[1] * gap[1] + gap[2] * gap[2]);
    for (int axis = 0; axis < s->mesh->dim; ++axis)
        for (int side = 0; side < 2; ++side) {
            const double plane = side == SIDE_LOWER ? s->mesh->lower[axis] : s->mesh->upper[axis];
            const double distance = fabs(end[axis] - plane);
            const bool towards = (side == SIDE_LOWER ? -gap[axis] : gap[axis]) > 0.5 * spacing;
            if (s->mesh->periodic[axis] || !wall_mirrors(s, group, axis, side) || !towards) continue;
            if (distance < 0.75 * spacing) return (line_end){axis, plane, distance > 0.25 * spacing};
        }
    return (line_end){.axis = -1};
}

/* Neighbours by number lie within a cell of each other, as seeding sees to; only a list of points with normals of their
 * own may be in any order. */
static bool is_ordered(const mpm *s, const membrane_line *line)
{
    double way[3];
    for (size_t i = 1; i < line->n; ++i) {
        way_of(s->mesh, line->x + 3 * (i - 1), line->x + 3 * i, way);
        for (int a = 0; a < s->mesh->dim; ++a)
            if (fabs(way[a]) > s->mesh->h[a] * (1.0 + 1e-9)) return false;
    }
    return true;
}

floe_status line_make(mpm *s, int body)
{
    membrane_line *line = &s->work->line[body];
    const scene_body *b = &s->scene->body[s->body[body].scene_body];
    *line = (membrane_line){.n = mpm_body_points(s, body), .closed = curve_is_closed(&b->membrane.curve)};
    line->end[0].axis = line->end[1].axis = -1;
    TRY(memory_new(s->ctx, &line->x, 3 * line->n, sizeof *line->x));
    if (b->membrane.strain == STRAIN_BY_PLACES) {
        TRY(line_measure(s, body));
        if (normals_are_free(s, body)) TRY(memory_new(s->ctx, &line->link, 2 * line->n, sizeof *line->link));
    }
    line_update(s, body, false);
    line->ordered = is_ordered(s, line);
    if (line->n < 2 || line->closed) return FLOE_OK;
    line->end[0] = find_mirror(s, s->body[body].group, line->x, line->x + 3);
    line->end[1] = find_mirror(s, s->body[body].group, line->x + 3 * (line->n - 1), line->x + 3 * (line->n - 2));
    return FLOE_OK;
}

void line_free(context *ctx, membrane_line *line)
{
    memory_free(ctx, &line->x);
    memory_free(ctx, &line->rest);
    memory_free(ctx, &line->link);
}

void mpm_membrane_end(const mpm *s, int body, bool last, double x[3])
{
    const size_t wanted = last ? s->work->line[body].n - 1 : 0;
    for (int a = 0; a < 3; ++a) x[a] = NAN;
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (size_t k = 0; k < s->points[b][body].n; ++k) {
            if (point_number(s, b, body, k) != wanted) continue;
            for (int a = 0; a < s->mesh->dim; ++a) x[a] = field_get(s->domain->fields[b], P_POS, body, a)[k];
        }
}
