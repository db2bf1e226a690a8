/* What a check looks at: every row of a column, or the straight line between two; and what keeps to its bounds. */
#include "check.h"

#include "io/csv.h"
#include "study/study_internal.h"

#include <math.h>
#include <string.h>

static const char *const rows = "time (s),low first (m),high first (m),high last (m),hole (m)\n"
                                "0,-7,9,1,1\n"
                                "1,2,3,2,nan\n"
                                "2,4,-2,4,1\n"
                                "4,3,1,8,1\n";

static scene_check check_of(const char *column, double at, bool change)
{
    scene_check check = {.at = at, .change = change, .least = NAN, .most = NAN};
    (void)snprintf(check.of, sizeof check.of, "%s", column);
    return check;
}

static study_range look(const csv_table *t, const char *column, double at, bool change)
{
    const run_summary none = {.drift_mass = 0.25, .drift_momentum = 0.5, .drift_energy = 0.75};
    const scene_check check = check_of(column, at, change);
    return study_range_of(&check, &none, &none, t);
}

static void check_range(study_range r, double least, double most)
{
    check_close(r.least, least, 0.0);
    check_close(r.most, most, 0.0);
}

/* Extremes in the first row, between, and in the last one; less the first value where the change is asked for. */
static void every_row_counts(void **state)
{
    csv_table t;
    check_ok(*state, csv_parse(&t, *state, rows));
    check_range(look(&t, "low first", NAN, false), -7.0, 4.0);
    check_range(look(&t, "high first", NAN, false), -2.0, 9.0);
    check_range(look(&t, "high last", NAN, false), 1.0, 8.0);
    check_range(look(&t, "low first", NAN, true), 0.0, 11.0);
    check_range(look(&t, "high first", NAN, true), -11.0, 0.0);
    check_true(isnan(look(&t, "hole", NAN, false).least) && isnan(look(&t, "hole", NAN, false).most));
    check_true(isnan(look(&t, "none", NAN, false).least) && isnan(look(&t, "none", 0.5, false).most));
    check_range(look(&t, "drift_mass", NAN, false), 0.25, 0.25);
    check_range(look(&t, "drift_momentum", NAN, false), 0.5, 0.5);
    check_range(look(&t, "drift_energy", NAN, false), 0.75, 0.75);
    csv_free(&t);
    check_ok(*state, csv_parse(&t, *state, "time (s),x (m)\n3,7\n"));
    check_range(look(&t, "x", NAN, false), 7.0, 7.0);
    check_range(look(&t, "x", 1.0, false), 7.0, 7.0);
    csv_free(&t);
    check_ok(*state, csv_parse(&t, *state, "time (s),x (m)\n"));
    check_true(isnan(look(&t, "x", NAN, false).least) && isnan(look(&t, "x", 1.0, false).least));
    csv_free(&t);
}

/* At a share of the time: on rows, and on the straight line from one to the next. */
static void rows_are_joined_by_lines(void **state)
{
    static const double share[] = {0.0, 0.125, 0.25, 0.375, 0.5, 0.75, 0.875, 1.0};
    static const double value[] = {9.0, 6.0, 3.0, 0.5, -2.0, -0.5, 0.25, 1.0};
    csv_table t;
    check_ok(*state, csv_parse(&t, *state, rows));
    for (int k = 0; k < 8; ++k) {
        check_range(look(&t, "high first", share[k], false), value[k], value[k]);
        check_range(look(&t, "high first", share[k], true), value[k] - 9.0, value[k] - 9.0);
    }
    csv_free(&t);
}

/* What is just on a bound keeps to it, what is beyond breaks it, and what is no number keeps to nothing. */
static void bounds_are_met_on_them(void **unused)
{
    (void)unused;
    char why[BATCH_MESSAGE];
    scene_check check = check_of("x", NAN, false);
    check_true(study_keeps_to(&check, (study_range){-1e300, 1e300}, why));
    check.least = 1.0;
    check_true(study_keeps_to(&check, (study_range){1.0, 5.0}, why));
    check_true(!study_keeps_to(&check, (study_range){nextafter(1.0, 0.0), 5.0}, why) && strstr(why, "at least 1 "));
    check.most = 5.0;
    check_true(study_keeps_to(&check, (study_range){1.0, 5.0}, why));
    check_true(!study_keeps_to(&check, (study_range){1.0, nextafter(5.0, 6.0)}, why) && strstr(why, "at most 5 "));
    check_true(!study_keeps_to(&check, (study_range){NAN, 2.0}, why) && strstr(why, "no number"));
    check_true(!study_keeps_to(&check, (study_range){2.0, NAN}, why) && strstr(why, "no number"));
    check_true(!study_keeps_to(&check, (study_range){2.0, INFINITY}, why) && strstr(why, "no number"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(every_row_counts, check_make_context, check_drop_context),
        cmocka_unit_test_setup_teardown(rows_are_joined_by_lines, check_make_context, check_drop_context),
        cmocka_unit_test(bounds_are_met_on_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
