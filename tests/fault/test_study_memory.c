/* Allocations of a whole study, and of a run to a tolerance, fail, at any place and all that follow: FLOE_NO_MEMORY with a message, and nothing left. The
 * program that is to run the cases fails too: that is their result. */
#include "check.h"

#include "base/memory.h"
#include "floe/floe.h"
#include "io/file.h"
#include "study/tolerance/tolerance.h"

#include <stdlib.h>
#include <string.h>

static floe_status attempt(context *ctx, const study_options *o, bool look)
{
    study *s;
    const floe_status status = study_run(&s, ctx, o);
    if (look) {
        assert_int_equal(status, FLOE_MISSED_BAR);
        assert_non_null(strstr(context_message(ctx), "4 of 4 cases have not come to their end"));
        context_clear(ctx);
        assert_int_equal(s->n, 4);
        assert_int_equal(s->n_groups, 2);
        for (size_t i = 0; i < s->n; i++) {
            assert_string_equal(batch_status_name(&s->run[i]), "failed");
            check_true(s->run[i].message[0] != '\0' && !s->run[i].ran);
        }
    }
    study_destroy(&s);
    return look ? FLOE_OK : status;
}

/* No case has an error to choose by. */
static floe_status attempt_tolerance(context *ctx, const study_options *o, bool look)
{
    tolerance *t;
    const tolerance_options of = {.study = *o, .dir = o->batch.dir, .tolerance = 0.01};
    const floe_status status = tolerance_run(&t, ctx, &of);
    if (look) {
        assert_int_equal(status, FLOE_MISSED_BAR);
        assert_non_null(strstr(context_message(ctx), "no case has an error 'eq13'"));
        context_clear(ctx);
    }
    tolerance_destroy(&t);
    return look ? FLOE_OK : status;
}

static void any_allocation_may_fail_of(floe_status (*attempt_it)(context *, const study_options *, bool),
                                       floe_status end)
{
    char dir[] = "/tmp/floe_test_XXXXXX", command[64];
    static const char *const axis[] = {"domain.cell=0.4,0.2", "coupling=mpm,ice-mpm"}, *const set[] = {"study=null"},
                             *const with_axes[] = {"study={axes: {coupling: [mpm, ice-mpm], domain.cell: [0.4, 0.2]}}"};
    const study_options o = {.name = "study",
                             .batch = {.deck = FLOE_SOURCE_DIR "/inputs/pressurized_cylinder.yaml",
                                       .jobs = 4,
                                       .program = "/bin/false",
                                       .dir = dir},
                             .set = {attempt_it == attempt ? set : with_axes, 1},
                             .axis = axis,
                             .n_axis = attempt_it == attempt ? 2 : 0,
                             .repeat = 2};
    context *ctx = context_create();
    floe_status status = FLOE_NO_MEMORY;
    uint64_t n = 1, tries = 0;
    assert_non_null(mkdtemp(dir));
    assert_int_equal(floe_init(), FLOE_OK);
    /* Some thousands of allocations, most of them in decks, whose own test fails each: the steps grow. */
    for (; status == FLOE_NO_MEMORY; n += 1 + n / 8, tries++) {
        memory_inject_failure(ctx, n);
        status = attempt_it(ctx, &o, false);
        memory_inject_failure(ctx, 0);
        if (status != end) check_fails(ctx, status, FLOE_NO_MEMORY);
        assert_int_equal(memory_read_account(ctx).live_bytes, 0);
        context_clear(ctx);
    }
    check_true(tries > 20);
    assert_int_equal(status, end);
    check_ok(ctx, attempt_it(ctx, &o, true));
    assert_int_equal(memory_read_account(ctx).live_bytes, 0);
    context_destroy(&ctx);
    (void)snprintf(command, sizeof command, "rm -rf '%s'", dir);
    assert_int_equal(system(command), 0);
}

static void any_allocation_of_a_study_may_fail(void **state)
{
    (void)state;
    any_allocation_may_fail_of(attempt, FLOE_MISSED_BAR);
}

static void any_allocation_of_a_tolerance_may_fail(void **state)
{
    (void)state;
    any_allocation_may_fail_of(attempt_tolerance, FLOE_MISSED_BAR);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(any_allocation_of_a_study_may_fail),
                                       cmocka_unit_test(any_allocation_of_a_tolerance_may_fail)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
