/* Counted memory: alignment, zeroing, the account, overflow, injected failure, misuse. */
#include "check.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

static int setup(void **state)
{
    *state = context_create();
    return *state == NULL;
}

/* Every test leaves nothing live. */
static int teardown(void **state)
{
    context *ctx = *state;
    const uint64_t live = memory_read_account(ctx).live_bytes;
    context_destroy(&ctx);
    return live != 0;
}

static void is_aligned_and_zero(void **state)
{
    context *ctx = *state;
    for (size_t count = 0; count < 200; count += 7) {
        double *x = NULL;
        check_ok(ctx, memory_new(ctx, &x, count, sizeof *x));
        assert_non_null(x);
        assert_int_equal((uintptr_t)x % MEMORY_ALIGNMENT, 0);
        for (size_t i = 0; i < count; i++) assert_true(x[i] == 0.0);
        for (size_t i = 0; i < count; i++) x[i] = 1.0; /* a later block may reuse this storage */
        memory_free(ctx, &x);
        assert_null(x);
    }
}

static void resize_keeps_and_zeroes(void **state)
{
    context *ctx = *state;
    int *x = NULL;
    check_ok(ctx, memory_resize(ctx, &x, 3, sizeof *x)); /* from NULL: a new block */
    for (int i = 0; i < 3; i++) x[i] = i + 1;
    check_ok(ctx, memory_resize(ctx, &x, 100, sizeof *x));
    for (int i = 0; i < 100; i++) assert_int_equal(x[i], i < 3 ? i + 1 : 0);
    check_ok(ctx, memory_resize(ctx, &x, 2, sizeof *x));
    assert_int_equal(x[1], 2);
    assert_int_equal(memory_read_account(ctx).live_bytes, 2 * sizeof *x);
    memory_free(ctx, &x);
}

static void counts_bytes(void **state)
{
    context *ctx = *state;
    char *a = NULL;
    char *b = NULL;
    check_ok(ctx, memory_new(ctx, &a, 100, 1));
    check_ok(ctx, memory_new(ctx, &b, 10, 5));
    memory_account account = memory_read_account(ctx);
    assert_int_equal(account.allocations, 2);
    assert_int_equal(account.live_bytes, 150);
    memory_free(ctx, &a);
    memory_free(ctx, &b);
    account = memory_read_account(ctx);
    assert_int_equal(account.live_bytes, 0);
    assert_int_equal(account.peak_bytes, 150);
}

static void refuses_overflow(void **state)
{
    context *ctx = *state;
    char *x = NULL;
    check_fails(ctx, memory_new(ctx, &x, SIZE_MAX, 1), FLOE_NO_MEMORY);
    check_fails(ctx, memory_new(ctx, &x, SIZE_MAX / 2 + 2, 2), FLOE_NO_MEMORY);
    assert_null(x);
    check_ok(ctx, memory_new(ctx, &x, 4, 1));
    char *const before = x;
    check_fails(ctx, memory_resize(ctx, &x, SIZE_MAX / 4 + 1, 4), FLOE_NO_MEMORY);
    assert_ptr_equal(x, before);
    memory_free(ctx, &x);
}

static void injects_failure(void **state)
{
    context *ctx = *state;
    char *a = NULL;
    char *b = NULL;
    memory_inject_failure(ctx, 2);
    check_ok(ctx, memory_new(ctx, &a, 8, 1));
    strcpy(a, "kept");
    check_fails(ctx, memory_new(ctx, &b, 8, 1), FLOE_NO_MEMORY);
    assert_null(b);
    check_fails(ctx, memory_resize(ctx, &a, 80, 1), FLOE_NO_MEMORY);
    assert_string_equal(a, "kept");
    check_fails(ctx, memory_string(ctx, &b, "text"), FLOE_NO_MEMORY);
    assert_null(b);
    memory_inject_failure(ctx, 0);
    check_ok(ctx, memory_new(ctx, &b, 8, 1));
    assert_int_equal(memory_read_account(ctx).allocations, 2);
    memory_free(ctx, &a);
    memory_free(ctx, &b);
}

static void copies_strings(void **state)
{
    context *ctx = *state;
    char *copy = NULL;
    check_ok(ctx, memory_string(ctx, &copy, "membrane"));
    assert_string_equal(copy, "membrane");
    memory_free(ctx, &copy);
    check_ok(ctx, memory_string(ctx, &copy, ""));
    assert_string_equal(copy, "");
    memory_free(ctx, &copy);
    check_fails(ctx, memory_string(ctx, &copy, NULL), FLOE_INTERNAL);
    assert_null(copy);
}

static void tolerates_null(void **state)
{
    context *ctx = *state;
    char *x = NULL;
    memory_free(ctx, &x);
    memory_free(ctx, NULL);
    memory_inject_failure(NULL, 1);
    assert_int_equal(memory_read_account(NULL).live_bytes, 0);
    check_ok(NULL, memory_new(NULL, &x, 4, 4)); /* without a context: memory, but no account */
    memory_free(NULL, &x);
}

static void many_threads_count_exactly(void **state)
{
    enum { ROUNDS = 2000 };
    context *ctx = *state;
    int failures = 0;
#pragma omp parallel for num_threads(4) reduction(+ : failures)
    for (int i = 0; i < ROUNDS; i++) {
        double *x = NULL;
        if (memory_new(ctx, &x, (size_t)(i % 50), sizeof *x) != FLOE_OK) failures++;
        if (memory_resize(ctx, &x, 60, sizeof *x) != FLOE_OK) failures++;
        memory_free(ctx, &x);
    }
    assert_int_equal(failures, 0);
    const memory_account account = memory_read_account(ctx);
    assert_int_equal(account.allocations, 2 * ROUNDS);
    assert_int_equal(account.live_bytes, 0);
    check_true(account.peak_bytes >= 60 * sizeof(double) && account.peak_bytes <= 4 * 2 * 60 * sizeof(double));
}

#ifdef FLOE_DEBUG
static void note_leak(void *user, log_level level, const char *line)
{
    *(bool *)user = level == LOG_ERROR && strstr(line, "24 bytes") != NULL;
}

static void debug_build_reports_leak(void **state)
{
    (void)state;
    bool reported = false;
    context *ctx = context_create();
    context_set_sink(ctx, note_leak, &reported, LOG_ERROR);
    char *leak = NULL;
    check_ok(ctx, memory_new(ctx, &leak, 24, 1));
    context_destroy(&ctx);
    check_true(reported);
    memory_free(NULL, &leak); /* freed after all, for the leak checker of the sanitizer */
}
#endif

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(is_aligned_and_zero, setup, teardown),
        cmocka_unit_test_setup_teardown(resize_keeps_and_zeroes, setup, teardown),
        cmocka_unit_test_setup_teardown(counts_bytes, setup, teardown),
        cmocka_unit_test_setup_teardown(refuses_overflow, setup, teardown),
        cmocka_unit_test_setup_teardown(injects_failure, setup, teardown),
        cmocka_unit_test_setup_teardown(copies_strings, setup, teardown),
        cmocka_unit_test_setup_teardown(tolerates_null, setup, teardown),
        cmocka_unit_test_setup_teardown(many_threads_count_exactly, setup, teardown),
#ifdef FLOE_DEBUG
        cmocka_unit_test(debug_build_reports_leak),
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
