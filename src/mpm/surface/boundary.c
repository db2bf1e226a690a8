#include "mpm/surface/boundary.h"

#include "base/memory.h"
#include "mpm/membrane/membrane_curve.h"
#include "mpm/stencil.h"
#include "mpm/surface/surface_markers.h"

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
    *out = (cut_vertex){{x[0], x[1]}, (int)point};
    out->x[end->axis] = end->plane;
    return true;
}

static floe_status has_left(const mpm *s, int end)
{
    const surface_markers *k = &s->work->markers;
    return fail(s->ctx, FLOE_DIVERGED,
                "a solid has left the side of the domain at (%g, %g) by a cell, and a sharp interface lets no gas "
                "between them: leave a whole cell between them at the start, or say symmetry where it is meant to stay",
                k->next[end].x[0], k->next[end].x[1]);
}

/* The end of a chain stays on the side of the mesh where it begins. A body that leaves the side draws the chain out
 * behind it, and the gas that would come between them has nowhere to come from. */
static floe_status check_end(const mpm *s, int end, int neighbour)
{
    const surface_markers *k = &s->work->markers;
    const int axis = k->pin[end];
    if (axis < 0 || fabs(k->next[neighbour].x[axis] - k->next[end].x[axis]) < s->mesh->h[axis]) return FLOE_OK;
    return has_left(s, end);
}

static bool is_wall(bc_kind kind)
{
    return kind == BC_SYMMETRY || kind == BC_SLIP || kind == BC_NO_SLIP;
}

/* The same on a line, of the points of bodies that reached a wall at the start: one to two cells from it they have left. */
static floe_status check_points(const mpm *s)
{
    const surface_markers *k = &s->work->markers;
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
    const surface_markers *k = &s->work->markers;
    if (s->mesh->dim == 1) return check_points(s);
    for (int c = 0; c < k->n_chains; ++c) {
        const int first = k->chain[c].first, last = first + k->chain[c].n - 1;
        if (k->chain[c].closed) continue;
        TRY(check_end(s, first, first + 1));
        TRY(check_end(s, last, last - 1));
    }
    return FLOE_OK;
}

static int first_beside(const surface_markers *k)
{
    int first = MPM_NO_FLUID;
    for (int c = 0; c < k->n_chains; ++c)
        if (k->beside[c] >= 0 && (first < 0 || k->beside[c] < first)) first = k->beside[c];
    return first;
}

/* Chains along which bodies are in touch are the first fluid's, which finds nothing there. */
static bool holds_back(const mpm *s, int chain, int fluid)
{
    const int beside = s->work->markers.beside[chain];
    return beside == fluid || (beside < 0 && fluid == first_beside(&s->work->markers));
}

floe_status mpm_boundary_beside(mpm *s, int fluid, bool next, cut_surface *out)
{
    const surface_markers *k = &s->work->markers;
    if (next) TRY(check_ends(s));
    TRY(cut_reserve(out, (int)k->n, k->n_chains));
    out->n_chains = 0;
    for (int c = 0; c < k->n_chains; ++c)
        if (holds_back(s, c, fluid)) out->chain[out->n_chains++] = k->chain[c];
    for (int n = 0; n < (int)k->n; ++n) {
        const double *x = (next ? k->next : k->now)[n].x;
        out->vertex[n] = (cut_vertex){{x[0], x[1]}, n};
    }
    return FLOE_OK;
}

floe_status mpm_boundary_vertices(mpm *s, int body, bool next, cut_surface *out)
{
    const membrane_curve *line = &s->work->curve[body];
    int n = 0;
    membrane_curve_update(s, body, next);
    TRY(cut_reserve(out, (int)line->n + 2, 1));
    n += !line->closed && end_on_mirror(line, false, &out->vertex[n]);
    for (size_t k = 0; k < line->n; ++k, ++n) {
        const double *x = line->x + 3 * k;
        if (isnan(x[0]))
            return fail(s->ctx, FLOE_DIVERGED, "membrane '%s' has lost its point %zu, and its gas with it",
                        s->scene->body[s->body[body].scene_body].name, k + 1);
        out->vertex[n] = (cut_vertex){{x[0], x[1]}, (int)k};
    }
    n += !line->closed && end_on_mirror(line, true, &out->vertex[n]);
    out->n_vertices = n;
    out->chain[0] = (cut_chain){.n = n, .closed = line->closed};
    return FLOE_OK;
}

void mpm_boundary_velocity(const mpm *s, int body, const cut_surface *c, double *velocity)
{
    const surface_markers *markers = &s->work->markers;
    for (size_t k = 0; k < markers->n; ++k) memcpy(velocity + 2 * k, markers->now[k].v, 2 * sizeof *velocity);
    if (markers->n > 0) return;
    double *by_point = s->work->membrane_force[body].v;
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int a = 0; a < 2; ++a) {
            const double *v = field_get(s->domain->fields[b], P_VEL, body, a);
            for (size_t k = 0; k < s->points[b][body].n; ++k)
                by_point[2 * point_number(s, b, body, k) + (size_t)a] = v[k];
        }
    for (int k = 0; k < c->n_vertices; ++k)
        memcpy(velocity + 2 * (ptrdiff_t)k, by_point + 2 * (ptrdiff_t)c->vertex[k].point, 2 * sizeof *velocity);
}

void mpm_boundary_force(mpm *s, int body, const cut_surface *c, const double *force)
{
    membrane_force *p = &s->work->membrane_force[body];
    for (size_t k = 0; k < 2 * s->work->markers.n; ++k) s->work->markers.force[k] += force[k];
    if (s->work->markers.n > 0) return;
    memset(p->force, 0, 2 * p->n * sizeof *p->force);
    for (int k = 0; k < c->n_vertices; ++k)
        for (int a = 0; a < 2; ++a) p->force[2 * c->vertex[k].point + a] += force[2 * k + a];
    /* The table of places is the next step's by the time that the forces are scattered again. */
    memcpy(p->x, s->work->curve[body].x, 3 * p->n * sizeof *p->x);
}

void mpm_boundary_clear(mpm *s)
{
    if (s->work->markers.n > 0)
        memset(s->work->markers.force, 0, 2 * s->work->markers.n * sizeof *s->work->markers.force);
}

void scatter_membrane_force(mpm *s, int group)
{
    for (int b = 0; b < s->n_bodies; ++b) {
        const membrane_force *p = &s->work->membrane_force[b];
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
    const membrane_force *p = &s->work->membrane_force[body];
    const int group = s->body[body].group;
    const double undamped = damping_left(s);
    if (s->work->markers.n > 0) {
        memcpy(path, s->work->markers.path, 2 * s->work->markers.n * sizeof *path);
        return;
    }
    for (int k = 0; k < c->n_vertices; ++k) {
        const double *x = p->x + 3 * (ptrdiff_t)c->vertex[k].point;
        const int b = place_block(s, x);
        const fields *f = s->domain->fields[b];
        mean_velocity m = {.last = 0.5 * (1.0 + undamped), .change = 0.5 * undamped * s->work->kick};
        for (int a = 0; a < 2; ++a) {
            m.v[a] = field_get(f, N_VEL_L, group, a);
            m.acceleration[a] = field_get(f, N_ACCEL, group, a);
        }
        const place_stencil st = stencil_at(s, x);
        visit_stencil(&s->mesh->block[b], &st, add_velocity, &m);
        for (int a = 0; a < 2; ++a) path[2 * k + a] = s->dt * m.sum[a];
    }
}

double mpm_boundary_lost_energy(const mpm *s)
{
    return s->work->lost;
}

floe_status start_membrane_force(mpm *s)
{
    for (int b = 0; b < s->n_bodies; ++b) {
        membrane_force *p = &s->work->membrane_force[b];
        const scene_membrane *given = &s->scene->body[s->body[b].scene_body].membrane;
        if (!given->present || given->encloses < 0) continue;
        p->n = s->work->curve[b].n;
        TRY(memory_new(s->ctx, &p->x, 3 * p->n, sizeof *p->x));
        TRY(memory_new(s->ctx, &p->v, 2 * p->n, sizeof *p->v));
        TRY(memory_new(s->ctx, &p->force, 2 * p->n, sizeof *p->force));
    }
    return FLOE_OK;
}

void free_membrane_force(context *ctx, struct mpm_work *w)
{
    for (int b = 0; b < SCENE_MAX_BODIES; ++b) {
        memory_free(ctx, &w->membrane_force[b].x);
        memory_free(ctx, &w->membrane_force[b].v);
        memory_free(ctx, &w->membrane_force[b].force);
    }
}
