/* When recurring outputs are due. */
#include "check.h"

#include "run/schedule.h"

#include <math.h>

static void multiples_follow_each_other(void **state)
{
    (void)state;
    double t = 0.0;
    for (int k = 1; k <= 1000; k++) {
        t = schedule_next(t, 0.1);
        check_close_relative(t, 0.1 * k, 1e-12);
        check_true(schedule_is_due(t, 0.1));
        check_true(!schedule_is_due(t - 0.05, 0.1));
    }
    check_true(isinf(schedule_next(1.0, INFINITY)));
    check_true(!schedule_is_due(0.0, INFINITY));
}

/* A time that misses a multiple by round-off has reached it: no second output an ulp later. */
static void round_off_is_forgiven(void **state)
{
    (void)state;
    const double interval = 1e-3 / 50.0;
    const double almost = nextafter(7.0 * interval, 0.0);
    check_true(schedule_is_due(almost, interval));
    check_close_relative(schedule_next(almost, interval), 8.0 * interval, 1e-15);
    check_true(schedule_is_passed(6.5 * interval, almost, interval));
    check_true(!schedule_is_passed(almost, 7.0 * interval, interval));
}

static void each_multiple_is_passed_once(void **state)
{
    (void)state;
    uint64_t seed = 1;
    double t = 0.0;
    int passed = 0;
    while (passed < 100) {
        const double next = t + check_random(&seed, 0.01, 0.9);
        passed += schedule_is_passed(t, next, 1.0);
        check_true(passed == (int)floor(next));
        t = next;
    }
    check_true(schedule_is_passed(0.0, 1e-9, 0.0));
    check_true(!schedule_is_passed(0.0, 1e9, INFINITY));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(multiples_follow_each_other),
        cmocka_unit_test(round_off_is_forgiven),
        cmocka_unit_test(each_multiple_is_passed_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
