/* Contexts: messages, the log, status texts. */
#include "check.h"

#include <string.h>

typedef struct capture {
    int lines;
    log_level level;
    char last[CONTEXT_MESSAGE_SIZE];
} capture;

static void capture_line(void *user, log_level level, const char *line)
{
    capture *seen = user;
    seen->lines++;
    seen->level = level;
    snprintf(seen->last, sizeof seen->last, "%s", line);
}

static int setup(void **state)
{
    *state = context_create();
    return *state == NULL;
}

static int teardown(void **state)
{
    context *ctx = *state;
    context_destroy(&ctx);
    return ctx != NULL;
}

static void keeps_first_message(void **state)
{
    context *ctx = *state;
    assert_string_equal(context_message(ctx), "");
    assert_int_equal(fail(ctx, FLOE_RETRY, "J = %g at point %d", -0.5, 7), FLOE_RETRY);
    assert_int_equal(fail(ctx, FLOE_IO, "later"), FLOE_IO);
    assert_string_equal(context_message(ctx), "J = -0.5 at point 7");
    context_clear(ctx);
    assert_string_equal(context_message(ctx), "");
    check_fails(ctx, fail(ctx, FLOE_IO, "later"), FLOE_IO);
}

static void cuts_long_message(void **state)
{
    context *ctx = *state;
    char text[2 * CONTEXT_MESSAGE_SIZE];
    memset(text, 'x', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    (void)fail(ctx, FLOE_IO, "%s", text);
    const char *message = context_message(ctx);
    assert_int_equal(strlen(message), CONTEXT_MESSAGE_SIZE - 1);
    assert_string_equal(message + CONTEXT_MESSAGE_SIZE - 4, "...");
    context_clear(ctx);
}

static void failure_with_ok_is_internal(void **state)
{
    check_fails(*state, fail(*state, FLOE_OK, "misuse"), FLOE_INTERNAL);
}

static floe_status tried(context *ctx, floe_status first, int *reached)
{
    TRY(first);
    ++*reached;
    return fail(ctx, FLOE_IO, "second");
}

static void try_returns_first_failure(void **state)
{
    int reached = 0;
    assert_int_equal(tried(*state, FLOE_RETRY, &reached), FLOE_RETRY);
    assert_int_equal(reached, 0);
    check_fails(*state, tried(*state, FLOE_OK, &reached), FLOE_IO);
    assert_int_equal(reached, 1);
}

static void refusals_keep_their_key(void **state)
{
    context *ctx = *state;
    assert_int_equal(fail_key(ctx, KEY("time", "substeps"), "%d: too many", 9), FLOE_BAD_INPUT);
    assert_int_equal(fail_key(ctx, KEY("time", "end"), "only the first counts"), FLOE_BAD_INPUT);
    assert_string_equal(context_key(ctx), "time.substeps");
    assert_string_equal(context_cause(ctx), "9: too many");
    assert_string_equal(context_message(ctx), "time.substeps: 9: too many");
    assert_int_equal(fail_under(ctx, FLOE_BAD_INPUT, KEY("part", "b")), FLOE_BAD_INPUT);
    assert_string_equal(context_message(ctx), "part.b.time.substeps: 9: too many");
    context_clear(ctx);
    assert_string_equal(context_key(ctx), "");

    (void)fail(ctx, FLOE_BAD_INPUT, "no key is known here");
    assert_string_equal(context_key(ctx), "");
    assert_string_equal(context_cause(ctx), "no key is known here");
    assert_int_equal(fail_under(ctx, FLOE_RETRY, KEY("bodies")), FLOE_RETRY);
    assert_string_equal(context_key(ctx), "");
    assert_int_equal(fail_under(ctx, FLOE_BAD_INPUT, KEY("bodies", "bag")), FLOE_BAD_INPUT);
    assert_string_equal(context_message(ctx), "bodies.bag: no key is known here");
    context_clear(ctx);

    char name[2 * CONTEXT_KEY_SIZE], cause[2 * CONTEXT_MESSAGE_SIZE];
    memset(name, 'n', sizeof name - 1);
    memset(cause, 'c', sizeof cause - 1);
    name[sizeof name - 1] = cause[sizeof cause - 1] = '\0';
    (void)fail_key(ctx, KEY("bodies", name, "shape"), "%s", cause);
    assert_string_equal(context_key(ctx), "bodies");
    assert_true(strlen(context_message(ctx)) < CONTEXT_MESSAGE_SIZE);
    assert_string_equal(context_key(NULL), "");
    assert_string_equal(context_cause(NULL), "");
    assert_int_equal(fail_key(NULL, KEY("time"), "nobody listens"), FLOE_BAD_INPUT);
}

static void logs_up_to_detail(void **state)
{
    context *ctx = *state;
    capture seen = {0};
    context_log(ctx, LOG_ERROR, "nobody listens");
    context_set_sink(ctx, capture_line, &seen, LOG_INFO);
    context_log(ctx, LOG_DETAIL, "too detailed");
    assert_int_equal(seen.lines, 0);
    context_log(ctx, LOG_INFO, "step %d\n", 3);
    assert_int_equal(seen.lines, 1);
    assert_int_equal(seen.level, LOG_INFO);
    assert_string_equal(seen.last, "step 3");
    context_set_sink(ctx, NULL, NULL, LOG_INFO);
    context_log(ctx, LOG_ERROR, "nobody listens");
    assert_int_equal(seen.lines, 1);
}

static void many_threads_fail_and_log(void **state)
{
    enum { LINES = 1000 };
    context *ctx = *state;
    capture seen = {0};
    context_set_sink(ctx, capture_line, &seen, LOG_INFO);
#pragma omp parallel for num_threads(4)
    for (int i = 0; i < LINES; i++) {
        (void)fail(ctx, FLOE_RETRY, "point %04d", i);
        context_log(ctx, LOG_INFO, "line %d", i);
    }
    assert_int_equal(seen.lines, LINES);
    assert_int_equal(strlen(context_message(ctx)), strlen("point 0000"));
    context_set_sink(ctx, NULL, NULL, LOG_INFO);
    context_clear(ctx);
}

static void statuses_have_names(void **state)
{
    (void)state;
    assert_string_equal(status_name(FLOE_RETRY), "FLOE_RETRY");
    assert_string_equal(status_text(FLOE_OK), "done");
    assert_int_equal(status_exit(FLOE_OK), 0);
    assert_int_equal(status_exit(FLOE_BAD_INPUT), 2);
    for (int code = 0; code < (int)FLOE_STATUS_COUNT; code++) {
        assert_non_null(status_name((floe_status)code));
        assert_non_null(status_text((floe_status)code));
    }
    assert_string_equal(status_name(FLOE_STATUS_COUNT), "FLOE_INTERNAL");
}

static void tolerates_null(void **state)
{
    (void)state;
    context *none = NULL;
    context_destroy(NULL);
    context_destroy(&none);
    context_clear(NULL);
    context_log(NULL, LOG_ERROR, "nothing");
    context_set_sink(NULL, capture_line, NULL, LOG_INFO);
    assert_int_equal(fail(NULL, FLOE_IO, "nothing"), FLOE_IO);
    assert_string_equal(context_message(NULL), "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(keeps_first_message, setup, teardown),
        cmocka_unit_test_setup_teardown(cuts_long_message, setup, teardown),
        cmocka_unit_test_setup_teardown(failure_with_ok_is_internal, setup, teardown),
        cmocka_unit_test_setup_teardown(try_returns_first_failure, setup, teardown),
        cmocka_unit_test_setup_teardown(refusals_keep_their_key, setup, teardown),
        cmocka_unit_test_setup_teardown(logs_up_to_detail, setup, teardown),
        cmocka_unit_test_setup_teardown(many_threads_fail_and_log, setup, teardown),
        cmocka_unit_test(statuses_have_names),
        cmocka_unit_test(tolerates_null),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
