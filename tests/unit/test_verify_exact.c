/* Every exact solution of the registry: its table is sound, and misuse is refused. */
#include "check.h"
#include "exact_values.h"

#include "base/memory.h"
#include "verify/exact.h"

#include <math.h>
#include <string.h>

static void check_params(const exact_model *model)
{
    for (size_t i = 0; i < model->n_params; i++) {
        const param_spec *spec = &model->params[i];
        const int count = spec->count < 0 ? 3 : spec->count;
        check_true(spec->key[0] != '\0' && spec->unit[0] != '\0' && spec->doc[0] != '\0');
        check_true(spec->offset + (size_t)count * sizeof(double) <= model->param_size);
        check_true(isnan(spec->fallback) || param_in_range(spec, spec->fallback));
        const double *given = (const void *)((const char *)model->sample.par + spec->offset);
        for (int k = 0; k < count; k++) check_true(param_in_range(spec, given[k]));
        for (size_t j = 0; j < i; j++) {
            check_true(strcmp(spec->key, model->params[j].key) != 0 && spec->offset != model->params[j].offset);
        }
    }
}

static void test_tables(void **state)
{
    (void)state;
    check_true(exact_registry_size > 0);
    check_true(exact_find("no such solution") == NULL);
    for (size_t m = 0; m < exact_registry_size; m++) {
        const exact_model *model = exact_registry[m];
        check_true(exact_find(model->name) == model);
        check_true(model->doc[0] != '\0' && model->cite[0] != '\0' && model->validity[0] != '\0');
        check_true(model->min_dim >= 1 && model->min_dim <= model->max_dim && model->max_dim <= 3);
        check_true(model->sample.dim >= model->min_dim && model->sample.dim <= model->max_dim);
        check_true(model->provides != 0 && model->provides < EXACT_BIT(EXACT_QUANTITY_COUNT));
        check_true((model->n_scalars > 0) == (model->scalar != NULL));
        check_params(model);
    }
    for (int q = 0; q < EXACT_QUANTITY_COUNT; q++) {
        check_true(exact_quantity_find(exact_quantity_name((exact_quantity)q)) == (exact_quantity)q);
    }
    check_true(exact_quantity_find("no such quantity") == EXACT_QUANTITY_COUNT);
    check_true(exact_quantity_name(EXACT_QUANTITY_COUNT)[0] == '\0');
}

static void test_defaults(void **state)
{
    (void)state;
    double par[64];
    for (size_t m = 0; m < exact_registry_size; m++) {
        const exact_model *model = exact_registry[m];
        check_true(model->param_size <= sizeof par);
        exact_fill_defaults(model, par);
        for (size_t i = 0; i < model->n_params; i++) {
            const double *given = exact_param(model, par, model->params[i].key);
            check_true(given != NULL && (*given == model->params[i].fallback || isnan(model->params[i].fallback)));
        }
        check_true(exact_param(model, par, "no such parameter") == NULL);
    }
}

static void test_misuse(void **state)
{
    context *ctx = *state;
    exact solution = {.dim = 0};
    for (size_t m = 0; m < exact_registry_size; m++) {
        const exact_model *model = exact_registry[m];
        check_fails(ctx, exact_create(ctx, model, model->sample.par, model->min_dim - 1, &solution), FLOE_BAD_INPUT);
        check_fails(ctx, exact_create(ctx, model, model->sample.par, model->max_dim + 1, &solution), FLOE_BAD_INPUT);
        memory_inject_failure(ctx, 1);
        check_fails(ctx, exact_create(ctx, model, model->sample.par, model->sample.dim, &solution), FLOE_NO_MEMORY);
        memory_inject_failure(ctx, 0);
        check_true(solution.model == NULL);
        exact_destroy(ctx, &solution);
    }
    exact_destroy(ctx, NULL);
    check_true(memory_read_account(ctx).live_bytes == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tables),
        cmocka_unit_test(test_defaults),
        cmocka_unit_test(test_misuse),
    };
    return cmocka_run_group_tests_name("tables of exact solutions", tests, check_make_context, check_drop_context);
}
