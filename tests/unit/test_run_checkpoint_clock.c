/* When checkpoints are due: with every snapshot and every two minutes, for at most 2 % of the wall time. */
#include "check.h"

#include "run/checkpoint_clock.h"

#include <math.h>
#include <stdlib.h>

/* A run of `seconds` with a snapshot every `interval` and checkpoints of `cost`, looked at every `step`. */
typedef struct trial_run {
    double seconds, interval, step, cost;
} trial_run;

typedef struct outcome {
    long written, passed;
    double share;   /* of the wall time, the largest at any time */
    double longest; /* s without a checkpoint */
    double late;    /* s from a snapshot to its checkpoint, the largest */
} outcome;

static double larger(double a, double b)
{
    return a > b ? a : b;
}

static outcome carry_out(double deck, const trial_run *t)
{
    outcome o = {0};
    double now = 100.0, last = now, next = now + t->interval, snapshot = NAN;
    checkpoint_clock c = checkpoint_clock_start(deck, now, t->cost);
    while (now - c.started < t->seconds) {
        now += t->step;
        if (now >= next) {
            checkpoint_clock_see_snapshot(&c);
            next += t->interval;
            if (isnan(snapshot)) snapshot = now;
        }
        o.longest = larger(o.longest, now - last);
        if (!checkpoint_clock_is_due(&c, now)) continue;
        if (!isnan(snapshot)) o.late = larger(o.late, now - snapshot);
        snapshot = NAN;
        checkpoint_clock_count(&c, now, now + t->cost);
        now += t->cost;
        last = now;
        o.share = larger(o.share, c.spent / (now - c.started));
    }
    o.written = c.written;
    o.passed = c.passed;
    return o;
}

/* Cheap beside the snapshots: each gets one, at once but for the first moments. */
static void every_snapshot_has_one(void **state)
{
    (void)state;
    const outcome o = carry_out(NAN, &(trial_run){600.0, 20.0, 0.01, 0.1});
    assert_in_range(o.written, 29, 30);
    assert_int_equal(o.passed, 0);
    check_true(o.late < 0.02);
    check_true(o.longest < 20.2);
}

/* Snapshots that are far apart, or none on the way. */
static void two_minutes_without_one_are_the_most(void **state)
{
    (void)state;
    const outcome o = carry_out(NAN, &(trial_run){3600.0, INFINITY, 0.5, 1.0});
    check_true(o.longest <= CHECKPOINT_CLOCK_LONGEST + 0.5);
    check_true(o.written == 29 || o.written == 30);
    check_true(o.share < 0.02);
}

/* Dear ones are spaced out: fifty times what one takes is then what a kill costs. */
static void dear_ones_are_spaced_out(void **state)
{
    (void)state;
    const double costs[] = {0.013, 0.3, 7.0, 60.0};
    for (size_t k = 0; k < sizeof costs / sizeof costs[0]; k++) {
        const trial_run t = {400.0 * costs[k], costs[k], 0.01 * costs[k], costs[k]};
        const outcome o = carry_out(NAN, &t);
        assert_in_range(o.written, 7, 8);
        check_true(o.passed > 300);
        check_true(o.share <= 0.02);
        check_true(o.longest <= 50.0 * costs[k] + 2.0 * t.step);
    }
}

/* A run that ends before the first one pays nothing for it. */
static void short_runs_pay_nothing(void **state)
{
    (void)state;
    assert_int_equal(carry_out(NAN, &(trial_run){0.24, 0.02, 1e-4, 0.005}).written, 0);
    assert_int_equal(carry_out(NAN, &(trial_run){0.26, 0.02, 1e-4, 0.005}).written, 1);
}

/* What the deck says rules. */
static void decks_rule(void **state)
{
    (void)state;
    const trial_run t = {100.0, 1.0, 0.01, 0.5};
    assert_int_equal(carry_out(INFINITY, &t).written, 0);
    const outcome o = carry_out(2.0, &t);
    assert_in_range(o.written, 48, 50);
    check_true(o.share > 0.1);
}

/* One that takes longer than expected is paid for before the next. */
static void surprises_are_paid_for(void **state)
{
    (void)state;
    checkpoint_clock c = checkpoint_clock_start(NAN, 0.0, 0.01);
    checkpoint_clock_see_snapshot(&c);
    check_true(!checkpoint_clock_is_due(&c, 0.49));
    check_true(checkpoint_clock_is_due(&c, 0.51));
    checkpoint_clock_count(&c, 0.51, 3.51);
    checkpoint_clock_see_snapshot(&c);
    check_true(!checkpoint_clock_is_due(&c, 299.0));
    check_true(checkpoint_clock_is_due(&c, 301.0));
    checkpoint_clock_count(&c, 301.0, 301.01);
    checkpoint_clock_see_snapshot(&c);
    check_true(checkpoint_clock_is_due(&c, 302.0));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_snapshot_has_one),
        cmocka_unit_test(two_minutes_without_one_are_the_most),
        cmocka_unit_test(dear_ones_are_spaced_out),
        cmocka_unit_test(short_runs_pay_nothing),
        cmocka_unit_test(decks_rule),
        cmocka_unit_test(surprises_are_paid_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
