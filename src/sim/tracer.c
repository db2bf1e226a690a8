#include "sim/tracer.h"

#include "base/memory.h"
#include "math/small_solve.h"

#include <math.h>
#include <stdlib.h>

enum { POSITION, VELOCITY = MESH_MAX_DIM, STRESS = 2 * MESH_MAX_DIM, VALUES = STRESS + 6 };

/* A point from which a tracer is computed. */
typedef struct tracer_point {
    double id;                  /* of the point, as P_ID has it */
    double weight;              /* 1; those of a tracer sum to one */
    double start[MESH_MAX_DIM]; /* m: its position at the start */
    double now[VALUES]; /* position (m), velocity (m/s), stress (Pa) when last read; NAN: it has left the domain */
    int tracer;         /* of the scene */
    int body;           /* of the points */
} tracer_point;

struct tracers {
    size_t n, reserved;
    tracer_point *point; /* by body, then by id, then by tracer */
};

static const double reach = 1.5;        /* cells: largest distance of the points of a tracer */
static const double least_pivot = 1e-3; /* of a well-posed fit, over its first pivot */

/* The body of points that body `number` of the scene is; -1: it is on the cells. */
static int body_of_points(const sim *s, int number)
{
    for (int b = 0; s->mpm && b < s->mpm->n_bodies; ++b)
        if (s->mpm->body[b].scene_body == number) return b;
    return -1;
}

bool tracer_is_of_points(const sim *s, int n)
{
    return body_of_points(s, s->scene->tracer[n].body) >= 0;
}

bool tracer_has_stress(const sim *s, int n)
{
    const int body = body_of_points(s, s->scene->tracer[n].body);
    return body >= 0 && field_get(s->domain->fields[0], P_STRESS, body, 0);
}

static floe_status add_point(struct tracers *t, context *ctx, const tracer_point *p)
{
    if (t->n == t->reserved) {
        const size_t more = t->reserved > 0 ? 2 * t->reserved : 64;
        TRY(memory_resize(ctx, &t->point, more, sizeof *t->point));
        t->reserved = more;
    }
    t->point[t->n++] = *p;
    return FLOE_OK;
}

/* From the place of a tracer to a point at x, in cells. */
static double offset_in_cells(const sim *s, const scene_tracer *t, const double x[MESH_MAX_DIM], int axis)
{
    return (x[axis] - t->position[axis]) / s->mesh.h[axis];
}

/* Lists the points of a body within reach of a tracer, weighted by nearness. */
static floe_status list_near_points(struct tracers *t, const sim *s, int n, int body)
{
    const scene_tracer *tracer = &s->scene->tracer[n];
    const size_t before = t->n;
    for (int b = 0; b < s->mesh.n_blocks; ++b) {
        const fields *f = s->domain->fields[b];
        for (size_t k = 0; k < s->mpm->points[b][body].n; ++k) {
            tracer_point p = {.id = field_get(f, P_ID, body, 0)[k], .tracer = n, .body = body};
            double square = 0.0;
            for (int a = 0; a < s->mesh.dim; ++a) {
                p.start[a] = field_get(f, P_POS, body, a)[k];
                square += pow(offset_in_cells(s, tracer, p.start, a), 2.0);
            }
            p.weight = exp(-square);
            if (square <= reach * reach) TRY(add_point(t, s->ctx, &p));
        }
    }
    if (t->n > before) return FLOE_OK;
    return fail_key(s->ctx, KEY("output", "tracers", tracer->name),
                    "body '%s' has no point within %g cells of this place: give a place of the body",
                    s->scene->body[tracer->body].name, reach);
}

/* The weight of the nearest point becomes one, those of the others nothing. */
static void keep_nearest(tracer_point *point, size_t n)
{
    size_t nearest = 0;
    for (size_t k = 1; k < n; ++k)
        if (point[k].weight > point[nearest].weight) nearest = k;
    for (size_t k = 0; k < n; ++k) point[k].weight = k == nearest ? 1.0 : 0.0;
}

/* Weights w with which a weighted least-squares plane through values at the points is read at the place of the tracer: sum w = 1, sum w
 * (x - place) = 0. Where the points define no plane, as those of a membrane: the nearest point. */
static void fit_weights(const sim *s, int n, tracer_point *point, size_t n_points)
{
    const scene_tracer *tracer = &s->scene->tracer[n];
    const int size = s->mesh.dim + 1;
    double matrix[16] = {0.0}, row[4] = {1.0}, plane[4] = {1.0};
    for (size_t k = 0; k < n_points; ++k) {
        for (int a = 0; a < s->mesh.dim; ++a) row[1 + a] = offset_in_cells(s, tracer, point[k].start, a);
        for (int i = 0; i < size; ++i)
            for (int j = 0; j < size; ++j) matrix[i * size + j] += point[k].weight * row[i] * row[j];
    }
    bool posed = small_ldl_factor(size, matrix);
    for (int i = 1; i < size && posed; ++i) posed = matrix[i * size + i] > least_pivot * matrix[0];
    if (!posed) {
        keep_nearest(point, n_points);
        return;
    }
    small_ldl_solve(size, matrix, plane);
    for (size_t k = 0; k < n_points; ++k) {
        double share = plane[0];
        for (int a = 0; a < s->mesh.dim; ++a) share += plane[1 + a] * offset_in_cells(s, tracer, point[k].start, a);
        point[k].weight *= share;
    }
}

static int compare_points(const void *a, const void *b)
{
    const tracer_point *p = a, *q = b;
    if (p->body != q->body) return p->body < q->body ? -1 : 1;
    if (p->id != q->id) return p->id < q->id ? -1 : 1;
    return p->tracer - q->tracer;
}

static floe_status fill_tracers(struct tracers *t, const sim *s)
{
    for (int n = 0; n < s->scene->n_tracers; ++n) {
        const int body = body_of_points(s, s->scene->tracer[n].body);
        const size_t first = t->n;
        if (body < 0) continue;
        TRY(list_near_points(t, s, n, body));
        fit_weights(s, n, t->point + first, t->n - first);
    }
    if (t->n > 0) qsort(t->point, t->n, sizeof *t->point, compare_points);
    return FLOE_OK;
}

floe_status tracers_create(struct tracers **out, const sim *s)
{
    TRY(memory_new(s->ctx, out, 1, sizeof **out));
    const floe_status status = fill_tracers(*out, s);
    if (status != FLOE_OK) tracers_destroy(s->ctx, out);
    return status;
}

void tracers_destroy(context *ctx, struct tracers **t)
{
    if (!t || !*t) return;
    memory_free(ctx, &(*t)->point);
    memory_free(ctx, t);
}

/* The first of n points in order whose id is not below this one. */
static size_t first_of_id(const tracer_point *point, size_t n, double id)
{
    size_t lo = 0;
    while (n > 0) {
        const size_t half = n / 2;
        if (point[lo + half].id < id) {
            lo += half + 1;
            n -= half + 1;
        } else {
            n = half;
        }
    }
    return lo;
}

static void read_point(const sim *s, const fields *f, size_t k, tracer_point *p)
{
    for (int a = 0; a < s->mesh.dim; ++a) {
        p->now[POSITION + a] = field_get(f, P_POS, p->body, a)[k];
        p->now[VELOCITY + a] = field_get(f, P_VEL, p->body, a)[k];
    }
    if (!field_get(f, P_STRESS, p->body, 0)) return;
    for (int c = 0; c < field_component_count(field_describe(P_STRESS)->components, s->mesh.dim); ++c)
        p->now[STRESS + c] = field_get(f, P_STRESS, p->body, c)[k];
}

/* Reads n listed points of one body. */
static void read_body(const sim *s, tracer_point *point, size_t n)
{
    const int body = point[0].body;
    for (size_t p = 0; p < n; ++p)
        for (int v = 0; v < VALUES; ++v) point[p].now[v] = NAN;
    for (int b = 0; b < s->mesh.n_blocks; ++b) {
        const fields *f = s->domain->fields[b];
        const double *id = field_get(f, P_ID, body, 0);
        for (size_t k = 0; k < s->mpm->points[b][body].n; ++k)
            for (size_t p = first_of_id(point, n, id[k]); p < n && point[p].id == id[k]; ++p)
                read_point(s, f, k, &point[p]);
    }
}

void tracers_read(const sim *s, tracer_value *out)
{
    struct tracers *t = s->tracers;
    for (int n = 0; n < s->scene->n_tracers; ++n) out[n] = (tracer_value){0};
    for (size_t first = 0, last = 0; first < t->n; first = last) {
        while (last < t->n && t->point[last].body == t->point[first].body) ++last;
        read_body(s, t->point + first, last - first);
    }
    for (size_t k = 0; k < t->n; ++k) {
        const tracer_point *p = &t->point[k];
        if (p->weight == 0.0) continue;
        for (int a = 0; a < s->mesh.dim; ++a) {
            out[p->tracer].displacement[a] += p->weight * (p->now[POSITION + a] - p->start[a]);
            out[p->tracer].velocity[a] += p->weight * p->now[VELOCITY + a];
        }
        for (int c = 0; c < 6; ++c) out[p->tracer].stress[c] += p->weight * p->now[STRESS + c];
    }
}
