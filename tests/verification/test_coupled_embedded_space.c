/* Membranes in space around gas of the cells: nothing passes them, at rest and in a stream nothing happens, a balloon bears the pressure that it
 * should and breathes with its exact period; the same bits for any blocks, any threads and after a restart. */
#include "embedded_fixture.h"

#include "io/checkpoint/checkpoint.h"
#include "io/io.h"

static const double pi = 3.14159265358979323846;

#define AIR "materials.air={eos: {ideal: {gamma: 1.4, specific_heat: 1}}}"
#define GAS "materials.gas={eos: {ideal: {gamma: 1.4, specific_heat: 1}}}"
/* Points that keep all of their motion. */
#define PLAIN "method={basis: quadratic, stress: usl, flip: 1}", "verify=null"

/* ---- at rest ---- */

/* Two gases of one pressure inside and outside of a whole sphere, anywhere in its cells. A pressure of 1000 is even to 1e-13 of itself, of which
 * 100 steps make at most 6e-12 m/s (test_coupled_embedded.c). */
static void test_rest(void **unused)
{
    (void)unused;
    static const char *const set[] = {
        AIR,
        PLAIN,
        "ambient={material: air, pressure: 1000, temperature: 700}",
        "domain={dim: 3, lower: [0, 0, 0], upper: [0.8, 0.8, 0.8], cell: 0.1}",
        "boundaries={x: symmetry, y: symmetry, z: symmetry}",
        "bodies.gas.shape={ball: {centre: [0.41, 0.38, 0.43], radius: 0.28}}",
        "bodies.skin.points=2",
        "bodies.skin.membrane={surface: {sphere: {centre: [0.41, 0.38, 0.43], radius: 0.27}}, thickness: 0.1, "
        "encloses: gas}"};
    trial t;
    ice_totals before, after;
    sealed_begin(&t, "membrane_sphere", set, sizeof set / sizeof *set);
    check_ok(t.ctx, ice_sum(t.sim->ice, &before));
    trial_steps(&t, 100);
    check_ok(t.ctx, ice_sum(t.sim->ice, &after));
    for (int gas = 0; gas < 2; ++gas) {
        check_close_relative(after.mass[gas], before.mass[gas], 1e-13);
        check_close_relative(after.internal[gas], before.internal[gas], 1e-12);
        for (int a = 0; a < 3; ++a) check_close(deviation_of(&t, C_VEL, gas, a, 0.0).inside, 0.0, 1e-10);
        check_close(deviation_of(&t, C_RHO, gas, 0, 0.0).outside, 0.0, 0.0);
    }
    trial_end(&t);
}

/* A plane membrane across a duct and the gases on its two sides are carried along, through two sides of cells. */
static void test_stream(void **unused)
{
    (void)unused;
    static const char *const set[] = {
        AIR,
        PLAIN,
        GAS,
        "domain={dim: 3, lower: [0, 0, 0], upper: [1, 0.2, 0.15], cell: 0.05}",
        "boundaries={x: {lower: {inlet: {velocity: [10, 0, 0], material: gas, pressure: 1000, temperature: 2500}}, "
        "upper: free}, y: slip, z: slip}",
        "bodies.gas={material: gas, shape: {box: {lower: [0, 0, 0], upper: [0.313, 0.2, 0.15]}}, pressure: 1000, "
        "density: 1, velocity: [10, 0, 0]}",
        "bodies.air={material: air, shape: {box: {lower: [0, 0, 0], upper: [1, 0.2, 0.15]}}, pressure: 1000, "
        "temperature: 700, velocity: [10, 0, 0]}",
        "bodies.skin={material: skin, velocity: [10, 0, 0], points: 2, membrane: {surface: {plane: {corner: [0.313, 0, "
        "0], first: [0, 0.2, 0], second: [0, 0, 0.15]}}, thickness: 0.1, encloses: gas}}"};
    trial t;
    sealed_begin(&t, "membrane_sphere", set, sizeof set / sizeof *set);
    trial_run(&t, 0.009);
    for (int gas = 0; gas < 2; ++gas) {
        for (int a = 0; a < 3; ++a)
            check_close(deviation_of(&t, C_VEL, gas, a, a == 0 ? 10.0 : 0.0).inside, 0.0, 2e-12);
        check_close_relative(deviation_of(&t, C_RHO, gas, 0, 0.0).inside, gas == 0 ? 1.0 : 1000.0 / 280.0, 1e-11);
    }
    trial_end(&t);
}

/* ---- one inside another, with weight ---- */

/* A sphere in a sphere, of gases that weigh 1, 2 and 5 at rest: of the inner membrane lift and weight are exact, and all stay in the account. */
static void test_nested(void **unused)
{
    (void)unused;
    static const char *const set[] = {
        "coupling=ice-mpm",
        AIR,
        PLAIN,
        GAS,
        "materials.other={eos: {ideal: {gamma: 1.4, specific_heat: 1}}}",
        "ambient={material: air, pressure: 1000, temperature: 500}",
        "domain={dim: 3, lower: [0, 0, 0], upper: [0.8, 0.8, 0.8], cell: 0.1}",
        "boundaries={x: symmetry, y: symmetry, z: symmetry}",
        "bodies.gas={material: gas, shape: {ball: {centre: [0.41, 0.38, 0.43], radius: 0.13}}, pressure: 1000, "
        "temperature: 2500}",
        "bodies.more={material: other, shape: {ball: {centre: [0.4, 0.4, 0.4], radius: 0.25}}, pressure: 1000, "
        "temperature: 1250}",
        "bodies.skin.points=2",
        "bodies.skin.membrane={surface: {sphere: {centre: [0.41, 0.38, 0.43], radius: 0.12}}, thickness: 0.1, "
        "encloses: gas}",
        "bodies.second={material: skin, points: 2, membrane: {surface: {sphere: {centre: [0.4, 0.4, 0.4], radius: "
        "0.24}}, thickness: 0.1, encloses: other}}",
        "loads={fall: {gravity: {acceleration: [0, 0, -0.1]}}}"};
    trial t;
    ice_totals before, after;
    mpm_totals points;
    membrane_enclosure in[2];
    sealed_begin(&t, "membrane_sphere", set, sizeof set / sizeof *set);
    assert_int_equal(t.sim->ice->embedded.boundary[0].within, 1);
    check_ok(t.ctx, ice_sum(t.sim->ice, &before));
    for (int k = 0; k < 2; ++k) mpm_membrane_enclosure(t.sim->mpm, k, &in[k]);
    trial_steps(&t, 1);
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &points));
    for (int gas = 0; gas < 3; ++gas)
        for (int a = 0; a < 3; ++a) check_close(deviation_of(&t, C_VEL, gas, a, 0.0).inside, 0.0, 4e-11);
    /* the gas between them presses on both; its weight, and that of all inside, is theirs. Walls are farther than their nodes reach */
    const double both = points.momentum[0][2] + points.momentum[1][2];
    const double enclosed =
        in[1].size * 1000.175 / (0.4 * 500.0) - (before.mass[0] + before.mass[2]) - points.mass[0] - points.mass[1];
    print_message("lift of both: %.3e off\n", both / t.sim->mpm->dt / (0.1 * enclosed) - 1.0);
    check_close_relative(both / t.sim->mpm->dt, 0.1 * enclosed, 1.2e-7);
    trial_steps(&t, 50);
    check_ok(t.ctx, ice_sum(t.sim->ice, &after));
    for (int gas = 0; gas < 3; ++gas) check_close_relative(after.mass[gas], before.mass[gas], 1e-13);
    check_ok(t.ctx, sim_update_ledger(t.sim));
    check_true(ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_Z) < 1e-11);
    trial_end(&t);
}

/* ---- the balance of gas and membrane ---- */

/* An eighth of the balloon of inputs/membrane_sphere.yaml from its exact rest, in a gas of 500: p_in - p_out = 2 sigma t/r. */
static void rest_of_balloon(const char *cell, double *pressure, double *stress)
{
    const char *const set[] = {
        AIR,
        "verify=null",
        cell,
        "ambient={material: air, pressure: 500, temperature: 2500}",
        "boundaries={x: symmetry, y: symmetry, z: symmetry}",
        "bodies.gas={material: gas, shape: {ball: {centre: [0, 0, 0], radius: 0.517445}}, pressure: 1384.042, density: "
        "0.902263}",
        "bodies.skin.points=2",
        "bodies.skin.membrane={surface: {sphere: {centre: [0, 0, 0], radius: 0.517445}}, thickness: 0.0933714, "
        "section: volume, slack: -0.0342933, encloses: gas}"};
    trial t;
    ice_totals before, after;
    membrane_enclosure in;
    sealed_begin(&t, "membrane_sphere", set, sizeof set / sizeof *set);
    check_ok(t.ctx, ice_sum(t.sim->ice, &before));
    trial_run(&t, 0.01);
    check_ok(t.ctx, ice_sum(t.sim->ice, &after));
    for (int gas = 0; gas < 2; ++gas) check_close_relative(after.mass[gas], before.mass[gas], 1e-13);
    check_ok(t.ctx, sim_update_ledger(t.sim));
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MASS) < 1e-13);
    check_true(ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_Z) < 1e-12);
    check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) <
               2.5e-7); /* measured 1.2e-7, which falls with the step */
    check_ok(t.ctx, ice_mean_pressure(t.sim->ice, 0, NULL, pressure));
    mpm_membrane_enclosure(t.sim->mpm, 0, &in);
    *pressure = *pressure / 1384.042 - 1.0;
    *stress = in.stress / 2449.52 - 1.0;
    print_message("balloon at rest: pressure %.2e, stress %.2e, volume %.2e off\n", *pressure, *stress,
                  in.size / (pi / 6.0 * pow(0.517445, 3.0)) - 1.0);
    trial_end(&t);
}

static void test_balloon(void **unused)
{
    (void)unused;
    double pressure[2], stress[2];
    rest_of_balloon("domain.cell=0.1", &pressure[0], &stress[0]);
    check_true(fabs(pressure[0]) < 8e-4);
    check_true(fabs(stress[0]) < 7e-3);
    if (!check_at_length()) return;
    rest_of_balloon("domain.cell=0.06", &pressure[1], &stress[1]);
    check_true(fabs(pressure[1]) < 0.5 * fabs(pressure[0])); /* second order: 0.36 */
    check_true(fabs(stress[1]) < 0.5 * fabs(stress[0]));
}

/* When the volume in the membrane is least, by the parabola through three steps. */
static double time_of_least_volume(trial *t, double latest)
{
    double volume[3] = {INFINITY, INFINITY, INFINITY}, time[3] = {0.0};
    while (!(volume[1] < volume[0] && volume[2] > volume[1])) {
        membrane_enclosure in;
        check_ok(t->ctx, sim_step(t->sim, INFINITY));
        assert_true(t->sim->time < latest);
        mpm_membrane_enclosure(t->sim->mpm, 0, &in);
        for (int k = 0; k < 2; ++k) {
            volume[k] = volume[k + 1];
            time[k] = time[k + 1];
        }
        volume[2] = in.size;
        time[2] = t->sim->time;
    }
    const double before = time[1] - time[0], after = time[2] - time[1];
    const double slope[2] = {(volume[1] - volume[0]) / before, (volume[2] - volume[1]) / after};
    return time[1] - (before * slope[1] + after * slope[0]) / (slope[1] - slope[0]) * 0.5;
}

/* Small swings of a sphere of the mass mu = 2 per area, stiffness k = 2 E t/((1 - nu) R^2), full of gas: mu w^2 = k - w^2 rho R/(z cot z - 1), z = w R/c,
 * which is w = 71.288 rad/s; the same gas without inertia would have 73.095. */
static double half_period(const char *cell)
{
    const char *const set[] = {
        PLAIN,
        GAS,
        cell,
        "reference_pressure=1000",
        "materials.skin={membrane: {plane_stress: {modulus: 2000, poisson_ratio: 0.3}}, density: 20}",
        "bodies.skin.points=2",
        "bodies.skin.membrane={surface: {sphere: {centre: [0, 0, 0], radius: 0.5}}, thickness: 0.1, slack: -0.002, "
        "encloses: gas}"};
    trial t;
    sealed_begin(&t, "membrane_sphere", set, sizeof set / sizeof *set);
    const double time = time_of_least_volume(&t, 0.06);
    trial_end(&t);
    return time;
}

static void test_breathing(void **unused)
{
    (void)unused;
    const double expected = pi / 71.288;
    const double coarse = half_period("domain.cell=0.1") / expected - 1.0;
    print_message("half period of a balloon: %.2e off at h = R/5\n", coarse);
    check_true(fabs(coarse) < 0.02);
    if (!check_at_length()) return;
    const double fine = half_period("domain.cell=0.06") / expected - 1.0;
    print_message("%.2e at R/8\n", fine);
    check_true(fabs(fine) < 0.4 * fabs(coarse));
}

/* ---- the same bits ---- */

static state run(int blocks, int threads, const char *path)
{
    const char *set[] = {AIR, "ambient={material: air, pressure: 10, temperature: 7}", "bodies.skin.points=2",
                         "domain.upper=[0.8, 0.8, 0.8]"};
    trial t;
    deck_begin(&t, "membrane_sphere", set, 4);
    for (int a = 0; a < 3; ++a) t.scene->mesh.blocks[a] = blocks;
    use_threads(threads);
    check_ok(t.ctx, sim_create(&t.sim, t.ctx, t.scene, COUPLING_ICE_MPM));
    trial_steps(&t, 5);
    if (path) { /* written, and read into another run with other blocks */
        check_ok(t.ctx, io_init(t.ctx));
        write_checkpoint(&t, path);
        trial_end(&t);
        deck_begin(&t, "membrane_sphere", set, 4);
        check_ok(t.ctx, sim_create(&t.sim, t.ctx, t.scene, COUPLING_ICE_MPM));
        read_checkpoint(&t, path);
    }
    trial_steps(&t, 5);
    return trial_finish(&t);
}

static void test_bits(void **unused)
{
    (void)unused;
    same_bits_however_run(run);
}

/* A surface that is open, or has no rows, encloses nothing. */
static void test_refused(void **unused)
{
    (void)unused;
    static const char *const surface[] = {"{cylinder: {centre: [0, 0, 0], radius: 0.4, from: 0, to: 0.5}}",
                                          "{points: {at: [[0.1, 0, 0.2], [0.1, 0.1, 0.2]], area: 0.02}}"};
    for (int k = 0; k < 2; ++k) {
        char membrane[256];
        (void)snprintf(membrane, sizeof membrane,
                       "bodies.skin.membrane={surface: %s, thickness: 0.1, encloses: gas, normals: quadric}",
                       surface[k]);
        const char *set[] = {"verify=null", membrane};
        trial t;
        deck_begin(&t, "membrane_sphere", set, 2);
        check_fails(t.ctx, sim_create(&t.sim, t.ctx, t.scene, COUPLING_ICE_MPM), FLOE_BAD_INPUT);
        print_message("%s\n", context_message(t.ctx));
        trial_end(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rest),      cmocka_unit_test(test_stream), cmocka_unit_test(test_balloon),
        cmocka_unit_test(test_breathing), cmocka_unit_test(test_nested), cmocka_unit_test(test_bits),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
