/* Every reference of the registry, unasked: its quantities are finite, rates are derivatives, what is constant is, and
 * nothing depends on which other times are asked for. A new file src/verify/reference/reference_<name>.c is covered as it stands. */
#include "check.h"
#include "reference_values.h"

#include "base/memory.h"
#include "verify/reference.h"

#include <math.h>
#include <string.h>

enum { TIMES = 401 };

typedef struct sampled {
    reference r;
    double t[TIMES];
    double value[REFERENCE_MAX_QUANTITIES * TIMES];
} sampled;

static void sample(context *ctx, sampled *s, const reference_model *model)
{
    check_true(model->n_quantities > 0 && model->n_quantities <= REFERENCE_MAX_QUANTITIES);
    check_ok(ctx, reference_create(ctx, model, model->sample, &s->r));
    for (int i = 0; i < TIMES; i++) s->t[i] = model->sample_end * i / (TIMES - 1);
    check_ok(ctx, reference_series(ctx, &s->r, TIMES, s->t, s->value));
}

static double largest(const double *value)
{
    double most = 0.0;
    for (int i = 0; i < TIMES; i++) most = fmax(most, fabs(value[i]));
    return most;
}

static void check_values(const sampled *s)
{
    const reference_model *model = s->r.model;
    for (size_t q = 0; q < model->n_quantities; q++) {
        const double *value = &s->value[q * TIMES];
        for (int i = 0; i < TIMES; i++) {
            if (!isfinite(value[i])) {
                print_error("%s: %s is %g at %g s\n", model->name, model->quantities[q].name, value[i], s->t[i]);
            }
            check_true(isfinite(value[i]));
            if (model->quantities[q].constant) check_close_relative(value[i], value[0], 1e-9);
        }
    }
}

/* The integral of the rate (Simpson's rule over pairs of intervals) is the change; where the rate jumps or has a kink the
 * error is that of one interval, so most intervals must agree closely and all of them roughly. */
static void check_rate(const sampled *s, size_t rate, size_t of)
{
    const double *v = &s->value[rate * TIMES];
    const double *x = &s->value[of * TIMES];
    const double dt = s->t[1] - s->t[0];
    const double bound = largest(v) * dt;
    int close = 0;
    for (int i = 2; i < TIMES; i += 2) {
        const double error = fabs(x[i] - x[i - 2] - dt / 3.0 * (v[i - 2] + 4.0 * v[i - 1] + v[i]));
        if (!(error <= 2.0 * bound)) {
            print_error("%s: %s is not the rate of %s at %g s: off by %g\n", s->r.model->name,
                        s->r.model->quantities[rate].name, s->r.model->quantities[of].name, s->t[i], error);
            check_true(false);
        }
        close += error <= 1e-3 * bound;
    }
    if (!(close >= 0.9 * (TIMES / 2))) print_error("%s: only %d intervals agree\n", s->r.model->name, close);
    check_true(close >= 0.9 * (TIMES / 2));
}

/* Asked for one time alone, a reference says the same. */
static void check_alone(context *ctx, const sampled *s)
{
    static const int at[] = {0, 57, TIMES - 1};
    const reference_model *model = s->r.model;
    for (int k = 0; k < 3; k++) {
        double value[REFERENCE_MAX_QUANTITIES];
        check_ok(ctx, reference_series(ctx, &s->r, 1, &s->t[at[k]], value));
        for (size_t q = 0; q < model->n_quantities; q++) {
            check_close(value[q], s->value[q * TIMES + at[k]], 1e-6 * largest(&s->value[q * TIMES]));
        }
    }
}

static void test_histories(void **state)
{
    context *ctx = *state;
    sampled *s;
    check_ok(ctx, memory_new(ctx, &s, 1, sizeof *s));
    for (size_t m = 0; m < reference_registry_size; m++) {
        const reference_model *model = reference_registry[m];
        sample(ctx, s, model);
        check_values(s);
        check_alone(ctx, s);
        for (size_t q = 0; q < model->n_quantities; q++) {
            const char *of = model->quantities[q].rate_of;
            if (of == NULL) continue;
            check_true(reference_quantity_find(model, of) < model->n_quantities);
            check_rate(s, q, reference_quantity_find(model, of));
        }
        reference_destroy(ctx, &s->r);
    }
    memory_free(ctx, &s);
    check_true(memory_read_account(ctx).live_bytes == 0);
}

static void test_tables(void **state)
{
    context *ctx = *state;
    for (size_t m = 0; m < reference_registry_size; m++) {
        const reference_model *model = reference_registry[m];
        check_true(reference_find(model->name) == model);
        check_true(strlen(model->doc) > 0 && strlen(model->cite) > 0 && strlen(model->validity) > 0);
        for (size_t i = 0; i < model->n_params; i++) {
            const param_spec *spec = &model->params[i];
            double value;
            memcpy(&value, (const char *)model->sample + spec->offset, sizeof value);
            if (!param_in_range(spec, value)) print_error("%s: %s = %g\n", model->name, spec->key, value);
            check_true(param_in_range(spec, value) && strlen(spec->doc) > 0);
        }
        reference r;
        check_ok(ctx, reference_create(ctx, model, model->sample, &r));
        for (size_t i = 0; i < model->n_scalars; i++) {
            check_true(isfinite(reference_scalar_value(&r, model->scalars[i].name)));
        }
        check_true(isnan(reference_scalar_value(&r, "no such scalar")));
        double value[2 * REFERENCE_MAX_QUANTITIES];
        check_fails(ctx, reference_series(ctx, &r, 2, (const double[]){1.0, 0.5}, value), FLOE_BAD_INPUT);
        check_fails(ctx, reference_series(ctx, &r, 1, (const double[]){-1.0}, value), FLOE_BAD_INPUT);
        reference_destroy(ctx, &r);
    }
    check_true(reference_find("no such reference") == NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_histories),
        cmocka_unit_test(test_tables),
    };
    return cmocka_run_group_tests_name("references", tests, check_make_context, check_drop_context);
}
