/* study.json, number by number: axes, orders, limits, fronts, checks and verdicts of cases whose errors are powers of two. */
#include "study_cases_fixture.h"

static json_t *written(const fixture *f)
{
    char path[2 * PATH], *text;
    check_ok(f->ctx, study_write_json(&f->s));
    (void)snprintf(path, sizeof path, "%s/study.json", f->dir);
    check_ok(f->ctx, file_read(f->ctx, path, &text, NULL));
    json_t *all = json_loads(text, 0, NULL);
    memory_free(f->ctx, &text);
    assert_non_null(all);
    return all;
}

/* The part of a JSON text at a path of keys and indices, "axes.1.values.2". */
static const json_t *part(const json_t *from, const char *path)
{
    char key[64];
    for (; *path; path += *path == '/') {
        const size_t n = strcspn(path, "/");
        assert_true(n < sizeof key);
        (void)snprintf(key, sizeof key, "%.*s", (int)n, path);
        from = json_is_array(from) ? json_array_get(from, (size_t)atoi(key)) : json_object_get(from, key);
        if (!from) print_error("no '%s'\n", key);
        assert_non_null(from);
        path += n;
    }
    return from;
}

static void check_numbers(const json_t *all, const char *path, size_t n, const double *wanted)
{
    const json_t *list = part(all, path);
    assert_int_equal(json_array_size(list), n);
    for (size_t k = 0; k < n; ++k) check_close_relative(json_number_value(json_array_get(list, k)), wanted[k], 1e-14);
}

static void check_number(const json_t *all, const char *path, double wanted)
{
    check_close(json_number_value(part(all, path)), wanted, 1e-12);
}

static void check_text(const json_t *all, const char *path, const char *wanted)
{
    assert_string_equal(json_string_value(part(all, path)), wanted);
}

static void axes_and_runs(void **state)
{
    fixture *f = *state;
    f->s.axes.axis[1].n_with = 2;
    for (int k = 0; k < 2; ++k) {
        (void)snprintf(f->s.axes.axis[1].with[k].key, sizeof f->s.axes.axis[1].with[k].key, "key.%d", k);
        for (int i = 0; i < SPACINGS; ++i) (void)snprintf(f->s.axes.axis[1].with[k].value[i], 2, i == k ? "7" : "9");
    }
    json_t *all = written(f);
    check_number(all, "schema", 1.0);
    check_text(all, "deck", "bar.yaml");
    check_text(all, "title", "bar");
    check_text(all, "axis/key", "domain.cell");
    assert_int_equal(json_array_size(part(all, "axes")), 2);
    check_text(all, "axes/0/key", "coupling");
    check_text(all, "axes/0/values/2", "ice");
    assert_null(json_object_get(part(all, "axes/0"), "with"));
    check_text(all, "axes/1/values/2", "0.1");
    assert_int_equal(json_object_size(part(all, "axes/1/with")), 2);
    check_text(all, "axes/1/with/key.0/0", "7");
    check_text(all, "axes/1/with/key.0/1", "9");
    check_text(all, "axes/1/with/key.1/1", "7");
    assert_int_equal(json_array_size(part(all, "runs")), CASES);
    assert_true(json_is_null(part(all, "verdicts")));
    check_number(all, "timing/repeat", 0.0);
    assert_true(json_is_false(part(all, "timing/disturbed")));
    json_decref(all);
}

/* Errors that fall by halves and by quarters; the second has two cases, the third none. Values that tend to 3 with their spacing. */
static void orders_and_limits(void **state)
{
    const fixture *f = *state;
    json_t *all = written(f);
    check_number(all, "orders/mpm/l2rel_density/order", 1.0);
    check_number(all, "orders/mpm/l2rel_density/stderr", 0.0);
    check_numbers(all, "orders/mpm/l2rel_density/values", 3, (const double[]){0.16, 0.08, 0.04});
    check_numbers(all, "orders/mpm/l2rel_density/h", 3, (const double[]){0.4, 0.2, 0.1});
    check_numbers(all, "orders/mpm/l2rel_density/pairs", 2, (const double[]){1.0, 1.0});
    check_numbers(all, "orders/ice-mpm/l2rel_density/pairs", 1, (const double[]){2.0});
    check_numbers(all, "orders/ice/l2rel_density/values", 0, NULL);
    check_numbers(all, "orders/ice/l2rel_density/pairs", 0, NULL);
    check_text(all, "limits/mpm/kinetic/kind", "monotone");
    check_number(all, "limits/mpm/kinetic/order", 1.0);
    check_number(all, "limits/mpm/kinetic/value", 3.0);
    check_number(all, "limits/mpm/kinetic/gci", 1.25 * 0.1);
    check_number(all, "limits/mpm/kinetic/gci_relative", 1.25 * 0.1 / 3.1);
    check_number(all, "limits/mpm/kinetic/gci_medium", 1.25 * 0.2);
    assert_true(json_is_null(part(all, "limits/mpm/kinetic/asymptotic_ratio"))); /* of three values there is none */
    assert_true(json_is_null(part(all, "limits/mpm/kinetic/fit")));
    assert_true(json_is_null(part(all, "limits/ice/kinetic")));
    /* Updates and seconds of the second group are twice those of the first, errors twice or the same. */
    for (int k = 0; k < 2; ++k) {
        const json_t *front = part(all, k ? "timing/pareto/l2rel_density" : "pareto/l2rel_density");
        assert_int_equal(json_array_size(front), 3);
        for (size_t i = 0; i < 3; ++i) {
            char name[16];
            (void)snprintf(name, sizeof name, "case-%zu", i);
            assert_string_equal(json_string_value(json_array_get(front, i)), name);
        }
    }
    json_decref(all);
}

static void checks_and_verdicts(void **state)
{
    fixture *f = *state;
    f->s.plan.n_checks = 2;
    for (int k = 0; k < 2; ++k) {
        scene_check *check = &f->s.plan.check[k];
        *check = (scene_check){.at = k ? 0.5 : (double)NAN, .change = k == 1, .least = 1.0 + k, .most = 3.0 + k};
        (void)snprintf(check->of, sizeof check->of, "column_%d", k);
        f->s.found[k] = (study_range){1.5 + k, 2.5 + k};
    }
    f->s.plan.check[1].where.n = 1;
    (void)snprintf(f->s.plan.check[1].where.key[0], sizeof f->s.plan.check[1].where.key[0], "coupling");
    (void)snprintf(f->s.plan.check[1].where.value[0], 4, "mpm");
    for (int k = 0; k < CASES; ++k) {
        f->list[k].verdict = k < 4 ? STUDY_RIGHT : k < 6 ? STUDY_REFUSED : STUDY_WRONG;
        f->list[k].unnoticed = k == 1 ? 1u : 0u;
    }
    json_t *all = written(f);
    check_number(all, "verdicts/right", 4.0);
    check_number(all, "verdicts/refused", 2.0);
    check_number(all, "verdicts/wrong", 3.0);
    check_number(all, "verdicts/unnoticed", 1.0);
    assert_int_equal(json_array_size(part(all, "verdicts/checks")), 2);
    check_text(all, "verdicts/checks/1/of", "column_1");
    assert_true(json_is_null(part(all, "verdicts/checks/0/at")));
    check_number(all, "verdicts/checks/1/at", 0.5);
    assert_true(json_is_false(part(all, "verdicts/checks/0/change")) &&
                json_is_true(part(all, "verdicts/checks/1/change")));
    check_number(all, "verdicts/checks/0/least", 1.0);
    check_number(all, "verdicts/checks/1/most", 4.0);
    check_number(all, "verdicts/checks/0/smallest", 1.5);
    check_number(all, "verdicts/checks/1/largest", 3.5);
    assert_int_equal(json_object_size(part(all, "verdicts/checks/0/where")), 0);
    check_text(all, "verdicts/checks/1/where/coupling", "mpm");
    json_decref(all);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(axes_and_runs, set_up, tear_down),
        cmocka_unit_test_setup_teardown(orders_and_limits, set_up, tear_down),
        cmocka_unit_test_setup_teardown(checks_and_verdicts, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
