/* Implicit wall pressures on light solids (theory 7.6). Let p be the changes of pressure of the cells, y the volume flux out of them in excess of
 * that with which the fluids have found their pressure, y0 the part of y due to the other forces, and S p the part that p causes, with the inertia behind the walls:
 *
 *     p = f(y),   y = y0 + S p
 *
 * f decreases with y (wall_response.h). Each step of Newton's method solves (1/K + S) p = f(y)/K + y - y0, K = -f'(y), a symmetric and positive
 * definite system, by conjugate gradients scaled by the diagonal. The residual p - f(y) costs no conservation: the same p acts on fluid and
 * solid. */
#include "base/memory.h"
#include "mpm/implicit/implicit_walls.h"
#include "mpm/surface/inertia.h"
#include "mpm/surface/surface_markers.h"
#include "mpm/surface/surface_place.h"
#include "mpm/surface/surfaces.h"
#include "mpm/transfer/scatter.h"

#include <math.h>
#include <string.h>

enum { NEWTON_STEPS = 8, GRADIENT_STEPS = 200 };
static const double tolerance = 1e-9; /* of the largest change of pressure, or of what the first flux would make */

enum { OWN, SLOPE, PRESSURE, FLUX, FIRST, RESIDUAL, SCALED, SEARCH, APPLIED, VECTORS };

/* Vectors of one number a cell; 0 in cells that push nothing. */
typedef struct cell_vectors {
    double *of[VECTORS];
    int n;
} cell_vectors;

static floe_status get_vectors(mpm *s, int n, cell_vectors *v)
{
    marker_inertia *t = s->surfaces->inertia;
    const size_t needed = (size_t)VECTORS * (size_t)n;
    if (needed > t->reserved_values) {
        TRY(memory_resize(s->ctx, &t->value, 2 * needed, sizeof *t->value));
        t->reserved_values = 2 * needed;
    }
    memset(t->value, 0, needed * sizeof *t->value);
    v->n = n;
    for (int k = 0; k < VECTORS; ++k) v->of[k] = t->value + (size_t)k * (size_t)n;
    return FLOE_OK;
}

static double inner_product(const cell_vectors *v, int a, int b)
{
    double sum = 0.0;
    for (int c = 0; c < v->n; ++c) sum += v->of[a][c] * v->of[b][c];
    return sum;
}

static void scale_residual(const cell_vectors *v)
{
    for (int c = 0; c < v->n; ++c) v->of[SCALED][c] = v->of[RESIDUAL][c] / (1.0 / v->of[SLOPE][c] + v->of[OWN][c]);
}

/* (1/K + S) of a vector, into APPLIED. */
static void apply(const mpm *s, const wall_response *w, const cell_vectors *v, int from)
{
    inertia_flux_of(s, w, v->of[from], v->of[APPLIED]);
    for (int c = 0; c < v->n; ++c) v->of[APPLIED][c] += v->of[from][c] / v->of[SLOPE][c];
}

/* Improves PRESSURE until its residual is small beside that of no pressure. */
static void solve_linear(const mpm *s, const wall_response *w, const cell_vectors *v)
{
    for (int c = 0; c < v->n; ++c) {
        const wall_cell *of = &w->cell[c];
        const double slope = of->first < 0 ? 1.0 : wall_pressure_slope(of, v->of[FLUX][c]);
        v->of[SLOPE][c] = slope;
        v->of[RESIDUAL][c] =
            of->first < 0 ? 0.0 : wall_pressure_change(of, v->of[FLUX][c]) / slope + v->of[FLUX][c] - v->of[FIRST][c];
    }
    scale_residual(v);
    const double whole = inner_product(v, RESIDUAL, SCALED);
    apply(s, w, v, PRESSURE);
    for (int c = 0; c < v->n; ++c) v->of[RESIDUAL][c] -= v->of[APPLIED][c];
    scale_residual(v);
    memcpy(v->of[SEARCH], v->of[SCALED], (size_t)v->n * sizeof(double));
    double left = inner_product(v, RESIDUAL, SCALED);
    for (int k = 0; k < GRADIENT_STEPS && left > tolerance * tolerance * whole; ++k) {
        apply(s, w, v, SEARCH);
        const double part = left / inner_product(v, SEARCH, APPLIED);
        for (int c = 0; c < v->n; ++c) {
            v->of[PRESSURE][c] += part * v->of[SEARCH][c];
            v->of[RESIDUAL][c] -= part * v->of[APPLIED][c];
        }
        scale_residual(v);
        const double now = inner_product(v, RESIDUAL, SCALED), kept = now / left;
        for (int c = 0; c < v->n; ++c) v->of[SEARCH][c] = v->of[SCALED][c] + kept * v->of[SEARCH][c];
        left = now;
    }
    inertia_flux_of(s, w, v->of[PRESSURE], v->of[FLUX]);
    for (int c = 0; c < v->n; ++c) v->of[FLUX][c] += v->of[FIRST][c];
}

/* Whether p = f(y) in all cells. */
static bool is_solved(const wall_response *w, const cell_vectors *v)
{
    double off = 0.0, largest = 0.0;
    for (int c = 0; c < v->n; ++c) {
        if (w->cell[c].first < 0) continue;
        off = fmax(off, fabs(v->of[PRESSURE][c] - wall_pressure_change(&w->cell[c], v->of[FLUX][c])));
        largest = fmax(largest, fabs(wall_pressure_change(&w->cell[c], v->of[FIRST][c])));
    }
    return off <= tolerance * largest;
}

/* What a wall_motion is asked with. */
typedef struct moved_walls {
    const mpm *s;
    const wall_response *w;
} moved_walls;

static void moved_flux(const void *walls, const double *pressure, double *flux)
{
    const moved_walls *m = walls;
    inertia_flux_of(m->s, m->w, pressure, flux);
}

/* Of nodes alone: the answer of a body that does not deform has a few directions only, which cost the search an iteration each, and
 * on the diagonal of every cell it would be far too much. */
static double moved_own_flux(const void *walls, int cell)
{
    const moved_walls *m = walls;
    const marker_inertia *t = m->s->surfaces->inertia;
    const int first = m->w->cell[cell].first;
    if (first < 0 || t->marker[t->of_vertex[m->w->push[first].vertex]].motion) return 0.0;
    return inertia_own_flux(m->s, m->w, cell);
}

/* By the fluids, whose other cells take part (theory 7.8). */
static floe_status find_together(mpm *s, wall_response *w, const cell_vectors *v)
{
    const moved_walls walls = {s, w};
    const wall_motion motion = {&walls, v->of[FIRST], moved_flux, moved_own_flux};
    inertia_first_flux(s, w, v->of[FIRST]);
    TRY(w->solve(w->fluids, &motion, v->of[PRESSURE]));
    inertia_flux_of(s, w, v->of[PRESSURE], v->of[FLUX]);
    for (int c = 0; c < w->n_cells; ++c) {
        w->cell[c].change = v->of[PRESSURE][c];
        w->cell[c].flux = v->of[FIRST][c] + v->of[FLUX][c];
    }
    inertia_force_of(s, w, v->of[PRESSURE]);
    return FLOE_OK;
}

static void find_pressures(mpm *s, wall_response *w, const cell_vectors *v)
{
    inertia_first_flux(s, w, v->of[FIRST]);
    memcpy(v->of[FLUX], v->of[FIRST], (size_t)v->n * sizeof(double));
    for (int c = 0; c < v->n; ++c)
        if (w->cell[c].first >= 0) v->of[OWN][c] = inertia_own_flux(s, w, c);
    for (int k = 0; k < NEWTON_STEPS && !is_solved(w, v); ++k) solve_linear(s, w, v);
    for (int c = 0; c < v->n; ++c) {
        w->cell[c].change = w->cell[c].first < 0 ? 0.0 : v->of[PRESSURE][c];
        w->cell[c].flux = w->cell[c].first < 0 ? 0.0 : v->of[FLUX][c];
    }
    inertia_force_of(s, w, v->of[PRESSURE]);
}

/* ---- forces ---- */

/* Every node of the block and its ghosts. */
static void move_forces(const mpm *s, int group, bool back)
{
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int a = 0; a < s->mesh->dim; ++a) {
            double *force = field_get(s->domain->fields[b], N_FORCE, group, a);
            double *aside = field_get(s->domain->fields[b], N_VEL_L, group, a);
            for (size_t k = 0; k < s->mesh->block[b].size; ++k) {
                if (!back) aside[k] = force[k];
                force[k] = back ? force[k] + aside[k] : 0.0;
            }
        }
}

/* Adds the forces of the changes to those of the markers, and to the nodes; sides fold both alike. */
static void add_forces(mpm *s)
{
    const marker_inertia *t = s->surfaces->inertia;
    for (int g = 0; g < s->n_groups; ++g) {
        move_forces(s, g, false);
        for (int n = 0; n < t->n_markers; ++n) {
            const int vertex = t->marker[n].vertex;
            if (s->surfaces->markers.group[vertex] == g)
                push_marker(s, g, s->surfaces->markers.now[vertex].x, t->marker[n].force);
        }
        fold_forces(s, g);
        move_forces(s, g, true);
    }
    for (int n = 0; n < t->n_markers; ++n)
        for (int a = 0; a < 3; ++a) s->surfaces->markers.force[3 * t->marker[n].vertex + a] += t->marker[n].force[a];
}

floe_status mpm_find_wall_pressures(mpm *s)
{
    wall_response *w = s->surfaces->fluids;
    cell_vectors v;
    TRY(inertia_find(s, w));
    TRY(get_vectors(s, w->n_cells, &v));
    if (w->solve)
        TRY(find_together(s, w, &v));
    else
        find_pressures(s, w, &v);
    add_forces(s);
    if (walls_are_stiff(s)) stiff_take(s);
    return FLOE_OK;
}
