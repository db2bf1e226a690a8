/* An exact solution at its sample with parameters changed, asked at one place and time. */
#ifndef TESTS_UNIT_EXACT_FIXTURE_H
#define TESTS_UNIT_EXACT_FIXTURE_H

#include "settings.h"

#include "verify/exact.h"

typedef struct fixture {
    double par[SETTINGS_MOST];
    exact solution;
} fixture;

static inline const exact_model *fixture_model(double par[SETTINGS_MOST], const char *name, const setting *change)
{
    const exact_model *model = exact_find(name);
    check_true(model != NULL);
    settings_apply(par, model->sample.par, model->param_size, model->params, model->n_params, change);
    return model;
}

static inline void make(context *ctx, fixture *f, const char *name, int dim, const setting *change)
{
    const exact_model *model = fixture_model(f->par, name, change);
    check_ok(ctx, exact_create(ctx, model, f->par, dim, &f->solution));
}

static inline void refuse(context *ctx, const char *name, int dim, const setting *change)
{
    double par[SETTINGS_MOST];
    exact solution;
    const exact_model *model = fixture_model(par, name, change);
    check_fails(ctx, exact_create(ctx, model, par, dim, &solution), FLOE_BAD_INPUT);
}

#endif
