/* Springs beside fluids on cells (theory 4.13): a piston on a spring between two columns of gas against the frequencies of all three, and a rigid cylinder on a
 * spring in water against its added mass. */
#include "coupled_fixture.h"

#include "mpm/mpm.h"

static const double pi = 3.14159265358979323846;

static const double gas_density = 1e5 / (0.4 * 717.5 * 300.0), stiffness = 4e5,
                    piston_mass = 50.0; /* of a square metre */

/* m w^2 = k + 2 rho c w cot(w L / c), with columns of length 1 m: the lowest w. */
static double piston_frequency(void)
{
    const double c = sqrt(1.4 * 0.4 * 717.5 * 300.0);
    double lo = 50.0, hi = 300.0;
    for (int k = 0; k < 100; ++k) {
        const double w = 0.5 * (lo + hi);
        if (piston_mass * w * w > stiffness + 2.0 * gas_density * c * w / tan(w / c))
            hi = w;
        else
            lo = w;
    }
    return lo;
}

/* A body starts at its turn: the time at which its centre has passed the middle of its swing for the second time is three quarters of its period. */
static double period_of(trial *t, int axis, double middle, double latest)
{
    double before = NAN, when = 0.0;
    int passed = 0;
    while (t->sim->time < latest) {
        mpm_totals sum;
        check_ok(t->ctx, mpm_sum(t->sim->mpm, &sum));
        const double way = sum.moment[0][axis] / sum.mass[0] - middle, now = t->sim->time;
        if (!isnan(before) && way * before < 0.0 && ++passed == 2)
            return (now - (now - when) * way / (way - before)) / 0.75;
        before = way;
        when = now;
        check_ok(t->ctx, sim_step(t->sim, INFINITY));
    }
    return NAN;
}

static double piston_error(solid_interface interface, bool rigid, int cells)
{
    const double size[3] = {2.2, 0.0, 0.0}, middle = 1.1 - 0.01 * stiffness / (stiffness + 2.8e5);
    trial t;
    coupled_begin(&t, 1, size, 1.0 / cells);
    t.scene->method.interface = interface;
    const int steel = coupled_solid(&t, 1e8, 5e7, 250.0);
    scene_body *b = coupled_body(&t, steel, make_box(&t, (const double[3]){1.0}, (const double[3]){1.2}), 2);
    if (rigid) b->motion = (scene_motion){.kind = MOTION_RIGID, .about = {NAN, NAN, NAN}, .axis = {0.0, 0.0, 1.0}};
    scene_spring *spring = &t.scene->spring[t.scene->n_springs++];
    (void)snprintf(spring->name, sizeof spring->name, "spring");
    spring->stiffness = stiffness;
    spring->rest_length = 0.89;
    spring->end[0] = (scene_spring_end){.body = -1, .place = {0.2}};
    spring->end[1] = (scene_spring_end){.body = 0, .place = {1.1}};
    coupled_start(&t);
    const double error = period_of(&t, 0, middle, 0.06) * piston_frequency() / (2.0 * pi) - 1.0;
    print_message("piston, %s, %s, %d cells: period off by %.2g; momentum %.1e, energy %.1e\n",
                  interface == INTERFACE_SHARP ? "sharp" : "smeared", rigid ? "rigid" : "elastic", cells, error,
                  ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_X),
                  ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY));
    check_true(ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_X) < 1e-12);
    check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) < (interface == INTERFACE_SMEARED ? 3e-6
                                                                 : rigid                        ? 2.4e-10
                                                                                                : 6.6e-8));
    trial_end(&t);
    return fabs(error);
}

static void test_piston(void **unused)
{
    (void)unused;
    static const solid_interface interface[] = {INTERFACE_SHARP, INTERFACE_SMEARED};
    static const double bound[2][2][2] = {{{7.8e-4, 4e-4}, {1.4e-4, 1.4e-4}}, {{1.9e-2, 9.4e-3}, {1.46e-2, 7.4e-3}}};
    for (int i = 0; i < 2; ++i)
        for (int rigid = 0; rigid < 2; ++rigid) {
            check_true(piston_error(interface[i], rigid, 20) < bound[i][rigid][0]);
            check_true(piston_error(interface[i], rigid, 40) < bound[i][rigid][1]);
        }
}

/* Its added mass in this tank is 1.0733 of the water that it displaces (scripts/results/defaults/h5.py): a period of half a second. */
static void test_cylinder(void **unused)
{
    (void)unused;
    static const char *const cell[] = {"domain.cell=0.1", "domain.cell=0.05", "domain.cell=0.05"},
                             *const pressure[] = {"method.pressure=explicit", "method.pressure=explicit",
                                                  "method.pressure=implicit"};
    static const double bound[] = {2e-2, 4.8e-3, 9.8e-3};
    char spring[256];
    (void)snprintf(
        spring, sizeof spring,
        "springs={s: {from: {position: [0, 0.3]}, to: {body: cylinder, position: [0, 1.2]}, stiffness: %.10g, "
        "rest_length: 0.88}}",
        3.07326 * 1000.0 * 0.5 * pi * 0.04 * 16.0 * pi * pi);
    for (int k = 0; k < 3; ++k) {
        const char *set[] = {"loads=null",
                             "runs_as=null",
                             "bodies.cylinder.motion=rigid",
                             "method.interface=sharp",
                             "output.interval=null",
                             spring,
                             cell[k],
                             pressure[k]};
        trial t;
        deck_begin(&t, "defaults/h5_cylinder", set, sizeof set / sizeof *set);
        check_ok(t.ctx, sim_create(&t.sim, t.ctx, t.scene, COUPLING_ICE_MPM));
        const double error = period_of(&t, 1, 1.18, 0.45) / 0.5 - 1.0;
        print_message("cylinder on a spring, %s, %s: period off by %.2g; energy %.1e\n", cell[k], pressure[k], error,
                      ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY));
        check_true(fabs(error) < bound[k]);
        trial_end(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_piston),
        cmocka_unit_test(test_cylinder),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
