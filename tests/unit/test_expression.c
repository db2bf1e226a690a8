/* Formulas: values against C's own, dimensions, what is refused, and tables. */
#include "check.h"

#include "base/memory.h"
#include "expression/expression.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/* Units of the tests: cm and bar. */
static bool unit_of_test(const char *unit, double given, double *value, expression_dimension *dimension, char *why)
{
    *dimension = (expression_dimension){.known = true};
    if (strcmp(unit, "cm") == 0) {
        *value = 0.01 * given;
        dimension->power[0] = 1;
    } else if (strcmp(unit, "bar") == 0) {
        *value = 1e5 * given;
        dimension->power[0] = -1;
        dimension->power[1] = 1;
        dimension->power[2] = -2;
    } else if (strcmp(unit, "1/s") == 0) {
        *value = given;
        dimension->power[2] = -1;
    } else if (strcmp(unit, "1/s^2") == 0) {
        *value = given;
        dimension->power[2] = -2;
    } else if (strcmp(unit, "cm/s^2") == 0) {
        *value = 0.01 * given;
        dimension->power[0] = 1;
        dimension->power[2] = -2;
    } else if (strcmp(unit, "cm^2") == 0) {
        *value = 1e-4 * given;
        dimension->power[0] = 2;
    } else if (strcmp(unit, "cm/s") == 0) {
        *value = 0.01 * given;
        dimension->power[0] = 1;
        dimension->power[2] = -1;
    } else {
        snprintf(why, EXPRESSION_WHY, "unit is not known");
        return false;
    }
    return true;
}

static const expression_constant constants[] = {{"p0", 2e5, {.known = true, .power = {-1, 1, -2}}},
                                                {"n", 3.0, {false, {0}}}};
static const expression_scope scope = {
    .axis = {"x", "y"}, .constant = constants, .n_constants = 2, .unit = unit_of_test};

static double value_at(context *ctx, const char *text, const double x[3], double t)
{
    char why[EXPRESSION_WHY] = "";
    expression *e;
    const floe_status status = expression_create(ctx, text, &scope, &e, NULL, why);
    if (status != FLOE_OK) print_error("%s: %s\n", text, why);
    assert_int_equal(status, FLOE_OK);
    const double value = expression_value(e, x, t);
    expression_destroy(ctx, &e);
    return value;
}

static void test_values_are_those_of_c(void **state)
{
    context *ctx = *state;
    const double at[3] = {0.3, -0.7, 0.0}, x = at[0], y = at[1], t = 1.7;
    const struct {
        const char *text;
        double value;
    } row[] = {
        {"1 + 2 * 3 - 4 / 8", 6.5},
        {"-x^2", -x * x},
        {"2^-1 + 2 ** 3", 8.5},
        {"2^3^2", 512.0},
        {"- -x - +y", x - y},
        {"1e2 + .5 + 2. + 1E-1", 102.6},
        {"3 cm + x", 0.03 + x},
        {"5 cm/s*t", 0.05 * t},
        {"5 cm/t", 0.05 / t},
        {"5 1/s * t", 5.0 * t},
        {"4 cm/s^2 * t", 0.04 * t},
        {"4 1/s^2*t", 4.0 * t},
        {"3 cm^2 / x", 3e-4 / x},
        {"(3 cm)^2 / x", 9e-4 / x},
        {"p0 - 1 bar", 1e5},
        {"n * x / y", 3.0 * x / y},
        {"sin(x) + cos(y) * tan(t)", sin(x) + cos(y) * tan(t)},
        {"asin(x) - acos(y) + atan(t)", asin(x) - acos(y) + atan(t)},
        {"atan2(y, x)", atan2(y, x)},
        {"sinh(x) + cosh(y) + tanh(t)", sinh(x) + cosh(y) + tanh(t)},
        {"exp(x) + log(t) + log10(t) + erf(y)", exp(x) + log(t) + log10(t) + erf(y)},
        {"sqrt(t) + abs(y) + sign(y) + floor(y)", sqrt(t) + 0.7 - 1.0 - 1.0},
        {"mod(y, 0.5) + min(x, y) + max(x, y)", 0.3 + y + x},
        {"if(x < 0.5, 10, 20)", 10.0},
        {"if(x > 0.5 or y >= -0.7 and not t == 0, 10, 20)", 10.0},
        {"if(x <= 0.2 or y != -0.7, 10, 20)", 20.0},
        {"ramp(t, 3.4)", 0.5},
        {"ramp(-1, 2) + ramp(5, 2)", 1.0},
        {"sin(2*pi*x)", sin(2.0 * pi * x)},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; ++i) {
        const double value = value_at(ctx, row[i].text, at, t);
        if (fabs(value - row[i].value) > 1e-15 * (1.0 + fabs(row[i].value))) print_error("%s\n", row[i].text);
        check_close(value, row[i].value, 1e-15 * (1.0 + fabs(row[i].value)));
    }
}

static void test_it_knows_what_it_hangs_on(void **state)
{
    context *ctx = *state;
    const struct {
        const char *text;
        bool place, time;
    } row[] = {{"1 + p0", false, false},
               {"x", true, false},
               {"2 * t", false, true},
               {"noise(1, 2)", true, false},
               {"x * t", true, true}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; ++i) {
        char why[EXPRESSION_WHY];
        expression *e;
        check_ok(ctx, expression_create(ctx, row[i].text, &scope, &e, NULL, why));
        assert_int_equal(expression_has_place(e), row[i].place);
        assert_int_equal(expression_has_time(e), row[i].time);
        assert_string_equal(expression_text(e), row[i].text);
        expression_destroy(ctx, &e);
    }
}

/* Each with words of the message. */
static void test_what_is_wrong_is_refused(void **state)
{
    context *ctx = *state;
    const struct {
        const char *text, *says;
    } row[] = {
        {"", "something is missing"},
        {"1 +", "something is missing"},
        {"(1 + 2", "not closed"},
        {"1 2", "over before its end"},
        {"2 x", "no sign between two factors"},
        {"5 1/x", "over before its end"},
        {"2x", "no blank"},
        {"3 foot", "not known"},
        {"foo + 1", "'foo' is not known"},
        {"z", "'z' is not known"},
        {"sin x", "is a function"},
        {"atan2(1)", "takes 2 numbers"},
        {"sin(1, 2)", "takes 1 number"},
        {"1 cm + 1 bar", "'+' of m and m-1 kg s-2"},
        {"x + 1 bar", "'+' of m and m-1 kg s-2"},
        {"t - p0", "'-' of s and m-1 kg s-2"},
        {"sin(1 cm)", "without a unit"},
        {"max(1 cm, t)", "'max' of m and s"},
        {"if(x > 0, 1 cm, 1 bar)", "'if' of m and"},
        {"x < 1 bar", "'<' of m and"},
        {"1 < 2 < 3", "over before its end"},
        {"1e999", "too large"},
        {"((((((((((((((((((((((((((((((((((((((((((((((((1))))))))))))))))))))))))))))))))))))))))))))))))",
         "too many brackets"},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; ++i) {
        char why[EXPRESSION_WHY] = "";
        expression *e;
        assert_int_equal(expression_create(ctx, row[i].text, &scope, &e, NULL, why), FLOE_BAD_INPUT);
        if (!strstr(why, row[i].says)) print_error("%s: %s\n", row[i].text, why);
        check_true(strstr(why, row[i].says));
        assert_null(e);
    }
}

/* Of numbers with units it is known; a plain number may stand for anything, and hides it. */
static void test_dimensions(void **state)
{
    context *ctx = *state;
    const struct {
        const char *text;
        bool known;
        signed char metre, kilogram, second;
    } row[] = {
        {"p0 * (x / 1 cm)^2", true, -1, 1, -2},
        {"sqrt(p0 / 1 bar) * x", true, 1, 0, 0},
        {"1 cm/s * t + x", true, 1, 0, 0},
        {"4 cm/s^2 * t", true, 1, 0, -1},
        {"2 * p0", false, 0, 0, 0},
        {"p0 + 3", true, -1, 1, -2},
        {"x / t", false, 0, 0, 0},
        {"if(x < 1, 1 cm, 2)", true, 1, 0, 0},
        {"-(1 cm)", true, 1, 0, 0},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; ++i) {
        char why[EXPRESSION_WHY] = "";
        expression_dimension d;
        expression *e;
        assert_int_equal(expression_create(ctx, row[i].text, &scope, &e, &d, why), FLOE_OK);
        if (d.known != row[i].known) print_error("%s\n", row[i].text);
        assert_int_equal(d.known, row[i].known);
        if (d.known) {
            assert_int_equal(d.power[0], row[i].metre);
            assert_int_equal(d.power[1], row[i].kilogram);
            assert_int_equal(d.power[2], row[i].second);
        }
        expression_destroy(ctx, &e);
    }
}

/* In [-1, 1], continuous, with a slope that the blend's bounds (1.5 times the difference of two corners), another for another seed, and of
 * mean and spread as independent corners have them. */
static void test_noise(void **state)
{
    context *ctx = *state;
    char why[EXPRESSION_WHY];
    double sum = 0.0, square = 0.0, apart = 0.0;
    expression *one, *other;
    const int n = 20000;
    check_ok(ctx, expression_create(ctx, "noise(0.1, 7)", &scope, &one, NULL, why));
    check_ok(ctx, expression_create(ctx, "noise(0.1, 8)", &scope, &other, NULL, why));
    double before = expression_value(one, (const double[3]){-1000.0 * 0.01, 0.25, 0.0}, 0.0);
    for (int i = 0; i < n; ++i) {
        const double x[3] = {-10.0 + 0.01 * i, 0.25, 0.0}, value = expression_value(one, x, 0.0);
        check_true(fabs(value) <= 1.0 && fabs(value - before) <= 1.5 * 2.0 * 0.1 + 1e-12);
        before = value;
        sum += value;
        square += value * value;
        apart += fabs(value - expression_value(other, x, 0.0));
    }
    check_close(sum / n, 0.0, 0.05);
    check_true(square / n > 0.1 && square / n < 1.0 / 3.0);
    check_true(apart / n > 0.2);
    expression_destroy(ctx, &one);
    expression_destroy(ctx, &other);
}

static void test_tables(void **state)
{
    context *ctx = *state;
    const double at[] = {1.0, 2.0, 4.0}, value[] = {10.0, 20.0, 0.0};
    value_table *t;
    check_ok(ctx, value_table_create(ctx, at, value, 3, TABLE_LINEAR, TABLE_CONSTANT, &t));
    check_close(value_table_at(t, 1.5), 15.0, 1e-14);
    check_close(value_table_at(t, 3.0), 10.0, 1e-14);
    check_close(value_table_at(t, 0.0), 10.0, 0.0);
    check_close(value_table_at(t, 9.0), 0.0, 0.0);
    check_true(isnan(value_table_at(t, (double)NAN)));
    value_table_destroy(ctx, &t);
    check_ok(ctx, value_table_create(ctx, at, value, 3, TABLE_STEPS, TABLE_ZERO, &t));
    check_close(value_table_at(t, 1.999), 10.0, 0.0);
    check_close(value_table_at(t, 2.0), 20.0, 0.0);
    check_close(value_table_at(t, 4.0), 0.0, 0.0);
    check_close(value_table_at(t, 0.999), 0.0, 0.0);
    value_table_destroy(ctx, &t);
    check_ok(ctx, value_table_create(ctx, at, value, 3, TABLE_LINEAR, TABLE_REPEAT, &t));
    check_close(value_table_at(t, 1.5 + 3.0 * 7.0), 15.0, 1e-12);
    check_close(value_table_at(t, 1.5 - 3.0 * 7.0), 15.0, 1e-12);
    value_table_destroy(ctx, &t);
    check_ok(ctx, value_table_create(ctx, at, value, 3, TABLE_SMOOTH, TABLE_CONSTANT, &t));
    for (int k = 0; k <= 300; ++k) {
        const double y = value_table_at(t, 1.0 + 0.01 * k);
        check_true(y >= 0.0 && y <= 20.0);
    }
    check_close(value_table_at(t, 2.0), 20.0, 1e-13);
    value_table_destroy(ctx, &t);
    check_fails(ctx, value_table_create(ctx, value, at, 3, TABLE_LINEAR, TABLE_ZERO, &t), FLOE_BAD_INPUT);
    assert_null(t);
}

static void test_a_table_in_a_formula(void **state)
{
    context *ctx = *state;
    const double at[] = {0.0, 2.0}, value[] = {0.0, 1.0};
    value_table *t;
    char why[EXPRESSION_WHY];
    expression *e;
    check_ok(ctx, value_table_create(ctx, at, value, 2, TABLE_LINEAR, TABLE_CONSTANT, &t));
    const expression_function function = {"push", t};
    const expression_scope with = {.axis = {"x"}, .function = &function, .n_functions = 1};
    check_ok(ctx, expression_create(ctx, "3 * push(t) + x", &with, &e, NULL, why));
    check_close(expression_value(e, (const double[3]){0.5, 0.0, 0.0}, 1.0), 2.0, 1e-15);
    expression_destroy(ctx, &e);
    assert_int_equal(expression_create(ctx, "push", &with, &e, NULL, why), FLOE_BAD_INPUT);
    value_table_destroy(ctx, &t);
}

/* An allocation that fails leaves nothing behind. */
static void test_without_memory(void **state)
{
    context *ctx = *state;
    char why[EXPRESSION_WHY];
    expression *e;
    for (uint64_t n = 1; n < 5; ++n) {
        memory_inject_failure(ctx, n);
        assert_int_equal(expression_create(ctx, "1 + x", &scope, &e, NULL, why), FLOE_NO_MEMORY);
        assert_null(e);
        context_clear(ctx);
    }
    memory_inject_failure(ctx, 0);
    assert_int_equal(memory_read_account(ctx).live_bytes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_values_are_those_of_c),
        cmocka_unit_test(test_it_knows_what_it_hangs_on),
        cmocka_unit_test(test_what_is_wrong_is_refused),
        cmocka_unit_test(test_dimensions),
        cmocka_unit_test(test_noise),
        cmocka_unit_test(test_tables),
        cmocka_unit_test(test_a_table_in_a_formula),
        cmocka_unit_test(test_without_memory),
    };
    return cmocka_run_group_tests(tests, check_make_context, check_drop_context);
}
