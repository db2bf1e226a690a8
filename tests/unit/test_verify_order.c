/* Observed order: power laws, a known standard error, refusals. */
#include "check.h"

#include "base/memory.h"
#include "verify/order.h"

#include <math.h>

static void test_power_law(void **state)
{
    context *ctx = *state;
    const double h[4] = {0.1, 0.05, 0.025, 0.0125};
    double error[4], pair[3];
    for (int i = 0; i < 4; i++) error[i] = 3.0 * pow(h[i], 1.75);
    order_fit fit;
    check_ok(ctx, order_fit_power(ctx, 4, h, error, &fit));
    check_close(fit.order, 1.75, 1e-13);
    check_close(fit.constant, 3.0, 1e-12);
    check_close(fit.standard_error, 0.0, 1e-13);
    check_true(fit.n == 4);
    check_ok(ctx, order_pairwise(ctx, 4, h, error, pair));
    for (int i = 0; i < 3; i++) check_close(pair[i], 1.75, 1e-13);

    check_ok(ctx, order_fit_power(ctx, 2, h, error, &fit));
    check_close(fit.order, 1.75, 1e-13);
    check_true(isnan(fit.standard_error));
}

/* log2 h = 0, 1, 2, 3 with log2 error = 0, 1, 2, 3 + d (1, -3, 3, -1): the deviation is orthogonal to 1 and to
 * (-3, -1, 1, 3) but for its slope -0 (sum of products: -3 + 3 + 3 - 3 = 0), so the slope stays 1 and
 * stderr^2 = sum of squares / (n - 2) / S_xx = 20 d^2/2/5. */
static void test_known_scatter(void **state)
{
    context *ctx = *state;
    const double d = 0.01;
    const double deviation[4] = {1.0, -3.0, 3.0, -1.0};
    double h[4], error[4];
    for (int i = 0; i < 4; i++) {
        h[i] = exp2(i);
        error[i] = exp2(i + d * deviation[i]);
    }
    order_fit fit;
    check_ok(ctx, order_fit_power(ctx, 4, h, error, &fit));
    check_close(fit.order, 1.0, 1e-14);
    check_close(fit.standard_error, d * sqrt(2.0), 1e-14);
}

/* The pressurised cylinder as an explicit code computes it: 26.5, 13.5, 7.0, 3.8 per cent. */
static void test_cylinder(void **state)
{
    context *ctx = *state;
    const double h[4] = {0.1, 0.05, 0.025, 0.0125};
    const double error[4] = {26.5, 13.5, 7.0, 3.8};
    order_fit fit;
    check_ok(ctx, order_fit_power(ctx, 4, h, error, &fit));
    check_close(fit.order, 0.935, 0.005);
    check_true(fit.standard_error > 0.0 && fit.standard_error < 0.05);
}

static void test_refused(void **state)
{
    context *ctx = *state;
    const double h[3] = {0.1, 0.05, 0.05}, same[3] = {0.1, 0.1, 0.1}, e[3] = {3.0, 2.0, 1.0};
    const double bad[] = {0.0, -1.0, NAN, INFINITY};
    double pair[2];
    order_fit fit;
    check_fails(ctx, order_fit_power(ctx, 1, h, e, &fit), FLOE_BAD_INPUT);
    check_fails(ctx, order_fit_power(ctx, 0, h, e, &fit), FLOE_BAD_INPUT);
    check_fails(ctx, order_fit_power(ctx, 3, same, e, &fit), FLOE_BAD_INPUT);
    check_true(isnan(fit.order));
    check_fails(ctx, order_pairwise(ctx, 3, h, e, pair), FLOE_BAD_INPUT);
    check_ok(ctx, order_fit_power(ctx, 3, h, e, &fit));
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        const double wrong[3] = {3.0, bad[i], 1.0};
        check_fails(ctx, order_fit_power(ctx, 3, h, wrong, &fit), FLOE_BAD_INPUT);
        check_fails(ctx, order_fit_power(ctx, 3, wrong, e, &fit), FLOE_BAD_INPUT);
        check_fails(ctx, order_pairwise(ctx, 3, h, wrong, pair), FLOE_BAD_INPUT);
    }
    memory_inject_failure(ctx, 1);
    check_fails(ctx, order_fit_power(ctx, 3, h, e, &fit), FLOE_NO_MEMORY);
    memory_inject_failure(ctx, 0);
    check_true(memory_read_account(ctx).live_bytes == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_power_law),
        cmocka_unit_test(test_known_scatter),
        cmocka_unit_test(test_cylinder),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests_name("observed order", tests, check_make_context, check_drop_context);
}
