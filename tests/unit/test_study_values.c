/* Orders, limits, fronts, answers and bars of a study whose errors and times follow known laws. */
#include "check.h"

#include "base/memory.h"
#include "study/study_internal.h"

#include <math.h>
#include <string.h>

enum { GROUPS = 2, SPACINGS = 4, CASES = GROUPS * SPACINGS };

/* error = scale h^order, seconds = price h^-2, quantity = 3 + h^order */
typedef struct law {
    const char *name;
    double scale, order, price;
} law;
static const law laws[GROUPS] = {{"mpm", 0.5, 1.0, 0.01}, {"ice-mpm", 4.0, 2.0, 0.05}};

typedef struct fixture {
    context *ctx;
    study s;
    study_case list[CASES];
    batch_case run[CASES];
    char group[GROUPS][STUDY_LABEL];
} fixture;

static void fill_case(fixture *f, int g, int k)
{
    const double h = 0.2 / (1 << k);
    const size_t i = (size_t)(g * SPACINGS + k);
    study_case *one = &f->list[i];
    run_summary *r = &f->run[i].summary;
    *one = (study_case){.pick = {g, k}, .group = (size_t)g, .h = h, .over = h, .run = &f->run[i]};
    one->timing.least = laws[g].price / (h * h);
    one->timing.scatter = 0.01;
    one->quantity[0] = 3.0 + pow(h, laws[g].order);
    f->run[i].state = BATCH_ENDED;
    f->run[i].ran = true;
    r->point_updates = 1e3 / (h * h);
    r->n_errors = 1;
    r->errors[0] = (summary_value){"l2rel_density", laws[g].scale * pow(h, laws[g].order)};
    (void)snprintf(f->run[i].label, sizeof f->run[i].label, "%s, %g", laws[g].name, h);
}

static int set_up(void **state)
{
    static fixture f;
    f = (fixture){.ctx = context_create()};
    study *s = &f.s;
    *s = (study){
        .ctx = f.ctx, .list = f.list, .run = f.run, .n = CASES, .n_groups = GROUPS, .group = f.group, .over = 1};
    s->axes.n = 2;
    s->axes.axis[0] = (scene_axis){.key = "coupling", .value = {"mpm", "ice-mpm"}, .n_values = GROUPS};
    s->axes.axis[1] =
        (scene_axis){.key = "domain.cell", .value = {"0.2", "0.1", "0.05", "0.025"}, .n_values = SPACINGS};
    s->metric[s->n_metrics++] = "l2rel_density";
    s->plan.n_quantities = 1;
    (void)snprintf(s->plan.quantity[0], sizeof s->plan.quantity[0], "kinetic");
    for (int g = 0; g < GROUPS; g++) {
        (void)snprintf(f.group[g], sizeof f.group[g], "%s", laws[g].name);
        for (int k = 0; k < SPACINGS; k++) fill_case(&f, g, k);
    }
    *state = &f;
    return 0;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    context_destroy(&f->ctx);
    return 0;
}

static void orders_are_those_of_the_laws(void **state)
{
    const fixture *f = *state;
    for (size_t g = 0; g < GROUPS; g++) {
        const study_order o = study_order_of(&f->s, g, "l2rel_density");
        assert_int_equal(o.n, SPACINGS);
        check_close(o.order, laws[g].order, 1e-12);
        check_true(o.standard_error < 1e-6 && o.h[0] > o.h[SPACINGS - 1]);
        for (int k = 0; k < SPACINGS - 1; k++) check_close(o.pair[k], laws[g].order, 1e-12);
    }
    check_true(isnan(study_order_of(&f->s, 0, "eq13").order));
}

static void limits_are_those_of_the_laws(void **state)
{
    const fixture *f = *state;
    for (size_t g = 0; g < GROUPS; g++) {
        study_limit l;
        check_true(study_limit_of(&f->s, g, 0, &l));
        assert_int_equal(l.limit.kind, RICHARDSON_MONOTONE);
        check_close(l.limit.order, laws[g].order, 1e-6);
        check_close(l.limit.value, 3.0, 1e-6);
        /* The index bounds the error of the finest value with the safety factor. */
        check_close_relative(l.limit.gci_fine, GCI_SAFETY * pow(0.025, laws[g].order), 1e-6);
        assert_int_equal(l.fit.n, SPACINGS);
    }
}

/* A case that has diverged has no error, whatever its summary says, and is on no front. */
static void only_finished_cases_count(void **state)
{
    fixture *f = *state;
    study_limit l;
    f->run[SPACINGS - 1].status = FLOE_DIVERGED;
    f->list[SPACINGS - 1].quantity[0] = NAN;
    assert_int_equal(study_order_of(&f->s, 0, "l2rel_density").n, SPACINGS - 1);
    check_true(study_limit_of(&f->s, 0, 0, &l));
    assert_int_equal(l.fit.n, 0);
    check_true(isnan(study_error(&f->list[SPACINGS - 1], "l2rel_density")));
    check_true(!study_is_on_front(&f->s, SPACINGS - 1, "l2rel_density", STUDY_SECONDS));
}

static void front_is_what_nobody_beats(void **state)
{
    const fixture *f = *state;
    for (size_t i = 0; i < CASES; i++) {
        bool beaten = false;
        for (size_t j = 0; j < CASES; j++) {
            beaten = beaten || (study_error(&f->list[j], "l2rel_density") < study_error(&f->list[i], "l2rel_density") &&
                                f->list[j].timing.least < f->list[i].timing.least);
        }
        assert_int_equal(study_is_on_front(&f->s, i, "l2rel_density", STUDY_SECONDS), !beaten);
    }
    check_true(study_is_on_front(&f->s, 0, "l2rel_density", STUDY_SECONDS));
    check_true(study_is_on_front(&f->s, CASES - 1, "l2rel_density", STUDY_SECONDS));
}

/* Errors and times are power laws of h, and so of each other: the interpolation is exact. */
static double seconds_of(const law *l, double target)
{
    return l->price * pow(l->scale / target, 2.0 / l->order);
}

static void answers_follow_the_laws(void **state)
{
    const fixture *f = *state;
    study_answer a[STUDY_MAX_TARGETS];
    char text[256];
    const int n = study_answers(&f->s, "l2rel_density", a);
    bool both = false, alone = false;
    check_true(n >= 3);
    for (int k = 0; k < n; k++) {
        /* mpm reaches 0.0125 at best, ice-mpm 0.0025. */
        assert_int_equal(a[k].next == GROUPS, a[k].target < 0.0125);
        const double first = a[k].target < 0.0125 ? (double)INFINITY : seconds_of(&laws[0], a[k].target);
        const double second = seconds_of(&laws[1], a[k].target);
        check_close_relative(a[k].seconds, fmin(first, second), 1e-12);
        assert_int_equal(a[k].best, first < second ? 0 : 1);
        if (a[k].next < GROUPS) check_close_relative(a[k].next_seconds, fmax(first, second), 1e-12);
        both = both || a[k].next < GROUPS;
        alone = alone || a[k].next == GROUPS;
        study_answer_text(&f->s, &a[k], text, sizeof text);
        check_true(strstr(text, laws[a[k].best].name) && strstr(text, "% in l2rel_density choose"));
    }
    check_true(alone && both);
}

/* Times that overlap with what they may be off choose none; a tenth of the scatter, and they do. */
static void close_times_are_not_told_apart(void **state)
{
    fixture *f = *state;
    study_answer a[STUDY_MAX_TARGETS];
    char text[256];
    const law close = {"ice-mpm", laws[0].scale, laws[0].order, 1.2 * laws[0].price};
    for (size_t k = 0; k < SPACINGS; k++) {
        study_case *one = &f->list[SPACINGS + k];
        one->timing.least = close.price / (one->h * one->h);
        f->run[SPACINGS + k].summary.errors[0].value = close.scale * one->h;
    }
    for (int wide = 0; wide < 2; wide++) {
        for (size_t i = 0; i < CASES; i++) f->list[i].timing.scatter = wide ? 0.12 : 0.012;
        const int n = study_answers(&f->s, "l2rel_density", a);
        check_true(n >= 1);
        for (int k = 0; k < n && a[k].best < GROUPS; k++) {
            assert_int_equal(a[k].best, 0);
            assert_int_equal(study_answer_is_close(&a[k]), wide);
            study_answer_text(&f->s, &a[k], text, sizeof text);
            assert_int_equal(strstr(text, "are not told apart") != NULL, wide);
            assert_int_equal(strstr(text, "choose mpm") != NULL, !wide);
        }
    }
}

/* An error that passes through zero on a coarse mesh is not what the variant can do there. */
static void lucky_errors_do_not_count(void **state)
{
    fixture *f = *state;
    study_answer a[STUDY_MAX_TARGETS];
    f->run[0].summary.errors[0].value = 1e-5; /* mpm, h = 0.2; 0.05 at h = 0.1 */
    const int n = study_answers(&f->s, "l2rel_density", a);
    check_true(n >= 1 && a[n - 1].target < 0.0125); /* of what mpm has reached on its finest mesh */
    for (int k = 0; k < n; k++) check_true(a[k].target >= 0.0125 || a[k].best != 0);
}

/* A level below twice what the reference is good for is not offered; of errors that are none against it, it is. */
static void levels_end_above_the_reference(void **state)
{
    fixture *f = *state;
    study_answer a[STUDY_MAX_TARGETS];
    for (size_t i = 0; i < CASES; i++) f->run[i].summary.reference_accuracy = 0.004;
    const int n = study_answers(&f->s, "l2rel_density", a); /* ice-mpm comes to 0.0025 */
    check_true(n >= 1);
    for (int k = 0; k < n; k++) check_true(a[k].target >= 0.008);
    check_close(study_least_level(&f->s, "l2rel_density"), 0.008, 1e-15);
    check_true(study_least_level(&f->s, "rel_gas_pressure") == STUDY_ROUND_OFF);
    check_true(study_least_level(&f->s, "l2_density") == 0.0);
}

/* Nothing is chosen on round-off. */
static void round_off_chooses_nothing(void **state)
{
    fixture *f = *state;
    study_answer a[STUDY_MAX_TARGETS];
    for (size_t i = 0; i < CASES; i++) f->run[i].summary.errors[0].value *= 1e-12;
    assert_int_equal(study_answers(&f->s, "l2rel_density", a), 0);
    f->run[0].summary.errors[0].value = 1e-3;
    const int n = study_answers(&f->s, "l2rel_density", a);
    for (int k = 0; k < n; k++) check_true(a[k].target >= STUDY_ROUND_OFF);
}

static void nothing_is_extrapolated(void **state)
{
    fixture *f = *state;
    study_answer a[STUDY_MAX_TARGETS];
    char text[256];
    for (size_t i = 0; i < CASES; i++) f->run[i].summary.errors[0].value += 0.5; /* none below 50 % */
    const int n = study_answers(&f->s, "l2rel_density", a);
    check_true(n >= 1);
    assert_int_equal(a[n - 1].best, GROUPS);
    study_answer_text(&f->s, &a[n - 1], text, sizeof text);
    check_true(
        strstr(text, "no variant reaches 1 % in l2rel_density: the smallest error is 50.250 %, ice-mpm, 0.025") !=
        NULL);
}

static size_t judge(fixture *f, const scene_bar *bar, bool *all_met)
{
    study_bar_result *list;
    size_t n;
    f->s.plan.bar[0] = *bar;
    f->s.plan.n_bars = 1;
    check_ok(f->ctx, study_bars(&f->s, &list, &n));
    *all_met = true;
    for (size_t i = 0; i < n; i++) *all_met = *all_met && list[i].met;
    memory_free(f->ctx, &list);
    return n;
}

/* What is just reached is met, and by the next number not. */
static void bars_are_met_at_their_limit(void **state)
{
    fixture *f = *state;
    bool met;
    const double order = study_order_of(&f->s, 0, "l2rel_density").order, finest = 0.5 * 0.025;
    scene_bar bar = {.metric = "l2rel_density", .order = order, .error = NAN, .where = {.n = 1}};
    (void)snprintf(bar.where.key[0], SCENE_KEY, "coupling");
    (void)snprintf(bar.where.value[0], SCENE_VALUE, "mpm");
    assert_int_equal(judge(f, &bar, &met), 1);
    check_true(met);
    bar.order = nextafter(order, 2.0);
    assert_int_equal(judge(f, &bar, &met), 1);
    check_true(!met);
    bar.order = NAN;
    bar.error = f->run[SPACINGS - 1].summary.errors[0].value;
    check_close(bar.error, finest, 1e-15);
    assert_int_equal(judge(f, &bar, &met), 1);
    check_true(met);
    bar.error = nextafter(bar.error, 0.0);
    assert_int_equal(judge(f, &bar, &met), 1);
    check_true(!met);
}

/* Levels are 1, 2 and 5 times powers of ten, each once and the coarsest first; one per cent is among them wherever errors are larger, as the
 * last where it is none of the finest. Errors with a unit are asked in that. */
static void levels_are_round(void **state)
{
    fixture *f = *state;
    study_answer a[STUDY_MAX_TARGETS];
    char text[256];
    for (double scale = 1e-3; scale < 1e2; scale *= 3.7) {
        double most = 0.0;
        for (size_t i = 0; i < CASES; i++) {
            const double error = laws[i / SPACINGS].scale * pow(f->list[i].h, laws[i / SPACINGS].order) * scale;
            f->run[i].summary.errors[0].value = error;
            most = fmax(most, error);
        }
        const int n = study_answers(&f->s, "l2rel_density", a);
        int per_cents = 0;
        check_true(n >= 1);
        for (int k = 0; k < n; k++) {
            const double digit = a[k].target / pow(10.0, floor(log10(a[k].target) + 1e-9));
            check_true(fmin(fmin(fabs(digit - 1.0), fabs(digit - 2.0)), fabs(digit - 5.0)) < 1e-9);
            check_true(k == 0 || a[k].target < a[k - 1].target || (k == n - 1 && a[k].target == 0.01));
            check_true(a[k].target <= most);
            per_cents += fabs(a[k].target - 0.01) < 1e-12;
        }
        assert_int_equal(per_cents, most >= 0.01);
    }
    for (size_t i = 0; i < CASES; i++)
        (void)snprintf(f->run[i].summary.errors[0].name, sizeof f->run[i].summary.errors[0].name, "l2_density");
    const study_answer own = {"l2_density", 0.02, 1, GROUPS, 3.0, NAN, 0.0, 0.0};
    study_answer_text(&f->s, &own, text, sizeof text);
    check_true(strncmp(text, "for 0.02 ", 9) == 0 && strstr(text, "choose ice-mpm, 3 s; no other variant reaches it"));
}

static void bars_judge_groups_and_cases(void **state)
{
    fixture *f = *state;
    bool met;
    scene_bar order = {.metric = "l2rel_density", .order = 0.99, .error = NAN};
    assert_int_equal(judge(f, &order, &met), GROUPS);
    check_true(met);
    order.order = 1.5;
    assert_int_equal(judge(f, &order, &met), GROUPS);
    check_true(!met);
    check_fails(f->ctx, study_check_results(&f->s), FLOE_MISSED_BAR);
    order.where.n = 1;
    (void)snprintf(order.where.key[0], SCENE_KEY, "coupling");
    (void)snprintf(order.where.value[0], SCENE_VALUE, "ice-mpm");
    assert_int_equal(judge(f, &order, &met), 1);
    check_true(met);
    check_ok(f->ctx, study_check_results(&f->s));
    /* An error is asked of the finest case of each group, or of the cases that are named. */
    scene_bar error = {.metric = "l2rel_density", .order = NAN, .error = 0.0126};
    assert_int_equal(judge(f, &error, &met), GROUPS);
    check_true(met);
    error.where.n = 1;
    (void)snprintf(error.where.key[0], SCENE_KEY, "domain.cell");
    (void)snprintf(error.where.value[0], SCENE_VALUE, "5e-2");
    assert_int_equal(judge(f, &error, &met), GROUPS);
    check_true(!met);
    /* What was not measured is missed. */
    scene_bar none = {.metric = "eq13", .order = NAN, .error = 1.0};
    assert_int_equal(judge(f, &none, &met), GROUPS);
    check_true(!met);
    scene_bar limit = {.metric = "kinetic", .order = 0.99, .error = 0.02};
    assert_int_equal(judge(f, &limit, &met), 2 * GROUPS);
    check_true(met);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(orders_are_those_of_the_laws, set_up, tear_down),
        cmocka_unit_test_setup_teardown(limits_are_those_of_the_laws, set_up, tear_down),
        cmocka_unit_test_setup_teardown(only_finished_cases_count, set_up, tear_down),
        cmocka_unit_test_setup_teardown(front_is_what_nobody_beats, set_up, tear_down),
        cmocka_unit_test_setup_teardown(answers_follow_the_laws, set_up, tear_down),
        cmocka_unit_test_setup_teardown(close_times_are_not_told_apart, set_up, tear_down),
        cmocka_unit_test_setup_teardown(lucky_errors_do_not_count, set_up, tear_down),
        cmocka_unit_test_setup_teardown(levels_end_above_the_reference, set_up, tear_down),
        cmocka_unit_test_setup_teardown(round_off_chooses_nothing, set_up, tear_down),
        cmocka_unit_test_setup_teardown(nothing_is_extrapolated, set_up, tear_down),
        cmocka_unit_test_setup_teardown(bars_are_met_at_their_limit, set_up, tear_down),
        cmocka_unit_test_setup_teardown(levels_are_round, set_up, tear_down),
        cmocka_unit_test_setup_teardown(bars_judge_groups_and_cases, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
