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
    assert_string_equal(floe_text(run, "coupling"), "ice");
    assert_string_equal(floe_text(run, "message"), "");
    assert_string_equal(floe_text(run, "status"), floe_run_status(run));
    assert_null(floe_text(run, "nothing"));
    assert_string_equal(floe_error_name(run, 0), "l1_density");
    assert_null(floe_error_name(run, 4));
    assert_null(floe_error_name(run, -1));
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

/* A run that is asked to stop before its first step ends in order. */
static void a_signal_stops_a_run(void **state)
{
    (void)state;
    const volatile sig_atomic_t stop = SIGTERM;
    char path[64], out[96];
    floe_context *floe = floe_create();
    floe_deck *deck;
    floe_run *run;
    assert_int_equal(floe_load(floe, sod, NULL, 0, &deck), FLOE_OK);
    (void)snprintf(out, sizeof out, "%s/out", folder(path));
    assert_int_equal(floe_execute(deck, &(floe_options){.directory = out, .stop = &stop}, &run), FLOE_INTERRUPTED);
    assert_string_equal(floe_run_status(run), "interrupted");
    assert_non_null(strstr(floe_message(floe), "SIGTERM"));
    floe_run_destroy(&run);
    floe_deck_destroy(&deck);
    floe_destroy(&floe);
}

static void a_deck_is_described(void **state)
{
    (void)state;
    static const char *const set[] = {"coupling=ice", "domain.cell=0.05"},
                             *const bad[] = {"study={axes: {domain.cell: [0.1, 0.3]}}"};
    char text[256] = "";
    floe_context *floe = floe_create();
    floe_deck *deck;
    floe_start start;
    FILE *file = tmpfile();
    assert_int_equal(floe_validate(floe, sod, set, 2, &deck), FLOE_OK);
    const floe_description d = floe_describe(deck);
    assert_string_equal(d.coupling, "ice");
    check_true(d.dimensionless && d.dimension == 1 && d.materials == 1 && d.bodies == 2 && d.compares);
    check_close(d.cells[0], 20.0, 1e-12);
    check_close(d.cells[1], 1.0, 0.0);
    assert_int_equal(floe_rehearse(deck, &start), FLOE_OK);
    check_true(start.ready && start.step > 0.0 && start.steps > 1.0 && start.limit);
    check_close(start.cells, 20.0, 0.0);
    check_close(start.most_cells, 1e6, 0.0);
    assert_int_equal(floe_plan(deck, true, file), FLOE_OK);
    rewind(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    check_true(text[0] == '{' && strstr(text, "\"coupling\": \"ice\""));
    floe_deck_destroy(&deck);
    /* A single run takes nothing of the axes. */
    assert_int_equal(floe_load(floe, sod, bad, 1, &deck), FLOE_OK);
    floe_deck_destroy(&deck);
    assert_int_equal(floe_validate(floe, sod, bad, 1, &deck), FLOE_BAD_INPUT);
    assert_non_null(strstr(floe_message(floe), "\n"));
    assert_string_equal(strrchr(floe_message(floe), ':'), ": 1 error");
    (void)fclose(file);
    floe_destroy(&floe);
}

static void lists_have_names(void **state)
{
    (void)state;
    const char *doc = NULL;
    int n = 0;
    floe_context *floe = floe_create();
    for (; floe_list_name(n, &doc); n++) {
        FILE *file = tmpfile();
        assert_int_equal(floe_list(floe, floe_list_name(n, NULL), file), FLOE_OK);
        check_true(ftell(file) > 0 && doc && doc[0]);
        (void)fclose(file);
    }
    check_true(n > 10);
    assert_null(floe_list_name(-1, NULL));
    assert_int_equal(floe_list(floe, "nothing", stdout), FLOE_BAD_INPUT);
    assert_non_null(strstr(floe_message(floe), "nothing"));
    floe_destroy(&floe);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(runs_and_reads_values), cmocka_unit_test(errors_carry_messages),
        cmocka_unit_test(a_signal_stops_a_run),  cmocka_unit_test(a_deck_is_described),
        cmocka_unit_test(lists_have_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
