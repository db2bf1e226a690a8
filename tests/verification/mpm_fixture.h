/* Scenes of material points made in C, run by the simulation object: what the tests of the points share. */
#ifndef TESTS_VERIFICATION_MPM_FIXTURE_H
#define TESTS_VERIFICATION_MPM_FIXTURE_H

#include "check.h"

#include "mpm/contact/contact.h"
#include "sim/sim.h"
#include "verify/exact.h"
#include "verify/norms.h"
#include "verify/order.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _OPENMP
#include <omp.h>
#endif

/* Functions that a test may leave unused. */
#define FIXTURE static inline __attribute__((unused))

typedef struct trial {
    context *ctx;
    scene *scene;
    sim *sim;
} trial;

/* Sets the parameter `key` of a table inside par; `index` counts along a list. */
FIXTURE void set_param(const param_spec *params, size_t n, void *par, const char *key, int index, double value)
{
    for (size_t k = 0; k < n; ++k)
        if (strcmp(params[k].key, key) == 0) {
            ((double *)(void *)((char *)par + params[k].offset))[index] = value;
            return;
        }
    print_error("no parameter '%s'\n", key);
    check_true(!"the parameter exists");
}

FIXTURE void use_threads(int n)
{
#ifdef _OPENMP
    omp_set_num_threads(n);
#else
    (void)n;
#endif
}

/* A scene of `dim` dimensions, a box [0, upper] of cells h, all sides free, FLIP 1, without growth limit; one
 * thread, since small scenes wait for each other on a busy machine. */
FIXTURE void trial_begin(trial *t, int dim, const double upper[3], double h)
{
    memset(t, 0, sizeof *t);
    use_threads(1);
    t->ctx = context_create();
    check_ok(t->ctx, scene_create(&t->scene, t->ctx));
    scene *s = t->scene;
    s->mesh.dim = dim;
    for (int a = 0; a < dim; ++a) {
        s->mesh.upper[a] = upper[a];
        s->mesh.cell[a] = h;
        s->bc.side[a][0].kind = s->bc.side[a][1].kind = BC_FREE;
    }
    s->method.flip = 1.0;
    s->method.edge_penalty = 0.0; /* tests of what holds edges ask for it */
    s->time.growth = 1e9;
    s->time.end = INFINITY;
}

FIXTURE void set_sides(trial *t, int axis, bc_kind lower, bc_kind upper)
{
    t->scene->bc.side[axis][0].kind = lower;
    t->scene->bc.side[axis][1].kind = upper;
    t->scene->mesh.periodic[axis] = lower == BC_PERIODIC;
}

FIXTURE void set_method(trial *t, const char *basis, stress_scheme stress, double flip)
{
    snprintf(t->scene->method.basis, sizeof t->scene->method.basis, "%s", basis);
    t->scene->method.stress = stress;
    t->scene->method.flip = flip;
}

/* Each basis that contact takes. */
#define FOR_CONTACT_BASES(i)                           \
    for (size_t i = 0; i < basis_registry_size; ++(i)) \
        if (basis_registry[i]->support <= CONTACT_SUPPORT)

FIXTURE int add_solid(trial *t, const char *law, double bulk, double shear, double density)
{
    scene_material *m = &t->scene->material[t->scene->n_materials];
    snprintf(m->name, sizeof m->name, "solid%d", t->scene->n_materials);
    m->kind = MATERIAL_SOLID;
    m->density = density;
    m->law = solid_find(law);
    assert_non_null(m->law);
    check_ok(t->ctx, scene_allocate(t->scene, &m->law_par, m->law->param_size));
    set_param(m->law->params, m->law->n_params, m->law_par, "bulk_modulus", 0, bulk);
    set_param(m->law->params, m->law->n_params, m->law_par, "shear_modulus", 0, shear);
    return t->scene->n_materials++;
}

FIXTURE int add_gas(trial *t, double gamma, double specific_heat)
{
    scene_material *m = &t->scene->material[t->scene->n_materials];
    snprintf(m->name, sizeof m->name, "gas%d", t->scene->n_materials);
    m->kind = MATERIAL_FLUID;
    m->eos.model = eos_find("ideal");
    assert_non_null(m->eos.model);
    check_ok(t->ctx, scene_allocate(t->scene, &m->eos.par, m->eos.model->param_size));
    set_param(m->eos.model->params, m->eos.model->n_params, m->eos.par, "gamma", 0, gamma);
    set_param(m->eos.model->params, m->eos.model->n_params, m->eos.par, "specific_heat", 0, specific_heat);
    return t->scene->n_materials++;
}

FIXTURE shape make_shape(trial *t, const char *name)
{
    shape s = {.model = shape_find(name)};
    assert_non_null(s.model);
    check_ok(t->ctx, scene_allocate(t->scene, &s.par, s.model->param_size));
    return s;
}

FIXTURE void shape_number(shape *s, const char *key, int index, double value)
{
    set_param(s->model->params, s->model->n_params, s->par, key, index, value);
}

FIXTURE shape make_box(trial *t, const double lower[3], const double upper[3])
{
    shape s = make_shape(t, "box");
    for (int a = 0; a < 3; ++a) {
        shape_number(&s, "lower", a, lower[a]);
        shape_number(&s, "upper", a, upper[a]);
    }
    return s;
}

FIXTURE shape make_ball(trial *t, const double centre[3], double radius)
{
    shape s = make_shape(t, "ball");
    for (int a = 0; a < 3; ++a) shape_number(&s, "centre", a, centre[a]);
    shape_number(&s, "radius", 0, radius);
    return s;
}

/* Also a shell in three dimensions, where the shape allows it. */
FIXTURE shape make_ring(trial *t, double inner, double outer)
{
    shape s = make_shape(t, "annulus");
    for (int a = 0; a < 3; ++a) shape_number(&s, "centre", a, 0.0);
    shape_number(&s, "inner_radius", 0, inner);
    shape_number(&s, "outer_radius", 0, outer);
    return s;
}

FIXTURE scene_body *add_body(trial *t, int material, shape s, int per_cell)
{
    scene_body *b = &t->scene->body[t->scene->n_bodies];
    snprintf(b->name, sizeof b->name, "body%d", t->scene->n_bodies++);
    b->material = material;
    b->shape = s;
    b->density = b->temperature = b->pressure = (double)NAN;
    for (int a = 0; a < 3; ++a) b->per_cell[a] = per_cell;
    b->seeding = SEED_LATTICE;
    b->merge = 0.3;
    return b;
}

FIXTURE scene_load *add_load(trial *t, load_kind kind, int body)
{
    scene_load *l = &t->scene->load[t->scene->n_loads];
    snprintf(l->name, sizeof l->name, "load%d", t->scene->n_loads++);
    l->kind = kind;
    l->body = body;
    return l;
}

FIXTURE void trial_start(trial *t)
{
    check_ok(t->ctx, sim_create(&t->sim, t->ctx, t->scene, COUPLING_MPM));
}

FIXTURE void trial_run(trial *t, double until)
{
    while (t->sim->time < until) check_ok(t->ctx, sim_step(t->sim, until));
}

FIXTURE void trial_steps(trial *t, long steps)
{
    for (long k = 0; k < steps; ++k) check_ok(t->ctx, sim_step(t->sim, INFINITY));
}

/* Runs on until the kinetic energy of body 0 has its first maximum, which must come by then (s): its time, by the parabola through
 * three steps. */
FIXTURE double time_of_most_motion(trial *t, double latest)
{
    double kinetic[3] = {0.0};
    for (;;) {
        mpm_totals sum;
        check_ok(t->ctx, sim_step(t->sim, INFINITY));
        check_ok(t->ctx, mpm_sum(t->sim->mpm, &sum));
        kinetic[0] = kinetic[1];
        kinetic[1] = kinetic[2];
        kinetic[2] = sum.kinetic[0];
        if (kinetic[1] > 0.0 && kinetic[2] < kinetic[1]) break;
        assert_true(t->sim->time < latest);
    }
    const double dt = t->sim->mpm->dt, curvature = kinetic[2] - 2.0 * kinetic[1] + kinetic[0];
    /* velocities are those of half a step before */
    return t->sim->time - dt - 0.5 * dt - 0.5 * dt * (kinetic[2] - kinetic[0]) / curvature;
}

FIXTURE void trial_end(trial *t)
{
    sim_destroy(&t->sim);
    scene_destroy(&t->scene);
    context_destroy(&t->ctx);
}

/* Calls `visit` for every point of a body, block by block. */
typedef void point_visitor(void *user, const fields *f, int body, size_t k);
FIXTURE void visit_points(const trial *t, int body, point_visitor *visit, void *user)
{
    for (int b = 0; b < t->sim->mesh.n_blocks; ++b)
        for (size_t k = 0; k < t->sim->mpm->points[b][body].n; ++k) visit(user, t->sim->domain->fields[b], body, k);
}

/* Largest relative drift of the ledger's quantities, up to date. */
FIXTURE double ledger_worst(trial *t, ledger_quantity first, ledger_quantity last)
{
    double worst = 0.0;
    check_ok(t->ctx, sim_update_ledger(t->sim));
    for (int q = first; q <= (int)last; ++q)
        if (!(ledger_drift(&t->sim->ledger, (ledger_quantity)q) <= worst))
            worst = ledger_drift(&t->sim->ledger, (ledger_quantity)q);
    return worst;
}

/* An exact solution as a scene's initial state. */
FIXTURE double initial_of_exact(void *user, initial_quantity quantity, int component, const double x[3])
{
    const exact *e = user;
    switch (quantity) {
    case INITIAL_DENSITY: return exact_value(e, EXACT_DENSITY, x, 0.0);
    case INITIAL_PRESSURE: return exact_value(e, EXACT_PRESSURE, x, 0.0);
    case INITIAL_VELOCITY: return exact_value(e, (exact_quantity)(EXACT_VELOCITY_X + component), x, 0.0);
    case INITIAL_STRESS: return exact_value(e, (exact_quantity)(EXACT_STRESS_XX + component), x, 0.0);
    }
    return (double)NAN;
}

/* Steps until the solids are at rest by the scene's rule, looked at every 1e-4 s, or until `latest`. */
FIXTURE void trial_settle(trial *t, double latest)
{
    sim_totals totals;
    double next = 1e-4;
    while (!t->sim->at_rest && t->sim->time < latest) {
        check_ok(t->ctx, sim_step(t->sim, INFINITY));
        if (t->sim->time < next) continue;
        next += 1e-4;
        check_ok(t->ctx, sim_update_ledger(t->sim));
        check_ok(t->ctx, sim_sum(t->sim, &totals));
        check_ok(t->ctx, sim_check_rest(t->sim, &totals));
    }
}

/* What the points of a body have together. */
typedef struct body_sums {
    double mass, momentum[3], kinetic, largest_error;
    double place[3]; /* of the centre of mass */
    double v[3];     /* against which errors of velocities are taken */
} body_sums;

FIXTURE void add_point_to_sums(void *user, const fields *f, int body, size_t k)
{
    body_sums *s = user;
    const double m = field_get(f, P_MASS, body, 0)[k];
    s->mass += m;
    for (int a = 0; field_get(f, P_POS, body, a); ++a) {
        const double v = field_get(f, P_VEL, body, a)[k];
        s->momentum[a] += m * v;
        s->place[a] += m * field_get(f, P_POS, body, a)[k];
        s->kinetic += 0.5 * m * v * v;
        s->largest_error = fmax(s->largest_error, fabs(v - s->v[a]));
    }
}

FIXTURE body_sums sum_body_points(const trial *t, int body, const double *v)
{
    body_sums s = {.mass = 0.0};
    if (v) memcpy(s.v, v, sizeof s.v);
    visit_points(t, body, add_point_to_sums, &s);
    for (int a = 0; a < 3; ++a) s.place[a] /= s.mass;
    return s;
}

#endif
