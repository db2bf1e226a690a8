/* Loads on surfaces of facets, whose corners the nodes move: what a pressure makes of it turns and stretches with them (theory 4.13). */
#include "mpm/surface/traction.h"

#include "math/tensor.h"
#include "mpm/loads/point_loads.h"
#include "mpm/surface/surface_facets.h"
#include "mpm/surface/surfaces.h"
#include "scene/state.h"

#include <string.h>

static int corners_of_facet(const mpm *s)
{
    return s->mesh->dim;
}

void centre_of_facet(const mpm *s, const double *place, const surface_facet *f, double x[3])
{
    const int n = corners_of_facet(s);
    for (int a = 0; a < 3; ++a) {
        x[a] = 0.0;
        for (int c = 0; c < n; ++c) x[a] += place[3 * f->corner[c] + (size_t)a] / n;
    }
}

void pressure_between(const mesh *m, const double *const corner[3], double force[3][3])
{
    const double *const *x = corner;
    memset(force, 0, 3 * sizeof force[0]);
    if (m->dim == 2) {
        const double normal[2] = {x[1][1] - x[0][1], x[0][0] - x[1][0]};
        const bool about_axis = m->geometry == MESH_AXISYMMETRIC;
        for (int c = 0; c < 2; ++c) {
            const double weight = about_axis ? (2.0 * x[c][0] + x[1 - c][0]) / 6.0 : 0.5;
            for (int a = 0; a < 2; ++a) force[c][a] = weight * normal[a];
        }
    } else {
        double normal[3];
        triangle_normal(x[0], x[1], x[2], normal);
        for (int c = 0; c < 3; ++c) vec_add_scaled(1.0 / 6.0, normal, force[c]);
    }
}

/* Of a facet with its corners there. */
static void pressure_there(const mpm *s, const surface_facet *f, const double *const corner[3], double force[3][3])
{
    if (s->mesh->dim == 1)
        memmove(force, f->at_rest, sizeof f->at_rest);
    else
        pressure_between(s->mesh, corner, force);
}

void pressure_on_corners(const mpm *s, const double *place, const surface_facet *f, double force[3][3])
{
    const double *const corner[3] = {&place[3 * f->corner[0]], &place[3 * f->corner[1]], &place[3 * f->corner[2]]};
    pressure_there(s, f, corner, force);
}

void area_of_facet(const mpm *s, const double *place, const surface_facet *f, double area[3])
{
    double force[3][3];
    pressure_on_corners(s, place, f, force);
    for (int a = 0; a < 3; ++a) area[a] = force[0][a] + force[1][a] + force[2][a];
}

bool facet_follows(const mpm *s, const surface_facet *f)
{
    return f->use != SURFACE_LOADED || !s->scene->load[f->number].dead;
}

/* The same as a load or gas finds it: at the start of the step; in steps that are solved for at their end, with inertia the mean of both. */
static void pressure_in_step(const mpm *s, const surface_facet *f, double force[3][3])
{
    const struct mpm_surfaces *w = s->surfaces;
    double first[3][3];
    if (!facet_follows(s, f)) {
        memcpy(force, f->at_rest, sizeof f->at_rest);
        return;
    }
    pressure_on_corners(s, mpm_is_solved(s) ? w->corner_next : w->corner, f, force);
    if (s->solver != SOLVER_IMPLICIT) return;
    pressure_on_corners(s, w->corner, f, first);
    for (int c = 0; c < 3; ++c)
        for (int a = 0; a < 3; ++a) force[c][a] = 0.5 * (force[c][a] + first[c][a]);
}

/* Adds the forces (N) of a load on a facet to its corners: a pressure, and a vector on the area at rest. */
static void load_facet(const mpm *s, const surface_facet *f)
{
    const scene_load *load = &s->scene->load[f->number];
    const int n = corners_of_facet(s);
    double x[3], unit[3][3], vector[3];
    centre_of_facet(s, mpm_is_solved(s) ? s->surfaces->corner_next : s->surfaces->corner, f, x);
    pressure_in_step(s, f, unit);
    const double share = load_now(s, load), pressure = share * load_target(s->scene, load, x, load_time(s));
    load_vector(s->scene, load, x, load_time(s), vector);
    for (int c = 0; c < n; ++c) {
        double *force = &s->surfaces->corner_force[3 * f->corner[c]];
        vec_add_scaled(pressure, unit[c], force);
        vec_add_scaled(share * vec_norm(f->at_rest[c]), vector, force);
    }
}

/* Forces of loads on the corners of a group; those in the region of a support act on nothing. */
static void find_corner_forces(mpm *s, int group)
{
    struct mpm_surfaces *w = s->surfaces;
    memset(w->corner_force, 0, 3 * w->n_corners * sizeof *w->corner_force);
    for (size_t k = 0; k < w->n_facets; ++k)
        if (w->facet[k].use == SURFACE_LOADED && s->body_group[w->facet[k].body] == group) load_facet(s, &w->facet[k]);
    for (size_t k = 0; k < w->n_corners; ++k)
        if (place_is_supported(s, group, &w->corner[3 * k])) memset(&w->corner_force[3 * k], 0, 3 * sizeof(double));
}

static bool is_nothing(const double force[3])
{
    return force[0] == 0.0 && force[1] == 0.0 && force[2] == 0.0;
}

/* One corner after the other, so that every block adds up a node in the same order. */
void scatter_surfaces(mpm *s, int group)
{
    const struct mpm_surfaces *w = s->surfaces;
    double moment[3] = {0.0};
    if (!w->pressed) return;
    find_corner_forces(s, group);
    for (size_t k = 0; k < w->n_corners; ++k) {
        const double *force = &w->corner_force[3 * k], *x = &w->corner[3 * k];
        if (is_nothing(force)) continue;
        add_surface_force(s, group, x, force);
        for (int a = 0; a < s->mesh->dim; ++a) {
            ledger_add(s->ledger, (ledger_quantity)(LEDGER_MOMENTUM_X + a), LEDGER_SOURCE, force[a] * s->kick);
            add_moment(moment, x, a, force[a]);
        }
    }
    ledger_turn(s->ledger, LEDGER_SOURCE, moment, s->kick);
}

void scatter_gas_pressure(mpm *s, int group, int gas)
{
    struct mpm_surfaces *w = s->surfaces;
    memset(w->corner_force, 0, 3 * w->n_corners * sizeof *w->corner_force);
    for (size_t k = 0; k < w->n_facets; ++k) {
        const surface_facet *f = &w->facet[k];
        double force[3][3];
        if (f->use != SURFACE_BY_GAS || f->number != gas || s->body_group[f->body] != group) continue;
        pressure_in_step(s, f, force);
        for (int c = 0; c < corners_of_facet(s); ++c) vec_add_scaled(1.0, force[c], &w->corner_force[3 * f->corner[c]]);
    }
    for (size_t k = 0; k < w->n_corners; ++k)
        if (!is_nothing(&w->corner_force[3 * k]))
            add_surface_force(s, group, &w->corner[3 * k], &w->corner_force[3 * k]);
}

/* By Simpson's rule, exact: forces are quadratic along the way of the corners, which is straight. */
static double swept_by_facet(const mpm *s, const surface_facet *f)
{
    const struct mpm_surfaces *w = s->surfaces;
    static const double weight[3] = {1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0};
    double sum = 0.0;
    for (int part = 0; part < 3; ++part) {
        double place[3][3], force[3][3];
        for (size_t c = 0; c < 3; ++c)
            for (size_t a = 0; a < 3; ++a) {
                const double first = w->corner[3 * f->corner[c] + a], last = w->corner_next[3 * f->corner[c] + a];
                place[c][a] = first + 0.5 * part * (last - first);
            }
        pressure_there(s, f, (const double *const[3]){place[0], place[1], place[2]}, force);
        for (int c = 0; c < corners_of_facet(s); ++c)
            for (size_t a = 0; a < 3; ++a)
                sum += weight[part] * force[c][a] *
                       (w->corner_next[3 * f->corner[c] + a] - w->corner[3 * f->corner[c] + a]);
    }
    return sum;
}

double surface_swept(const mpm *s, int gas)
{
    const struct mpm_surfaces *w = s->surfaces;
    double sum = 0.0;
    for (size_t k = 0; k < w->n_facets; ++k)
        if (w->facet[k].use == SURFACE_BY_GAS && w->facet[k].number == gas) sum += swept_by_facet(s, &w->facet[k]);
    return sum;
}

/* With the forces that the nodes were given in this step. */
void move_surfaces(mpm *s, int group)
{
    struct mpm_surfaces *w = s->surfaces;
    double work = 0.0;
    if (!w->pressed) return;
    find_corner_forces(s, group);
    for (size_t k = 0; k < w->n_corners; ++k) {
        if (s->body_group[w->corner_body[k]] != group) continue;
        const surface_motion m = surface_motion_at(s, group, &w->corner[3 * k]);
        for (size_t a = 0; a < 3; ++a) {
            w->corner_next[3 * k + a] = w->corner[3 * k + a] + s->dt * m.velocity[a];
            work += w->corner_force[3 * k + a] * s->dt * m.velocity[a];
        }
    }
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_SOURCE, work);
}

void displace_surfaces(mpm *s, node_displacement *displacement)
{
    struct mpm_surfaces *w = s->surfaces;
    for (size_t k = 0; k < w->n_corners; ++k) {
        memcpy(&w->corner_next[3 * k], &w->corner[3 * k], 3 * sizeof *w->corner);
        displace_position(s, s->body_group[w->corner_body[k]], &w->corner[3 * k], displacement, &w->corner_next[3 * k]);
    }
}

double *mpm_surface(mpm *s, size_t *n, size_t *stride)
{
    *n = s->surfaces->n_corners;
    *stride = 3;
    return *n ? s->surfaces->corner : NULL;
}
