/* The public ring: a deck run by a program. */
#include "check.h"

#include "floe/floe.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char sod[] = FLOE_SOURCE_DIR "/inputs/sod.yaml";

/* A folder of this process alone; what is in it stays for the system to clear. */
static const char *folder(char path[64])
{
    (void)snprintf(path, 64, "/tmp/floe-test-XXXXXX");
    assert_non_null(mkdtemp(path));
    return path;
}

static void runs_and_reads_values(void **state)
{
    (void)state;
    static const char *const set[] = {"coupling=ice", "domain.cell=0.05"};
    char path[64], out[96];
    floe_context *floe = floe_create();
    floe_deck *deck;
    floe_run *run;
    assert_int_equal(floe_init(), FLOE_OK);
    assert_int_equal(floe_init(), FLOE_OK);
    assert_int_equal(floe_load(floe, sod, set, 2, &deck), FLOE_OK);
    (void)snprintf(out, sizeof out, "%s/out", folder(path));
    assert_int_equal(floe_execute(deck, &(floe_options){.directory = out, .threads = 1}, &run), FLOE_OK);
    assert_string_equal(floe_run_status(run), "done");
    check_true(floe_value(run, "steps") > 0.0);
    check_close(floe_value(run, "cells"), 20.0, 0.0);
    check_close_relative(floe_value(run, "time"), 0.143, 1e-12);
    check_true(floe_value(run, "errors.l1_density") > 0.0);
    check_true(floe_value(run, "conservation.mass") < 1e-13);
    check_true(isnan(floe_value(run, "errors.nothing")));
    check_true(isnan(floe_value(run, "nothing")));
    floe_run_destroy(&run);
    floe_deck_destroy(&deck);
    floe_destroy(&floe);
    assert_null(floe);
}

static void errors_carry_messages(void **state)
{
    (void)state;
    static const char *const set[] = {"domain.cel=1"};
    floe_context *floe = floe_create();
    floe_deck *deck;
    floe_run *run;
    assert_int_equal(floe_init(), FLOE_OK);
    assert_int_equal(floe_load(floe, "/nowhere/at/all.yaml", NULL, 0, &deck), FLOE_IO);
    assert_non_null(strstr(floe_message(floe), "/nowhere/at/all.yaml"));
    assert_int_equal(floe_load(floe, sod, set, 1, &deck), FLOE_BAD_INPUT);
    assert_null(deck);
    assert_non_null(strstr(floe_message(floe), "cell"));
    assert_int_equal(floe_load(floe, sod, NULL, 0, &deck), FLOE_OK);
    assert_string_equal(floe_message(floe), "");
    assert_int_equal(floe_execute(deck, NULL, &run), FLOE_BAD_INPUT);
    assert_null(run);
    floe_run_destroy(&run);
    floe_deck_destroy(&deck);
    floe_deck_destroy(&deck);
    floe_destroy(&floe);
    floe_destroy(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(runs_and_reads_values),
        cmocka_unit_test(errors_carry_messages),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
