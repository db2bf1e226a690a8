/* A reference at its sample with parameters changed, asked for one quantity at one time. */
#ifndef TESTS_UNIT_REFERENCE_FIXTURE_H
#define TESTS_UNIT_REFERENCE_FIXTURE_H

#include "check.h"

#include "verify/reference.h"

#include <math.h>
#include <string.h>

typedef struct fixture {
    double par[32];
    reference r;
} fixture;

typedef struct setting {
    const char *key;
    double value;
} setting;

/* The end of a list of settings, and an empty one. */
#define END       \
    {             \
        NULL, 0.0 \
    }
#define NONE ((const setting[]){END})

static void fill(double par[32], const reference_model *model, const setting *change)
{
    check_true(model != NULL && model->param_size <= 32 * sizeof par[0]);
    memcpy(par, model->sample, model->param_size);
    for (; change->key != NULL; change++) {
        double *to = param_find(model->params, model->n_params, par, change->key);
        check_true(to != NULL);
        *to = change->value;
    }
}

static void make(context *ctx, fixture *f, const char *name, const setting *change)
{
    const reference_model *model = reference_find(name);
    fill(f->par, model, change);
    check_ok(ctx, reference_create(ctx, model, f->par, &f->r));
}

static void refuse(context *ctx, const char *name, const setting *change)
{
    const reference_model *model = reference_find(name);
    double par[32];
    reference r;
    fill(par, model, change);
    check_fails(ctx, reference_create(ctx, model, par, &r), FLOE_BAD_INPUT);
}

static void drop(context *ctx, fixture *f)
{
    reference_destroy(ctx, &f->r);
}

static double at(context *ctx, const fixture *f, const char *quantity, double t)
{
    double value[REFERENCE_MAX_QUANTITIES];
    const size_t q = reference_quantity_find(f->r.model, quantity);
    check_true(q < f->r.model->n_quantities);
    check_ok(ctx, reference_series(ctx, &f->r, 1, &t, value));
    return value[q];
}

static double scalar(const fixture *f, const char *name)
{
    return reference_scalar_value(&f->r, name);
}

static int make_context(void **state)
{
    *state = context_create();
    return *state == NULL;
}

static int drop_context(void **state)
{
    context *ctx = *state;
    context_destroy(&ctx);
    return 0;
}

#endif
