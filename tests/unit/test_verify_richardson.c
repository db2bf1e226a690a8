/* Richardson extrapolation and the grid convergence index: manufactured sequences of known order and limit, published
 * figures, and every way in which a sequence may fail to converge. */
#include "check.h"

#include "base/memory.h"
#include "verify/richardson.h"

#include <math.h>
#include <string.h>

static const double orders[] = {0.5, 1.0, 1.7, 2.0, 3.3};
enum { ORDERS = sizeof orders / sizeof orders[0] };

static const double even[4] = {0.1, 0.05, 0.025, 0.0125};
static const double uneven[4] = {0.1, 0.06, 0.043, 0.02}; /* ratios 1.67, 1.40, 2.15 */

static void check_order(context *ctx, const double h[4], double p, double limit, double constant)
{
    double f[4];
    richardson r;
    for (int i = 0; i < 4; i++) f[i] = limit + constant * pow(h[i], p);
    check_ok(ctx, richardson_estimate(ctx, 3, h + 1, f + 1, NAN, &r));
    check_true(r.kind == RICHARDSON_MONOTONE);
    check_close(r.order, p, 1e-8);
    check_close_relative(r.value, limit, 1e-10);
    check_close_relative(r.gci_fine, 1.25 * fabs(f[3] - limit), 1e-6);
    check_close_relative(r.gci_medium, 1.25 * fabs(f[2] - limit), 1e-6);
    check_true(r.safety == 1.25 && isnan(r.asymptotic_ratio));

    check_ok(ctx, richardson_estimate(ctx, 4, h, f, NAN, &r));
    check_close(r.order, p, 1e-8);
    check_close(r.asymptotic_ratio, 1.0, 1e-8);
    check_ok(ctx, richardson_estimate(ctx, 4, h, f, p, &r));
    check_close(r.asymptotic_ratio, 1.0, 1e-8);

    richardson_fit fit;
    check_ok(ctx, richardson_fit_power(ctx, 4, h, f, NAN, &fit));
    check_true(fit.kind == RICHARDSON_MONOTONE && fit.n == 4);
    check_close(fit.order, p, 1e-6);
    check_close_relative(fit.value, limit, 1e-8);
    check_close_relative(fit.constant, constant, 1e-5);
    check_close(fit.deviation, 0.0, 1e-8 * fabs(constant));
    const double safety = p <= 2.1 ? 1.25 : 3.0;
    check_close_relative(fit.uncertainty, safety * fabs(f[3] - limit), 1e-3);
}

static void test_orders(void **state)
{
    for (int i = 0; i < ORDERS; i++) {
        check_order(*state, even, orders[i], 7.0, 3.0);
        check_order(*state, uneven, orders[i], -2.0, 0.5);
        check_order(*state, uneven, orders[i], 5.0, -40.0);
    }
}

/* The sequence h^p + h^(p + 1) has its order in the limit only: the error in it halves with h. */
static void test_second_term(void **state)
{
    context *ctx = *state;
    double off[3];
    for (int level = 0; level < 3; level++) {
        double h[3], f[3];
        richardson r;
        for (int i = 0; i < 3; i++) {
            h[i] = 0.01 * exp2(-level - i);
            f[i] = 1.0 + h[i] * h[i] + pow(h[i], 3.0);
        }
        check_ok(ctx, richardson_estimate(ctx, 3, h, f, 2.0, &r));
        off[level] = r.order - 2.0;
        check_true(fabs(r.asymptotic_ratio - 1.0) > 1e-4 && fabs(r.asymptotic_ratio - 1.0) < 0.05);
        check_true(fabs(f[2] - 1.0) <= r.gci_fine);
    }
    check_close_relative(off[0], 2.0 * off[1], 0.02);
    check_close_relative(off[1], 2.0 * off[2], 0.02);
}

/* Celik et al. (2008), table 1: 18000, 8000, 4500 cells in the plane; 18000, 4500, 980 cells. */
static void test_published(void **state)
{
    context *ctx = *state;
    const double h[3] = {1.0, 1.5, 2.0}; /* (18000/8000)^(1/2) = 1.5, (8000/4500)^(1/2) = 4/3 */
    const double length[3] = {6.063, 5.972, 5.863}, velocity[3] = {10.7880, 10.7250, 10.6050};
    richardson r;
    check_ok(ctx, richardson_estimate(ctx, 3, h, length, NAN, &r));
    check_true(r.kind == RICHARDSON_MONOTONE);
    check_close(r.order, 1.53, 0.005);
    check_close(r.value, 6.1685, 5e-4);
    check_close(r.gci_fine / length[0], 0.022, 5e-4);
    check_ok(ctx,
             richardson_estimate(ctx, 3, (const double[]){1.0, 2.0, 2.0 * sqrt(4500.0 / 980.0)}, velocity, NAN, &r));
    check_close(r.order, 0.75, 0.005);
    check_close(r.value, 10.8801, 3e-4);
    check_close(r.gci_fine / velocity[0], 0.011, 5e-4);
}

/* Spacings may come in any order. */
static void test_sorting(void **state)
{
    context *ctx = *state;
    const double h[4] = {0.05, 0.2, 0.1, 0.4};
    double f[4];
    richardson r;
    for (int i = 0; i < 4; i++) f[i] = 1.0 + pow(h[i], 1.7);
    check_ok(ctx, richardson_estimate(ctx, 4, h, f, NAN, &r));
    check_close(r.order, 1.7, 1e-10);
    check_close_relative(r.gci_fine, 1.25 * pow(0.05, 1.7), 1e-9);
}

static void test_oscillatory(void **state)
{
    context *ctx = *state;
    for (int k = 0; k < ORDERS; k++) {
        double f[4];
        richardson r;
        for (int i = 0; i < 4; i++) f[i] = 3.0 + (i % 2 ? -1.0 : 1.0) * pow(uneven[i], orders[k]);
        check_ok(ctx, richardson_estimate(ctx, 4, uneven, f, NAN, &r));
        check_true(r.kind == RICHARDSON_OSCILLATORY);
        check_close(r.order, orders[k], 1e-8);
        check_close(r.value, 3.0, 1e-10);
        check_close(r.asymptotic_ratio, 1.0, 1e-8);
        check_true(fabs(f[3] - 3.0) <= r.gci_fine && fabs(f[2] - 3.0) <= r.gci_medium);
    }
    /* values of both signs are nothing special */
    const double h[3] = {1.0, 2.0, 4.0}, f[3] = {0.1, -0.2, 0.4};
    richardson r;
    check_ok(ctx, richardson_estimate(ctx, 3, h, f, NAN, &r));
    check_true(r.kind == RICHARDSON_OSCILLATORY);
    check_close(r.order, 1.0, 1e-12);
    check_close(r.value, 0.0, 1e-15);
}

static richardson estimate(context *ctx, double f1, double f2, double f3)
{
    richardson r;
    check_ok(ctx, richardson_estimate(ctx, 3, (const double[]){1.0, 2.0, 3.0}, (const double[]){f1, f2, f3}, NAN, &r));
    return r;
}

/* Ratios 2 and 1.5: a power of h that shrinks has |f3 - f2|/|f2 - f1| over log 1.5/log 2 = 0.585. */
static void test_divergent(void **state)
{
    context *ctx = *state;
    richardson r = estimate(ctx, 1.0, 2.0, 2.58);
    check_true(r.kind == RICHARDSON_DIVERGENT && r.order < 0.0 && r.order > -0.05);
    check_true(r.value == 1.0 && isinf(r.gci_fine) && isinf(r.gci_medium) && isnan(r.asymptotic_ratio));
    r = estimate(ctx, 1.0, 2.0, 2.59);
    check_true(r.kind == RICHARDSON_MONOTONE && r.order > 0.0 && r.order < 0.05 && isfinite(r.gci_fine));
    r = estimate(ctx, 1.0, 2.0, 2.0 + 1e-9);
    check_true(r.kind == RICHARDSON_DIVERGENT && r.order < -10.0 && isfinite(r.order));
    r = estimate(ctx, 1.0, 2.0, 1.01);
    check_true(r.kind == RICHARDSON_OSCILLATING && r.order < 0.0 && r.value == 1.0 && isinf(r.gci_fine));
    r = estimate(ctx, 1.0, 2.0, 2.0);
    check_true(r.kind == RICHARDSON_DIVERGENT && isinf(r.order) && r.order < 0.0);
}

static void test_equal(void **state)
{
    context *ctx = *state;
    const double values[] = {0.0, -5.0, 1e-300, 1e300};
    for (int i = 0; i < 4; i++) {
        const double f = values[i];
        const richardson all[2] = {estimate(ctx, f, f, f), estimate(ctx, f, f * (1.0 + 4e-16), f + 1.0)};
        for (int k = 0; k < 2; k++) {
            check_true(all[k].kind == RICHARDSON_EQUAL && all[k].value == f && isnan(all[k].order));
            check_true(all[k].gci_fine == 0.0 && all[k].gci_medium == 0.0);
        }
    }
    /* a difference next to round-off is still one, and a huge ratio of differences has an order */
    const richardson r = estimate(ctx, 1.0, 1.0 + 1e-14, 1e200);
    check_true(r.kind == RICHARDSON_MONOTONE && r.order > 500.0 && isfinite(r.order) && isfinite(r.gci_fine));
    check_close(r.value, 1.0, 1e-13);
}

static void test_two(void **state)
{
    context *ctx = *state;
    const double h[2] = {0.1, 0.05};
    const double f[2] = {1.0 + 0.1 * 0.1, 1.0 + 0.05 * 0.05};
    richardson r;
    check_ok(ctx, richardson_estimate(ctx, 2, h, f, 2.0, &r));
    check_true(r.kind == RICHARDSON_ASSUMED && r.safety == 3.0 && r.order == 2.0 && isnan(r.asymptotic_ratio));
    check_close(r.value, 1.0, 1e-14);
    check_close(r.gci_fine, 3.0 * 0.0025, 1e-14);
    check_close(r.gci_medium, 3.0 * 0.01, 1e-14);
    check_ok(ctx, richardson_estimate(ctx, 2, h, (const double[]){4.0, 4.0}, 2.0, &r));
    check_true(r.kind == RICHARDSON_EQUAL && r.value == 4.0 && r.gci_fine == 0.0);
    check_fails(ctx, richardson_estimate(ctx, 2, h, f, NAN, &r), FLOE_BAD_INPUT);
}

/* Scatter of a known size: over many sequences the true order and limit lie within twice their standard errors about as
 * often as Student's t says (2 degrees of freedom: 82 %), and within the uncertainty nearly always (meant as 95 %). */
static void test_noisy(void **state)
{
    context *ctx = *state;
    enum { TRIES = 400, POINTS = 5 };
    uint64_t seed = 7;
    int order_within = 0;
    int value_within = 0;
    int bounded = 0;
    for (int k = 0; k < TRIES; k++) {
        double h[POINTS], f[POINTS];
        for (int i = 0; i < POINTS; i++) {
            double noise = 0.0;
            for (int j = 0; j < 12; j++) noise += check_random(&seed, -0.5, 0.5); /* nearly normal, deviation 1 */
            h[i] = 0.4 * exp2(-0.75 * i);
            f[i] = 1.0 + pow(h[i], 1.7) + 1e-4 * noise;
        }
        richardson_fit fit;
        check_ok(ctx, richardson_fit_power(ctx, POINTS, h, f, NAN, &fit));
        check_true(fit.kind == RICHARDSON_MONOTONE && fit.deviation < 5e-4);
        order_within += fabs(fit.order - 1.7) <= 2.0 * fit.order_error;
        value_within += fabs(fit.value - 1.0) <= 2.0 * fit.value_error;
        bounded += fabs(f[POINTS - 1] - 1.0) <= fit.uncertainty;
    }
    check_close((double)order_within / TRIES, 0.82, 0.08);
    check_close((double)value_within / TRIES, 0.82, 0.08);
    check_true(bounded >= 0.95 * TRIES);
}

static void test_unfitted(void **state)
{
    context *ctx = *state;
    const double jump[4] = {9.0, 1.0, 1.0, 1.0}, growing[4] = {1.0, 2.0, 4.0, 8.0}, same[4] = {2.0, 2.0, 2.0, 2.0};
    richardson_fit fit;
    check_ok(ctx, richardson_fit_power(ctx, 4, even, jump, NAN, &fit));
    check_true(fit.kind == RICHARDSON_UNFITTED && fit.order == 16.0 && isinf(fit.uncertainty) && fit.value == 1.0);
    check_ok(ctx, richardson_fit_power(ctx, 4, even, growing, NAN, &fit));
    check_true(fit.kind == RICHARDSON_UNFITTED && fit.order == 1.0 / 16.0 && isinf(fit.uncertainty));
    check_ok(ctx, richardson_fit_power(ctx, 4, even, same, NAN, &fit));
    check_true(fit.kind == RICHARDSON_EQUAL && fit.value == 2.0 && fit.uncertainty == 0.0 && isnan(fit.order));
    /* scatter larger than the trend: stated as a wide bound */
    const double scatter[4] = {1.1, 1.0, 1.2, 1.05};
    check_ok(ctx, richardson_fit_power(ctx, 4, even, scatter, NAN, &fit));
    check_true(!(fit.uncertainty < 0.1));
}

static void test_refused(void **state)
{
    context *ctx = *state;
    const double h[4] = {0.4, 0.2, 0.1, 0.2}, f[4] = {1.0, 1.1, 1.15, 1.2};
    const double bad_spacing[] = {0.0, -1.0, NAN, INFINITY};
    richardson r[2];
    richardson_fit fit;
    check_fails(ctx, richardson_estimate(ctx, 1, h, f, 2.0, r), FLOE_BAD_INPUT);
    check_fails(ctx, richardson_estimate(ctx, 4, h, f, 2.0, r), FLOE_BAD_INPUT); /* one spacing twice */
    check_fails(ctx, richardson_estimate(ctx, 3, h, f, 0.0, r), FLOE_BAD_INPUT);
    check_fails(ctx, richardson_fit_power(ctx, 3, h, f, 2.0, &fit), FLOE_BAD_INPUT);
    for (int i = 0; i < 4; i++) {
        const double wrong[3] = {0.4, bad_spacing[i], 0.1};
        check_fails(ctx, richardson_estimate(ctx, 3, wrong, f, 2.0, r), FLOE_BAD_INPUT);
        if (i > 1) check_fails(ctx, richardson_estimate(ctx, 3, h, wrong, 2.0, r), FLOE_BAD_INPUT);
    }
    for (int k = 1; k <= 2; k++) {
        memory_inject_failure(ctx, (uint64_t)k);
        check_fails(ctx, richardson_fit_power(ctx, 4, even, f, 2.0, &fit), FLOE_NO_MEMORY);
        memory_inject_failure(ctx, 0);
    }
    check_true(memory_read_account(ctx).live_bytes == 0);
}

static void test_names(void **state)
{
    (void)state;
    for (int i = 0; i < RICHARDSON_KIND_COUNT; i++) check_true(strlen(richardson_name((richardson_kind)i)) > 0);
    assert_string_equal(richardson_name(RICHARDSON_OSCILLATORY), "oscillatory");
    assert_string_equal(richardson_name(RICHARDSON_KIND_COUNT), "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_orders),   cmocka_unit_test(test_second_term), cmocka_unit_test(test_published),
        cmocka_unit_test(test_sorting),  cmocka_unit_test(test_oscillatory), cmocka_unit_test(test_divergent),
        cmocka_unit_test(test_equal),    cmocka_unit_test(test_two),         cmocka_unit_test(test_noisy),
        cmocka_unit_test(test_unfitted), cmocka_unit_test(test_refused),     cmocka_unit_test(test_names),
    };
    return cmocka_run_group_tests_name("extrapolation", tests, check_make_context, check_drop_context);
}
