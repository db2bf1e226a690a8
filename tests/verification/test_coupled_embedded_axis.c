/* A membrane around gas of the cells about an axis: at rest and in a stream nothing happens, a balloon and a tube come
 * to their exact rests, nothing passes; the same bits for any blocks. */
#include "embedded_fixture.h"

/* Points that keep all of their motion: nothing but damping takes energy. */
#define PLAIN "method={basis: quadratic, flip: 1}"
#define AIR "materials.air={eos: {ideal: {gamma: 1.4, specific_heat: 1}}}"

/* Two viscous gases of one pressure and different densities on the two sides of a ball, 1000 steps. A pressure of 1000 is even to 1e-13 of
 * itself, and so at most 2e-11 m/s come of it (test_coupled_embedded.c). */
static void test_rest(void **unused)
{
    (void)unused;
    static const char *const set[] = {AIR,
                                      PLAIN,
                                      "materials.air.viscosity={shear: 0.1}",
                                      "ambient={material: air, pressure: 1000, temperature: 700}",
                                      "boundaries={r: symmetry, z: symmetry}",
                                      "damping=null"};
    trial t;
    ice_totals before, after;
    sealed_begin(&t, "membrane_balloon", set, 6);
    check_ok(t.ctx, ice_sum(t.sim->ice, &before));
    trial_steps(&t, 1000);
    check_ok(t.ctx, ice_sum(t.sim->ice, &after));
    for (int gas = 0; gas < 2; ++gas) {
        check_close_relative(after.mass[gas], before.mass[gas], 1e-13);
        check_close_relative(after.internal[gas], before.internal[gas], 1e-12);
        for (int a = 0; a < 2; ++a) check_close(deviation_of(&t, C_VEL, gas, a, 0.0).inside, 0.0, 2e-10);
        check_close(deviation_of(&t, C_RHO, gas, 0, 0.0).outside, 0.0, 0.0); /* none of it beyond the membrane */
    }
    trial_end(&t);
}

/* A vacuum is at the reference pressure: a gas of that pressure stays at rest, too. */
static void test_reference_pressure(void **unused)
{
    (void)unused;
    static const char *const set[] = {PLAIN, "reference_pressure=1000", "boundaries={r: symmetry, z: symmetry}",
                                      "damping=null"};
    trial t;
    sealed_begin(&t, "membrane_balloon", set, 4);
    trial_steps(&t, 300);
    for (int a = 0; a < 2; ++a) check_close(deviation_of(&t, C_VEL, 0, a, 0.0).inside, 0.0, 1e-10);
    trial_end(&t);
}

#define STREAM                                                                                                       \
    AIR, PLAIN, "damping=null", "materials.gas.viscosity=null", "bodies.skin.velocity=[0, 10]",                      \
        "bodies.air={material: air, shape: {box: {lower: [0, 0], upper: [0.5, 1.2]}}, pressure: 1000, temperature: " \
        "700, velocity: [0, 10]}"

/* A disc across a pipe and the gases on its two sides are carried along, through two sides of cells. */
static void test_disc(void **unused)
{
    (void)unused;
    static const char *const set[] = {
        STREAM, "domain={dim: 2, geometry: axisymmetric, lower: [0, 0], upper: [0.3, 1], cell: 0.05}",
        "boundaries={r: {lower: symmetry, upper: slip}, z: {lower: {inlet: {velocity: [0, 10], material: gas, "
        "pressure: "
        "1000, temperature: 2500}}, upper: free}}",
        "bodies.gas={material: gas, shape: {box: {lower: [0, 0], upper: [0.3, 0.313]}}, pressure: 1000, density: 1, "
        "velocity: [0, 10]}",
        "bodies.skin.membrane.curve={segment: {from: [0.3, 0.313], to: [0, 0.313]}}"};
    trial t;
    sealed_begin(&t, "membrane_balloon", set, 10);
    trial_run(&t, 0.012);
    for (int gas = 0; gas < 2; ++gas) {
        check_close(deviation_of(&t, C_VEL, gas, 0, 0.0).inside, 0.0, 2e-12);
        check_close(deviation_of(&t, C_VEL, gas, 1, 10.0).inside, 0.0, 2e-12);
        check_close_relative(deviation_of(&t, C_RHO, gas, 0, 0.0).inside, gas == 0 ? 1.0 : 1000.0 / 280.0, 1e-11);
    }
    trial_end(&t);
}

/* A ball of gas in a stream of another, carried through three cells. Areas are means of four places in the step, which a curved line does not
 * close to round-off: measured 1.2e-8 of the pressure; with the two places at the ends of the step it was 1.4e-4. */
static void test_ball_in_stream(void **unused)
{
    (void)unused;
    static const char *const set[] = {
        STREAM, "domain={dim: 2, geometry: axisymmetric, lower: [0, 0], upper: [0.5, 1.2], cell: 0.05}",
        "boundaries={r: {lower: symmetry, upper: slip}, z: {lower: {inlet: {velocity: [0, 10], material: air, "
        "pressure: "
        "1000, temperature: 700}}, upper: free}}",
        "bodies.gas={material: gas, shape: {ball: {centre: [0, 0.5], radius: 0.26}}, pressure: 1000, density: 1, "
        "velocity: [0, 10]}",
        "bodies.skin.membrane={curve: {arc: {centre: [0, 0.5], radius: 0.25, from: -1.5707963267948966, to: "
        "1.5707963267948966}}, thickness: 0.1, number: 150, encloses: gas}"};
    trial t;
    double pressure;
    ice_totals before, after;
    sealed_begin(&t, "membrane_balloon", set, 10);
    check_ok(t.ctx, ice_sum(t.sim->ice, &before));
    trial_run(&t, 0.015);
    check_ok(t.ctx, ice_sum(t.sim->ice, &after));
    check_close_relative(after.mass[0], before.mass[0], 1e-13);
    check_close(deviation_of(&t, C_RHO, 0, 0, 0.0).outside, 0.0, 0.0);
    check_close(deviation_of(&t, C_VEL, 0, 1, 10.0).inside, 0.0, 7e-7); /* of 10 m/s */
    check_ok(t.ctx, ice_mean_pressure(t.sim->ice, 0, NULL, &pressure));
    check_close_relative(pressure, 1000.0, 1.5e-8);
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MASS) < 1e-13);
    check_true(ledger_worst(&t, LEDGER_MOMENTUM_Y, LEDGER_MOMENTUM_Y) < 1e-13);
    trial_end(&t);
}

/* Where gas and membrane balance (reference membrane_rest): radius on the mirror and at the axis, pressure, volume. */
typedef struct rest_case {
    const char *set[6];
    size_t n_set;
    double volume; /* m3 per radian, over the square or the cube of the radius */
    int power;
    double radius, pressure, tolerance; /* exact; share */
} rest_case;

static void check_rest(const rest_case *c)
{
    trial t;
    membrane_enclosure enclosure;
    double first[3], pressure;
    sealed_begin(&t, "membrane_balloon", c->set, c->n_set);
    trial_run(&t, t.scene->time.end);
    mpm_membrane_end(t.sim->mpm, 0, false, first);
    mpm_membrane_enclosure(t.sim->mpm, 0, &enclosure);
    check_ok(t.ctx, ice_mean_pressure(t.sim->ice, 0, NULL, &pressure));
    print_message("radius %.6f, pressure %.3f, stresses %.2f and %.2f, energy %.1e\n", first[0], pressure,
                  enclosure.stress, enclosure.hoop, ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY));
    check_close_relative(first[0], c->radius, c->tolerance);
    check_close_relative(enclosure.size, c->volume * pow(c->radius, c->power), 3.0 * c->tolerance);
    check_close_relative(pressure, c->pressure, c->tolerance);
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MASS) < 1e-13);
    check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) < 5e-4);
    check_close(deviation_of(&t, C_RHO, 0, 0, 0.0).outside, 0.0, 0.0);
    trial_end(&t);
}

/* Measured: radius 1.1e-4, pressure 2.1e-4, volume 1.6e-4. */
static void test_balloon(void **unused)
{
    (void)unused;
    check_rest(
        &(rest_case){.volume = 1.0 / 3.0, .power = 3, .radius = 0.517445, .pressure = 884.042, .tolerance = 4e-4});
}

/* Measured: radius 2.5e-5, pressure 3.1e-4, volume 5.1e-5. */
static void test_tube(void **unused)
{
    (void)unused;
    check_rest(&(rest_case){.set = {"domain.upper=[0.8, 0.2]", "boundaries.z=symmetry", "verify=null",
                                    "bodies.gas.shape={box: {lower: [0, 0], upper: [0.5, 0.2]}}",
                                    "bodies.skin.membrane.curve={segment: {from: [0.5, 0], to: [0.5, 0.2]}}",
                                    "bodies.skin.membrane.number=8"},
                            .n_set = 6,
                            .volume = 0.5 * 0.2,
                            .power = 2,
                            .radius = 0.545944,
                            .pressure = 810.279,
                            .tolerance = 5e-4});
}

/* Against a reference pressure of 200, which does work on the membrane: the account knows of it. Measured: radius 0.8e-4, pressure 1.9e-4. */
static void test_balloon_against_pressure(void **unused)
{
    (void)unused;
    check_rest(&(rest_case){.set = {"reference_pressure=200", "verify=null"},
                            .n_set = 2,
                            .volume = 1.0 / 3.0,
                            .power = 3,
                            .radius = 0.513556,
                            .pressure = 905.389,
                            .tolerance = 4e-4});
}

#define AIR_OUTLET "{outlet: {pressure: 200, temperature: 500, material: air}}"

/* Against air of that pressure, which goes out and comes back through two sides, where the gas inside has no state to come with. The sound that
 * goes out takes some of the energy. Measured: radius 6.5e-4, pressure 3.9e-3. */
static void test_balloon_in_air(void **unused)
{
    (void)unused;
    check_rest(&(rest_case){.set = {AIR, "materials.air.viscosity={bulk: 10}", "verify=null",
                                    "ambient={material: air, pressure: 200, temperature: 500}",
                                    "boundaries={r: {lower: symmetry, upper: " AIR_OUTLET
                                    "}, z: {lower: symmetry, upper: " AIR_OUTLET "}}"},
                            .n_set = 5,
                            .volume = 1.0 / 3.0,
                            .power = 3,
                            .radius = 0.513556,
                            .pressure = 905.389,
                            .tolerance = 5e-3});
}

static state run(int blocks)
{
    static const char *const set[] = {"domain.cell=0.05", AIR, "ambient={material: air, pressure: 10, temperature: 7}"};
    trial t;
    deck_begin(&t, "membrane_balloon", set, 3);
    for (int a = 0; a < 2; ++a) t.scene->mesh.blocks[a] = blocks;
    use_threads(blocks);
    check_ok(t.ctx, sim_create(&t.sim, t.ctx, t.scene, COUPLING_ICE_MPM));
    trial_steps(&t, 100);
    return trial_finish(&t);
}

static void test_bits(void **unused)
{
    (void)unused;
    state expected = run(1), found = run(2);
    same_state(&expected, &found);
    state_free(&found);
    state_free(&expected);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rest),           cmocka_unit_test(test_reference_pressure),
        cmocka_unit_test(test_disc),           cmocka_unit_test(test_ball_in_stream),
        cmocka_unit_test(test_balloon),        cmocka_unit_test(test_balloon_against_pressure),
        cmocka_unit_test(test_balloon_in_air), cmocka_unit_test(test_tube),
        cmocka_unit_test(test_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
