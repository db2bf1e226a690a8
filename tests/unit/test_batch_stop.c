/* A case that is asked to stop is waiting, even if it dies of the signal; one that dies of itself has ended. */
#include "check.h"

#include "batch/batch.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <unistd.h>

static volatile sig_atomic_t stop;

static void ask(int number)
{
    (void)number;
    stop = 1;
}

/* Runs one case whose program is a script in DIR. */
static floe_status run_script(const char *dir, const char *script, batch_case *one, context *ctx)
{
    static const char *const set[] = {"study=null"};
    char program[128];
    (void)snprintf(program, sizeof program, "%s/program", dir);
    FILE *file = fopen(program, "w");
    assert_non_null(file);
    (void)fprintf(file, "#!/bin/sh\n%s\n", script);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(chmod(program, 0700), 0);
    *one = (batch_case){.label = "one", .folder = "one", .set = set, .n_set = 1};
    const batch_options o = {.program = program,
                             .deck = FLOE_SOURCE_DIR "/inputs/sod.yaml",
                             .dir = dir,
                             .keep_finished = true,
                             .stop = &stop};
    return batch_run(ctx, &o, one, 1);
}

static void what_is_stopped_waits(void **state)
{
    (void)state;
    char dir[] = "/tmp/floe_test_XXXXXX", command[64];
    batch_case one;
    context *ctx = context_create();
    assert_non_null(ctx);
    assert_non_null(mkdtemp(dir));

    /* Nobody has asked: it was killed. */
    check_ok(ctx, run_script(dir, "kill -TERM $$", &one, ctx));
    assert_int_equal(one.state, BATCH_ENDED);
    assert_string_equal(batch_status_name(&one), "failed");
    assert_non_null(strstr(one.message, "killed by signal 15"));

    /* Asked to stop while it knows nothing of signals, as any process before it has a handler. */
    const struct itimerval soon = {.it_value = {.tv_usec = 200 * 1000}};
    assert_true(signal(SIGALRM, ask) != SIG_ERR);
    assert_int_equal(setitimer(ITIMER_REAL, &soon, NULL), 0);
    assert_int_equal(run_script(dir, "exec sleep 60", &one, ctx), FLOE_INTERRUPTED);
    assert_int_equal(one.state, BATCH_WAITING);
    assert_string_equal(batch_status_name(&one), "not_run");
    assert_int_equal(one.status, FLOE_INTERRUPTED);

    (void)snprintf(command, sizeof command, "rm -rf %s", dir);
    assert_int_equal(system(command), 0);
    context_destroy(&ctx);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_is_stopped_waits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
