/* A scene on the cells, made in C and stepped by itself: what the tests of the ICE module share. */
#ifndef TESTS_VERIFICATION_ICE_FIXTURE_H
#define TESTS_VERIFICATION_ICE_FIXTURE_H

#include "check.h"
#include "exact_values.h"

#include "base/memory.h"
#include "ice/ice.h"
#include "verify/exact.h"
#include "verify/norms.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct fixture {
    context *ctx;
    scene *scene;
    mesh mesh;
    stage_list stages;
    ledger ledger;
    domain *domain;
    ice *ice;
    exact exact; /* initial state and reference, if any */
    void *exact_par;
    double time, dt;
    long steps;
    double scale[LEDGER_QUANTITIES];
} fixture;

/* Sets a double in a parameter struct by the key of its table; index counts along a list. */
static inline void fixture_param(const param_spec *params, size_t n, void *par, const char *key, int index,
                                 double value)
{
    for (size_t k = 0; k < n; ++k)
        if (strcmp(params[k].key, key) == 0) {
            ((double *)(void *)((char *)par + params[k].offset))[index] = value;
            return;
        }
    printf("no parameter %s\n", key);
    check_true(!"the parameter exists");
}

/* An empty scene of a box [0, length]^dim of n cells an axis, closed by symmetry or periodic. */
static inline void fixture_create(fixture *f, int dim, const int *cells, const double *length, bool periodic)
{
    memset(f, 0, sizeof *f);
    f->ctx = context_create();
    check_ok(f->ctx, scene_create(&f->scene, f->ctx));
    scene *s = f->scene;
    s->mesh.dim = dim;
    s->coupling = COUPLING_ICE;
    for (int a = 0; a < dim; ++a) {
        s->mesh.upper[a] = length[a];
        s->mesh.cell[a] = length[a] / cells[a];
        s->mesh.periodic[a] = periodic;
        for (int side = 0; side < 2; ++side) {
            s->bc.side[a][side].kind = periodic ? BC_PERIODIC : BC_SYMMETRY;
            s->bc.side[a][side].material = -1;
        }
    }
    s->method.exchange = 0.0;
}

static inline int fixture_fluid(fixture *f, const char *model, double gamma, double specific_heat, double p_inf)
{
    scene_material *m = &f->scene->material[f->scene->n_materials];
    snprintf(m->name, sizeof m->name, "fluid%d", f->scene->n_materials);
    m->kind = MATERIAL_FLUID;
    m->eos.model = eos_find(model);
    assert_non_null(m->eos.model);
    check_ok(f->ctx, scene_allocate(f->scene, &m->eos.par, m->eos.model->param_size));
    const eos_model *e = m->eos.model;
    fixture_param(e->params, e->n_params, m->eos.par, "gamma", 0, gamma);
    fixture_param(e->params, e->n_params, m->eos.par, "specific_heat", 0, specific_heat);
    if (strcmp(model, "stiffened") == 0) fixture_param(e->params, e->n_params, m->eos.par, "p_inf", 0, p_inf);
    return f->scene->n_materials++;
}

/* A box body [lo, hi] of a fluid, with a density (or, if that is NAN, a temperature). */
static inline scene_body *fixture_box(fixture *f, int material, const double *lo, const double *hi, double p, double T,
                                      double rho)
{
    scene_body *b = &f->scene->body[f->scene->n_bodies++];
    const shape_model *box = shape_find("box");
    assert_non_null(box);
    b->material = material;
    b->pressure = p;
    b->temperature = T;
    b->density = rho;
    b->shape.model = box;
    check_ok(f->ctx, scene_allocate(f->scene, &b->shape.par, box->param_size));
    for (int a = 0; a < 3; ++a) {
        fixture_param(box->params, box->n_params, b->shape.par, "lower", a, a < f->scene->mesh.dim ? lo[a] : -1.0);
        fixture_param(box->params, box->n_params, b->shape.par, "upper", a, a < f->scene->mesh.dim ? hi[a] : 1.0);
    }
    return b;
}

/* A body that fills the domain. */
static inline scene_body *fixture_fill(fixture *f, int material, double p, double T, double rho)
{
    double lo[3], hi[3];
    for (int a = 0; a < 3; ++a) {
        lo[a] = f->scene->mesh.lower[a] - 1.0;
        hi[a] = f->scene->mesh.upper[a] + 1.0;
    }
    return fixture_box(f, material, lo, hi, p, T, rho);
}

/* The earth's gravity, down an axis. */
static inline void fixture_gravity(fixture *f, int axis)
{
    scene_load *load = &f->scene->load[f->scene->n_loads++];
    load->kind = LOAD_BODY_FORCE;
    load->body = -1;
    load->vector[axis] = -9.81;
}

static inline double fixture_initial(void *user, initial_quantity quantity, int component, const double x[3])
{
    const exact *e = user;
    switch (quantity) {
    case INITIAL_DENSITY: return exact_value(e, EXACT_DENSITY, x, 0.0);
    case INITIAL_PRESSURE: return exact_value(e, EXACT_PRESSURE, x, 0.0);
    case INITIAL_VELOCITY: return exact_value(e, (exact_quantity)(EXACT_VELOCITY_X + component), x, 0.0);
    default: return (double)NAN;
    }
}

/* Parameters of the exact solution: pairs of key and value. */
typedef struct fixture_value {
    const char *key;
    double value;
    int index;
} fixture_value;

static inline void fixture_exact(fixture *f, const char *name, size_t n, const fixture_value *values)
{
    const exact_model *model = exact_find(name);
    assert_non_null(model);
    check_ok(f->ctx, scene_allocate(f->scene, &f->exact_par, model->param_size));
    exact_fill_defaults(model, f->exact_par);
    for (size_t k = 0; k < n; ++k) {
        double *at = exact_param(model, f->exact_par, values[k].key);
        if (!at) printf("no parameter %s\n", values[k].key);
        assert_non_null(at);
        at[values[k].index] = values[k].value;
    }
    check_ok(f->ctx, exact_create(f->ctx, model, f->exact_par, f->scene->mesh.dim, &f->exact));
    f->scene->initial = fixture_initial;
    f->scene->initial_user = &f->exact;
    for (int b = 0; b < f->scene->n_bodies; ++b) f->scene->body[b].initial_from_exact = true;
}

static inline void fixture_account(fixture *f, ledger *l)
{
    ice_totals t;
    check_ok(f->ctx, ice_sum(f->ice, &t));
    double total[LEDGER_QUANTITIES] = {0.0};
    for (int r = 0; r < f->ice->n_materials; ++r) {
        total[LEDGER_MASS] += t.mass[r];
        total[LEDGER_ENERGY] += t.internal[r] + t.kinetic[r];
        for (int a = 0; a < 3; ++a) total[LEDGER_MOMENTUM_X + a] += t.momentum[r][a];
    }
    for (int q = 0; q < LEDGER_QUANTITIES; ++q) {
        l->not_conserved[q] = q >= LEDGER_MOMENT_X; /* advection keeps these to truncation, not to round-off */
        l->total[q] = total[q];
        const double size =
            q >= LEDGER_MOMENTUM_X && q <= LEDGER_MOMENTUM_Z ? t.momentum_scale[q - LEDGER_MOMENTUM_X] : fabs(total[q]);
        l->scale[q] = fmax(l->scale[q], size);
    }
}

/* Plans, registers and initialises. */
static inline void fixture_start(fixture *f)
{
    check_ok(f->ctx, mesh_init(&f->mesh, f->ctx, &f->scene->mesh));
    stage_list_init(&f->stages, f->ctx);
    check_ok(f->ctx, ice_create(&f->ice, f->ctx, f->scene, &f->mesh, &f->stages, &f->ledger, false));
    f->stages.planning = true;
    check_ok(f->ctx, ice_step(f->ice));
    f->stages.planning = false;
    check_ok(f->ctx, domain_create(&f->domain, f->ctx, &f->mesh));
    f->stages.domain = f->domain;
    check_ok(f->ctx, ice_register(f->ice, f->domain));
    check_ok(f->ctx, ice_initialise(f->ice, NULL));
    fixture_account(f, &f->ledger);
    memcpy(f->ledger.initial, f->ledger.total, sizeof f->ledger.initial);
}

static inline floe_status fixture_try(fixture *f, double dt)
{
    f->ice->dt = dt;
    f->ice->time = f->time;
    f->ice->step = f->steps;
    const floe_status status = ice_step(f->ice);
    if (status != FLOE_OK) {
        ledger_discard(&f->ledger);
        return status;
    }
    for (int b = 0; b < f->mesh.n_blocks; ++b) fields_commit(f->domain->fields[b]);
    ledger_commit(&f->ledger);
    f->time += dt;
    f->steps++;
    return FLOE_OK;
}

/* Steps to `end` at the CFL number of the scene; the first step is a fifth of it. */
static inline void fixture_run(fixture *f, double end)
{
    double before = 0.0;
    while (f->time < end * (1.0 - 1e-12)) {
        step_limit limit;
        check_ok(f->ctx, ice_time_step(f->ice, &limit));
        double dt = f->steps == 0 ? 0.2 * limit.dt : fmin(limit.dt, 1.2 * before);
        before = dt;
        dt = fmin(dt, end - f->time);
        floe_status status = fixture_try(f, dt);
        for (int tries = 0; status == FLOE_RETRY && tries < 10; ++tries) {
            printf("retry: %s\n", context_message(f->ctx));
            context_clear(f->ctx);
            dt *= 0.5;
            status = fixture_try(f, dt);
        }
        check_ok(f->ctx, status);
    }
    fixture_account(f, &f->ledger);
}

static inline void fixture_destroy(fixture *f)
{
    ice_destroy(&f->ice);
    domain_destroy(&f->domain);
    stage_list_destroy(&f->stages);
    exact_destroy(f->ctx, &f->exact);
    scene_destroy(&f->scene);
    context_destroy(&f->ctx);
}

static inline double *fixture_array(const fixture *f, field_id id, int r, int component)
{
    return field_get(f->domain->fields[0], id, r, component);
}

/* L1 of density against exact cell averages. */
static inline norm_result fixture_density_error(const fixture *f)
{
    norm n = {0};
    for (int id = 0; id < f->mesh.n_blocks; ++id) {
        const block *b = &f->mesh.block[id];
        const double *rho = field_get(f->domain->fields[id], C_RHO, 0, 0);
        for (int k = 0; k < b->n[2]; ++k)
            for (int j = 0; j < b->n[1]; ++j)
                for (int i = 0; i < b->n[0]; ++i) {
                    const int at[3] = {i, j, k};
                    double lo[3] = {0.0}, hi[3] = {0.0};
                    for (int a = 0; a < f->mesh.dim; ++a) {
                        lo[a] = mesh_node(&f->mesh, a, b->lo[a] + at[a]);
                        hi[a] = lo[a] + f->mesh.h[a];
                    }
                    norm_add(&n, rho[mesh_index(b, i, j, k)],
                             exact_cell_average(&f->exact, EXACT_DENSITY, lo, hi, f->time, EXACT_PLAIN), 1.0);
                }
    }
    return norm_finish(&n);
}

#endif
