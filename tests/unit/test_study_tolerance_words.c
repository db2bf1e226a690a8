/* The table and the words of a run to a tolerance, exactly: three variants, of which two have run, one of whose cases has failed. */
#include "check.h"

#include "study/tolerance/tolerance_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { VARIANTS = 3, SPACINGS = 3, CASES = VARIANTS * SPACINGS };

typedef struct fixture {
    context *ctx;
    tolerance_options options;
    tolerance t;
    study s;
    study_case one[CASES];
    batch_case run[CASES];
    char group[VARIANTS][STUDY_LABEL];
    choose_curve curve[VARIANTS];
    choose_case list[CASES];
    size_t index[CASES];
} fixture;

static void put_case(fixture *f, size_t k, choose_state state, double seconds, double error)
{
    f->list[k].state = state;
    f->list[k].seconds = seconds;
    f->list[k].error = error;
    f->list[k].sure = state == CHOOSE_DONE;
    f->run[k].state = state == CHOOSE_OPEN ? BATCH_WAITING : BATCH_ENDED;
    f->run[k].ran = state != CHOOSE_OPEN;
    f->run[k].status = state == CHOOSE_FAILED ? FLOE_DIVERGED : FLOE_OK;
    f->run[k].summary.wall_seconds = state == CHOOSE_OPEN ? 0.0 : 2.0 * seconds;
}

/* mpm reaches 4 % on its second spacing, 1 % in 3 s on its third; ice-mpm reaches 1 % in 5 s, and its finest case diverged. */
static int set_up(void **state)
{
    static fixture f;
    static const char *const name[VARIANTS] = {"mpm", "ice-mpm", "ice"}, *const h[SPACINGS] = {"0.2", "0.1", "0.05"};
    f = (fixture){.ctx = context_create(), .options = {.tolerance = 0.01, .dir = "out"}};
    f.s = (study){
        .ctx = f.ctx, .list = f.one, .run = f.run, .n = CASES, .n_groups = VARIANTS, .group = f.group, .over = 1};
    f.s.axes.n = 2;
    f.s.axes.axis[0] = (scene_axis){.key = "coupling", .n_values = VARIANTS};
    f.s.axes.axis[1] = (scene_axis){.key = "domain.cell", .n_values = SPACINGS};
    for (int k = 0; k < CASES; k++) {
        const int g = k / SPACINGS, i = k % SPACINGS;
        (void)snprintf(f.s.axes.axis[0].value[g], SCENE_VALUE, "%s", name[g]);
        (void)snprintf(f.s.axes.axis[1].value[i], SCENE_VALUE, "%s", h[i]);
        (void)snprintf(f.group[g], STUDY_LABEL, "%s", name[g]);
        (void)snprintf(f.run[k].label, sizeof f.run[k].label, "%s, domain.cell=%s", name[g], h[i]);
        f.one[k] = (study_case){.pick = {g, i}, .group = (size_t)g, .h = 0.2 / (1 << i), .run = &f.run[k]};
        f.index[k] = (size_t)k;
        put_case(&f, (size_t)k, CHOOSE_OPEN, 0.0, NAN);
    }
    for (size_t g = 0; g < VARIANTS; g++)
        f.curve[g] = (choose_curve){.list = f.list + g * SPACINGS,
                                    .n = SPACINGS,
                                    .order = NAN,
                                    .reach_seconds = INFINITY,
                                    .wanted_h = NAN,
                                    .wanted_seconds = NAN};
    put_case(&f, 0, CHOOSE_DONE, 0.5, 0.16);
    put_case(&f, 1, CHOOSE_DONE, 1.25, 0.04);
    put_case(&f, 2, CHOOSE_DONE, 3.0, 0.0098);
    put_case(&f, 3, CHOOSE_DONE, 0.5, 0.03);
    put_case(&f, 4, CHOOSE_DONE, 5.0, 0.01);
    put_case(&f, 5, CHOOSE_FAILED, 7.5, NAN);
    f.curve[0].next = f.curve[1].next = SPACINGS;
    f.curve[0].standing = f.curve[1].standing = CHOOSE_SPENT;
    f.curve[2].standing = CHOOSE_SLOWER;
    f.curve[2].next_seconds = 9.0;
    (void)snprintf(f.s.exact, sizeof f.s.exact, "lame");
    f.t = (tolerance){.ctx = f.ctx,
                      .options = &f.options,
                      .study = &f.s,
                      .metric = "eq13",
                      .quantity = -1,
                      .curve = f.curve,
                      .list = f.list,
                      .index = f.index,
                      .step = {CHOOSE_REACHED, 0, 2},
                      .met = true,
                      .published = true};
    *state = &f;
    return 0;
}

static int tear_down(void **state)
{
    context_destroy(&((fixture *)*state)->ctx);
    return 0;
}

static void check_table(const fixture *f, const char *wanted)
{
    char text[4096] = "";
    FILE *file = tmpfile();
    assert_non_null(file);
    tolerance_print(&f->t, file);
    rewind(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    (void)fclose(file);
    assert_string_equal(text, wanted);
}

static void the_table_is_this(void **state)
{
    check_table(*state, "coupling  h               eq13        time\n"
                        "mpm       0.2         16.000 %       0.5 s\n"
                        "ice-mpm   0.2          3.000 %       0.5 s\n"
                        "mpm       0.1          4.000 %      1.25 s\n"
                        "mpm       0.05         0.980 %         3 s  chosen\n"
                        "ice-mpm   0.1          1.000 %         5 s\n"
                        "ice-mpm   0.05               -       7.5 s  diverged\n"
                        "not tried: ice, left: its next case alone is predicted to take 9 s\n"
                        "chosen: mpm, domain.cell=0.05, within the tolerance in 3 s; the next best, ice-mpm, took 5 s\n"
                        "error: 0.980 % (measured: eq13 against lame); all cases took 35.5 s\n");
}

static void check_reason(const fixture *f, const char *wanted)
{
    char text[TOLERANCE_TEXT];
    tolerance_reason(&f->t, text);
    assert_string_equal(text, wanted);
}

/* The next best is the one with the least time that has done it for sure, or is predicted to. */
static void the_next_best_is_known_or_predicted(void **state)
{
    fixture *f = *state;
    check_reason(f, "within the tolerance in 3 s; the next best, ice-mpm, took 5 s");
    f->curve[2].reach_seconds = 4.5;
    check_reason(f, "within the tolerance in 3 s; the next best, ice, is predicted to take 4.5 s");
    f->curve[0].reach_seconds = 0.1; /* of the chosen one's own nothing is said */
    f->curve[2].reach_seconds = 5.5;
    check_reason(f, "within the tolerance in 3 s; the next best, ice-mpm, took 5 s");
    f->list[4].sure = false;
    check_reason(f, "within the tolerance in 3 s; the next best, ice, is predicted to take 5.5 s");
    f->list[4].sure = true;
    f->list[4].state = CHOOSE_FAILED;
    check_reason(f, "within the tolerance in 3 s; the next best, ice, is predicted to take 5.5 s");
    f->list[4].state = CHOOSE_DONE;
    f->list[4].error = 0.0101;
    check_reason(f, "within the tolerance in 3 s; the next best, ice, is predicted to take 5.5 s");
    f->curve[2].reach_seconds = INFINITY;
    check_reason(f, "within the tolerance in 3 s; no other variant is known to reach it");
    f->s.n_groups = 1;
    check_reason(f, "within the tolerance in 3 s");
    f->t.met = false;
    check_reason(f, "the smallest error of all cases that were run");
}

static void check_left(const fixture *f, const char *wanted)
{
    char text[TOLERANCE_TEXT];
    tolerance_why_left(&f->t, 1, text);
    assert_string_equal(text, wanted);
}

static void what_was_left_is_said(void **state)
{
    fixture *f = *state;
    check_left(f, "its finest case");
    f->curve[1].standing = CHOOSE_BROKEN;
    check_left(f, "left: two of its cases have failed");
    f->curve[1].standing = CHOOSE_HOPELESS;
    check_left(f, "left: its finest case would not do");
    f->curve[1].standing = CHOOSE_RUNS;
    check_left(f, "");
    f->curve[1].standing = CHOOSE_SLOWER;
    f->curve[1].order = 1.5;
    check_left(f, "left: it is not predicted to reach the tolerance");
    f->curve[1].reach_seconds = 44.0;
    check_left(f, "left: the tolerance is predicted to take 44 s");
}

static void check_refusal(const fixture *f, const char *wanted)
{
    const floe_status status = tolerance_refuse(&f->t);
    assert_string_equal(context_message(f->ctx), wanted);
    check_fails(f->ctx, status, FLOE_MISSED_BAR);
    context_clear(f->ctx);
}

/* What would do it: of the variants with an extrapolation the fastest one. */
static void a_refusal_says_what_it_would_take(void **state)
{
    fixture *f = *state;
    f->options.tolerance = 0.001;
    f->t.met = false;
    f->t.step.action = CHOOSE_UNREACHED;
    check_refusal(
        f, "0.100 % in eq13 is not reached: the best is 0.980 %, mpm, domain.cell=0.05, which is what 'out' has");
    f->curve[0].wanted_h = 0.016;
    f->curve[0].wanted_seconds = 40.0;
    f->curve[0].order = 2.0;
    f->curve[1].wanted_h = 0.032;
    f->curve[1].wanted_seconds = 50.0;
    f->list[2].sure = false;
    check_refusal(f, "0.100 % in eq13 is not reached: the best is 0.980 % (not certain), mpm, domain.cell=0.05, which "
                     "is what 'out' has; by "
                     "extrapolation mpm would take h = 0.016 and 40 s (order 2): add finer values to the axis, the "
                     "same command goes on");
    f->options.budget = 60.0;
    f->t.step.action = CHOOSE_OUT_OF_TIME;
    f->curve[1].wanted_seconds = 30.0;
    f->curve[1].order = 1.5;
    check_refusal(f, "0.100 % in eq13 is not reached in 60 s: the best is 0.980 % (not certain), mpm, "
                     "domain.cell=0.05, which is what 'out' has; by "
                     "extrapolation ice-mpm would take h = 0.032 and 30 s (order 1.5): give it more time by --budget, "
                     "the same command goes on");
    f->t.step.curve = VARIANTS;
    check_refusal(f, "no case has an error 'eq13' after 60 s: give it more time by --budget, the same command goes on");
    f->t.step.action = CHOOSE_UNREACHED;
    check_refusal(f, "no case has an error 'eq13'");
    (void)snprintf(f->run[5].message, sizeof f->run[5].message, "no step is small enough");
    check_refusal(f, "no case has an error 'eq13'; ice-mpm, domain.cell=0.05: no step is small enough");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_table_is_this, set_up, tear_down),
        cmocka_unit_test_setup_teardown(the_next_best_is_known_or_predicted, set_up, tear_down),
        cmocka_unit_test_setup_teardown(what_was_left_is_said, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_refusal_says_what_it_would_take, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
