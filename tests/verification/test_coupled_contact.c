/* Two solids in gas on cells: what the exchange does not hold apart, a contact does. */
#include "coupled_fixture.h"

static double mean_velocity(const trial *t, int body)
{
    mpm_totals totals;
    check_ok(t->ctx, mpm_sum(t->sim->mpm, &totals));
    return totals.momentum[body][0] / totals.mass[body];
}

static int rubber(trial *t)
{
    const int solid = add_solid(t, "neo_hookean", 2e6, 1e6, 1000.0);
    t->scene->material[solid].specific_heat = 1800.0;
    t->scene->material[solid].tension_switch = COUPLED_PRESSURE;
    return solid;
}

/* Discs that meet head on at 5 m/s each; the velocity of the left one when all is over, and the worst drift of momentum. */
static double collide(bool contact, contact_kind kind, double exchange, double *drift)
{
    trial t;
    const double size[3] = {1.6, 0.6, 0.0};
    coupled_begin(&t, 2, size, 0.05);
    t.scene->method.exchange = exchange;
    t.scene->contact.enabled = contact;
    t.scene->contact.kind = kind;
    for (int k = 0; k < 2; ++k)
        coupled_body(&t, rubber(&t), make_ball(&t, (const double[]){k == 0 ? 0.5 : 1.1, 0.3, 0.0}, 0.22), 2)
            ->velocity[0] = k == 0 ? 5.0 : -5.0;
    coupled_start(&t);
    trial_run(&t, 0.04);
    const double v = mean_velocity(&t, 0);
    *drift = ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_Y);
    trial_end(&t);
    return v;
}

static void test_weak_exchange(void **unused)
{
    (void)unused;
    double drift;
    check_true(collide(false, CONTACT_STICK, 1e3, &drift) > 3.0); /* through each other */
    for (int kind = CONTACT_RELEASE; kind <= CONTACT_FRICTION; ++kind) {
        const double v = collide(true, (contact_kind)kind, 1e3, &drift);
        print_message("kind %d: %.3f m/s, drift of momentum %.1e\n", kind, v, drift);
        check_true(v < -3.0);
        check_true(drift <= 1e-12);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_weak_exchange),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
