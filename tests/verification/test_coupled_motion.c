/* Bodies with a motion of their own beside fluids on cells (theory 4.17): a piston driven through gas against the relations of shock and fan, a fixed block
 * in gas at rest, the lift of water, a rigid cylinder let go in water against its added mass, and what is refused. */
#include "coupled_fixture.h"

#include "mpm/mpm.h"

static const double gamma_air = 1.4;

static void begin(trial *t, const char *deck, const char *const *set, size_t n, scene_coupling coupling)
{
    deck_begin(t, deck, set, n);
    check_ok(t->ctx, sim_create(&t->sim, t->ctx, t->scene, coupling));
}

/* Pressure before a piston less that behind it, over the pressure at rest; `mach`: its speed over that of sound. */
static double load_of_piston(double mach, double *shock)
{
    const double g = gamma_air, a = 0.25 * (g + 1.0) * mach;
    *shock = a + sqrt(a * a + 1.0);
    const double before = 1.0 + 2.0 * g / (g + 1.0) * (*shock * *shock - 1.0);
    return before - pow(1.0 - 0.5 * (g - 1.0) * mach, 2.0 * g / (g - 1.0));
}

/* Runs until the shock has gone 0.6 m; returns the error of the momentum that the drive has given, and checks the ledger. */
static double run_piston(const char *interface, scene_coupling coupling, double mach, double energy)
{
    char velocity[64], method[64];
    double shock;
    const double sound = sqrt(gamma_air * 0.4 * 717.5 * 300.0), load = 1e5 * load_of_piston(mach, &shock);
    (void)snprintf(velocity, sizeof velocity, "bodies.piston.motion.velocity=%.17g", mach * sound);
    (void)snprintf(method, sizeof method, "method.interface=%s", interface);
    const char *set[] = {velocity, method, "materials.steel.density=3"}; /* it does not matter */
    trial t;
    begin(&t, "defaults/f3_piston", set, 3, coupling);
    const double until = 0.6 / (shock * sound);
    trial_run(&t, until);
    const ledger_sum *given = &t.sim->ledger.entry[LEDGER_MOMENTUM_X][LEDGER_BOUNDARY];
    const double error = (given->value + given->carry) / (load * until) - 1.0;
    const double drift[] = {ledger_worst(&t, LEDGER_MASS, LEDGER_MASS),
                            ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_X),
                            ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY)};
    print_message("piston, %s %s, Mach %g: impulse off by %.2g; mass %.1e, momentum %.1e, energy %.1e\n",
                  coupling_name(coupling), interface, mach, error, drift[0], drift[1], drift[2]);
    check_true(drift[0] < 1e-12 && drift[1] < 1e-12 && drift[2] < energy);
    trial_end(&t);
    return fabs(error);
}

/* Measured: 2e-6, 1.9e-3, 5.1e-3: of a shock that starts at once, 0.03 of a cell. */
static void test_piston_sharp(void **unused)
{
    (void)unused;
    check_true(run_piston("sharp", COUPLING_ICE_MPM, 0.01, 1e-12) < 4e-6);
    check_true(run_piston("sharp", COUPLING_ICE_MPM, 1.0, 1e-12) < 3e-3);
    check_true(run_piston("sharp", COUPLING_ICE_MPM, 3.0, 1e-12) < 8e-3);
}

/* First order, and so is its energy. Measured: 8.5e-3, 3.8e-3, 4.5e-3; energy 6e-7, 6e-3, 2e-2. */
static void test_piston_smeared(void **unused)
{
    (void)unused;
    check_true(run_piston("smeared", COUPLING_ICE_MPM, 0.01, 1.3e-6) < 1.4e-2);
    check_true(run_piston("smeared", COUPLING_ICE_MPM, 1.0, 1.2e-2) < 6e-3);
    check_true(run_piston("smeared", COUPLING_ICE_MPM, 3.0, 4e-2) < 7e-3);
}

/* With artificial viscosity. Measured: 3.6e-3, 1.8e-2; energy 1.3e-6, 1.1e-5. */
static void test_piston_points(void **unused)
{
    (void)unused;
    check_true(run_piston("smeared", COUPLING_MPM, 0.01, 2.6e-6) < 7e-3);
    check_true(run_piston("smeared", COUPLING_MPM, 1.0, 2.2e-5) < 3.6e-2);
}

static const char still_block[] =
    "bodies.piston={material: steel, shape: {ball: {centre: [0.53, 0.48], radius: 0.213}}, "
    "motion: fixed}";
static const char square[] = "domain={dim: 2, lower: [0, 0], upper: [1, 1], cell: 0.05}";

/* Nothing pushes a fixed block, and the gas about it stays at rest. Measured: 1e-26 J of 2.5e5 J, 2e-11 N of 4e4 N. */
static void test_still(void **unused)
{
    (void)unused;
    for (int smeared = 0; smeared < 2; ++smeared) {
        const char *set[] = {square, "boundaries={x: slip, y: slip}", still_block,
                             smeared ? "method.interface=smeared" : "method.interface=sharp", "output.probes={}"};
        trial t;
        double force[3], moment[3];
        ice_totals gas;
        begin(&t, "defaults/f3_piston", set, 5, COUPLING_ICE_MPM);
        trial_run(&t, 1e-3);
        check_ok(t.ctx, ice_sum(t.sim->ice, &gas));
        check_true(mpm_motion_force(t.sim->mpm, 0, force, moment));
        print_message("block at rest: %.1e J, %.1e N\n", gas.kinetic[0], hypot(force[0], force[1]));
        check_true(gas.kinetic[0] < 1e-22 && hypot(force[0], force[1]) < 4e-10);
        trial_end(&t);
    }
}

/* The weight of the water that a fixed cylinder displaces; water of one temperature is heavier below, rho = rho_0 exp(g z/R'). Measured: 2.9e-3 and 7e-4 at
 * 2 and 4 cells of radius. */
static void test_lift(void **unused)
{
    (void)unused;
    const double weight = 1000.0 * 9.81 * 0.5 * 3.14159265358979323846 * 0.2 * 0.2;
    for (int k = 0; k < 2; ++k) {
        char cell[48];
        (void)snprintf(cell, sizeof cell, "domain.cell=%g", k == 0 ? 0.1 : 0.05);
        const char *set[] = {cell, "bodies.cylinder.motion=fixed", "method.interface=sharp"};
        trial t;
        double force[3], moment[3];
        begin(&t, "defaults/h5_cylinder", set, 3, COUPLING_ICE_MPM);
        trial_run(&t, 0.01);
        check_true(mpm_motion_force(t.sim->mpm, 0, force, moment));
        const double heavier = exp(9.81 * 0.8 / (3.4 * 1816.0 * 0.367655)); /* at the depth of its middle */
        print_message("lift off by %.2g\n", force[1] / (weight * heavier) - 1.0);
        check_close_relative(force[1], weight * heavier, k == 0 ? 5.8e-3 : 2e-3);
        trial_end(&t);
    }
}

/* A rigid cylinder, twice as heavy as the water, sinks 0.09975 m by its added mass (scripts/results/defaults/h5.py). Measured at 4 cells of radius: 0.54 % less. */
static void test_added_mass(void **unused)
{
    (void)unused;
    const char *set[] = {"bodies.cylinder.motion=rigid", "method.interface=sharp"};
    trial t;
    mpm_totals m;
    begin(&t, "defaults/h5_cylinder", set, 2, COUPLING_ICE_MPM);
    trial_run(&t, 0.25);
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &m));
    const double sunk = 1.2 - m.moment[0][1] / m.mass[0];
    print_message("a rigid cylinder sinks by %.5f m\n", sunk);
    check_close_relative(sunk, 0.0997515, 8e-3);
    check_true(ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_Y) < 1e-12);
    check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) < 1e-12);
    trial_end(&t);
}

static void refuse(const char *change, const char *change_too, const char *words)
{
    const char *set[] = {change, change_too};
    trial t;
    deck_begin(&t, "defaults/f3_piston", set, 2);
    check_true(sim_create(&t.sim, t.ctx, t.scene, COUPLING_ICE_MPM) == FLOE_BAD_INPUT);
    if (!strstr(context_message(t.ctx), words)) print_message("%s\n", context_message(t.ctx));
    check_true(strstr(context_message(t.ctx), words) != NULL);
    trial_end(&t);
}

static void test_refused(void **unused)
{
    (void)unused;
    refuse("bodies.piston.velocity=3", "method.interface=sharp", "leave 'velocity' out");
    refuse("bodies.piston.motion={velocity: 1, spin: 2, about: 1}", "method.interface=sharp", "along a line");
    refuse("bodies.block={material: steel, shape: {box: {lower: 1.3, upper: 1.5}}}", "method.interface=smeared",
           "a material of its own");
    refuse("time.solver=implicit", "time.increments=3", "take time.solver dynamic");
    refuse("bodies.piston.motion=rigid", "damping={rate: 10}", "leave the damping out");
    refuse("loads.push={traction: {body: piston, surface: {box: {lower: 0.9, upper: 1.1}}, pressure: 1e5}}",
           "method.interface=sharp", "leave the load out");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_piston_sharp),  cmocka_unit_test(test_piston_smeared),
        cmocka_unit_test(test_piston_points), cmocka_unit_test(test_still),
        cmocka_unit_test(test_lift),          cmocka_unit_test(test_added_mass),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
