/* Surfaces of solids beside gas of the cells (theory 7.2): chains of massless markers, placed on the shapes when the
 * bodies are seeded and moved by the nodes. They are the embedded boundary in the cells, and transfer the force of the
 * gas to nodes with mass (traction.c). */
#include "mpm/surface/surface_markers.h"

#include "base/memory.h"
#include "geom/facets.h"
#include "geom/images.h"
#include "math/tensor.h"
#include "mpm/surface/boundary.h"
#include "mpm/surface/standing.h"
#include "mpm/surface/surface_facets.h"
#include "mpm/surface/surface_place.h"
#include "mpm/surface/surfaces.h"
#include "mpm/surface/welded.h"
#include "scene/state.h"

#include <math.h>
#include <string.h>

enum {
    CONTOUR_DIVISIONS = 4, /* markers per cell edge, about */
    FACET_DIVISIONS = 2    /* the same in space, where pieces cost as many squared */
};

static floe_status reserve_markers(mpm *s, size_t markers, size_t chains)
{
    surface_markers *k = &s->surfaces->markers;
    TRY(memory_resize(s->ctx, &k->now, markers, sizeof *k->now));
    TRY(memory_resize(s->ctx, &k->next, markers, sizeof *k->next));
    TRY(memory_resize(s->ctx, &k->group, markers, sizeof *k->group));
    TRY(memory_resize(s->ctx, &k->pin, markers, sizeof *k->pin));
    TRY(memory_resize(s->ctx, &k->force, 3 * markers, sizeof *k->force));
    TRY(memory_resize(s->ctx, &k->heat, markers, sizeof *k->heat));
    TRY(memory_resize(s->ctx, &k->path, 3 * markers, sizeof *k->path));
    TRY(memory_resize(s->ctx, &k->beside, chains, sizeof *k->beside));
    return memory_resize(s->ctx, &k->chain, chains, sizeof *k->chain);
}

/* Axis across the side of the mesh on which a chain ends, as a bit. */
static int side_under(const mesh *m, const double x[2])
{
    for (int a = 0; a < 2; ++a)
        if (x[a] == m->lower[a] || x[a] == m->upper[a]) return 1 << a;
    return 0;
}

/* Marker n at x, of a body's group, free to move. */
static floe_status set_marker(mpm *s, const mpm_body *b, size_t n, const double *x)
{
    surface_markers *k = &s->surfaces->markers;
    surface_marker *out = &k->now[n];
    double v[3], stress[6];
    *out = (surface_marker){.x = {x[0], x[1], s->mesh->dim > 2 ? x[2] : 0.0}};
    TRY(body_solid_state(s->scene, b->scene_body, out->x, v, stress));
    memcpy(out->v, v, (size_t)s->mesh->dim * sizeof *v);
    k->group[n] = b->group;
    k->pin[n] = 0;
    return FLOE_OK;
}

/* The only fluid of the cells; -1: there are several. */
static int only_fluid(const scene *s)
{
    int found = s->has_ambient ? s->ambient_material : -1;
    for (int b = 0; b < s->n_bodies; ++b) {
        const int of = s->body[b].material;
        if (s->material[of].kind != MATERIAL_FLUID || of == found) continue;
        if (found >= 0) return -1;
        found = of;
    }
    return found;
}

int mpm_fluid_at(const scene *s, int dim, const double x[3])
{
    int found = s->has_ambient ? s->ambient_material : -1;
    for (int b = s->n_bodies - 1; b >= 0; --b) {
        const scene_body *body = &s->body[b];
        if (!body->shape.model || !shape_inside(&body->shape, dim, x)) continue;
        if (s->material[body->material].kind != MATERIAL_FLUID) return MPM_IN_A_SOLID;
        if (!body->yields || found < 0) found = body->material;
    }
    return found;
}

/* A little beyond the middle between two points of a chain, or beyond its only point. */
static void place_beyond(const mesh *m, const contour *o, const contour_chain *c, size_t k, double x[3])
{
    const double *a = o->x[c->first + k], *b = o->x[c->first + (k + 1) % c->n], step = 1e-3 * m->h[0];
    const double displacement[2] = {b[0] - a[0], b[1] - a[1]}, length = hypot(displacement[0], displacement[1]);
    x[0] = 0.5 * (a[0] + b[0]) + (m->dim == 1 ? -c->into * step : -step * displacement[1] / length);
    x[1] = 0.5 * (a[1] + b[1]) + (m->dim == 1 ? 0.0 : step * displacement[0] / length);
    x[2] = 0.0;
}

int fluid_beside(const scene *s, const mesh *m, const contour *o, size_t chain)
{
    const contour_chain *c = &o->chain[chain];
    const size_t n = m->dim == 1 ? 1 : c->closed ? c->n : c->n - 1;
    int found = only_fluid(s);
    if (found >= 0) return found;
    found = MPM_IN_A_SOLID;
    for (size_t k = 0; k < n; ++k) {
        double x[3];
        place_beyond(m, o, c, k, x);
        const int fluid = mpm_fluid_at(s, m->dim, x);
        if (fluid == MPM_IN_A_SOLID) continue;
        if (found != MPM_IN_A_SOLID && found != fluid) return MPM_FLUIDS_MEET;
        found = fluid;
    }
    return found;
}

static floe_status add_contour(mpm *s, const mpm_body *b, const contour *o)
{
    surface_markers *k = &s->surfaces->markers;
    const size_t first = k->n, chains = (size_t)k->n_chains;
    if (o->n == 0) return FLOE_OK;
    TRY(reserve_markers(s, first + o->n, chains + o->n_chains));
    for (size_t n = 0; n < o->n; ++n) TRY(set_marker(s, b, first + n, o->x[n]));
    for (size_t c = 0; c < o->n_chains; ++c) {
        const contour_chain *from = &o->chain[c];
        const size_t at = first + from->first, last = at + from->n - 1;
        k->beside[k->n_chains] = fluid_beside(s->scene, s->mesh, o, c);
        k->chain[k->n_chains++] = (cut_chain){(int)at, (int)from->n, from->closed, from->into};
        if (s->mesh->dim == 1) continue;
        if (from->closed) continue;
        k->pin[at] = side_under(s->mesh, k->now[at].x);
        k->pin[last] = side_under(s->mesh, k->now[last].x);
    }
    k->n += o->n;
    return FLOE_OK;
}

/* What is traced of a shape that reaches a periodic side, or comes near to it, is that of its images too. */
static shape go_around(const mesh *m, const shape *s, images *around)
{
    return images_make(around, s, m->dim, m->lower, m->upper, m->periodic, 2.0 * m->h[0]);
}

/* ---- in space ---- */

/* None for bodies whose surface another has, to which they are welded. `closed`: also along sides that the body can leave. */
static floe_status make_facets(const scene *s, const mesh *m, const scene_body *body, bool closed, facet_surface *out)
{
    const seed_spec grid = body_seed_spec(s, m, body);
    welded w;
    *out = (facet_surface){.n = 0};
    floe_status status = welded_find(s, m, body, &w);
    if (status == FLOE_OK && w.shape.model) {
        inset part;
        images around;
        const shape own = closed ? standing_shape(s, m, body, &w.shape, &part) : w.shape;
        const shape surface = go_around(m, &own, &around);
        status = facets_make(out, s->ctx, &surface, &grid, FACET_DIVISIONS);
    }
    welded_free(s->ctx, &w);
    return status;
}

/* A little beyond the middle of a facet, on the side of the gas. */
static void place_off(const mesh *m, const facet_surface *o, const facet *f, double x[3])
{
    const double *p = o->x[f->vertex[0]], *q = o->x[f->vertex[1]], *r = o->x[f->vertex[2]];
    double into[3];
    triangle_normal(p, q, r, into);
    const double length = vec_norm(into);
    for (int a = 0; a < 3; ++a)
        x[a] = (p[a] + q[a] + r[a]) / 3.0 - (length > 0.0 ? 1e-2 * m->h[0] * into[a] / length : 0.0);
}

static int joined(int *up, int v)
{
    while (up[v] != v) v = up[v] = up[up[v]];
    return v;
}

/* The fluid beside each connected part of a surface, for every facet: as fluid_beside has it of a chain. */
static floe_status find_facing(const scene *s, const mesh *m, const facet_surface *o, int *facing)
{
    const int only = only_fluid(s);
    int *up = NULL;
    for (int n = 0; n < o->n_facets; ++n) facing[n] = only;
    if (only >= 0 || o->n_facets == 0) return FLOE_OK;
    TRY(memory_new(s->ctx, &up, 2 * (size_t)o->n, sizeof *up));
    int *found = up + o->n;
    for (int v = 0; v < o->n; ++v) {
        up[v] = v;
        found[v] = MPM_IN_A_SOLID;
    }
    for (int n = 0; n < o->n_facets; ++n)
        for (int k = 1; k < 3; ++k) up[joined(up, o->facet[n].vertex[k])] = joined(up, o->facet[n].vertex[0]);
    for (int n = 0; n < o->n_facets; ++n) {
        double x[3];
        int *of = &found[joined(up, o->facet[n].vertex[0])];
        place_off(m, o, &o->facet[n], x);
        const int fluid = mpm_fluid_at(s, 3, x);
        if (fluid != MPM_IN_A_SOLID) *of = *of == MPM_IN_A_SOLID || *of == fluid ? fluid : MPM_FLUIDS_MEET;
    }
    for (int n = 0; n < o->n_facets; ++n) facing[n] = found[joined(up, o->facet[n].vertex[0])];
    memory_free(s->ctx, &up);
    return FLOE_OK;
}

static floe_status reserve_triangles(mpm *s, int triangles)
{
    surface_markers *k = &s->surfaces->markers;
    TRY(memory_resize(s->ctx, &k->triangle, (size_t)triangles, sizeof *k->triangle));
    return memory_resize(s->ctx, &k->facing, (size_t)triangles, sizeof *k->facing);
}

/* Ends on sides of the mesh stay on them. */
static void pin_rims(const mpm *s, const cut_triangle *t)
{
    const surface_markers *k = &s->surfaces->markers;
    for (int n = 0; n < 3; ++n) {
        const int end[2] = {t->vertex[n], t->vertex[(n + 1) % 3]};
        for (int a = 0; a < 3 && (t->rim >> n & 1); ++a) {
            const double x = k->now[end[0]].x[a];
            if (x != k->now[end[1]].x[a] || (x != s->mesh->lower[a] && x != s->mesh->upper[a])) continue;
            for (int i = 0; i < 2; ++i) k->pin[end[i]] |= 1 << a;
        }
    }
}

static floe_status add_facets(mpm *s, const mpm_body *b, const facet_surface *o)
{
    surface_markers *k = &s->surfaces->markers;
    const int first = (int)k->n, triangles = k->n_triangles;
    if (o->n_facets == 0) return FLOE_OK;
    TRY(reserve_markers(s, k->n + (size_t)o->n, 1));
    TRY(reserve_triangles(s, triangles + o->n_facets));
    for (int n = 0; n < o->n; ++n) TRY(set_marker(s, b, (size_t)(first + n), o->x[n]));
    TRY(find_facing(s->scene, s->mesh, o, k->facing + triangles));
    for (int n = 0; n < o->n_facets; ++n) {
        const facet *f = &o->facet[n];
        k->triangle[triangles + n] =
            (cut_triangle){{first + f->vertex[0], first + f->vertex[1], first + f->vertex[2]}, f->rim};
        pin_rims(s, &k->triangle[triangles + n]);
    }
    k->n += (size_t)o->n;
    k->n_triangles += o->n_facets;
    return FLOE_OK;
}

static floe_status lay_facets(const scene *s, const mesh *m, const scene_body *body, const facet_surface *o, int fluid,
                              cut_surface *out)
{
    const int number = (int)(body - s->body);
    const int vertices = out->n_vertices, triangles = out->n_triangles;
    int *facing = NULL;
    TRY(cut_reserve(out, vertices + o->n, 0));
    TRY(cut_reserve_triangles(out, triangles + o->n_facets));
    out->n_triangles = triangles;
    for (int k = 0; k < o->n; ++k)
        out->vertex[vertices + k] = (cut_vertex){{o->x[k][0], o->x[k][1], o->x[k][2]}, vertices + k, number};
    TRY(memory_new(s->ctx, &facing, (size_t)o->n_facets + 1, sizeof *facing));
    const floe_status status = find_facing(s, m, o, facing);
    for (int n = 0; n < o->n_facets && status == FLOE_OK; ++n) {
        const int *v = o->facet[n].vertex;
        if (fluid >= 0 && facing[n] != fluid) continue;
        out->triangle[out->n_triangles++] =
            (cut_triangle){{vertices + v[0], vertices + v[1], vertices + v[2]}, o->facet[n].rim};
    }
    memory_free(s->ctx, &facing);
    return status;
}

/* ---- of bodies ---- */

/* The same in the plane, four markers a cell. */
static floe_status trace_contour(const scene *s, const mesh *m, const scene_body *body, bool closed, contour *out)
{
    const seed_spec grid = body_seed_spec(s, m, body);
    inset part;
    images around;
    const shape own = closed ? standing_shape(s, m, body, &body->shape, &part) : body->shape;
    const shape surface = go_around(m, &own, &around);
    return contour_trace(out, s->ctx, &surface, &grid, CONTOUR_DIVISIONS);
}

static floe_status lay_chains(const scene *s, const mesh *m, const scene_body *body, const contour *o, int fluid,
                              cut_surface *out)
{
    const int number = (int)(body - s->body);
    const int vertices = out->n_vertices, chains = out->n_chains;
    TRY(cut_reserve(out, vertices + (int)o->n, chains + (int)o->n_chains));
    out->n_chains = chains;
    for (size_t k = 0; k < o->n; ++k)
        out->vertex[vertices + (int)k] = (cut_vertex){{o->x[k][0], o->x[k][1], 0.0}, vertices + (int)k, number};
    for (size_t c = 0; c < o->n_chains; ++c) {
        if (fluid >= 0 && fluid_beside(s, m, o, c) != fluid) continue;
        out->chain[out->n_chains++] =
            (cut_chain){vertices + (int)o->chain[c].first, (int)o->chain[c].n, o->chain[c].closed, o->chain[c].into};
    }
    return FLOE_OK;
}

floe_status mpm_boundary_add(const scene *s, const mesh *m, const scene_body *body, int fluid, cut_surface *out)
{
    if (m->dim == 3) {
        facet_surface f;
        TRY(make_facets(s, m, body, false, &f));
        const floe_status laid = lay_facets(s, m, body, &f, fluid, out);
        facets_free(s->ctx, &f);
        return laid;
    }
    contour o;
    TRY(trace_contour(s, m, body, false, &o));
    const floe_status status = lay_chains(s, m, body, &o, fluid, out);
    contour_free(s->ctx, &o);
    return status;
}

static floe_status seed_on_body(mpm *s, const mpm_body *b)
{
    const scene_body *body = &s->scene->body[b->scene_body];
    if (s->mesh->dim == 3) {
        facet_surface f;
        TRY(make_facets(s->scene, s->mesh, body, true, &f));
        const floe_status status = add_facets(s, b, &f);
        facets_free(s->ctx, &f);
        return status;
    }
    contour o;
    TRY(trace_contour(s->scene, s->mesh, body, true, &o));
    const floe_status status = add_contour(s, b, &o);
    contour_free(s->ctx, &o);
    return status;
}

floe_status seed_markers(mpm *s)
{
    surface_markers *k = &s->surfaces->markers;
    for (int b = 0; b < s->n_bodies; ++b) {
        TRY(seed_on_body(s, &s->body[b]));
        k->of_body[b + 1] = k->n;
    }
    if (k->n == 0)
        return fail_key(s->ctx, KEY("method", "interface"),
                        "sharp: no solid has a surface inside the domain; leave it out");
    memcpy(k->next, k->now, k->n * sizeof *k->now);
    return FLOE_OK;
}

void scatter_markers(mpm *s, int group, const double *force)
{
    const surface_markers *k = &s->surfaces->markers;
    for (size_t n = 0; n < k->n; ++n)
        if (k->group[n] == group) push_marker(s, group, k->now[n].x, force + 3 * n);
}

void scatter_marker_heat(mpm *s, int group)
{
    const surface_markers *k = &s->surfaces->markers;
    for (size_t n = 0; n < k->n; ++n)
        if (k->group[n] == group && k->heat[n] != 0.0) add_surface_heat(s, group, k->now[n].x, k->heat[n]);
}

void move_markers(mpm *s, int group)
{
    const surface_markers *k = &s->surfaces->markers;
    for (size_t n = 0; n < k->n; ++n) {
        if (k->group[n] != group) continue;
        const surface_motion m = surface_motion_at(s, group, k->now[n].x);
        for (int a = 0; a < s->mesh->dim; ++a) {
            const bool pinned = k->pin[n] >> a & 1;
            k->next[n].v[a] = pinned ? 0.0 : m.after[a];
            k->next[n].x[a] = k->now[n].x[a] + (pinned ? 0.0 : m.displacement[a]);
            k->path[3 * n + (size_t)a] = (s->substep > 0 ? k->path[3 * n + (size_t)a] : 0.0) + s->dt * m.working[a];
        }
    }
}

void displace_markers(mpm *s, node_displacement *displacement)
{
    const surface_markers *k = &s->surfaces->markers;
    for (size_t n = 0; n < k->n; ++n) {
        const double *x = k->now[n].x;
        surface_marker *next = &k->next[n];
        *next = (surface_marker){.x = {x[0], x[1], x[2]}};
        displace_position(s, k->group[n], x, displacement, next->x);
        for (int a = 0; a < s->mesh->dim; ++a)
            if (k->pin[n] >> a & 1) next->x[a] = x[a];
    }
}

/* Adds to the markers at the corners of a segment or a triangle what these have of its area vector. */
static void add_piece_area(const mpm *s, const surface_marker *at, const int corner[3], double *area)
{
    double x[3][3], share[3][3];
    for (int c = 0; c < s->mesh->dim; ++c)
        for (int a = 0; a < 3; ++a) {
            const double here = at[corner[c]].x[a];
            x[c][a] = here + mesh_to_image(s->mesh, a, here, at[corner[0]].x[a]);
        }
    pressure_between(s->mesh, (const double *const[3]){x[0], x[1], x[2]}, share);
    for (int c = 0; c < s->mesh->dim; ++c) vec_add_scaled(1.0, share[c], area + 3 * corner[c]);
}

/* The share of each marker of the area vectors about it; on a line 1. */
static void find_marker_areas(const mpm *s, const surface_marker *at, double *area)
{
    const surface_markers *k = &s->surfaces->markers;
    memset(area, 0, 3 * k->n * sizeof *area);
    for (size_t n = 0; n < k->n && s->mesh->dim == 1; ++n) area[3 * n] = 1.0;
    for (int c = 0; c < k->n_chains && s->mesh->dim == 2; ++c)
        for (int n = 0; n + (k->chain[c].closed ? 0 : 1) < k->chain[c].n; ++n)
            add_piece_area(s, at, (const int[3]){k->chain[c].first + n, k->chain[c].first + (n + 1) % k->chain[c].n},
                           area);
    for (int t = 0; t < k->n_triangles; ++t) add_piece_area(s, at, k->triangle[t].vertex, area);
}

/* What of a force is along the area of its marker turns and stretches with it. */
void turn_marker_forces(const mpm *s, const double *force, double *out)
{
    const surface_markers *k = &s->surfaces->markers;
    double *first = k->path, *last = out;
    find_marker_areas(s, k->now, first);
    find_marker_areas(s, k->next, last);
    for (size_t n = 0; n < k->n; ++n) {
        const double square = vec_dot(first + 3 * n, first + 3 * n),
                     share = square > 0.0 ? vec_dot(force + 3 * n, first + 3 * n) / square : 0.0;
        for (size_t a = 3 * n; a < 3 * n + 3; ++a) out[a] = force[a] + share * (last[a] - first[a]);
    }
}

double swept_by_markers(const mpm *s, const double *first, const double *last)
{
    const surface_markers *k = &s->surfaces->markers;
    double sum = 0.0;
    for (size_t n = 0; n < k->n; ++n)
        for (size_t a = 0; a < 3; ++a)
            sum += 0.5 * (first[3 * n + a] + last[3 * n + a]) * (k->next[n].x[a] - k->now[n].x[a]);
    return sum;
}

void commit_markers(mpm *s)
{
    surface_markers *k = &s->surfaces->markers;
    surface_marker *swap = k->now;
    k->now = k->next;
    k->next = swap;
    for (size_t n = 0; n < k->n; ++n)
        for (int a = 0; a < s->mesh->dim; ++a) k->now[n].x[a] = mesh_brought_around(s->mesh, a, k->now[n].x[a]);
}

void free_markers(context *ctx, surface_markers *k)
{
    memory_free(ctx, &k->now);
    memory_free(ctx, &k->next);
    memory_free(ctx, &k->group);
    memory_free(ctx, &k->pin);
    memory_free(ctx, &k->force);
    memory_free(ctx, &k->heat);
    memory_free(ctx, &k->path);
    memory_free(ctx, &k->chain);
    memory_free(ctx, &k->beside);
    memory_free(ctx, &k->triangle);
    memory_free(ctx, &k->facing);
}

double *mpm_surface_markers(mpm *s, size_t *n, size_t *stride)
{
    *n = s->surfaces->markers.n;
    *stride = sizeof(surface_marker) / sizeof(double);
    return *n ? s->surfaces->markers.now[0].x : NULL;
}
