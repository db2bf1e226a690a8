/* The ledger: entries of a step count once it is final, sums do not lose the small, drifts are shares of the whole. */
#include "check.h"
#include "grid/ledger.h"

#include <string.h>

/* An account of 1 kg m/s along x and next to none along y. */
static void open_account(ledger *l)
{
    memset(l, 0, sizeof *l);
    l->initial[LEDGER_MOMENTUM_X] = l->total[LEDGER_MOMENTUM_X] = l->scale[LEDGER_MOMENTUM_X] = 1.0;
    l->scale[LEDGER_MOMENTUM_Y] = 1e-18;
}

static void a_rejected_step_leaves_nothing(void **state)
{
    (void)state;
    ledger l;
    open_account(&l);
    ledger_add(&l, LEDGER_MOMENTUM_X, LEDGER_SOURCE, 0.5);
    ledger_tally(&l, COUNT_FLOORS, 3);
    ledger_discard(&l);
    ledger_commit(&l);
    check_close(ledger_drift(&l, LEDGER_MOMENTUM_X), 0.0, 0.0);
    assert_int_equal(l.count[COUNT_FLOORS], 0);
    ledger_add(&l, LEDGER_MOMENTUM_X, LEDGER_SOURCE, 0.5);
    ledger_tally(&l, COUNT_FLOORS, 3);
    ledger_commit(&l);
    check_close(ledger_drift(&l, LEDGER_MOMENTUM_X), 0.5, 0.0);
    assert_int_equal(l.count[COUNT_FLOORS], 3);
    l.total[LEDGER_MOMENTUM_X] = 1.5;
    check_close(ledger_drift(&l, LEDGER_MOMENTUM_X), 0.0, 0.0);
}

/* A million entries of 1e-12, each below what 1e5 can hold to half of itself, are 1e-6. */
static void small_entries_are_not_lost(void **state)
{
    (void)state;
    ledger l;
    open_account(&l);
    ledger_add(&l, LEDGER_ENERGY, LEDGER_SOURCE, 1e5);
    ledger_commit(&l);
    for (int i = 0; i < 1000000; i++) {
        ledger_add(&l, LEDGER_ENERGY, LEDGER_SOURCE, 1e-12);
        ledger_commit(&l);
    }
    const ledger_sum *sum = &l.entry[LEDGER_ENERGY][LEDGER_SOURCE];
    check_close((sum->value - 1e5) + sum->carry, 1e-6, 1e-15);
}

/* Along an axis that is at rest, round-off is a share of the momentum there is, and not all of its own. */
static void momentum_is_one_vector(void **state)
{
    (void)state;
    ledger l;
    open_account(&l);
    l.total[LEDGER_MOMENTUM_Y] = 1e-18;
    check_close(ledger_drift(&l, LEDGER_MOMENTUM_Y), 1e-18, 1e-33);
    l.total[LEDGER_MOMENTUM_Z] = 1e-3;
    check_close(ledger_drift(&l, LEDGER_MOMENTUM_Z), 1e-3, 1e-18);
    l.scale[LEDGER_ENERGY] = 1e-30;
    l.total[LEDGER_ENERGY] = 1e-30;
    check_close(ledger_drift(&l, LEDGER_ENERGY), 1.0, 0.0);
    l.no_account[LEDGER_MOMENTUM_Z] = true;
    check_close(ledger_drift(&l, LEDGER_MOMENTUM_Z), 0.0, 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rejected_step_leaves_nothing),
        cmocka_unit_test(small_entries_are_not_lost),
        cmocka_unit_test(momentum_is_one_vector),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
