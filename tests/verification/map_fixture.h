/* A scene rotated, mirrored, shifted or extended to more dimensions: positions, vectors and sides by one map of the
 * axes. */
#ifndef TESTS_VERIFICATION_MAP_FIXTURE_H
#define TESTS_VERIFICATION_MAP_FIXTURE_H

#include "map_formula_fixture.h"
#include "scene_map_fixture.h"

/* Whether left becomes right. */
FIXTURE bool map_reverses(const scene_map *m)
{
    return m->dim == 2 && m->sign[0] * m->sign[1] * (m->from[0] == 0 ? 1.0 : -1.0) < 0.0;
}

/* Component (i, j) of the old scene that is component c of a symmetric tensor, xx yy zz xy yz zx, of the new one, and its sign. */
FIXTURE int map_stress(const scene_map *m, int c, double *sign)
{
    static const int row[] = {0, 1, 2, 0, 1, 2}, column[] = {0, 1, 2, 1, 2, 0};
    const int i = row[c] < m->dim ? m->from[row[c]] : row[c], j = column[c] < m->dim ? m->from[column[c]] : column[c];
    *sign = (row[c] < m->dim ? m->sign[row[c]] : 1.0) * (column[c] < m->dim ? m->sign[column[c]] : 1.0);
    if (i == j) return i;
    return i + j == 1 ? 3 : i + j == 3 ? 4 : 5;
}

/* ---- shapes ---- */

/* A shape of the old scene in the new one; of its two sides of a plane one or both. */
typedef struct mapped_par {
    const scene_map *map;
    shape old;
    double half; /* 0: all; +1, -1: what lies above, below `plane` of the new scene's last axis */
    double plane;
} mapped_par;

FIXTURE double mapped_level(const void *par, int dim, const double x[3])
{
    (void)dim;
    const mapped_par *p = par;
    double old[3];
    map_back(p->map, x, old);
    const double level = p->old.model->level(p->old.par, p->map->dim, old);
    return p->half == 0.0 ? level : fmax(level, p->half * (p->plane - x[p->map->dim - 1]));
}

/* Without end along an axis that the old scene does not have. */
FIXTURE bool mapped_bounds(const void *par, int dim, double lo[3], double hi[3])
{
    const mapped_par *p = par;
    const int last = p->map->dim - 1;
    double low[3] = {0.0}, high[3] = {0.0};
    if (!p->old.model->bounds(p->old.par, p->map->dim, low, high)) return false;
    map_place(p->map, low);
    map_place(p->map, high);
    for (int a = 0; a < dim; ++a) {
        lo[a] = a <= last ? fmin(low[a], high[a]) : -(double)INFINITY;
        hi[a] = a <= last ? fmax(low[a], high[a]) : (double)INFINITY;
    }
    if (p->half > 0.0) lo[last] = fmax(lo[last], p->plane);
    if (p->half < 0.0) hi[last] = fmin(hi[last], p->plane);
    return true;
}

static const shape_model mapped_model = {.name = "mapped", .level = mapped_level, .bounds = mapped_bounds},
                         mapped_box = {
                             .name = "mapped", .level = mapped_level, .bounds = mapped_bounds, .fills_bounds = true};

FIXTURE mapped_par *map_shape(scene *s, const scene_map *m, shape *it)
{
    if (!it->model) return NULL;
    mapped_par *par;
    check_ok(s->ctx, scene_allocate(s, &par, sizeof *par));
    *par = (mapped_par){m, *it, 0.0, 0.0};
    *it = (shape){shape_fills_bounds(it, m->dim) ? &mapped_box : &mapped_model, par};
    return par;
}

/* ---- curves ---- */

/* The same line; that of a membrane around gas the other way round where a map makes right of left, so that the gas is
 * on its left. */
FIXTURE void map_curve(scene *s, const scene_map *m, curve_line *c, bool holds)
{
    const bool turned = holds && map_reverses(m), mirrors = map_reverses(m);
    double ahead[3] = {1.0, 0.0, 0.0};
    map_vector(m, ahead);
    const double begin = atan2(ahead[1], ahead[0]), from = c->angle_from, to = c->angle_to;
    c->angle_from = mirrors ? begin - (turned ? to : from) : begin + from;
    c->angle_to = mirrors ? begin - (turned ? from : to) : begin + to;
    map_place(m, c->from);
    map_place(m, c->to);
    map_place(m, c->centre);
    for (int a = 0; a < 3 && turned; ++a) {
        const double kept = c->from[a];
        c->from[a] = c->to[a];
        c->to[a] = kept;
    }
    if (c->n_vertices == 0) return;
    double *vertex;
    check_ok(s->ctx, scene_allocate(s, &vertex, 3 * (size_t)c->n_vertices * sizeof *vertex));
    for (int i = 0; i < c->n_vertices; ++i) {
        double *x = vertex + 3 * (turned ? c->n_vertices - 1 - i : i);
        memcpy(x, c->vertex + 3 * i, 3 * sizeof *x);
        map_place(m, x);
    }
    c->vertex = vertex;
}

/* ---- the exact solution ---- */

typedef struct mapped_exact {
    const scene_map *map;
    initial_function *initial;
    source_function *driving, *driving_solids;
    void *user;
} mapped_exact;

FIXTURE double mapped_initial(void *user, initial_quantity quantity, int component, const double x[3])
{
    const mapped_exact *e = user;
    double old[3], sign = 1.0;
    map_back(e->map, x, old);
    if (quantity == INITIAL_STRESS) component = map_stress(e->map, component, &sign);
    if (quantity == INITIAL_VELOCITY && component >= e->map->dim) return 0.0;
    if (quantity == INITIAL_VELOCITY) {
        sign = e->map->sign[component];
        component = e->map->from[component];
    }
    return sign * e->initial(e->user, quantity, component, old);
}

FIXTURE double mapped_source(const mapped_exact *e, source_function *source, const double x[3], double t, double f[3])
{
    double old[3];
    map_back(e->map, x, old);
    const double heat = source(e->user, old, t, f);
    map_vector(e->map, f);
    return heat;
}

FIXTURE double mapped_driving(void *user, const double x[3], double t, double force[3])
{
    return mapped_source(user, ((const mapped_exact *)user)->driving, x, t, force);
}

FIXTURE double mapped_driving_solids(void *user, const double x[3], double t, double force[3])
{
    return mapped_source(user, ((const mapped_exact *)user)->driving_solids, x, t, force);
}

FIXTURE void map_exact(scene *s, const scene_map *m)
{
    mapped_exact *e;
    check_ok(s->ctx, scene_allocate(s, &e, sizeof *e));
    *e = (mapped_exact){m, s->initial, s->driving, s->driving_solids, s->initial_user};
    s->initial_user = e;
    if (s->initial) s->initial = mapped_initial;
    if (s->driving) s->driving = mapped_driving;
    if (s->driving_solids) s->driving_solids = mapped_driving_solids;
}

/* ---- the scene ---- */

FIXTURE void map_mesh(scene *s, const scene_map *m)
{
    const mesh_spec old = s->mesh;
    const bc_table sides = s->bc;
    double offset[3] = {s->lattice_offset[0], s->lattice_offset[1], s->lattice_offset[2]};
    map_vector(m, offset);
    memcpy(s->lattice_offset, offset, sizeof offset);
    for (int a = 0; a < m->dim; ++a) {
        const int from = m->from[a];
        const bool turned = m->sign[a] < 0.0;
        s->mesh.lower[a] = m->sign[a] * (turned ? old.upper : old.lower)[from] + m->shift[a];
        s->mesh.upper[a] = m->sign[a] * (turned ? old.lower : old.upper)[from] + m->shift[a];
        s->mesh.cell[a] = old.cell[from];
        s->mesh.periodic[a] = old.periodic[from];
        s->mesh.blocks[a] = old.blocks[from];
        for (int side = 0; side < 2; ++side) {
            s->bc.side[a][side] = sides.side[from][turned ? 1 - side : side];
            map_vector(m, s->bc.side[a][side].velocity);
        }
    }
}

FIXTURE void map_parts(scene *s, const scene_map *m)
{
    for (int i = 0; i < s->n_parts; ++i) {
        scene_side_part *part = &s->part[i];
        part->axis = map_axis(m, part->axis);
        if (m->sign[part->axis] < 0.0) part->end = 1 - part->end;
        (void)map_shape(s, m, &part->where);
        map_vector(m, part->condition.velocity);
    }
}

FIXTURE void map_body(scene *s, const scene_map *m, scene_body *b)
{
    int per_cell[3];
    memcpy(per_cell, b->per_cell, sizeof per_cell);
    for (int a = 0; a < m->dim; ++a) b->per_cell[a] = per_cell[m->from[a]];
    (void)map_shape(s, m, &b->shape);
    map_vector(m, b->velocity);
    if (b->membrane.present) map_curve(s, m, &b->membrane.curve, b->membrane.encloses >= 0);
}

/* The whole scene, its exact solution attached; the map must outlive it. Surfaces in space stay what they are. */
FIXTURE void map_scene(scene *s, const scene_map *m)
{
    map_exact(s, m);
    map_mesh(s, m);
    map_parts(s, m);
    map_formulas(s, m);
    map_vector(m, s->ambient_velocity);
    for (int i = 0; i < s->n_bodies; ++i) map_body(s, m, &s->body[i]);
    for (int i = 0; i < s->n_loads; ++i) {
        (void)map_shape(s, m, &s->load[i].region);
        map_vector(m, s->load[i].vector);
    }
    for (int i = 0; i < s->n_supports; ++i) {
        (void)map_shape(s, m, &s->support[i].region);
        map_vector(m, s->support[i].velocity);
    }
    for (int i = 0; i < s->n_mass_sources; ++i) {
        (void)map_shape(s, m, &s->mass_source[i].region);
        map_vector(m, s->mass_source[i].velocity);
    }
    for (int i = 0; i < 2 * s->n_vents; ++i) (void)map_shape(s, m, &s->vent[i / 2].side[i % 2].region);
    for (int i = 0; i < s->n_springs; ++i)
        for (int e = 0; e < 2; ++e) map_place(m, s->spring[i].end[e].place);
    for (int i = 0; i < s->n_probes; ++i) map_place(m, s->probe[i].position);
    for (int i = 0; i < s->n_tracers; ++i) map_place(m, s->tracer[i].position);
}

#endif
