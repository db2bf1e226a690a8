/* Errors of histories: shifted, scaled and stretched waves whose errors are known; noise, missing values, constants. */
#include "check.h"

#include "verify/history_metric.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

enum { ROWS = 1001 };

typedef struct wave {
    double t[ROWS], y[ROWS], ref[ROWS];
} wave;

/* y = level + a cos(2 pi (t - shift)/T) against the same with a = T = 1, shift = 0, over `cycles` (the end not on a row of
 * symmetry). */
static void fill(wave *w, double level, double a, double period, double shift, double cycles)
{
    for (int i = 0; i < ROWS; i++) {
        w->t[i] = cycles * i / (ROWS - 1);
        w->ref[i] = level + cos(2.0 * pi * w->t[i]);
        w->y[i] = level + a * cos(2.0 * pi * (w->t[i] - shift) / period);
    }
}

static double measure(const wave *w, history_metric_kind kind)
{
    return history_metric_value(kind, ROWS, w->t, w->y, w->ref);
}

static void test_waves(void **state)
{
    (void)state;
    wave w;
    fill(&w, 40.0, 1.25, 1.0, 0.0, 5.0);
    check_close(measure(&w, HISTORY_MAX), 0.25, 1e-12);
    check_close(measure(&w, HISTORY_END), 0.25, 1e-12);
    check_close(measure(&w, HISTORY_RMS), 0.25 / sqrt(2.0), 1e-6);
    check_close(measure(&w, HISTORY_PERIOD), 0.0, 1e-5);
    check_close(measure(&w, HISTORY_TURNS), 0.0, 1e-12);
    fill(&w, 0.0, 1.0, 1.003, 0.0, 5.4);
    check_close(measure(&w, HISTORY_PERIOD), 0.003, 1e-5);
    check_close(measure(&w, HISTORY_TURNS), 0.003, 1e-5); /* each turning point is 0.3 % late */
    fill(&w, 0.0, 1.0, 1.0, 0.01, 0.9);
    check_close(measure(&w, HISTORY_TURNS), 0.02, 1e-5); /* the minimum at 0.5 is 0.01 late */
    check_true(isnan(measure(&w, HISTORY_PERIOD)));      /* each level is crossed once in each direction */
}

/* 3 % noise turns no point and crosses the middle at most next to a crossing. */
static void test_noise(void **state)
{
    (void)state;
    wave w;
    uint64_t seed = 3;
    fill(&w, 0.0, 1.0, 1.01, 0.0, 5.4);
    for (int i = 0; i < ROWS; i++) w.y[i] += check_random(&seed, -0.001, 0.001);
    check_close(measure(&w, HISTORY_PERIOD), 0.01, 2e-3);
    check_close(measure(&w, HISTORY_TURNS), 0.01, 0.02);
    w.y[ROWS / 2] = NAN;
    for (int k = 0; k < HISTORY_METRIC_COUNT; k++) check_true(isnan(measure(&w, (history_metric_kind)k)));
}

/* What settles to 2.02 with a ripple, against 2: relative to 2, as the reference does not change. */
static void test_settled(void **state)
{
    (void)state;
    wave w;
    for (int i = 0; i < ROWS; i++) {
        w.t[i] = 10.0 * i / (ROWS - 1);
        w.ref[i] = 2.0;
        w.y[i] = 2.02 + exp(-3.0 * w.t[i]) + 0.1 * cos(20.0 * pi * w.t[i]);
    }
    check_close(measure(&w, HISTORY_LATE), 0.01, 2e-5);
    check_close(measure(&w, HISTORY_END), 0.06, 1e-6);
    check_close(measure(&w, HISTORY_MAX), 0.56, 1e-12);
    check_true(isnan(measure(&w, HISTORY_PERIOD)) && isnan(measure(&w, HISTORY_TURNS)));
    for (int i = 0; i < ROWS; i++) w.y[i] = w.ref[i] = 0.0;
    check_true(isnan(measure(&w, HISTORY_MAX))); /* no size to measure by */
    check_true(isnan(history_metric_value(HISTORY_MAX, 0, w.t, w.y, w.ref)));
    w.ref[0] = 2.0;
    w.y[0] = 2.5;
    check_close(history_metric_value(HISTORY_RMS, 1, w.t, w.y, w.ref), 0.25, 1e-15);
    check_close(history_metric_value(HISTORY_LATE, 1, w.t, w.y, w.ref), 0.25, 1e-15);
}

/* A history that turns more often than its reference is no match, not a small error. */
static void test_extra_turn(void **state)
{
    (void)state;
    wave w;
    fill(&w, 0.0, 1.0, 1.0, 0.0, 2.9);
    check_close(measure(&w, HISTORY_TURNS), 0.0, 1e-12);
    for (int i = 200; i < ROWS; i++) w.y[i] = cos(4.0 * pi * w.t[i]);
    check_true(isnan(measure(&w, HISTORY_TURNS)));
}

static void test_names(void **state)
{
    (void)state;
    const char *quantity;
    check_true(history_metric_parse("hperiod_position", &quantity) == HISTORY_PERIOD);
    assert_string_equal(quantity, "position");
    check_true(history_metric_parse("hmax_strain_energy", &quantity) == HISTORY_MAX);
    assert_string_equal(quantity, "strain_energy");
    check_true(history_metric_parse("hmax", &quantity) == HISTORY_METRIC_COUNT);
    check_true(history_metric_parse("l1_density", &quantity) == HISTORY_METRIC_COUNT);
    for (int k = 0; k < HISTORY_METRIC_COUNT; k++) {
        const char *pattern = history_metric_pattern((history_metric_kind)k);
        check_true(history_metric_parse(pattern, &quantity) == (history_metric_kind)k);
        assert_string_equal(quantity, "X");
        check_true(strlen(history_metric_doc((history_metric_kind)k)) > 0);
    }
    assert_string_equal(history_metric_doc(HISTORY_METRIC_COUNT), "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_waves),      cmocka_unit_test(test_noise), cmocka_unit_test(test_settled),
        cmocka_unit_test(test_extra_turn), cmocka_unit_test(test_names),
    };
    return cmocka_run_group_tests_name("errors of histories", tests, NULL, NULL);
}
