/* The cheapest way to an error, on curves of known order and cost; and estimates of errors without an exact solution. */
#include "check.h"

#include "study/tolerance/tolerance.h"

#include <math.h>

enum { CURVES = 5, SPACINGS = 7 };

/* A variant as it is: error = constant h^order, time = price h^-exponent. */
typedef struct truth {
    double constant, order, price, exponent;
    size_t fails; /* this case and all finer ones fail; SPACINGS: none */
} truth;

typedef struct world {
    truth of[CURVES];
    choose_case list[CURVES][SPACINGS];
    choose_curve curve[CURVES];
    double tolerance, spent;
    size_t runs;
} world;

static double error_at(const truth *t, double h)
{
    return t->constant * pow(h, t->order);
}

static double seconds_at(const truth *t, double h)
{
    return t->price * pow(h, -t->exponent);
}

static void begin(world *w)
{
    w->spent = 0.0;
    w->runs = 0;
    for (size_t i = 0; i < CURVES; i++) {
        for (size_t k = 0; k < SPACINGS; k++) {
            const double h = pow(0.5, (double)k + 1.0);
            w->list[i][k] = (choose_case){.h = h, .weight = pow(h, -3.0), .error = NAN};
        }
        w->curve[i] = (choose_curve){.list = w->list[i], .n = SPACINGS};
    }
}

static void run(world *w, choose_step step)
{
    const truth *t = &w->of[step.curve];
    choose_case *one = &w->list[step.curve][step.at];
    assert_int_equal(one->state, CHOOSE_OPEN);
    one->state = step.at < t->fails ? CHOOSE_DONE : CHOOSE_FAILED;
    one->seconds = seconds_at(t, one->h);
    one->error = error_at(t, one->h);
    one->sure = true;
    w->spent += one->seconds;
    w->runs++;
}

static choose_step follow(world *w, double budget)
{
    choose_step step = choose_next(w->curve, CURVES, w->tolerance, 1, budget - w->spent);
    for (; step.action == CHOOSE_RUN; step = choose_next(w->curve, CURVES, w->tolerance, 1, budget - w->spent))
        run(w, step);
    return step;
}

/* The least time in which any variant reaches the tolerance. */
static double least_seconds(const world *w)
{
    double least = INFINITY;
    for (size_t i = 0; i < CURVES; i++) {
        for (size_t k = 0; k < w->of[i].fails && k < SPACINGS; k++) {
            const double h = w->list[i][k].h;
            if (error_at(&w->of[i], h) <= w->tolerance) least = fmin(least, seconds_at(&w->of[i], h));
        }
    }
    return least;
}

static void make_random(world *w, uint64_t *seed, double exponent_low, double exponent_high)
{
    for (size_t i = 0; i < CURVES; i++) {
        w->of[i] = (truth){.constant = exp(check_random(seed, log(0.3), log(30.0))),
                           .order = check_random(seed, 0.7, 3.0),
                           .price = exp(check_random(seed, log(0.02), log(2.0))),
                           .exponent = check_random(seed, exponent_low, exponent_high),
                           .fails = SPACINGS};
    }
    /* No coarsest case is within it. */
    w->tolerance = INFINITY;
    for (size_t i = 0; i < CURVES; i++) w->tolerance = fmin(w->tolerance, 0.9 * error_at(&w->of[i], 0.5));
    w->tolerance *= check_random(seed, 0.05, 1.0);
}

/* Where the weights say how time grows, the cheapest case of all is found, and what is spent in all is no more than the cheap ends of all
 * curves cost: all cases below the chosen one's time, of which each curve has a geometric series (1 + 1/8 + ...). */
static void the_cheapest_is_found(void **state)
{
    (void)state;
    world w;
    uint64_t seed = 7;
    size_t found = 0;
    for (int n = 0; n < 500; n++) {
        make_random(&w, &seed, 3.0, 3.0 + 1e-9);
        begin(&w);
        const double least = least_seconds(&w);
        const choose_step step = follow(&w, INFINITY);
        if (!isfinite(least)) continue;
        assert_int_equal(step.action, CHOOSE_REACHED);
        check_close_relative(w.list[step.curve][step.at].seconds, least, 1e-9);
        check_true(w.list[step.curve][step.at].error <= w.tolerance);
        check_true(w.spent <= CURVES * 8.0 / 7.0 * 8.0 * least);
        found++;
    }
    check_true(found > 400);
}

/* With other exponents than the weights say, a curve may be left too early: then by less than a halving's difference in cost. */
static void other_exponents_cost_little(void **state)
{
    (void)state;
    world w;
    uint64_t seed = 11;
    size_t found = 0, exact = 0;
    for (int n = 0; n < 500; n++) {
        make_random(&w, &seed, 2.0, 3.5);
        begin(&w);
        const double least = least_seconds(&w);
        const choose_step step = follow(&w, INFINITY);
        if (!isfinite(least)) continue;
        assert_int_equal(step.action, CHOOSE_REACHED);
        const double ratio = w.list[step.curve][step.at].seconds / least;
        check_true(ratio <= 2.0);
        exact += ratio < 1.0 + 1e-9;
        found++;
    }
    check_true(found > 400 && 10 * exact >= 9 * found);
}

static void make_equal(world *w)
{
    for (size_t i = 0; i < CURVES; i++)
        w->of[i] =
            (truth){.constant = 1.0, .order = 1.0, .price = 0.1 * (double)(i + 1), .exponent = 3.0, .fails = SPACINGS};
}

/* Dear variants are not refined, and none of their cases costs more than the answer. */
static void dear_variants_are_left(void **state)
{
    (void)state;
    world w;
    make_equal(&w);
    w.of[2] = (truth){.constant = 1.0, .order = 2.0, .price = 0.3, .exponent = 3.0, .fails = SPACINGS};
    w.tolerance = 0.01;
    begin(&w);
    const choose_step step = follow(&w, INFINITY);
    assert_int_equal(step.action, CHOOSE_REACHED);
    assert_int_equal(step.curve, 2);
    assert_int_equal(step.at, 3); /* h = 1/16: 1/256 */
    for (size_t i = 0; i < CURVES; i++) {
        for (size_t k = 0; k < SPACINGS && i != 2; k++) {
            if (w.list[i][k].state != CHOOSE_OPEN) check_true(w.list[i][k].seconds < w.list[2][3].seconds);
        }
        if (i != 2) assert_int_equal(w.curve[i].standing, CHOOSE_SLOWER);
    }
}

static void what_fails_is_passed_over(void **state)
{
    (void)state;
    world w;
    make_equal(&w);
    w.of[0].fails = 3;
    w.tolerance = 0.02;
    begin(&w);
    const choose_step step = follow(&w, INFINITY);
    assert_int_equal(step.action, CHOOSE_REACHED);
    assert_int_equal(step.curve, 1);
    assert_int_equal(w.curve[0].standing, CHOOSE_BROKEN);
    size_t failed = 0;
    for (size_t k = 0; k < SPACINGS; k++) failed += w.list[0][k].state == CHOOSE_FAILED;
    assert_int_equal(failed, 2); /* one may be by chance */
}

/* Out of reach: the dear cases are not run, and what it would take is told by the curve's own law. */
static void what_is_out_of_reach_is_not_tried(void **state)
{
    (void)state;
    world w;
    make_equal(&w);
    w.tolerance = 1e-6;
    begin(&w);
    const choose_step step = follow(&w, INFINITY);
    assert_int_equal(step.action, CHOOSE_UNREACHED);
    check_true(w.runs <= 3 * CURVES);
    check_close_relative(w.curve[0].wanted_h, 1e-6, 1e-9);
    check_close_relative(w.curve[0].wanted_seconds, 0.1 * 1e18, 1e-9);
    assert_int_equal(w.curve[0].standing, CHOOSE_HOPELESS);
}

static void the_budget_is_kept(void **state)
{
    (void)state;
    world w;
    make_equal(&w);
    w.tolerance = 0.02;
    begin(&w);
    const double budget = 60.0;
    const choose_step step = follow(&w, budget);
    assert_int_equal(step.action, CHOOSE_OUT_OF_TIME);
    check_true(w.spent <= budget);
    check_true(step.curve < CURVES && w.list[step.curve][step.at].state == CHOOSE_DONE);
}

/* What the values say when h^order is the whole truth: the bound is the error times the factor. */
static void smooth_values_are_extrapolated(void **state)
{
    (void)state;
    double h[4], f[4];
    for (int p = 1; p <= 2; p++) {
        for (int k = 0; k < 4; k++) {
            h[k] = 0.2 * pow(0.5, k);
            f[k] = 3.0 + 0.7 * pow(h[k], p);
        }
        tolerance_estimate e = tolerance_estimate_of(4, h, f);
        check_true(e.sure);
        check_close(e.order, (double)p, 1e-6);
        check_close_relative(e.relative, 1.25 * (f[3] - 3.0) / f[3], 1e-6);
        e = tolerance_estimate_of(3, h, f);
        check_true(e.sure);
        check_close_relative(e.relative, 3.0 * (f[1] - f[2]) / f[2], 1e-6);
        check_true(!tolerance_estimate_of(2, h, f).sure);
        check_true(!tolerance_estimate_of(1, h, f).sure && isnan(tolerance_estimate_of(1, h, f).relative));
    }
}

/* Two terms that nearly cancel, so that values pass their limit, turn round, or seem to converge faster than they do: no estimate that is
 * sure is less than the true error. */
static void estimates_hold_beside_the_asymptotic_range(void **state)
{
    (void)state;
    double h[4], f[4];
    size_t sure = 0;
    for (int i = -40; i <= 40; i++) {
        const double a = 0.025 * i;
        for (int k = 0; k < 4; k++) {
            h[k] = 0.4 * pow(0.5, k);
            f[k] = 5.0 + a * h[k] + h[k] * h[k];
        }
        for (size_t n = 3; n <= 4; n++) {
            const tolerance_estimate e = tolerance_estimate_of(n, h, f);
            if (!e.sure) continue;
            check_true(fabs(f[n - 1] - 5.0) / f[n - 1] <= e.relative);
            sure++;
        }
    }
    check_true(sure > 120);
}

static void what_does_not_converge_is_not_sure(void **state)
{
    (void)state;
    const double h[] = {0.4, 0.2, 0.1}, f[] = {1.0, 1.1, 1.4};
    const tolerance_estimate e = tolerance_estimate_of(3, h, f);
    check_true(!e.sure);
    check_close_relative(e.relative, 2.0 * 0.4 / 1.4, 1e-12);
}

/* The coarsest spacing sees next to nothing of the scene: its value is far off, and the span of three that has it in it is no sign that the next
 * will be as wide. */
static void a_coarse_outlier_is_no_end(void **state)
{
    (void)state;
    const double h[] = {0.2, 0.1, 0.05, 0.025}, f[] = {1017.0, 1216.0, 1219.5};
    choose_case list[4];
    for (size_t k = 0; k < 4; k++) {
        list[k] = (choose_case){.h = h[k], .weight = pow(h[k], -3.0), .error = NAN};
        if (k == 3) continue;
        const tolerance_estimate e = tolerance_estimate_of(k + 1, h, f);
        list[k].state = CHOOSE_DONE;
        list[k].seconds = pow(h[k], -3.0);
        list[k].error = e.relative;
        list[k].sure = e.sure;
        list[k].settled = e.settled;
    }
    check_close_relative(list[2].error, 2.0 * 202.5 / 1219.5, 1e-12);
    check_close_relative(list[2].settled, 2.0 * 3.5 / 1219.5, 1e-12);
    choose_curve curve = {.list = list, .n = 4};
    const choose_step next = choose_next(&curve, 1, 0.01, 3, INFINITY);
    assert_int_equal(next.action, CHOOSE_RUN);
    assert_int_equal(next.at, 3);
    assert_int_equal(choose_next(&curve, 1, 0.005, 3, INFINITY).action,
                     CHOOSE_UNREACHED); /* it cannot be less than 0.57 % */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_cheapest_is_found),
        cmocka_unit_test(other_exponents_cost_little),
        cmocka_unit_test(dear_variants_are_left),
        cmocka_unit_test(what_fails_is_passed_over),
        cmocka_unit_test(what_is_out_of_reach_is_not_tried),
        cmocka_unit_test(the_budget_is_kept),
        cmocka_unit_test(smooth_values_are_extrapolated),
        cmocka_unit_test(estimates_hold_beside_the_asymptotic_range),
        cmocka_unit_test(what_does_not_converge_is_not_sure),
        cmocka_unit_test(a_coarse_outlier_is_no_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
