/* Steps of points that are solved for, in motion: what damping takes is in the ledger. */
#include "mpm_fixture.h"

static void solve_motion(trial *t, double end, long steps)
{
    t->scene->time.solver = SOLVER_IMPLICIT;
    t->scene->time.increments = steps;
    t->scene->time.end = end;
    trial_start(t);
    trial_run(t, end);
    assert_int_equal(t->sim->steps, steps);
}

/* A block in flight in a viscous bath: its velocity decays by the rule of the middle, and what the bath takes of momentum and energy is entered. */
static void damped_flight(void **unused)
{
    (void)unused;
    enum { STEPS = 4 };
    const double rate = 6.0, end = 0.2, half = 0.5 * rate * end / STEPS;
    for (int dim = 1; dim <= 3; ++dim) {
        trial t;
        trial_begin(&t, dim, (const double[3]){1.2, 0.5, 0.5}, 0.1);
        t.scene->damping.rate = rate;
        scene_body *b = add_body(&t, add_solid(&t, "neo_hookean", 1e6, 0.6e6, 1000.0),
                                 make_box(&t, (const double[3]){0.1, 0.1, 0.1}, (const double[3]){0.3, 0.4, 0.3}), 2);
        b->velocity[0] = 2.0;
        solve_motion(&t, end, STEPS);
        const double v[3] = {2.0 * pow((1.0 - half) / (1.0 + half), STEPS)};
        const body_sums sums = sum_body_points(&t, 0, v);
        const ledger *l = &t.sim->ledger;
        const double left = 0.5 * sums.mass * v[0] * v[0], lost = 0.5 * sums.mass * 4.0 - left;
        print_message("%d-D: velocity off by %.1e; %.12g J lost, %.12g entered; ledger off by %.1e\n", dim,
                      sums.largest_error, lost, -l->entry[LEDGER_ENERGY][LEDGER_DAMPING].value,
                      ledger_worst(&t, LEDGER_MASS, LEDGER_ENERGY));
        check_true(sums.largest_error <= 1e-12);
        check_close_relative(l->entry[LEDGER_ENERGY][LEDGER_DAMPING].value, -lost, 1e-12);
        check_close_relative(l->entry[LEDGER_MOMENTUM_X][LEDGER_DAMPING].value, sums.mass * (v[0] - 2.0), 1e-12);
        check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_ENERGY) <= 1e-12);
        trial_end(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(damped_flight),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
