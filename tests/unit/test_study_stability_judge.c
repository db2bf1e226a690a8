/* Energies of a history: what is growth, and what a load, a wall or a gas has paid for. */
#include "check.h"

#include "study/stability/stability_judge.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define NAMES                                                                                                   \
    "time (s),steps,dt_limit,kinetic (J),strain (J),internal (J),kinetic_steel (J),ledger_energy_boundary (J)," \
    "ledger_energy_source (J)\n"

static energy_record energies_of(const char *text)
{
    context *ctx = context_create();
    csv_table history;
    check_ok(ctx, csv_parse(&history, ctx, text));
    const energy_record e = energy_read(&history);
    csv_free(&history);
    context_destroy(&ctx);
    return e;
}

static void test_growth(void **state)
{
    (void)state;
    const energy_record e =
        energies_of(NAMES "0,0,\"\",2,0,0,2,0,0\n1,1,\"a, b\",1,1,0,1,0,0\n2,2,\"c\",300,100,0,300,0,0\n"
                          "3,3,\"c\",1,1,0,1,0,0\n");
    check_true(e.judged && e.finite);
    assert_int_equal(e.rows, 4);
    check_close(e.ratio, 200.0, 0.0); /* the largest, not the last; a comma in quotes is no end of a field */
    check_close(e.last_time, 3.0, 0.0);
}

/* Work of loads and walls, and what a gas gives by expanding, is no growth; what has been there once still counts. */
static void test_what_is_paid_for(void **state)
{
    (void)state;
    check_close(energies_of(NAMES "0,0,\"\",0,0,0,0,0,0\n1,1,\"\",3,2,0,3,0,5\n").ratio, 1.0, 1e-15);
    check_close(energies_of(NAMES "0,0,\"\",0,0,0,0,0,0\n1,1,\"\",3,2,0,3,4,1\n").ratio, 1.0, 1e-15);
    check_close(energies_of(NAMES "0,0,\"\",0,0,100,0,0,0\n1,1,\"\",8,0,92,8,0,0\n").ratio, 1.0, 1e-15);
    check_close(energies_of(NAMES "0,0,\"\",0,0,100,0,0,0\n1,1,\"\",80,0,92,80,0,0\n").ratio, 10.0, 1e-13);
    check_close(energies_of(NAMES "0,0,\"\",1,0,0,1,0,9\n1,1,\"\",10,0,0,10,0,0\n").ratio, 1.0, 1e-15);
    /* what is taken out does not make room */
    check_close(energies_of(NAMES "0,0,\"\",4,0,0,4,0,0\n1,1,\"\",4,0,0,4,-3,0\n").ratio, 1.0, 1e-15);
}

/* A gas at rest stirs by round-off. */
static void test_rest(void **state)
{
    (void)state;
    check_true(energies_of(NAMES "0,0,\"\",0,0,1e5,0,0,0\n1,1,\"\",1e-20,0,1e5,1e-20,0,0\n").ratio < 1e-10);
    check_close(energies_of(NAMES "0,0,\"\",0,0,0,0,0,0\n1,1,\"\",0,0,0,0,0,0\n").ratio, 0.0, 0.0);
    /* motion from nothing is growth without end */
    check_true(isinf(energies_of(NAMES "0,0,\"\",0,0,0,0,0,0\n1,1,\"\",1,0,0,1,0,0\n").ratio));
}

static void test_strange_histories(void **state)
{
    (void)state;
    check_true(!energies_of(NAMES "0,0,\"\",1,0,0,1,0,0\n1,1,\"\",nan,0,0,1,0,0\n").finite);
    check_true(!energies_of(NAMES "0,0,\"\",1,0,0,1,0,0\n1,1,\"\",inf,0,0,1,0,0\n").finite);
    check_true(!energies_of("time (s),kinetic (J)\n0,1\n").judged);
    check_true(!energies_of("").judged);
    assert_int_equal(energies_of(NAMES).rows, 0);
}

static void test_criterion(void **state)
{
    (void)state;
    char text[CRITERION_TEXT];
    criterion_text(100.0, true, text);
    check_true(strstr(text, "no step is rejected") && strstr(text, "below 100 times"));
    criterion_text(100.0, false, text);
    check_true(strstr(text, "not judged") && !strstr(text, "100"));
    for (int a = 0; a < VERDICT_COUNT; a++) {
        for (int b = 0; b < a; b++) {
            check_true(strcmp(verdict_name((verdict)a), verdict_name((verdict)b)) != 0);
            check_true(verdict_sign((verdict)a) != verdict_sign((verdict)b));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_growth),    cmocka_unit_test(test_what_is_paid_for),
        cmocka_unit_test(test_rest),      cmocka_unit_test(test_strange_histories),
        cmocka_unit_test(test_criterion),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
