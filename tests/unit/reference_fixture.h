/* A reference at its sample with parameters changed, asked for one quantity at one time. */
#ifndef TESTS_UNIT_REFERENCE_FIXTURE_H
#define TESTS_UNIT_REFERENCE_FIXTURE_H

#include "reference_values.h"
#include "settings.h"

#include "verify/reference.h"

typedef struct fixture {
    double par[SETTINGS_MOST];
    reference r;
} fixture;

static inline const reference_model *fixture_model(double par[SETTINGS_MOST], const char *name, const setting *change)
{
    const reference_model *model = reference_find(name);
    check_true(model != NULL);
    settings_apply(par, model->sample, model->param_size, model->params, model->n_params, change);
    return model;
}

static inline void make(context *ctx, fixture *f, const char *name, const setting *change)
{
    const reference_model *model = fixture_model(f->par, name, change);
    check_ok(ctx, reference_create(ctx, model, f->par, &f->r));
}

static inline void refuse(context *ctx, const char *name, const setting *change)
{
    double par[SETTINGS_MOST];
    reference r;
    const reference_model *model = fixture_model(par, name, change);
    check_fails(ctx, reference_create(ctx, model, par, &r), FLOE_BAD_INPUT);
}

static inline void drop(context *ctx, fixture *f)
{
    reference_destroy(ctx, &f->r);
}

static inline double at(context *ctx, const fixture *f, const char *quantity, double t)
{
    double value[REFERENCE_MAX_QUANTITIES];
    const size_t q = reference_quantity_find(f->r.model, quantity);
    check_true(q < f->r.model->n_quantities);
    check_ok(ctx, reference_series(ctx, &f->r, 1, &t, value));
    return value[q];
}

static inline double scalar(const fixture *f, const char *name)
{
    return reference_scalar_value(&f->r, name);
}

#endif
