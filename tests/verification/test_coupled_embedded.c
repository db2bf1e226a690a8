/* A membrane around gas of the cells: nothing passes it, at rest and in a stream nothing happens, what the gas loses it
 * gains, a piston swings as it should, a circle comes to its exact rest; the same bits for any blocks, any threads and
 * after a restart. */
#include "embedded_fixture.h"

static const double pi = 3.14159265358979323846;

/* The membrane's strain as York has it, and points that keep all of their motion: nothing but damping takes energy. */
#define PLAIN \
    "bodies.skin.membrane.strain=null", "bodies.skin.membrane.smoothing=null", "method={basis: quadratic, flip: 1}"

/* ---- at rest ---- */

/* Two gases of one pressure and different densities, 1000 steps. A pressure of 1000 is even to 1e-13 of itself; what that gives the gas
 * in a step of 2e-5 through a cell of 0.1 is 2e-14 m/s, and 1000 of those are 2e-11 at worst. */
static void test_rest(void **unused)
{
    (void)unused;
    const char *set[] = {"materials.air={eos: {ideal: {gamma: 1.4, specific_heat: 1}}}",
                         "ambient={material: air, pressure: 1000, temperature: 700}",
                         "boundaries={x: symmetry, y: symmetry}", "damping=null", PLAIN};
    trial t;
    ice_totals before, after;
    sealed_begin(&t, "membrane_circle", set, 7);
    check_ok(t.ctx, ice_sum(t.sim->ice, &before));
    trial_steps(&t, 1000);
    check_ok(t.ctx, ice_sum(t.sim->ice, &after));
    for (int gas = 0; gas < 2; ++gas) {
        check_close_relative(after.mass[gas], before.mass[gas], 1e-13);
        check_close_relative(after.internal[gas], before.internal[gas], 1e-12);
        check_close(deviation_of(&t, C_VEL, gas, 0, 0.0).inside, 0.0, 2e-10);
        check_close(deviation_of(&t, C_VEL, gas, 1, 0.0).inside, 0.0, 2e-10);
        check_close(deviation_of(&t, C_RHO, gas, 0, 0.0).outside, 0.0, 0.0); /* none of it beyond the membrane */
    }
    trial_end(&t);
}

/* A plane membrane and the gases on its two sides are carried along, through two sides of cells. */
static void test_stream(void **unused)
{
    (void)unused;
    const char *set[] = {
        "domain={dim: 2, stress_state: plane_strain, lower: [0, 0], upper: [1, 0.3], cell: 0.05}",
        "boundaries={x: {lower: {inlet: {velocity: [10, 0], material: gas, pressure: 1000, temperature: 2500}}, upper: "
        "free}, "
        "y: slip}",
        "materials.air={eos: {ideal: {gamma: 1.4, specific_heat: 1}}}",
        "materials.gas.viscosity=null",
        "bodies.gas={material: gas, shape: {box: {lower: [0, 0], upper: [0.313, 0.3]}}, pressure: 1000, density: 1, "
        "velocity: "
        "[10, 0]}",
        "bodies.air={material: air, shape: {box: {lower: [0, 0], upper: [1, 0.3]}}, pressure: 1000, temperature: 700, "
        "velocity: [10, 0]}",
        "bodies.skin.velocity=[10, 0]",
        "bodies.skin.membrane.curve={segment: {from: [0.313, 0], to: [0.313, 0.3]}}",
        "damping=null",
        PLAIN};
    trial t;
    sealed_begin(&t, "membrane_circle", set, 12);
    trial_run(&t, 0.012);
    for (int gas = 0; gas < 2; ++gas) {
        check_close(deviation_of(&t, C_VEL, gas, 0, 10.0).inside, 0.0, 2e-12);
        check_close(deviation_of(&t, C_VEL, gas, 1, 0.0).inside, 0.0, 2e-12);
        check_close_relative(deviation_of(&t, C_RHO, gas, 0, 0.0).inside, gas == 0 ? 1.0 : 1000.0 / 280.0, 1e-11);
    }
    trial_end(&t);
}

/* ---- the balance of gas and membrane ---- */

/* A quarter of a round membrane at rest around gas that holds what damping has left of its energy E: p r = E' eps t and p pi r^2/4/(gamma -
 * 1) + E' eps^2 L t/2 = E with eps = ln(r/r0); the pressure, and the radius. */
static double pressure_at_rest(double energy, double *radius)
{
    const double r0 = 0.5, modulus = 1e6 / (1.0 - 0.09), thickness = 0.1, length = 0.5 * pi * r0;
    double lo = r0, hi = 1.1 * r0, pressure = 0.0;
    while (hi - lo > 1e-15) {
        const double r = 0.5 * (lo + hi), eps = log(r / r0);
        pressure = modulus * eps * thickness / r;
        const double total = pressure * 0.25 * pi * r * r / 0.4 + 0.5 * modulus * eps * eps * length * thickness;
        *(total < energy ? &lo : &hi) = r;
    }
    *radius = lo;
    return pressure;
}

/* Sulsky and York 2000, section 8. Measured: pressure -0.006 %, radius -0.003 % (the swing at t = 0.06), energy 4.4e-7. */
static void test_circle(void **unused)
{
    (void)unused;
    trial t;
    const char *set[] = {PLAIN};
    double x[3], pressure, radius;
    sealed_begin(&t, "membrane_circle", set, 3);
    trial_run(&t, 0.0025); /* outward at full speed: the scale of the drifts */
    check_ok(t.ctx, sim_update_ledger(t.sim));
    trial_run(&t, 0.06);
    check_ok(t.ctx, sim_update_ledger(t.sim));
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MASS) < 1e-13);
    check_true(ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_Y) < 1e-12);
    check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) < 8e-7);
    const double damped = t.sim->ledger.entry[LEDGER_ENERGY][LEDGER_DAMPING].value;
    const double rest = pressure_at_rest(1000.0 * 0.25 * pi * 0.25 / 0.4 + damped, &radius);
    mpm_membrane_end(t.sim->mpm, 0, false, x);
    check_ok(t.ctx, ice_mean_pressure(t.sim->ice, 0, NULL, &pressure));
    print_message("damping took %.4g; pressure %.6g for %.6g, radius %.7g for %.7g\n", damped, pressure, rest,
                  hypot(x[0], x[1]), radius);
    check_close_relative(hypot(x[0], x[1]), radius, 6.4e-5);
    check_close_relative(pressure, rest, 9e-5);
    check_close(deviation_of(&t, C_RHO, 0, 0, 0.0).outside, 0.0, 0.0);
    trial_end(&t);
}

/* York 2000, section 4.2: half a period after the blow the piston passes its place again. 886.43 rad/s; measured with cells of 2: the
 * period of three swings 2e-5; one crossing, of steps of 1e-6, is timed to 3e-4. */
static void test_piston(void **unused)
{
    (void)unused;
    const char *set[] = {"domain.cell=[2, 1]"};
    trial t;
    double x[3] = {0.0, 0.0, 0.0};
    sealed_begin(&t, "piston_membrane", set, 1);
    do {
        check_ok(t.ctx, sim_step(t.sim, INFINITY));
        mpm_membrane_end(t.sim->mpm, 0, true, x);
    } while (x[0] < 20.0 && t.sim->time < 0.01);
    check_close_relative(t.sim->time, pi / 886.43, 8e-5);
    trial_end(&t);
}

/* ---- more than one membrane ---- */

#define SECOND_DISC(centre, radius, gas_radius, state)                                                              \
    "bodies.more={material: other, shape: {ball: {centre: [" centre ", 0.5], radius: " gas_radius "}}, " state "}", \
        "bodies.second={material: skin, membrane: {curve: {circle: {centre: [" centre ", 0.5], radius: " radius     \
        "}}, thickness: 0.1, number: 91, encloses: other}}"

/* Two discs of gas, each of its own kind, in a third; `air` sets its pressure. */
static void two_discs(trial *t, const char *air, int blocks)
{
    const char *set[] = {"domain={dim: 2, stress_state: plane_strain, lower: [0, 0], upper: [2, 1], cell: 0.1}",
                         "boundaries={x: symmetry, y: symmetry}",
                         "verify=null",
                         "damping=null",
                         "materials.air={eos: {ideal: {gamma: 1.4, specific_heat: 1}}}",
                         "materials.other={eos: {ideal: {gamma: 1.67, specific_heat: 1}}}",
                         air,
                         "bodies.gas.shape={ball: {centre: [0.5, 0.5], radius: 0.33}}",
                         "bodies.skin.membrane={curve: {circle: {centre: [0.5, 0.5], radius: 0.32}}, thickness: 0.1, "
                         "number: 91, encloses: "
                         "gas}",
                         SECOND_DISC("1.09", "0.25", "0.26", "pressure: 1000, density: 2"),
                         "method={basis: quadratic, flip: 1}"};
    deck_begin(t, "membrane_circle", set, sizeof set / sizeof *set);
    t->scene->mesh.blocks[0] = blocks;
    use_threads(blocks);
    check_ok(t->ctx, sim_create(&t->sim, t->ctx, t->scene, COUPLING_ICE_MPM));
}

/* Three gases of one pressure, as in test_rest; some cells are cut by both membranes. */
static void test_two_rest(void **unused)
{
    (void)unused;
    trial t;
    ice_totals before, after;
    int shared = 0;
    two_discs(&t, "ambient={material: air, pressure: 1000, temperature: 700}", 1);
    const ice_embedded_boundary *line = t.sim->ice->embedded.boundary;
    for (int k = 0; k < line[0].place[CUT_NOW].n_cells; ++k)
        shared += cut_open(&line[1].place[CUT_NOW], line[0].place[CUT_NOW].cell[k].cell) > 0.0;
    assert_true(shared > 0);
    check_ok(t.ctx, ice_sum(t.sim->ice, &before));
    trial_steps(&t, 500);
    check_ok(t.ctx, ice_sum(t.sim->ice, &after));
    for (int gas = 0; gas < 3; ++gas) {
        check_close_relative(after.mass[gas], before.mass[gas], 1e-13);
        check_close_relative(after.internal[gas], before.internal[gas], 1e-12);
        for (int a = 0; a < 2; ++a) check_close(deviation_of(&t, C_VEL, gas, a, 0.0).inside, 0.0, 2e-10);
        check_close(deviation_of(&t, C_RHO, gas, 0, 0.0).outside, 0.0, 0.0);
    }
    trial_end(&t);
}

/* Both blow up, towards each other, in thinner air: each gas stays where it is, and the account closes; blocks and threads are no
 * matter. */
static void test_two_move(void **unused)
{
    (void)unused;
    state found[2];
    for (int k = 0; k < 2; ++k) {
        trial t;
        ice_totals before, after;
        two_discs(&t, "ambient={material: air, pressure: 100, temperature: 70}", k + 1);
        check_ok(t.ctx, ice_sum(t.sim->ice, &before));
        trial_run(&t, 0.003);
        check_ok(t.ctx, ice_sum(t.sim->ice, &after));
        for (int gas = 0; gas < 3; ++gas) {
            check_close_relative(after.mass[gas], before.mass[gas], 1e-13);
            check_close(deviation_of(&t, C_RHO, gas, 0, 0.0).outside, 0.0, 0.0);
        }
        check_ok(t.ctx, sim_update_ledger(t.sim));
        check_true(ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_Y) < 1e-12);
        const double energy = ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY);
        check_true(energy < 3e-4); /* measured 1.4e-4, which falls with the step */
        found[k] = state_of(t.sim);
        state_add_ledger(&found[k], t.sim);
        trial_end(&t);
    }
    same_state(&found[0], &found[1]);
    for (int k = 0; k < 2; ++k) state_free(&found[k]);
}

/* What there is to know of a bag: the pressure in it, its area, and the stress of its membrane. */
typedef struct bag {
    double mass, pressure, area, stress;
} bag;

static bag bag_of(trial *t, int body, int gas)
{
    membrane_enclosure enclosure;
    ice_totals sum;
    bag out;
    mpm_membrane_enclosure(t->sim->mpm, body, &enclosure);
    check_ok(t->ctx, ice_mean_pressure(t->sim->ice, gas, NULL, &out.pressure));
    check_ok(t->ctx, ice_sum(t->sim->ice, &sum));
    out.mass = sum.mass[gas];
    out.area = enclosure.size;
    out.stress = enclosure.stress;
    return out;
}

/* Two bags in a vacuum, nine cells apart, the second where the first is but for that: each does what the first does alone. What they
 * lose becomes heat of their gases, half of it each. */
static void test_two_as_one(void **unused)
{
    (void)unused;
    const char *set[] = {
        "domain={dim: 2, stress_state: plane_strain, lower: [0, 0], upper: [2, 1], cell: 0.1}",
        "verify=null",
        "bodies.gas.shape={ball: {centre: [0.5, 0.5], radius: 0.3}}",
        "bodies.skin.membrane.curve={circle: {centre: [0.5, 0.5], radius: 0.3}}",
        "materials.other={eos: {ideal: {gamma: 1.4, specific_heat: 1}}, viscosity: {shear: 0.2}}",
        "bodies.more={material: other, shape: {ball: {centre: [1.4, 0.5], radius: 0.3}}, pressure: 1000, density: 1}",
        "bodies.second={material: skin, membrane: {curve: {circle: {centre: [1.4, 0.5], radius: 0.3}}, thickness: 0.1, "
        "number: 91, strain: positions, smoothing: 0.05, encloses: other}}"};
    trial alone, both;
    sealed_begin(&alone, "membrane_circle", set, 4);
    trial_run(&alone, 0.004);
    sealed_begin(&both, "membrane_circle", set, sizeof set / sizeof *set);
    trial_run(&both, 0.004);
    const bag one = bag_of(&alone, 0, 0);
    assert_true(one.pressure < 997.0); /* of 1000: it has grown */
    for (int k = 0; k < 2; ++k) {
        const bag b = bag_of(&both, k, k);
        check_close_relative(b.mass, one.mass, 1e-13);
        check_close_relative(b.pressure, one.pressure, 1e-10);
        check_close_relative(b.area, one.area, 1e-10);
        check_close_relative(b.stress, one.stress, 2e-12);
        check_close(deviation_of(&both, C_RHO, k, 0, 0.0).outside, 0.0, 0.0);
    }
    trial_end(&alone);
    trial_end(&both);
}

/* ---- membranes inside others ---- */

#define DISC(name, gas, x, radius, gas_radius, density)                                                      \
    "materials." gas "={eos: {ideal: {gamma: 1.4, specific_heat: 1}}}",                                      \
        "bodies." gas "={material: " gas ", shape: {ball: {centre: [" x ", 0.5], radius: " gas_radius        \
        "}}, pressure: 1000, density: " density "}",                                                         \
        "bodies." name "={material: skin, membrane: {curve: {circle: {centre: [" x ", 0.5], radius: " radius \
        "}}, thickness: 0.1, number: 120, encloses: " gas "}}"

/* Five membranes around six gases of one pressure: three in each other, two beside them, as in test_rest. */
static void test_nested_rest(void **unused)
{
    (void)unused;
    static const char *const set[] = {
        "domain={dim: 2, stress_state: plane_strain, lower: [0, 0], upper: [2, 1], cell: 0.05}",
        "boundaries={x: symmetry, y: symmetry}",
        "verify=null",
        "damping=null",
        "method={basis: quadratic, flip: 1}",
        "materials.air={eos: {ideal: {gamma: 1.4, specific_heat: 1}}}",
        "ambient={material: air, pressure: 1000, temperature: 700}",
        "bodies.gas.shape={ball: {centre: [0.5, 0.5], radius: 0.15}}",
        "bodies.skin.membrane={curve: {circle: {centre: [0.5, 0.5], radius: 0.14}}, thickness: 0.1, number: 60, "
        "encloses: gas}",
        DISC("second", "b", "0.5", "0.28", "0.29", "2"),
        DISC("third", "c", "0.5", "0.42", "0.43", "3"),
        DISC("fourth", "d", "1.3", "0.25", "0.26", "4"),
        DISC("fifth", "e", "1.75", "0.15", "0.16", "5")};
    trial t;
    ice_totals before, after;
    sealed_begin(&t, "membrane_circle", set, sizeof set / sizeof *set);
    assert_int_equal(t.sim->ice->embedded.n_boundaries, 5);
    static const int within[] = {1, 2, -1, -1, -1};
    for (int l = 0; l < 5; ++l) assert_int_equal(t.sim->ice->embedded.boundary[l].within, within[l]);
    check_ok(t.ctx, ice_sum(t.sim->ice, &before));
    trial_steps(&t, 200);
    check_ok(t.ctx, ice_sum(t.sim->ice, &after));
    assert_int_equal(t.sim->ice->n_materials, 6);
    for (int gas = 0; gas < 6; ++gas) {
        check_close_relative(after.mass[gas], before.mass[gas], 1e-13);
        check_close_relative(after.internal[gas], before.internal[gas], 1e-12);
        for (int a = 0; a < 2; ++a) check_close(deviation_of(&t, C_VEL, gas, a, 0.0).inside, 0.0, 2e-10);
        check_close(deviation_of(&t, C_RHO, gas, 0, 0.0).outside, 0.0, 0.0);
    }
    trial_end(&t);
}

/* Two membranes about one centre, taut by a strain of a thousandth, from their exact rest: p_in - p_out = E/(1 - nu^2) t eps/r of each, with a
 * vacuum at 100 outside. */
static void test_nested_balance(void **unused)
{
    (void)unused;
    const double across = 1e6 / (1.0 - 0.09) * 0.1 * 1e-3, middle = 100.0 + across / 0.4,
                 inside = middle + across / 0.2;
    char more[160], gas[160];
    (void)snprintf(more, sizeof more,
                   "bodies.more={material: other, shape: {ball: {centre: [0, 0], radius: 0.4}}, pressure: %.17g, "
                   "density: 2}",
                   middle);
    (void)snprintf(
        gas, sizeof gas,
        "bodies.gas={material: gas, shape: {ball: {centre: [0, 0], radius: 0.2}}, pressure: %.17g, density: 1}",
        inside);
    const char *set[] = {
        "verify=null",
        "damping=null",
        "domain.cell=0.05",
        "reference_pressure=100",
        "materials.other={eos: {ideal: {gamma: 1.67, specific_heat: 1}}}",
        gas,
        more,
        "bodies.skin.membrane={curve: {arc: {centre: [0, 0], radius: 0.2, from: 0, to: 1.5707963267948966}}, "
        "thickness: 0.1, number: 60, slack: -0.001, encloses: gas}",
        "bodies.second={material: skin, membrane: {curve: {arc: {centre: [0, 0], radius: 0.4, from: 0, to: "
        "1.5707963267948966}}, thickness: 0.1, number: 120, slack: -0.001, encloses: other}}",
        "method={basis: quadratic, flip: 1}"};
    trial t;
    double p[2];
    sealed_begin(&t, "membrane_circle", set, sizeof set / sizeof *set);
    trial_run(&t, 0.002);
    check_ok(t.ctx, sim_update_ledger(t.sim));
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MASS) < 1e-13);
    check_true(ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_Y) < 1e-12);
    check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) < 8e-8);
    for (int k = 0; k < 2; ++k) check_ok(t.ctx, ice_mean_pressure(t.sim->ice, k, NULL, &p[k]));
    print_message("nested membranes at rest: pressures %.2e and %.2e off\n", p[0] / inside - 1.0, p[1] / middle - 1.0);
    check_close_relative(p[0], inside, 8e-6);
    check_close_relative(p[1], middle, 3e-6);
    trial_end(&t);
}

/* ---- gravity ---- */

/* A disc of light gas in a heavier one that starts at rest in its weight: the membrane bears the lift and the weight of what it encloses. */
static void test_lift(void **unused)
{
    (void)unused;
    static const char *const set[] = {
        "verify=null",
        "damping=null",
        "method={basis: quadratic, flip: 1}",
        "boundaries={x: symmetry, y: symmetry}",
        "materials.gas.viscosity=null",
        "materials.air={eos: {ideal: {gamma: 1.4, specific_heat: 1}}}",
        "ambient={material: air, pressure: 1000, temperature: 500}",
        "bodies.gas={material: gas, shape: {ball: {centre: [0.52, 0.49], radius: 0.31}}, pressure: 1000, temperature: "
        "2500}",
        "bodies.skin.membrane={curve: {circle: {centre: [0.52, 0.49], radius: 0.3}}, thickness: 0.1, number: 120, "
        "encloses: gas}",
        "loads={fall: {gravity: {acceleration: [0, -0.1]}}}"};
    trial t;
    ice_totals gases;
    mpm_totals points;
    membrane_enclosure in;
    sealed_begin(&t, "membrane_circle", set, sizeof set / sizeof *set);
    check_ok(t.ctx, ice_sum(t.sim->ice, &gases));
    mpm_membrane_enclosure(t.sim->mpm, 0, &in);
    trial_steps(&t, 1);
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &points));
    for (int gas = 0; gas < 2; ++gas)
        for (int a = 0; a < 2; ++a) check_close(deviation_of(&t, C_VEL, gas, a, 0.0).inside, 0.0, 2.5e-11);
    /* the air about it has the pressure at its centre in the mean */
    const double lift = 0.1 * (in.size * 1000.23 / (0.4 * 500.0) - gases.mass[0] - points.mass[0]);
    print_message("lift: %.2e off\n", points.momentum[0][1] / t.sim->mpm->dt / lift - 1.0);
    check_close_relative(points.momentum[0][1] / t.sim->mpm->dt, lift, 1e-7);
    trial_steps(&t, 100);
    check_ok(t.ctx, sim_update_ledger(t.sim));
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MASS) < 1e-13);
    check_true(ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_Y) < 1e-11);
    check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) < 2e-12);
    trial_end(&t);
}

/* A membrane across another, either way round: refused, with the place. */
static void test_two_crossed(void **unused)
{
    (void)unused;
    static const char *const curve[] = {"bodies.second.membrane.curve.circle={centre: [0.6, 0.5], radius: 0.31}",
                                        "bodies.second.membrane.curve.circle={centre: [0.75, 0.5], radius: 0.15}"};
    for (int k = 0; k < 2; ++k) {
        const char *set[] = {"verify=null",
                             "materials.other={eos: {ideal: {gamma: 1.67, specific_heat: 1}}}",
                             "materials.air={eos: {ideal: {gamma: 1.4, specific_heat: 1}}}",
                             "ambient={material: air, pressure: 100, temperature: 70}",
                             "bodies.skin.membrane.curve={circle: {centre: [0.5, 0.5], radius: 0.3}}",
                             SECOND_DISC("0.9", "0.08", "0.1", "pressure: 1000, density: 2"),
                             curve[k]};
        trial t;
        deck_begin(&t, "membrane_circle", set, sizeof set / sizeof *set);
        assert_int_equal(sim_create(&t.sim, t.ctx, t.scene, COUPLING_ICE_MPM), FLOE_BAD_INPUT);
        assert_non_null(strstr(context_message(t.ctx), "in cell ("));
        trial_end(&t);
    }
}

/* Said when the deck is read: two that hold one fluid, and more than there may be. */
static void test_two_refused(void **unused)
{
    (void)unused;
    static const char *const words[] = {"encloses 'other' already", "8 membranes enclose gas already"};
    static char more[14][200];
    const char *set[5 + 14] = {
        "verify=null", SECOND_DISC("0.2", "0.08", "0.1", "pressure: 1000, density: 2"),
        "bodies.third={material: skin, membrane: {curve: {circle: {centre: [0.5, 0.8], radius: 0.08}}, "
        "thickness: 0.1, number: 40, encloses: other}}",
        "materials.other={eos: {ideal: {gamma: 1.67, specific_heat: 1}}}"};
    for (int k = 0; k < 7; ++k) {
        (void)snprintf(more[2 * k], sizeof *more, "materials.g%d={eos: {ideal: {gamma: 1.4, specific_heat: 1}}}", k);
        (void)snprintf(more[2 * k + 1], sizeof *more,
                       "bodies.%s={material: skin, membrane: {curve: {circle: {centre: [0.1, %g], radius: 0.03}}, "
                       "thickness: 0.1, number: 40, encloses: g%d}}",
                       k == 0 ? "third" : (const char[]){'m', (char)('0' + k), 0}, 0.1 + 0.1 * k, k);
        set[5 + 2 * k] = more[2 * k];
        set[6 + 2 * k] = more[2 * k + 1];
    }
    const size_t n_set[] = {5, sizeof set / sizeof *set};
    for (int k = 0; k < 2; ++k) {
        context *ctx = context_create();
        deck_catalogue *catalogue;
        deck_report report = {0};
        scene *s = NULL;
        deck_init();
        check_ok(ctx, catalogue_create(&catalogue, ctx));
        assert_int_equal(deck_load(&s, ctx, FLOE_SOURCE_DIR "/inputs/membrane_circle.yaml",
                                   &(deck_overrides){set, n_set[k]}, catalogue, &report),
                         FLOE_BAD_INPUT);
        assert_non_null(strstr(report.text, words[k]));
        catalogue_destroy(ctx, &catalogue);
        deck_report_free(&report);
        context_destroy(&ctx);
    }
}

/* ---- the same bits ---- */

static void circle_begin(trial *t, int blocks)
{
    const char *set[] = {"domain.cell=0.05", "materials.air={eos: {ideal: {gamma: 1.4, specific_heat: 1}}}",
                         "ambient={material: air, pressure: 10, temperature: 7}"};
    deck_begin(t, "membrane_circle", set, 3);
    for (int a = 0; a < 2; ++a) t->scene->mesh.blocks[a] = blocks;
}

static state run(int blocks, int threads, const char *path)
{
    return run_in_halves(circle_begin, 50, blocks, threads, path);
}

static void test_bits(void **unused)
{
    (void)unused;
    same_bits_however_run(run);
}

/* What cannot be done is said before anything runs. */
static void test_refused(void **unused)
{
    (void)unused;
    static const char *const sets[][1] = {
        {"bodies.gas.shape={ball: {centre: [1, 1], radius: 0.2}}"},                           /* on the other side */
        {"bodies.skin.membrane.curve={arc: {centre: [0, 0], radius: 0.5, from: 0, to: 1}}"}}; /* open */
    for (int k = 0; k < 2; ++k) {
        trial t;
        deck_begin(&t, "membrane_circle", sets[k], 1);
        check_fails(t.ctx, sim_create(&t.sim, t.ctx, t.scene, COUPLING_ICE_MPM), FLOE_BAD_INPUT);
        trial_end(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rest),       cmocka_unit_test(test_stream),      cmocka_unit_test(test_circle),
        cmocka_unit_test(test_piston),     cmocka_unit_test(test_two_rest),    cmocka_unit_test(test_two_move),
        cmocka_unit_test(test_two_as_one), cmocka_unit_test(test_nested_rest), cmocka_unit_test(test_nested_balance),
        cmocka_unit_test(test_lift),       cmocka_unit_test(test_two_crossed), cmocka_unit_test(test_two_refused),
        cmocka_unit_test(test_bits),       cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
