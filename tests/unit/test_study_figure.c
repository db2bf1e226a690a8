/* Figures of a study, exactly: what their curves and their front are, and which case's profile a group shows. */
#include "study_cases_fixture.h"

static void check_file(const fixture *f, const char *name, const char *wanted)
{
    char path[2 * PATH], *text;
    (void)snprintf(path, sizeof path, "%s/%s", f->dir, name);
    check_ok(f->ctx, file_read(f->ctx, path, &text, NULL));
    assert_string_equal(text, wanted);
    memory_free(f->ctx, &text);
}

/* From coarse to fine; errors of ratios in per cent; what did not come to its end is on no curve and no front. */
static void curves_go_from_coarse_to_fine(void **state)
{
    const fixture *f = *state;
    check_ok(f->ctx, study_write_figures(&f->s));
    check_file(f, "errors.csv",
               "panel,series,x,y,label\n"
               "\"\",\"mpm\",0.40000000000000002,16,\n"
               "\"\",\"mpm\",0.20000000000000001,8,\n"
               "\"\",\"mpm\",0.10000000000000001,4,\n"
               "\"\",\"ice-mpm\",0.40000000000000002,32,\n"
               "\"\",\"ice-mpm\",0.20000000000000001,8,\n"
               "\"\",\"mpm\",1000,16,\n"
               "\"\",\"mpm\",2000,8,\n"
               "\"\",\"mpm\",4000,4,\n"
               "\"\",\"ice-mpm\",2000,32,\n"
               "\"\",\"ice-mpm\",4000,8,\n"
               "\"\",\"Pareto front\",1000,16,\n"
               "\"\",\"Pareto front\",2000,8,\n"
               "\"\",\"Pareto front\",4000,4,\n"
               "\"\",\"mpm\",1,16,\n"
               "\"\",\"mpm\",2,8,\n"
               "\"\",\"mpm\",4,4,\n"
               "\"\",\"ice-mpm\",2,32,\n"
               "\"\",\"ice-mpm\",4,8,\n"
               "\"\",\"Pareto front\",1,16,\n"
               "\"\",\"Pareto front\",2,8,\n"
               "\"\",\"Pareto front\",4,4,\n");
    check_file(f, "quantities.csv",
               "panel,series,x,y,label\n"
               "\"\",\"mpm\",0.40000000000000002,3.3999999999999999,\n"
               "\"\",\"mpm\",0.20000000000000001,3.2000000000000002,\n"
               "\"\",\"mpm\",0.10000000000000001,3.1000000000000001,\n");
}

/* Of each group the finest case that has come to its end, with the columns that it has; the exact curve at the
 * positions of the one with most rows. */
static void profiles_are_of_the_finest_cases(void **state)
{
    const fixture *f = *state;
    put_profile(f, 1, "r (m),sigma (Pa),exact_sigma (Pa)\n9,9,9\n9,9,9\n9,9,9\n");
    put_profile(f, 2, "r (m),sigma (Pa),exact_sigma (Pa),u (m/s),exact_u (m/s)\n1,4e6,4.5e6,7,8\n2,2e6,2.25e6,,1\n");
    put_profile(f, 4, "r (m),u (m/s),exact_u (m/s)\n1.5,0.5,0.75\n");
    put_profile(f, 5, "r (m),u (m/s),exact_u (m/s)\n8,8,8\n8,8,8\n8,8,8\n");
    put_profile(f, 8, "r (m),u (m/s),exact_u (m/s)\n8,8,8\n8,8,8\n8,8,8\n");
    check_ok(f->ctx, study_write_figures(&f->s));
    check_file(f, "profile.csv",
               "panel,series,x,y,label\n"
               "\"\",\"lame\",1,4.5,\n"
               "\"\",\"lame\",2,2.25,\n"
               "\"\",\"mpm\",1,4,\n"
               "\"\",\"mpm\",2,2,\n"
               "\"\",\"lame\",1,8,\n"
               "\"\",\"lame\",2,1,\n"
               "\"\",\"mpm\",1,7,\n"
               "\"\",\"mpm\",2,nan,\n"
               "\"\",\"ice-mpm\",1.5,0.5,\n");
}

/* As many quantities as a figure has panels, and one more, which it leaves out. */
static void as_many_panels_as_there_may_be(void **state)
{
    enum { PANELS = 64 };
    const fixture *f = *state;
    char path[2 * PATH], *text, names[TEXT] = "r (m)", numbers[TEXT] = "1";
    for (int k = 0; k <= PANELS; ++k) {
        const size_t at = strlen(names), to = strlen(numbers);
        (void)snprintf(names + at, sizeof names - at, ",q%d (m/s),exact_q%d (m/s)", k, k);
        (void)snprintf(numbers + to, sizeof numbers - to, ",%d,%d", k, -k);
    }
    char whole[2 * TEXT + 4];
    (void)snprintf(whole, sizeof whole, "%s\n%s\n", names, numbers);
    put_profile(f, 2, whole);
    check_ok(f->ctx, study_write_figures(&f->s));
    (void)snprintf(path, sizeof path, "%s/profile.csv", f->dir);
    check_ok(f->ctx, file_read(f->ctx, path, &text, NULL));
    for (int k = 0; k <= PANELS; ++k) {
        char exact[64], found[64];
        (void)snprintf(exact, sizeof exact, "\"\",\"lame\",1,%d,\n", -k);
        (void)snprintf(found, sizeof found, "\"\",\"mpm\",1,%d,\n", k);
        assert_int_equal(strstr(text, exact) && strstr(text, found), k < PANELS);
    }
    memory_free(f->ctx, &text);
}

/* Beside errors over the spacing stand lines of the first and second order; over costs none. */
static void slopes_are_of_both_orders(void **state)
{
    const fixture *f = *state;
    char path[2 * PATH], *text;
    int found = 0;
    check_ok(f->ctx, study_write_figures(&f->s));
    (void)snprintf(path, sizeof path, "%s/errors.json", f->dir);
    check_ok(f->ctx, file_read(f->ctx, path, &text, NULL));
    json_t *all = json_loads(text, 0, NULL), *panels = json_object_get(all, "panels");
    memory_free(f->ctx, &text);
    assert_int_equal(json_array_size(panels), 3);
    for (size_t k = 0; k < 3; ++k) {
        const json_t *slopes = json_object_get(json_array_get(panels, k), "slopes");
        if (json_array_size(slopes) == 0) continue;
        assert_int_equal(json_array_size(slopes), 2);
        for (size_t n = 0; n < 2; ++n) check_close(json_number_value(json_array_get(slopes, n)), (double)(n + 1), 0.0);
        found++;
    }
    assert_int_equal(found, 1);
    json_decref(all);
}

/* All rows of the profiles that are shown, each with its group and spacing; the names once. */
static void profiles_are_one_table(void **state)
{
    const fixture *f = *state;
    put_profile(f, 2, "r (m),u (m/s),exact_u (m/s)\n1,2,3\n4,,6\n");
    put_profile(f, 4, "r (m),u (m/s),exact_u (m/s)\n7,8,9\n");
    check_ok(f->ctx, study_write_figures(&f->s));
    check_file(f, "profiles.csv",
               "group,h (m),r (m),u (m/s),exact_u (m/s)\n\"mpm\",0.1,1,2,3\n\"mpm\",0.1,4,,6\n\"ice-mpm\",0.2,7,8,9\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(curves_go_from_coarse_to_fine, set_up, tear_down),
        cmocka_unit_test_setup_teardown(profiles_are_of_the_finest_cases, set_up, tear_down),
        cmocka_unit_test_setup_teardown(profiles_are_one_table, set_up, tear_down),
        cmocka_unit_test_setup_teardown(slopes_are_of_both_orders, set_up, tear_down),
        cmocka_unit_test_setup_teardown(as_many_panels_as_there_may_be, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
