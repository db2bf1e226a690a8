/* Gas along a wall of points at 30 degrees to the mesh, periodic both ways: with `tangential: free` it keeps most of its momentum
 * along the wall, which one velocity in the mixed cells takes; across the wall it is constrained as before. */
#include "coupled_fixture.h"

/* Momentum that the wall has gained along and across itself, over that of the gas at the start. */
typedef struct gain {
    double along, across;
} gain;

static gain blow(const char *tangential, const char *velocity, double end)
{
    static const double tangent[2] = {0.86602540378443865, 0.5};
    trial t;
    const char *const set[] = {tangential, velocity, "domain.cell=[0.0481125224324688, 0.05]"};
    deck_begin(&t, "slip_wall", set, 3);
    coupled_start(&t);
    sim_totals now;
    check_ok(t.ctx, sim_sum(t.sim, &now));
    const double gas = 50.0 * now.ice.mass[0];
    trial_run(&t, end);
    check_ok(t.ctx, sim_sum(t.sim, &now));
    gain out = {0.0, 0.0};
    for (int b = 0; b < t.sim->mpm->n_bodies; ++b) {
        const double *p = now.mpm.momentum[b];
        out.along += (p[0] * tangent[0] + p[1] * tangent[1]) / gas;
        out.across += (p[1] * tangent[0] - p[0] * tangent[1]) / gas;
    }
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MASS) <= 1e-14);
    check_true(ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_Y) <= 1e-12);
    trial_end(&t);
    return out;
}

/* 50 m/s along the wall for 2 ms, two cells' way: measured 6.7 % lost, against 52 % to one velocity. */
static void test_along(void **unused)
{
    (void)unused;
    static const char along[] = "bodies.stream.velocity=[43.301270189221932, 25]";
    const gain slip = blow("exchange.wall.tangential=free", along, 2e-3),
               locked = blow("exchange.wall.tangential=locked", along, 2e-3);
    print_message("along the wall: it gains %.4f of the gas' momentum with slip, %.4f locked\n", slip.along,
                  locked.along);
    check_true(slip.along > 0.0 && slip.along < 0.08);
    check_true(slip.along < 0.15 * locked.along);
    check_true(fabs(slip.across) < 0.01);
}

/* 50 m/s onto it, for 0.2 ms: the wall must stop the gas as it does locked. */
static void test_across(void **unused)
{
    (void)unused;
    static const char onto[] = "bodies.stream.velocity=[25, -43.301270189221932]";
    const gain slip = blow("exchange.wall.tangential=free", onto, 2e-4),
               locked = blow("exchange.wall.tangential=locked", onto, 2e-4);
    print_message("onto the wall: it gains %.4f of the gas' momentum with slip, %.4f locked\n", -slip.across,
                  -locked.across);
    check_close(slip.across, locked.across, 0.0125 * fabs(locked.across));
    check_true(locked.across < -0.1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_along),
        cmocka_unit_test(test_across),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
