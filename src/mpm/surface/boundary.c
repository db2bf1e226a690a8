#include "mpm/surface/boundary.h"

#include "base/memory.h"
#include "mpm/surface/inertia.h"
#include "mpm/surface/membrane_boundary.h"
#include "mpm/surface/surface_markers.h"
#include "mpm/surface/surfaces.h"
#include "mpm/surface/welded.h"

#include <math.h>
#include <string.h>

static floe_status has_left(const mpm *s, int end)
{
    const surface_markers *k = &s->surfaces->markers;
    return fail(s->ctx, FLOE_DIVERGED,
                "a solid has left the side of the domain at (%g, %g) by a cell, and a sharp interface lets no gas "
                "between them: leave a tenth of a cell between them at the start, or say symmetry where it is meant to "
                "stay",
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

static bool is_wall_kind(bc_kind kind)
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
            if (gap[side] >= h && gap[side] < 2.0 * h && is_wall_kind(s->scene->bc.side[0][side].kind))
                return has_left(s, k->chain[c].first);
    }
    return FLOE_OK;
}

/* Bodies that part draw the surface out between them that they had in common. */
static floe_status check_drawn_out(const mpm *s)
{
    static const double cells = 3.0; /* six times as long as at the start */
    const surface_markers *k = &s->surfaces->markers;
    for (int n = 0; n < k->n_triangles; ++n)
        for (int e = 0; e < 3; ++e) {
            const double *x = k->next[k->triangle[n].vertex[e]].x, *y = k->next[k->triangle[n].vertex[(e + 1) % 3]].x;
            for (int a = 0; a < 3; ++a)
                if (!(fabs(x[a] - y[a] - mesh_to_image(s->mesh, a, y[a], x[a])) < cells * s->mesh->h[a]))
                    return fail(s->ctx, FLOE_DIVERGED,
                                "the surface of a solid is drawn out by three cells at (%g, %g, %g), as where bodies "
                                "part that touched at the start: leave a cell between them, or use method.interface: "
                                "smeared",
                                x[0], x[1], x[2]);
        }
    return FLOE_OK;
}

static floe_status check_ends(const mpm *s)
{
    const surface_markers *k = &s->surfaces->markers;
    if (s->mesh->dim == 1) return check_points(s);
    TRY(check_drawn_out(s));
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
        out->vertex[n] = (cut_vertex){{x[0], x[1], x[2]}, n, 0};
    }
    return FLOE_OK;
}

floe_status mpm_boundary_vertices(mpm *s, int body, bool next, cut_surface *out)
{
    return membrane_vertices(s, body, next, out);
}

void mpm_boundary_velocity(const mpm *s, int body, const cut_surface *c, double *velocity)
{
    const surface_markers *markers = &s->surfaces->markers;
    for (size_t k = 0; k < markers->n; ++k) memcpy(velocity + 3 * k, markers->now[k].v, 3 * sizeof *velocity);
    if (markers->n == 0) membrane_velocity(s, body, c, velocity);
}

void mpm_boundary_force(mpm *s, int body, const cut_surface *c, const double *force)
{
    for (size_t k = 0; k < 3 * s->surfaces->markers.n; ++k) s->surfaces->markers.force[k] += force[k];
    if (s->surfaces->markers.n == 0) membrane_set_force(s, body, c, force);
}

void mpm_boundary_clear(mpm *s)
{
    surface_markers *k = &s->surfaces->markers;
    if (k->n == 0) return;
    memset(k->force, 0, 3 * k->n * sizeof *k->force);
    memset(k->heat, 0, k->n * sizeof *k->heat);
}

void mpm_boundary_temperature(const mpm *s, double *temperature)
{
    const surface_markers *k = &s->surfaces->markers;
    for (int b = 0; b < s->n_bodies; ++b)
        for (size_t n = k->of_body[b]; n < k->of_body[b + 1]; ++n)
            temperature[n] =
                s->body[b].conductivity > 0.0 ? surface_temperature(s, k->group[n], k->now[n].x) : (double)NAN;
}

void mpm_boundary_heat(mpm *s, const double *heat)
{
    for (size_t n = 0; n < s->surfaces->markers.n; ++n) s->surfaces->markers.heat[n] += heat[n];
}

bool mpm_boundary_sum_force(const mpm *s, int body, double force[3])
{
    if (!s->surfaces || s->surfaces->markers.n == 0) return false;
    if (welded_to_others(s->scene, s->mesh, &s->scene->body[s->body[body].scene_body])) return false;
    const surface_markers *k = &s->surfaces->markers;
    for (int a = 0; a < 3; ++a) force[a] = 0.0;
    for (size_t n = k->of_body[body]; n < k->of_body[body + 1]; ++n)
        for (size_t a = 0; a < 3; ++a) force[a] += k->force[3 * n + a];
    return k->of_body[body + 1] > k->of_body[body];
}

void mpm_boundary_responds(mpm *s, wall_response *w)
{
    s->surfaces->fluids = w;
    s->forces_at_end = w && w->solve;
}

void mpm_boundary_displacement(const mpm *s, int body, const cut_surface *c, double *path)
{
    if (s->surfaces->markers.n > 0)
        memcpy(path, s->surfaces->markers.path, 3 * s->surfaces->markers.n * sizeof *path);
    else
        membrane_displacement(s, body, c, path);
}

double mpm_boundary_lost_energy(const mpm *s)
{
    return s->lost;
}

void surfaces_free(mpm *s)
{
    if (!s->surfaces) return;
    free_membrane_force(s);
    free_markers(s->ctx, &s->surfaces->markers);
    inertia_free(s);
    memory_free(s->ctx, &s->surfaces->corner);
    memory_free(s->ctx, &s->surfaces->corner_next);
    memory_free(s->ctx, &s->surfaces->corner_force);
    memory_free(s->ctx, &s->surfaces->corner_body);
    memory_free(s->ctx, &s->surfaces->facet);
    memory_free(s->ctx, &s->surfaces);
}
