/* Clocks never run backwards; the resident set holds what was touched. Speed is never tested here. */
#include "check.h"

#include "base/memory.h"
#include "base/timer.h"

#include <string.h>

static void wall_clock_is_monotonic(void **state)
{
    (void)state;
    double before = wall_seconds();
    for (int i = 0; i < 1000; i++) {
        const double now = wall_seconds();
        check_true(now >= before);
        before = now;
    }
}

static void cpu_clock_counts_work(void **state)
{
    (void)state;
    const double start = cpu_seconds();
    check_true(start >= 0.0);
    volatile double sum = 0.0;
    while (cpu_seconds() <= start) sum = sum + 1.0;
    check_true(cpu_seconds() > start);
}

static void peak_rss_grows_with_touched_memory(void **state)
{
    (void)state;
    const size_t size = 64u << 20;
    char *block = NULL;
    context *ctx = context_create();
    check_ok(ctx, memory_new(ctx, &block, size, 1));
    memset(block, 1, size);
    check_true(peak_rss_bytes() >= (long long)size);
    memory_free(ctx, &block);
    check_true(peak_rss_bytes() >= (long long)size); /* a peak stays */
    context_destroy(&ctx);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wall_clock_is_monotonic),
        cmocka_unit_test(cpu_clock_counts_work),
        cmocka_unit_test(peak_rss_grows_with_touched_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
