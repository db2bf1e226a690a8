#include "mpm/surface/membrane_boundary.h"

#include "base/memory.h"
#include "geom/sheet_triangles.h"
#include "mpm/membrane/membrane_curve.h"
#include "mpm/nodes/node.h"
#include "mpm/surface/surfaces.h"
#include "mpm/transfer/stencil.h"
#include "scene/state.h"

#include <math.h>
#include <string.h>

/* The end of an open line on a mirror: where it meets it. False where the line ends on the mirror itself, or is
 * free. */
static bool end_on_mirror(const membrane_curve *line, bool last, cut_vertex *out)
{
    const curve_end *end = &line->end[last];
    const size_t point = last ? line->n - 1 : 0;
    const double *x = line->x + 3 * point;
    if (end->axis < 0 || x[end->axis] == end->plane) return false;
    *out = (cut_vertex){{x[0], x[1], 0.0}, (int)point, 0};
    out->x[end->axis] = end->plane;
    return true;
}

static const char *name_of_membrane(const mpm *s, int body)
{
    return s->scene->body[s->body[body].scene_body].name;
}

static floe_status has_lost(const mpm *s, int body, size_t point)
{
    return fail(s->ctx, FLOE_DIVERGED, "membrane '%s' has lost its point %zu, and its gas with it",
                name_of_membrane(s, body), point + 1);
}

static floe_status curve_vertices(mpm *s, int body, cut_surface *out)
{
    const membrane_curve *line = &s->curve[body];
    int n = 0;
    TRY(cut_reserve(out, (int)line->n + 2, 1));
    n += !line->closed && end_on_mirror(line, false, &out->vertex[n]);
    for (size_t k = 0; k < line->n; ++k, ++n) {
        const double *x = line->x + 3 * k;
        if (isnan(x[0])) return has_lost(s, body, k);
        out->vertex[n] = (cut_vertex){{x[0], x[1], 0.0}, (int)k, 0};
    }
    n += !line->closed && end_on_mirror(line, true, &out->vertex[n]);
    out->n_vertices = n;
    out->chain[0] = (cut_chain){.n = n, .closed = line->closed};
    return FLOE_OK;
}

static floe_status sheet_vertices(const mpm *s, int body, cut_surface *out)
{
    const sheet_triangles *t = &s->surfaces->membrane_force[body].joined;
    const double *x = s->curve[body].x;
    for (size_t k = 0; k < s->curve[body].n; ++k)
        if (isnan(x[3 * k])) return has_lost(s, body, k);
    TRY(cut_reserve(out, t->n, 0));
    TRY(cut_reserve_triangles(out, t->n_facets));
    for (int k = 0; k < t->n; ++k) {
        out->vertex[k].point = t->vertex[k].point;
        sheet_vertex_at(&t->vertex[k], x, s->mesh->lower, s->mesh->upper, out->vertex[k].x);
    }
    for (int k = 0; k < t->n_facets; ++k) {
        const int *v = t->facet[k].vertex;
        out->triangle[k] = (cut_triangle){{v[0], v[1], v[2]}, t->facet[k].rim};
    }
    return FLOE_OK;
}

floe_status membrane_vertices(mpm *s, int body, bool next, cut_surface *out)
{
    membrane_curve_update(s, body, next);
    return s->mesh->dim == 3 ? sheet_vertices(s, body, out) : curve_vertices(s, body, out);
}

void membrane_velocity(const mpm *s, int body, const cut_surface *c, double *velocity)
{
    const int dim = s->mesh->dim;
    double *by_point = s->surfaces->membrane_force[body].v;
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int a = 0; a < dim; ++a) {
            const double *v = field_get(s->domain->fields[b], P_VEL, body, a);
            for (size_t k = 0; k < s->points[b][body].n; ++k)
                by_point[(size_t)dim * point_number(s, b, body, k) + (size_t)a] = v[k];
        }
    for (int k = 0; k < c->n_vertices; ++k)
        for (int a = 0; a < 3; ++a) velocity[3 * k + a] = a < dim ? by_point[dim * c->vertex[k].point + a] : 0.0;
}

void membrane_set_force(mpm *s, int body, const cut_surface *c, const double *force)
{
    const int dim = s->mesh->dim;
    membrane_force *p = &s->surfaces->membrane_force[body];
    memset(p->force, 0, (size_t)dim * p->n * sizeof *p->force);
    for (int k = 0; k < c->n_vertices; ++k)
        for (int a = 0; a < dim; ++a) p->force[dim * c->vertex[k].point + a] += force[3 * k + a];
    /* The table of places is the next step's by the time that the forces are scattered again. */
    memcpy(p->x, s->curve[body].x, 3 * p->n * sizeof *p->x);
}

void scatter_membrane_force(mpm *s, int group)
{
    const int dim = s->mesh->dim;
    for (int b = 0; b < s->n_bodies; ++b) {
        const membrane_force *p = &s->surfaces->membrane_force[b];
        for (size_t k = 0; k < p->n && s->body[b].group == group; ++k) {
            double force[3] = {0.0};
            for (int a = 0; a < dim; ++a) force[a] = p->force[(size_t)dim * k + (size_t)a];
            push_nodes(s, group, p->x + 3 * k, force);
        }
    }
}

typedef struct mean_velocity {
    const double *v[3], *acceleration[3];
    double last, change; /* weights: of the velocity at the end, and of what changed it */
    double sum[3];
    int dim;
} mean_velocity;

static void add_velocity(void *user, ptrdiff_t at, double weight, double mass)
{
    mean_velocity *m = user;
    (void)mass;
    for (int a = 0; a < m->dim; ++a) m->sum[a] += weight * (m->last * m->v[a][at] - m->change * m->acceleration[a][at]);
}

void membrane_displacement(const mpm *s, int body, const cut_surface *c, double *path)
{
    const membrane_force *p = &s->surfaces->membrane_force[body];
    const int group = s->body[body].group, dim = s->mesh->dim;
    const double undamped = damping_left(s);
    for (int k = 0; k < c->n_vertices; ++k) {
        const double *x = p->x + 3 * (ptrdiff_t)c->vertex[k].point;
        const int b = place_block(s, x);
        const fields *f = s->domain->fields[b];
        mean_velocity m = {.last = 0.5 * (1.0 + undamped), .change = 0.5 * undamped * s->kick, .dim = dim};
        for (int a = 0; a < dim; ++a) {
            m.v[a] = field_get(f, N_VEL_L, group, a);
            m.acceleration[a] = field_get(f, N_ACCEL, group, a);
        }
        const place_stencil st = stencil_at(s, x);
        visit_stencil(&s->mesh->block[b], &st, add_velocity, &m);
        for (int a = 0; a < 3; ++a) path[3 * k + a] = s->dt * m.sum[a];
    }
}

/* The points of a surface by their rows, as they were seeded. */
static floe_status join_points(mpm *s, int body, sheet_triangles *out)
{
    const scene_body *given = &s->scene->body[s->body[body].scene_body];
    const seed_spec grid = body_seed_spec(s->scene, s->mesh, given);
    sheet_rows rows;
    membrane_curve_update(s, body, false);
    floe_status status = body_rows(given, s->ctx, &grid, &rows);
    if (status == FLOE_OK) status = sheet_triangles_make(out, s->ctx, &rows, s->curve[body].x, &grid);
    sheet_rows_free(s->ctx, &rows);
    return fail_under(s->ctx, status, KEY("bodies", given->name, "membrane", "encloses"));
}

floe_status start_membrane_force(mpm *s)
{
    const size_t dim = (size_t)s->mesh->dim;
    for (int b = 0; b < s->n_bodies; ++b) {
        membrane_force *p = &s->surfaces->membrane_force[b];
        const scene_membrane *given = &s->scene->body[s->body[b].scene_body].membrane;
        if (!given->present || given->encloses < 0) continue;
        p->n = s->curve[b].n;
        TRY(memory_new(s->ctx, &p->x, 3 * p->n, sizeof *p->x));
        TRY(memory_new(s->ctx, &p->v, dim * p->n, sizeof *p->v));
        TRY(memory_new(s->ctx, &p->force, dim * p->n, sizeof *p->force));
        if (dim == 3) TRY(join_points(s, b, &p->joined));
    }
    return FLOE_OK;
}

void free_membrane_force(mpm *s)
{
    for (int b = 0; b < SCENE_MAX_BODIES; ++b) {
        membrane_force *p = &s->surfaces->membrane_force[b];
        memory_free(s->ctx, &p->x);
        memory_free(s->ctx, &p->v);
        memory_free(s->ctx, &p->force);
        sheet_triangles_free(s->ctx, &p->joined);
    }
}

bool membrane_is_joined(const mpm *s, int body)
{
    return s->surfaces->membrane_force[body].joined.n_facets > 0;
}

double membrane_volume(mpm *s, int body)
{
    const sheet_triangles *t = &s->surfaces->membrane_force[body].joined;
    membrane_curve_update(s, body, false);
    return sheet_triangles_volume(t, s->curve[body].x, s->mesh->lower, s->mesh->upper);
}
