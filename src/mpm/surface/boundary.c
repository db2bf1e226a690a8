#include "mpm/surface/boundary.h"

#include "base/memory.h"
#include "mpm/membrane/membrane_curve.h"
#include "mpm/nodes/node.h"
#include "mpm/surface/surface_markers.h"
#include "mpm/surface/surfaces.h"
#include "mpm/transfer/stencil.h"

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
    *out = (cut_vertex){{x[0], x[1], 0.0}, (int)point};
    out->x[end->axis] = end->plane;
    return true;
}

static floe_status has_left(const mpm *s, int end)
{
    const surface_markers *k = &s->surfaces->markers;
    return fail(s->ctx, FLOE_DIVERGED,
                "a solid has left the side of the domain at (%g, %g) by a cell, and a sharp interface lets no gas "
                "between them: leave a whole cell between them at the start, or say symmetry where it is meant to stay",
                k->next[end].x[0], k->next[end].x[1]);
}

/* The end of a chain stays on the side of the mesh where it begins. A body that leaves the side draws the chain out
 * behind it, and the gas that would come between them has nowhere to come from. */
static floe_status check_end(const mpm *s, int end, int neighbour, double cells)
{
    const surface_markers *k = &s->surfaces->markers;
    for (int a = 0; a < s->mesh->dim; ++a)
        if (k->pin[end] >> a & 1 && !(fabs(k->next[neighbour].x[a] - k->next[end].x[a]) < cells * s->mesh->h[a]))
            return has_left(s, end);
    return FLOE_OK;
}

static bool is_wall(bc_kind kind)
{
    return kind == BC_SYMMETRY || kind == BC_SLIP || kind == BC_NO_SLIP;
}

/* The same on a line, of the points of bodies that reached a wall at the start: one to two cells from it they have left. */
static floe_status check_points(const mpm *s)
{
    const surface_markers *k = &s->surfaces->markers;
    for (int c = 0; c < k->n_chains; ++c) {
        const double x = k->next[k->chain[c].first].x[0], h = s->mesh->h[0];
        const double gap[2] = {x - s->mesh->lower[0], s->mesh->upper[0] - x};
        for (int side = 0; side < 2 && k->chain[c].outward == 0; ++side)
            if (gap[side] >= h && gap[side] < 2.0 * h && is_wall(s->scene->bc.side[0][side].kind))
                return has_left(s, k->chain[c].first);
    }
    return FLOE_OK;
}

static floe_status check_ends(const mpm *s)
{
    const surface_markers *k = &s->surfaces->markers;
    if (s->mesh->dim == 1) return check_points(s);
    for (int n = 0; n < k->n_triangles; ++n) /* whose sides may be two cells long from the start */
        for (int e = 0; e < 3 && k->triangle[n].rim; ++e)
            TRY(check_end(s, k->triangle[n].vertex[e], k->triangle[n].vertex[(e + 1) % 3], 3.0));
    for (int c = 0; c < k->n_chains; ++c) {
        const int first = k->chain[c].first, last = first + k->chain[c].n - 1;
        if (k->chain[c].closed) continue;
        TRY(check_end(s, first, first + 1, 1.0));
        TRY(check_end(s, last, last - 1, 1.0));
    }
    return FLOE_OK;
}

static int first_beside(const surface_markers *k)
{
    int first = MPM_NO_FLUID;
    for (int c = 0; c < k->n_chains; ++c)
        if (k->beside[c] >= 0 && (first < 0 || k->beside[c] < first)) first = k->beside[c];
    for (int n = 0; n < k->n_triangles; ++n)
        if (k->facing[n] >= 0 && (first < 0 || k->facing[n] < first)) first = k->facing[n];
    return first;
}

/* Chains along which bodies are in touch are the first fluid's, which finds nothing there. */
static bool holds_back(int beside, int fluid, int first)
{
    return fluid < 0 || beside == fluid || (beside < 0 && fluid == first);
}

floe_status mpm_boundary_beside(mpm *s, int fluid, bool next, cut_surface *out)
{
    const surface_markers *k = &s->surfaces->markers;
    const int first = first_beside(k);
    if (next) TRY(check_ends(s));
    TRY(cut_reserve(out, (int)k->n, k->n_chains));
    out->n_chains = 0;
    for (int c = 0; c < k->n_chains; ++c)
        if (holds_back(k->beside[c], fluid, first)) out->chain[out->n_chains++] = k->chain[c];
    if (k->n_triangles > 0) TRY(cut_reserve_triangles(out, k->n_triangles));
    out->n_triangles = 0;
    for (int n = 0; n < k->n_triangles; ++n)
        if (holds_back(k->facing[n], fluid, first)) out->triangle[out->n_triangles++] = k->triangle[n];
    for (int n = 0; n < (int)k->n; ++n) {
        const double *x = (next ? k->next : k->now)[n].x;
        out->vertex[n] = (cut_vertex){{x[0], x[1], x[2]}, n};
    }
    return FLOE_OK;
}

floe_status mpm_boundary_vertices(mpm *s, int body, bool next, cut_surface *out)
{
    const membrane_curve *line = &s->curve[body];
    int n = 0;
    membrane_curve_update(s, body, next);
    TRY(cut_reserve(out, (int)line->n + 2, 1));
    n += !line->closed && end_on_mirror(line, false, &out->vertex[n]);
    for (size_t k = 0; k < line->n; ++k, ++n) {
        const double *x = line->x + 3 * k;
        if (isnan(x[0]))
            return fail(s->ctx, FLOE_DIVERGED, "membrane '%s' has lost its point %zu, and its gas with it",
                        s->scene->body[s->body[body].scene_body].name, k + 1);
        out->vertex[n] = (cut_vertex){{x[0], x[1], 0.0}, (int)k};
    }
    n += !line->closed && end_on_mirror(line, true, &out->vertex[n]);
    out->n_vertices = n;
    out->chain[0] = (cut_chain){.n = n, .closed = line->closed};
    return FLOE_OK;
}

void mpm_boundary_velocity(const mpm *s, int body, const cut_surface *c, double *velocity)
{
    const surface_markers *markers = &s->surfaces->markers;
    for (size_t k = 0; k < markers->n; ++k) memcpy(velocity + 3 * k, markers->now[k].v, 3 * sizeof *velocity);
    if (markers->n > 0) return;
    double *by_point = s->surfaces->membrane_force[body].v;
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int a = 0; a < 2; ++a) {
            const double *v = field_get(s->domain->fields[b], P_VEL, body, a);
            for (size_t k = 0; k < s->points[b][body].n; ++k)
                by_point[2 * point_number(s, b, body, k) + (size_t)a] = v[k];
        }
    for (int k = 0; k < c->n_vertices; ++k) {
        memcpy(velocity + 3 * (ptrdiff_t)k, by_point + 2 * (ptrdiff_t)c->vertex[k].point, 2 * sizeof *velocity);
        velocity[3 * (ptrdiff_t)k + 2] = 0.0;
    }
}

void mpm_boundary_force(mpm *s, int body, const cut_surface *c, const double *force)
{
    membrane_force *p = &s->surfaces->membrane_force[body];
    for (size_t k = 0; k < 3 * s->surfaces->markers.n; ++k) s->surfaces->markers.force[k] += force[k];
    if (s->surfaces->markers.n > 0) return;
    memset(p->force, 0, 2 * p->n * sizeof *p->force);
    for (int k = 0; k < c->n_vertices; ++k)
        for (int a = 0; a < 2; ++a) p->force[2 * c->vertex[k].point + a] += force[3 * k + a];
    /* The table of places is the next step's by the time that the forces are scattered again. */
    memcpy(p->x, s->curve[body].x, 3 * p->n * sizeof *p->x);
}

void mpm_boundary_clear(mpm *s)
{
    if (s->surfaces->markers.n > 0)
        memset(s->surfaces->markers.force, 0, 3 * s->surfaces->markers.n * sizeof *s->surfaces->markers.force);
}

void scatter_membrane_force(mpm *s, int group)
{
    for (int b = 0; b < s->n_bodies; ++b) {
        const membrane_force *p = &s->surfaces->membrane_force[b];
        for (size_t k = 0; k < p->n && s->body[b].group == group; ++k) {
            const double force[3] = {p->force[2 * k], p->force[2 * k + 1], 0.0};
            push_nodes(s, group, p->x + 3 * k, force);
        }
    }
}

typedef struct mean_velocity {
    const double *v[2], *acceleration[2];
    double last, change; /* weights: of the velocity at the end, and of what changed it */
    double sum[2];
} mean_velocity;

static void add_velocity(void *user, ptrdiff_t at, double weight, double mass)
{
    mean_velocity *m = user;
    (void)mass;
    for (int a = 0; a < 2; ++a) m->sum[a] += weight * (m->last * m->v[a][at] - m->change * m->acceleration[a][at]);
}

void mpm_boundary_displacement(const mpm *s, int body, const cut_surface *c, double *path)
{
    const membrane_force *p = &s->surfaces->membrane_force[body];
    const int group = s->body[body].group;
    const double undamped = damping_left(s);
    if (s->surfaces->markers.n > 0) {
        memcpy(path, s->surfaces->markers.path, 3 * s->surfaces->markers.n * sizeof *path);
        return;
    }
    for (int k = 0; k < c->n_vertices; ++k) {
        const double *x = p->x + 3 * (ptrdiff_t)c->vertex[k].point;
        const int b = place_block(s, x);
        const fields *f = s->domain->fields[b];
        mean_velocity m = {.last = 0.5 * (1.0 + undamped), .change = 0.5 * undamped * s->kick};
        for (int a = 0; a < 2; ++a) {
            m.v[a] = field_get(f, N_VEL_L, group, a);
            m.acceleration[a] = field_get(f, N_ACCEL, group, a);
        }
        const place_stencil st = stencil_at(s, x);
        visit_stencil(&s->mesh->block[b], &st, add_velocity, &m);
        for (int a = 0; a < 2; ++a) path[3 * k + a] = s->dt * m.sum[a];
        path[3 * k + 2] = 0.0;
    }
}

double mpm_boundary_lost_energy(const mpm *s)
{
    return s->lost;
}

floe_status start_membrane_force(mpm *s)
{
    for (int b = 0; b < s->n_bodies; ++b) {
        membrane_force *p = &s->surfaces->membrane_force[b];
        const scene_membrane *given = &s->scene->body[s->body[b].scene_body].membrane;
        if (!given->present || given->encloses < 0) continue;
        p->n = s->curve[b].n;
        TRY(memory_new(s->ctx, &p->x, 3 * p->n, sizeof *p->x));
        TRY(memory_new(s->ctx, &p->v, 2 * p->n, sizeof *p->v));
        TRY(memory_new(s->ctx, &p->force, 2 * p->n, sizeof *p->force));
    }
    return FLOE_OK;
}

void surfaces_free(mpm *s)
{
    if (!s->surfaces) return;
    for (int b = 0; b < SCENE_MAX_BODIES; ++b) {
        memory_free(s->ctx, &s->surfaces->membrane_force[b].x);
        memory_free(s->ctx, &s->surfaces->membrane_force[b].v);
        memory_free(s->ctx, &s->surfaces->membrane_force[b].force);
    }
    free_markers(s->ctx, &s->surfaces->markers);
    memory_free(s->ctx, &s->surfaces->loaded);
    memory_free(s->ctx, &s->surfaces->loaded_next);
    memory_free(s->ctx, &s->surfaces);
}
