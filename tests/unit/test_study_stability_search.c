/* The search for a limit against oracles of which the limit is known. */
#include "check.h"

#include "study/stability/stability_search.h"

#include <math.h>

typedef search_answer oracle(double x, const double *limit);

static search_answer below(double x, const double *limit)
{
    return x <= limit[0] ? SEARCH_STABLE : SEARCH_UNSTABLE;
}

static search_answer above(double x, const double *limit)
{
    return x >= limit[0] ? SEARCH_STABLE : SEARCH_UNSTABLE;
}

/* Stable up to limit[0], and again from limit[1] to limit[2]. */
static search_answer window(double x, const double *limit)
{
    return x <= limit[0] || (x >= limit[1] && x <= limit[2]) ? SEARCH_STABLE : SEARCH_UNSTABLE;
}

/* No deck can be made of values beyond limit[1]. */
static search_answer bounded(double x, const double *limit)
{
    return x > limit[1] ? SEARCH_REFUSED : below(x, limit);
}

/* Searches with `at_once` values a round; *rounds and *asked count. */
static search_state run(const search_spec *spec, oracle *judge, const double *limit, size_t at_once, int *rounds,
                        int *asked)
{
    search s;
    double x[SEARCH_MOST];
    search_begin(&s, spec);
    *rounds = *asked = 0;
    for (size_t n = search_next(&s, at_once, x); n > 0; n = search_next(&s, at_once, x)) {
        check_true(n <= at_once);
        for (size_t i = 0; i < n; i++) search_tell(&s, x[i], judge(x[i], limit));
        ++*rounds;
        *asked += (int)n;
        check_true(*rounds < 200);
    }
    const search_state end = search_look(&s);
    check_true(end.outcome != SEARCH_OPEN);
    return end;
}

static void check_bracket(const search_state *at, double limit, double tolerance)
{
    assert_int_equal(at->outcome, SEARCH_FOUND);
    check_true((at->stable <= limit) == (at->unstable > limit) || at->stable == limit);
    check_close(at->stable, limit, tolerance * limit);
    check_close(at->unstable, limit, tolerance * limit);
}

static void test_known_limits(void **state)
{
    (void)state;
    const double limits[] = {1.0 / 3.0, 0.1000001, 0.9999, 0.5};
    const double tolerances[] = {0.1, 1e-2, 1e-4, 1e-6};
    int rounds, asked;
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 4; k++) {
            const search_spec spec = {.from = 0.1, .to = 1.0, .tolerance = tolerances[k], .most = 40};
            const search_state at = run(&spec, below, &limits[i], 1, &rounds, &asked);
            check_bracket(&at, limits[i], tolerances[k] * 1.01);
            check_true(at.stable < at.unstable);
            /* ln 10 / tolerance, halved until it is one, and the two ends */
            check_true(asked <= 2 + (int)ceil(log2(log(10.0) / tolerances[k])) + 1);
            assert_int_equal(asked, at.judged);
        }
    }
}

/* The other way round: the smallest stable value. */
static void test_lower_limit(void **state)
{
    (void)state;
    const double limit = 42.0;
    int rounds, asked;
    const search_spec spec = {.from = 1.0, .to = 1e4, .tolerance = 1e-3, .most = 40};
    const search_state at = run(&spec, above, &limit, 1, &rounds, &asked);
    check_bracket(&at, limit, 1.1e-3);
    check_true(at.stable > at.unstable);
}

/* Ranges that hold zero are halved by difference. */
static void test_range_with_zero(void **state)
{
    (void)state;
    const double limit = 0.3;
    int rounds, asked;
    const search_spec spec = {.from = -1.0, .to = 1.0, .tolerance = 1e-3, .most = 40};
    const search_state at = run(&spec, below, &limit, 1, &rounds, &asked);
    check_bracket(&at, limit, 1.1e-3);
}

static void test_no_limit(void **state)
{
    (void)state;
    const double low = 0.01, high = 100.0;
    int rounds, asked;
    const search_spec spec = {.from = 0.1, .to = 1.0, .tolerance = 1e-3, .most = 40};
    search_state at = run(&spec, below, &high, 1, &rounds, &asked);
    assert_int_equal(at.outcome, SEARCH_ALL_STABLE);
    assert_int_equal(asked, 2);
    at = run(&spec, below, &low, 1, &rounds, &asked);
    assert_int_equal(at.outcome, SEARCH_ALL_UNSTABLE);
    assert_int_equal(asked, 2);
}

/* Without a range it is looked for, upwards and downwards. */
static void test_range_is_found(void **state)
{
    (void)state;
    const double limits[] = {3.0e5, 1.0, 2.7e-5};
    int rounds, asked;
    for (int i = 0; i < 3; i++) {
        const search_spec spec = {.from = 1.0, .to = NAN, .tolerance = 1e-3, .most = 60};
        const search_state at = run(&spec, below, &limits[i], 1, &rounds, &asked);
        check_bracket(&at, limits[i], 1.1e-3);
    }
    /* not for ever: twenty doublings */
    const double far = 1e12;
    const search_spec wide = {.from = 1.0, .to = NAN, .tolerance = 1e-3, .most = 60};
    assert_int_equal(run(&wide, below, &far, 1, &rounds, &asked).outcome, SEARCH_ALL_STABLE);
    assert_int_equal(asked, 21);
    /* and twenty halvings, values with nine digits */
    const double near = 1e-12;
    const search_state low = run(&wide, below, &near, 1, &rounds, &asked);
    assert_int_equal(low.outcome, SEARCH_ALL_UNSTABLE);
    assert_int_equal(asked, 21);
    check_close_relative(low.unstable, ldexp(1.0, -20), 1e-8);
    /* up to where the deck takes no more */
    const double bound[] = {2.0, 5.0}, open[] = {7.0, 5.0};
    const search_spec spec = {.from = 1.0, .to = NAN, .tolerance = 1e-3, .most = 60};
    search_state at = run(&spec, bounded, bound, 1, &rounds, &asked);
    check_bracket(&at, 2.0, 1.1e-3);
    at = run(&spec, bounded, open, 1, &rounds, &asked);
    assert_int_equal(at.outcome, SEARCH_ALL_STABLE);
    check_true(at.refused);
    check_close(at.stable, 4.0, 0.0);
}

static void test_few_probes(void **state)
{
    (void)state;
    const double limit = 0.3;
    int rounds, asked;
    const search_spec spec = {.from = 0.1, .to = 1.0, .tolerance = 1e-6, .most = 5};
    const search_state at = run(&spec, below, &limit, 1, &rounds, &asked);
    assert_int_equal(at.outcome, SEARCH_OUT_OF_PROBES);
    assert_int_equal(asked, 5);
    check_true(at.stable <= limit && at.unstable > limit);
    /* narrower than a value can be written */
    const search_spec fine = {.from = 0.1, .to = 1.0, .tolerance = 1e-15, .most = SEARCH_MOST};
    assert_int_equal(run(&fine, below, &limit, 1, &rounds, &asked).outcome, SEARCH_OUT_OF_PROBES);
}

/* Several values at once: the same bracket, in fewer rounds. */
static void test_at_once(void **state)
{
    (void)state;
    const double limit = 0.2718281828;
    const search_spec spec = {.from = 0.1, .to = 1.0, .tolerance = 1e-5, .most = 40};
    int rounds, asked, alone;
    const search_state plain = run(&spec, below, &limit, 1, &alone, &asked);
    for (size_t at_once = 2; at_once <= 7; at_once++) {
        const search_state at = run(&spec, below, &limit, at_once, &rounds, &asked);
        check_true(at.stable == plain.stable && at.unstable == plain.unstable && at.judged == plain.judged);
        check_true(rounds < alone);
        if (at_once == 7) check_true(rounds <= alone / 3 + 1);
    }
}

static void test_more_than_one_limit(void **state)
{
    (void)state;
    const double limits[] = {0.2, 0.4, 0.6};
    search s;
    double x[7];
    const search_spec spec = {.from = 0.1, .to = 1.0, .tolerance = 1e-3, .most = 40};
    search_begin(&s, &spec);
    for (size_t n = search_next(&s, 7, x); n > 0; n = search_next(&s, 7, x)) {
        for (size_t i = 0; i < n; i++) search_tell(&s, x[i], window(x[i], limits));
    }
    const search_state at = search_look(&s);
    assert_int_equal(at.outcome, SEARCH_FOUND); /* one of them */
    check_true(fabs(at.stable - 0.2) < 1e-3 || fabs(at.stable - 0.6) < 1e-3);
    check_true(!search_is_monotone(&s)); /* seven values at once have met an island */
    search_begin(&s, &spec);
    for (int k = 0; k < 20; k++) search_tell(&s, 0.1 + 0.045 * k, below(0.1 + 0.045 * k, limits));
    check_true(search_is_monotone(&s));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_known_limits),    cmocka_unit_test(test_lower_limit),
        cmocka_unit_test(test_range_with_zero), cmocka_unit_test(test_no_limit),
        cmocka_unit_test(test_range_is_found),  cmocka_unit_test(test_few_probes),
        cmocka_unit_test(test_at_once),         cmocka_unit_test(test_more_than_one_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
