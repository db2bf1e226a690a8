/* Ranges, units and ticks. */
#include "check.h"

#include "base/memory.h"
#include "draw/scale.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static scale ranged(double lower, double upper, const char *unit)
{
    scale s = {.lower = lower, .upper = upper};
    scale_set_unit(&s, unit);
    return s;
}

static void expect_ticks(double lower, double upper, const char *unit, int most, int n, const char *const label[])
{
    const scale s = ranged(lower, upper, unit);
    scale_ticks t;
    scale_make_ticks(&s, most, &t);
    assert_int_equal(t.n, n);
    for (int i = 0; i < n; i++) assert_string_equal(t.label[i], label[i]);
}

static void ticks_are_round(void **state)
{
    (void)state;
    expect_ticks(0.0, 1.2, "m", 7, 7, (const char *const[]){"0.0", "0.2", "0.4", "0.6", "0.8", "1.0", "1.2"});
    expect_ticks(0.0, 1.2, "m", 6, 3, (const char *const[]){"0.0", "0.5", "1.0"});
    expect_ticks(-24e6, 24e6, "Pa", 5, 5, (const char *const[]){"−20", "−10", "0", "10", "20"});
    expect_ticks(-0.3, 0.3, "1", 4, 3, (const char *const[]){"−0.2", "0.0", "0.2"});
    expect_ticks(1.013e5, 1.014e5, "Pa", 3, 3, (const char *const[]){"0", "50", "100"}); /* above an offset */
}

/* Whatever the range: within it, ascending by 1, 2 or 5 times a power of ten, and no more than were asked for. */
static void ticks_hold_for_any_range(void **state)
{
    (void)state;
    uint64_t seed = 5;
    for (int n = 0; n < 3000; n++) {
        const double middle = check_random(&seed, -1.0, 1.0) * pow(10.0, check_random(&seed, -12.0, 12.0));
        const double half = fabs(middle) * pow(10.0, check_random(&seed, -7.0, 3.0));
        const int most = 2 + n % 7;
        const scale s = ranged(middle - half, middle + half, n % 2 ? "Pa" : "kg/m3");
        scale_ticks t;
        scale_make_ticks(&s, most, &t);
        check_true(t.n >= 1 || most < 4);
        assert_true(t.n <= most);
        for (int i = 0; i < t.n; i++) {
            const double slack = 1e-6 * half;
            check_true(t.value[i] >= s.lower - slack && t.value[i] <= s.upper + slack);
            if (i == 0) continue;
            const double step = (t.value[i] - t.value[i - 1]) / s.factor;
            const double lead = step / pow(10.0, floor(log10(step) + 1e-6));
            const double off = fmin(fabs(lead - 1.0), fmin(fabs(lead - 2.0), fabs(lead - 5.0)));
            check_close(off, 0.0, 1e-4);
            assert_string_not_equal(t.label[i], t.label[i - 1]);
        }
    }
}

static void expect_unit(double lower, double upper, const char *unit, const char *shown, double factor)
{
    const scale s = ranged(lower, upper, unit);
    assert_string_equal(s.unit, shown);
    check_close_relative(s.factor, factor, 1e-15);
    assert_string_equal(s.offset_text, "");
}

static void units_take_prefixes(void **state)
{
    (void)state;
    expect_unit(0.0, 19.4e6, "Pa", "MPa", 1e6);
    expect_unit(0.0, 101325.0, "Pa", "kPa", 1e3);
    expect_unit(-0.5, 0.2, "m", "m", 1.0);
    expect_unit(0.0, 2e-3, "m", "mm", 1e-3);
    expect_unit(0.0, 2e-6, "s", "µs", 1e-6);
    expect_unit(0.0, 3e5, "J/kg", "kJ/kg", 1e3);
    expect_unit(0.0, 7800.0, "kg/m3", "kg/m³", 1.0);
    expect_unit(0.0, 2e-5, "kg/m3", "10⁻⁶ kg/m³", 1e-6);
    expect_unit(0.0, 300.0, "K", "K", 1.0);
    expect_unit(0.0, 1.0, "1", "", 1.0);
    expect_unit(0.0, 3e5, "1", "10³", 1e3);
    expect_unit(0.0, 2e3, "m3", "m³", 1.0); /* a prefix would be cubed */
    expect_unit(0.0, 40.0, "1/s", "1/s", 1.0);
}

static void narrow_ranges_get_an_offset(void **state)
{
    (void)state;
    const scale s = ranged(101325.2, 101326.1, "Pa");
    check_close(s.offset, 101326.0, 1e-9);
    assert_string_equal(s.offset_text, " − 101.326 kPa");
    assert_string_equal(s.unit, "Pa");
}

static void numbers_in_words(void **state)
{
    (void)state;
    char text[SCALE_TEXT];
    scale_number(text, 1.4e-3, "s", 4);
    assert_string_equal(text, "1.4 ms");
    scale_number(text, -0.143, "1", 4);
    assert_string_equal(text, "−0.143");
    scale_number(text, 0.0, "s", 4);
    assert_string_equal(text, "0 s");
}

static scale of_values(const double *value, size_t n, bool about_zero)
{
    context *ctx = context_create();
    scale_sample sample = {0};
    scale s = {0};
    check_ok(ctx, scale_sample_add(&sample, ctx, value, n));
    scale_from_sample(&s, &sample, about_zero);
    scale_sample_free(&sample, ctx);
    assert_int_equal(memory_read_account(ctx).live_bytes, 0);
    context_destroy(&ctx);
    assert_true(s.lower < s.upper);
    return s;
}

static void range_of_values(void **state)
{
    (void)state;
    static double v[100000];
    for (int i = 0; i < 100000; i++) v[i] = i / 99999.0;
    scale s = of_values(v, 100000, false);
    check_close(s.lower, 0.0, 1e-12);
    check_close(s.upper, 1.0, 1e-12);
    assert_false(s.more_below || s.more_above);
    v[7] = 40.0; /* one stray value does not take the range from the others */
    v[8] = NAN;
    v[9] = INFINITY;
    s = of_values(v, 100000, false);
    check_close(s.upper, 1.0, 0.06);
    assert_true(s.more_above && !s.more_below);
    v[7] = 1.5; /* but what fits in reason is shown */
    s = of_values(v, 100000, false);
    assert_true(s.upper >= 1.5 && !s.more_above);
}

static void range_about_zero(void **state)
{
    (void)state;
    scale s = of_values((const double[]){-24.0, 0.0, 3.0}, 3, true);
    assert_true(s.lower == -s.upper && s.upper >= 24.0 && s.upper <= 26.4);
    s = of_values((const double[]){12.0, 32.0}, 2, true); /* zero is out of sight */
    assert_true(s.lower > 0.0);
}

static void range_of_nothing_and_of_one(void **state)
{
    (void)state;
    of_values(NULL, 0, false);
    of_values((const double[]){NAN}, 1, true);
    const scale zero = of_values((const double[]){0.0, 0.0}, 2, false);
    assert_true(zero.lower == 0.0 && zero.upper > 0.0);
    const double p = 101325.0;
    const scale one = of_values((const double[]){p, p * (1.0 + 1e-13)}, 2, false); /* round-off is no structure */
    assert_true(one.lower < 0.95 * p && one.upper > 1.05 * p);
    scale s = of_values((const double[]){-3e300, 3e300}, 2, false);
    scale_ticks t;
    scale_set_unit(&s, "Pa");
    scale_make_ticks(&s, 5, &t);
    assert_in_range(t.n, 1, 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ticks_are_round),     cmocka_unit_test(ticks_hold_for_any_range),
        cmocka_unit_test(units_take_prefixes), cmocka_unit_test(narrow_ranges_get_an_offset),
        cmocka_unit_test(numbers_in_words),    cmocka_unit_test(range_of_values),
        cmocka_unit_test(range_about_zero),    cmocka_unit_test(range_of_nothing_and_of_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
