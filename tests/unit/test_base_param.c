/* Parameter ranges, their edges, and their words. */
#include "check.h"

#include "base/param.h"

#include <float.h>
#include <math.h>

static const param_spec any = {.range = PARAM_ANY};
static const param_spec positive = {.range = PARAM_POSITIVE};
static const param_spec nonnegative = {.range = PARAM_NONNEGATIVE};
static const param_spec between = {.range = PARAM_BETWEEN, .lo = 0.0, .hi = 0.5};

static void accepts_its_range(void **state)
{
    (void)state;
    check_true(param_in_range(&any, -DBL_MAX));
    check_true(param_in_range(&positive, DBL_MIN) && !param_in_range(&positive, 0.0));
    check_true(param_in_range(&nonnegative, 0.0) && !param_in_range(&nonnegative, -DBL_MIN));
    check_true(param_in_range(&between, 0.0) && param_in_range(&between, 0.5));
    check_true(!param_in_range(&between, nextafter(0.5, 1.0)) && !param_in_range(&between, -DBL_MIN));
}

static void refuses_what_is_not_finite(void **state)
{
    (void)state;
    const param_spec *const specs[] = {&any, &positive, &nonnegative, &between};
    for (size_t i = 0; i < sizeof specs / sizeof *specs; i++) {
        check_true(!param_in_range(specs[i], (double)NAN));
        check_true(!param_in_range(specs[i], (double)INFINITY));
        check_true(!param_in_range(specs[i], (double)-INFINITY));
    }
}

static void refuses_unknown_range(void **state)
{
    (void)state;
    const param_spec broken = {.range = (param_range)17};
    char text[64] = "";
    check_true(!param_in_range(&broken, 1.0));
    param_describe_range(&broken, text, sizeof text);
    assert_string_equal(text, "a number in an unknown range");
}

static void describes_its_range(void **state)
{
    (void)state;
    char text[64];
    param_describe_range(&any, text, sizeof text);
    assert_string_equal(text, "a finite number");
    param_describe_range(&positive, text, sizeof text);
    assert_string_equal(text, "a number > 0");
    param_describe_range(&nonnegative, text, sizeof text);
    assert_string_equal(text, "a number >= 0");
    param_describe_range(&between, text, sizeof text);
    assert_string_equal(text, "a number from 0 to 0.5");
}

static void writes_no_further_than_size(void **state)
{
    (void)state;
    char text[8] = "#######";
    param_describe_range(&positive, text, 5);
    assert_string_equal(text, "a nu");
    assert_int_equal(text[5], '#');
    param_describe_range(&positive, NULL, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(accepts_its_range),           cmocka_unit_test(refuses_what_is_not_finite),
        cmocka_unit_test(refuses_unknown_range),       cmocka_unit_test(describes_its_range),
        cmocka_unit_test(writes_no_further_than_size),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
