/* Axes of the command line: values with commas inside, and every fault in words. */
#include "check.h"

#include "study/axis.h"

#include <string.h>

static void values_may_hold_commas(void **state)
{
    (void)state;
    context *ctx = context_create();
    scene_axis a;
    check_ok(ctx, axis_from_text(ctx, "--axis", "bodies.b.points=[2, 2], {x: [1,2], y: 3} ,'a,b',4 mm", &a));
    assert_string_equal(a.key, "bodies.b.points");
    assert_int_equal(a.n_values, 4);
    assert_string_equal(a.value[0], "[2, 2]");
    assert_string_equal(a.value[1], "{x: [1,2], y: 3}");
    assert_string_equal(a.value[2], "'a,b'");
    assert_string_equal(a.value[3], "4 mm");
    context_destroy(&ctx);
}

static void faults_are_named(void **state)
{
    (void)state;
    static const char *const fault[][2] = {
        {"domain.cell", "no key with values"},
        {"=0.1", "no key with values"},
        {"domain.cell=", "empty"},
        {"domain.cell=0.1,", "value 2 is empty"},
        {"domain.cell=0.1, ,2", "value 2 is empty"},
        {"domain.cell=0.1,1e-1", "'1e-1' is given twice"},
    };
    context *ctx = context_create();
    for (size_t i = 0; i < sizeof fault / sizeof fault[0]; i++) {
        scene_axis a;
        const floe_status status = axis_from_text(ctx, "--axis", fault[i][0], &a);
        assert_non_null(strstr(context_message(ctx), fault[i][0]));
        assert_non_null(strstr(context_message(ctx), fault[i][1]));
        assert_non_null(strstr(context_message(ctx), "write KEY=V1,V2"));
        check_fails(ctx, status, FLOE_BAD_INPUT);
    }
    context_destroy(&ctx);
}

static void too_many_are_refused(void **state)
{
    (void)state;
    context *ctx = context_create();
    char text[512] = "a=0";
    scene_axis a;
    for (int i = 1; i <= SCENE_MAX_AXIS; i++) (void)snprintf(text + strlen(text), sizeof text - strlen(text), ",%d", i);
    check_fails(ctx, axis_from_text(ctx, "--axis", text, &a), FLOE_BAD_INPUT);
    (void)snprintf(text, sizeof text, "a=%0*d", SCENE_VALUE, 1);
    check_fails(ctx, axis_from_text(ctx, "--axis", text, &a), FLOE_BAD_INPUT);
    context_destroy(&ctx);
}

static scene_axis axis_of(const char *text)
{
    context *ctx = context_create();
    scene_axis a;
    check_ok(ctx, axis_from_text(ctx, "--axis", text, &a));
    context_destroy(&ctx);
    return a;
}

static void numbers_are_known(void **state)
{
    (void)state;
    const scene_axis a = axis_of("k=0.1,0.05,1e-3"), b = axis_of("k=1 mm,2 mm"), c = axis_of("k=1 mm,2 m");
    const scene_axis d = axis_of("k=mpm,ice"), e = axis_of("k=0,1"), f = axis_of("k=[1],[2]"), g = axis_of("k=1");
    check_true(axis_is_numeric(&a) && axis_is_numeric(&b));
    check_true(!axis_is_numeric(&c) && !axis_is_numeric(&d) && !axis_is_numeric(&e) && !axis_is_numeric(&f));
    check_true(!axis_is_numeric(&g));
    const scene_axis below = axis_of("k=1,-1"), nothing = axis_of("k=2,0"); /* an order is found from logarithms */
    check_true(!axis_is_numeric(&below) && !axis_is_numeric(&nothing));
    check_true(axis_same_value("0.10", "1e-1") && axis_same_value("2 mm", "2.0 mm") && axis_same_value("ice", "ice"));
    check_true(axis_same_value("\"p 1, rho 2\"", "p 1, rho 2") && !axis_same_value("\"p 1", "p 1") &&
               !axis_same_value("\"", "\"\""));
    check_true(!axis_same_value("2 mm", "2 m") && !axis_same_value("ice", "ice-mpm") && !axis_same_value("1", "2"));
}

static void a_key_has_one_axis(void **state)
{
    (void)state;
    context *ctx = context_create();
    const scene_axis a = axis_of("k=1,2"), b = axis_of("k=3"), c = axis_of("l=1");
    axis_list list = {.n = 0};
    strbuf errors;
    strbuf_init(&errors, ctx);
    check_true(axis_put(&list, &a, &errors) && axis_put(&list, &c, &errors) && axis_put(&list, &b, &errors));
    assert_int_equal(list.n, 2);
    assert_string_equal(list.axis[0].value[0], "3");
    assert_int_equal(axis_find(&list, "l"), 1);
    assert_int_equal(axis_find(&list, "m"), -1);
    for (int i = 2; i < SCENE_MAX_AXES; i++) {
        scene_axis more = axis_of("x=1");
        more.key[0] = (char)('A' + i);
        check_true(axis_put(&list, &more, &errors));
    }
    const scene_axis beyond = axis_of("z=1");
    check_true(!axis_put(&list, &beyond, &errors));
    assert_non_null(strstr(strbuf_string(&errors), "more than"));
    strbuf_free(&errors);
    context_destroy(&ctx);
}

static void keys_change_along(void **state)
{
    (void)state;
    context *ctx = context_create();
    scene_axis a, some, other;
    axis_list list = {.n = 0};
    strbuf errors;
    char text[SCENE_SETTING];
    strbuf_init(&errors, ctx);
    check_true(axis_parse("h=0.2,0.1,0.05; b.n=20,40,80;b.curve={from: [0, 1], to: [2; 3]},2,3", &a, &errors));
    check_true(axis_put(&list, &a, &errors));
    assert_int_equal(scene_axis_settings(&a), 3);
    scene_axis_setting(&a, 0, 1, text);
    assert_string_equal(text, "h=0.1");
    scene_axis_setting(&a, 2, 0, text);
    assert_string_equal(text, "b.curve={from: [0, 1], to: [2; 3]}");
    check_true(axis_parse("h=0.050,0.2", &some, &errors) && axis_put(&list, &some, &errors));
    scene_axis_setting(&list.axis[0], 1, 0, text);
    assert_string_equal(text, "b.n=80");
    assert_int_equal(errors.length, 0);
    check_true(axis_parse("h=0.3", &some, &errors) && !axis_put(&list, &some, &errors));
    assert_non_null(strstr(strbuf_string(&errors), "what goes along with 0.3: add ';b.n=...'"));
    check_true(axis_parse("c=1,2;b.n=1,2", &other, &errors) && axis_put(&list, &other, &errors));
    axis_check_keys(&list, &errors);
    assert_non_null(strstr(strbuf_string(&errors), "the axes 'h' and 'c' both set 'b.n'"));
    check_true(!axis_parse("h=1,2;n=3", &a, &errors));
    assert_non_null(strstr(strbuf_string(&errors), "'n' has 1 values for 2 of 'h'"));
    check_true(!axis_parse("h=1,2;", &a, &errors));
    strbuf_free(&errors);
    check_fails(ctx, axis_from_text(ctx, "--each", "h=1,2;n=3,4", &a), FLOE_BAD_INPUT);
    context_destroy(&ctx);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_may_hold_commas), cmocka_unit_test(faults_are_named),
        cmocka_unit_test(too_many_are_refused),   cmocka_unit_test(numbers_are_known),
        cmocka_unit_test(a_key_has_one_axis),     cmocka_unit_test(keys_change_along),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
