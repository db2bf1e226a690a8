/* Error norms and the names of metrics: hand values, NaN, merging. */
#include "check.h"

#include "verify/metric.h"
#include "verify/norms.h"

#include <math.h>
#include <string.h>

static void test_hand_values(void **state)
{
    (void)state;
    norm n = {0};
    norm_add(&n, 1.5, 1.0, 1.0);   /* |e| = 0.5 */
    norm_add(&n, -2.0, -4.0, 3.0); /* |e| = 2 */
    const norm_result r = norm_finish(&n);
    check_close(r.l1, 6.5 / 4.0, 1e-15);
    check_close(r.l1rel, 6.5 / 13.0, 1e-15);
    check_close(r.l2, sqrt(12.25 / 4.0), 1e-15);
    check_close(r.l2rel, sqrt(12.25 / 49.0), 1e-15);
    check_close(r.linf, 2.0, 0.0);
    check_close(r.linfrel, 0.5, 0.0);
}

static bool all_nan(const norm_result *r)
{
    return isnan(r->l1) && isnan(r->l1rel) && isnan(r->l2) && isnan(r->l2rel) && isnan(r->linf) && isnan(r->linfrel);
}

/* A NaN poisons wherever it comes: first, in the middle, last, in the value, the exact value or the weight. */
static void test_nan(void **state)
{
    (void)state;
    for (int where = 0; where < 5; where++) {
        for (int what = 0; what < 4; what++) {
            norm n = {0};
            for (int i = 0; i < 5; i++) {
                const bool bad = i == where;
                norm_add(&n, bad && what == 0 ? (double)NAN : 1.0 + i, bad && what == 1 ? (double)NAN : 2.0 * i,
                         bad && what == 2 ? (double)NAN : (bad && what == 3 ? -1.0 : 1.0));
            }
            const norm_result r = norm_finish(&n);
            check_true(isnan(r.l1) && isnan(r.l1rel) && isnan(r.l2) && isnan(r.l2rel) && isnan(r.linf));
            check_true(what == 0 || all_nan(&r));
        }
    }
    norm weightless = {0};
    norm_add(&weightless, 1.0, 1.0, 1.0);
    norm_add(&weightless, NAN, 1.0, 0.0);
    check_true(isnan(norm_finish(&weightless).l1));
}

static void test_empty_and_zero(void **state)
{
    (void)state;
    const norm empty = {0};
    const norm_result none = norm_finish(&empty);
    check_true(all_nan(&none));
    norm zero = {0};
    norm_add(&zero, 0.25, 0.0, 2.0);
    const norm_result r = norm_finish(&zero);
    check_close(r.l1, 0.25, 0.0);
    check_true(isinf(r.l1rel) && isinf(r.l2rel) && isinf(r.linfrel));
}

/* A million tenths: exact to round-off, where a plain sum has lost five digits. */
static void test_compensated(void **state)
{
    (void)state;
    norm whole = {0};
    for (int i = 0; i < 1000000; i++) norm_add(&whole, 0.1, 0.0, 0.1);
    check_close_relative(norm_finish(&whole).l1, 0.1, 4e-16);
    check_close_relative(whole.weight.value + whole.weight.carry, 1e5, 1e-15);
    norm large = {0};
    norm_add(&large, 1.0, 0.0, 1.0);
    norm_add(&large, 1e-20, 0.0, 1e20);
    norm_add(&large, 1.0, 0.0, 1.0);
    check_close(large.weight.value + large.weight.carry, 1e20, 0.0);
    check_close(large.error.value + large.error.carry, 3.0, 0.0);
}

static void test_eq13(void **state)
{
    (void)state;
    /* Guilkey's case: S = 2P/3. */
    const double s = 2.0 * 19.4e6 / 3.0;
    const double good[3] = {s, -s, s};
    const double off[4] = {1.1 * s, 0.9 * s, s, -1.2 * s};
    const double bad[2] = {s, NAN};
    check_close(guilkey_eq13(3, good, 19.4e6, 0.5, 1.0), 0.0, 1e-15);
    check_close(guilkey_eq13(4, off, 19.4e6, 0.5, 1.0), 0.1, 1e-15);
    check_true(isnan(guilkey_eq13(2, bad, 19.4e6, 0.5, 1.0)) && isnan(guilkey_eq13(0, bad, 19.4e6, 0.5, 1.0)));
    const double other[1] = {2.0 * 3.0 * 1.0 / (9.0 - 1.0)};
    check_close(guilkey_eq13(1, other, 3.0, 1.0, 3.0), 0.0, 1e-15);
}

static void test_metric_names(void **state)
{
    context *ctx = *state;
    metric m;
    for (int kind = 0; kind < METRIC_COUNT; kind++) {
        check_true(metric_describe((metric_kind)kind).name[0] != '\0');
        check_true(metric_describe((metric_kind)kind).doc[0] != '\0');
        for (int q = 0; q < EXACT_QUANTITY_COUNT; q++) {
            const char *pattern = metric_describe((metric_kind)kind).name; /* "l1_X", but eq13 */
            const bool plain = kind == METRIC_EQ13;
            const int stem = (int)strlen(pattern) - (plain ? 0 : 1);
            char text[64];
            snprintf(text, sizeof text, "%.*s%s", stem, pattern, plain ? "" : exact_quantity_name((exact_quantity)q));
            check_ok(ctx, metric_parse(ctx, text, &m));
            check_true(m.kind == (metric_kind)kind && m.quantity == (plain ? EXACT_QUANTITY_COUNT : (exact_quantity)q));
        }
    }
    check_true(strcmp(metric_describe(METRIC_L1REL).name, "l1rel_X") == 0);
    check_true(metric_describe(METRIC_COUNT).name[0] == '\0');
    static const char *const wrong[] = {"",        "l1",           "l1_",      "l1_mass", "l3_density",
                                        "density", "eq13_density", "_density", "l1rel"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        check_fails(ctx, metric_parse(ctx, wrong[i], &m), FLOE_BAD_INPUT);
    }
    const norm_result r = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
    for (int kind = 0; kind < METRIC_EQ13; kind++) check_close(metric_pick((metric_kind)kind, &r), kind + 1.0, 0.0);
    check_true(isnan(metric_pick(METRIC_EQ13, &r)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hand_values), cmocka_unit_test(test_nan),  cmocka_unit_test(test_empty_and_zero),
        cmocka_unit_test(test_compensated), cmocka_unit_test(test_eq13), cmocka_unit_test(test_metric_names),
    };
    return cmocka_run_group_tests_name("norms and metrics", tests, check_make_context, check_drop_context);
}
