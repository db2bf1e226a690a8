/* York's airbag (inputs/airbag_200.yaml, airbag_500.yaml) with its gas on the cells: nothing leaks, and what probe, bag and gas have of mass,
 * momentum and energy stays theirs, with a contact and against the pressure of the air, too. (Gas as points: test_mpm_airbag.c.) */
#include "embedded_fixture.h"

enum { BAG, PROBE }; /* the bodies of points */

typedef struct push_case {
    const char *deck, *set[9];
    size_t n_set;
    double least, most; /* m: how far the probe has moved in 10 ms */
} push_case;

static void push_in(const push_case *c)
{
    trial t;
    mpm_totals start, sum;
    ice_totals gas, later;
    membrane_enclosure enclosure;
    sealed_begin(&t, c->deck, c->set, c->n_set);
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &start));
    check_ok(t.ctx, ice_sum(t.sim->ice, &gas));
    mpm_membrane_enclosure(t.sim->mpm, BAG, &enclosure);
    /* what the bag encloses it fills, of the printed density */
    check_close_relative(gas.mass[0], 1.2156 * enclosure.size, 1e-12);
    trial_run(&t, 0.01);
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &sum));
    check_ok(t.ctx, ice_sum(t.sim->ice, &later));
    const double moved = (start.moment[PROBE][1] - sum.moment[PROBE][1]) / sum.mass[PROBE];
    const double energy = ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY);
    print_message("%s: probe down %.4f m, energy %.1e\n", c->deck, moved, energy);
    check_true(moved > c->least && moved < c->most);
    check_close_relative(later.mass[0], gas.mass[0], 1e-13);
    check_close(ice_mass_beyond(t.sim->ice, 0), 0.0, 0.0);
    check_true(energy < 1.5e-4);
    check_true(ledger_worst(&t, LEDGER_MOMENTUM_Y, LEDGER_MOMENTUM_Y) < 1e-12);
    trial_end(&t);
}

/* Gas as points: 0.0370 and 0.0437 m. */
static void test_small_probe(void **unused)
{
    (void)unused;
    push_in(&(push_case){.deck = "airbag_200", .least = 0.0363, .most = 0.0377});
}

static void test_large_probe(void **unused)
{
    (void)unused;
    push_in(&(push_case){.deck = "airbag_500", .least = 0.043, .most = 0.0447});
}

#define AIR                                                                                                \
    "reference_pressure=101300", "bodies.core.pressure=105300", "bodies.waist.pressure=105300",            \
        "bodies.inner.pressure=105300", "bodies.outer.pressure=105300", "bodies.shoulder.pressure=105300", \
        "bodies.rim.pressure=105300"

/* The air pushes on the bag from outside, which weighs in the momentum and works: both are in the ledger. */
static void test_air(void **unused)
{
    (void)unused;
    push_in(&(push_case){.deck = "airbag_500",
                         .set = {AIR, "contact={between: [bag, probe]}"},
                         .n_set = 8,
                         .least = 0.0445,
                         .most = 0.046});
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_small_probe), cmocka_unit_test(test_large_probe),
                                       cmocka_unit_test(test_air)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
