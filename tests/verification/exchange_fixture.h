/* Materials that share every cell of a periodic line, at rates that the tests set: exchange and reactions without flow. */
#ifndef TESTS_VERIFICATION_EXCHANGE_FIXTURE_H
#define TESTS_VERIFICATION_EXCHANGE_FIXTURE_H

#include "coupling/exchange_law.h"
#include "ice_fixture.h"

/* A law of exchange with its parameters: pairs of key and value. */
static inline scene_exchange_law fixture_law(fixture *f, const char *name, exchange_role role, size_t n,
                                             const fixture_value *values)
{
    const exchange_model *m = exchange_find(name);
    scene_exchange_law out = {.model = m};
    assert_non_null(m);
    const exchange_law *law = &m->law[role];
    check_ok(f->ctx, scene_allocate(f->scene, &out.par, law->param_size > 0 ? law->param_size : 1));
    param_fill_defaults(law->params, law->n_params, out.par);
    for (size_t k = 0; k < n; ++k)
        fixture_param(law->params, law->n_params, out.par, values[k].key, 0, values[k].value);
    return out;
}

static inline scene_exchange_law fixture_constant(fixture *f, exchange_role role, double coefficient)
{
    return fixture_law(f, "constant", role, 1, (const fixture_value[]){{"coefficient", coefficient, 0}});
}

static inline scene_exchange *fixture_pair(fixture *f, int first, int second)
{
    scene_exchange *e = &f->scene->exchange[f->scene->n_exchanges++];
    snprintf(e->name, sizeof e->name, "pair%d", f->scene->n_exchanges);
    e->material[0] = first;
    e->material[1] = second;
    return e;
}

/* A body of a fluid that fills `share` of every cell, or what is left of it. */
static inline void fixture_share(fixture *f, int material, double share, double velocity, double T)
{
    scene_body *b = fixture_fill(f, material, 1e5, T, (double)NAN);
    b->fraction = share;
    b->velocity[0] = velocity;
}

static inline void fixture_steps(fixture *f, int n, double dt)
{
    for (int k = 0; k < n; ++k) check_ok(f->ctx, fixture_try(f, dt));
    fixture_account(f, &f->ledger);
}

/* The first cell's value. */
static inline double fixture_value_of(const fixture *f, field_id id, int r)
{
    return fixture_array(f, id, r, 0)[mesh_index(&f->mesh.block[0], 0, 0, 0)];
}

#endif
