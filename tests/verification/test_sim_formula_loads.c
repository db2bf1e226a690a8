/* Loads by formulas of place and time, against exact motion and exact heat, in the couplings that take them. */
#include "deck_run_fixture.h"

static const double pi = 3.14159265358979323846;

static void begin_with(bench *t, const char *text, const char *coupling, const char *cell)
{
    char set[2][80];
    const char *const list[] = {set[0], set[1]};
    snprintf(set[0], sizeof set[0], "coupling=%s", coupling);
    snprintf(set[1], sizeof set[1], "constants.h=%s", cell);
    begin(t, text, list, 2);
}

/* ---- gravity that swings ---- */

/* Everything falls alike: u = (A / w) (1 - cos wt), from rest, and the other way round along y, in a gas that no wall holds. */
static const char falling[] = "floe: 1\n"
                              "coupling: mpm\n"
                              "constants: {h: 0.1, A: 300 m/s2, w: 2000 1/s}\n"
                              "domain: {dim: 2, lower: [0, 0], upper: [1, 0.4], cell: h}\n"
                              "boundaries: periodic\n"
                              "materials: {gas: {eos: {ideal: {gamma: 1.4, specific_heat: 717}}}}\n"
                              "bodies: {gas: {material: gas, shape: {box: {lower: [0, 0], upper: [1, 0.4]}}, pressure: "
                              "1 bar, temperature: 300}}\n"
                              "loads: {swing: {gravity: {acceleration: [\"A * sin(w * t)\", \"-A * sin(w * t)\"]}}}\n"
                              "time: {end: 1, fixed_step: 1e-5}\n";

static void check_fall(const char *coupling, double tolerance)
{
    bench t;
    sim_totals sum;
    begin_with(&t, falling, coupling, "0.1");
    run_until(&t, 1e-3);
    check_ok(t.ctx, sim_sum(t.sim, &sum));
    const double u = 300.0 / 2000.0 * (1.0 - cos(2.0)), mass = 0.4 * 1e5 / (0.4 * 717.0 * 300.0);
    check_close(sum.momentum[0] / mass, u, tolerance * u);
    check_close(sum.momentum[1] / mass, -u, tolerance * u);
    end(&t);
}

/* The middle of a step is the integral to (w dt)^2 / 24, 1.7e-5; points have their velocities half a step before: 0.65 %. */
static void test_gravity_that_swings(void **state)
{
    (void)state;
    check_fall("ice", 2e-5);
    check_fall("mpm", 1.2e-2);
}

/* ---- a bar that is pulled ---- */

/* Its end is pressed by p(t) = P sin^2(wt): until the wave is back, the end moves as u = p(t) / (rho c). */
static const char pressed[] = "floe: 1\n"
                              "coupling: mpm\n"
                              "constants: {h: 0.01, P: 1 MPa, rho: 1000 kg/m3, c: 1000 m/s, w: 2 * pi * 1000 1/s}\n"
                              "domain: {dim: 1, lower: -0.2, upper: 1.2, cell: h}\n"
                              "materials: {m: {density: rho, law: {linear_elastic: {bulk_modulus: rho * c^2, "
                              "shear_modulus: 1e-6 * rho * c^2}}}}\n"
                              "bodies: {bar: {material: m, shape: {box: {lower: 0, upper: 1}}}}\n"
                              "loads: {push: {traction: {body: bar, surface: {box: {lower: 0, upper: 1.1}}, pressure: "
                              "\"if(x < 0.5, P * sin(w * t)^2, 0)\"}}}\n"
                              "time: {end: 1}\n";

/* Momentum that has gone in: the integral of p. Measured: -0.23 %, of velocities half a step before. */
static void test_traction_in_time(void **state)
{
    (void)state;
    const double until = 0.8e-3, w = 2.0 * pi * 1000.0;
    const double impulse = 1e6 * (0.5 * until - sin(2.0 * w * until) / (4.0 * w));
    bench t;
    sim_totals sum;
    begin_with(&t, pressed, "mpm", "0.01");
    run_until(&t, until);
    check_ok(t.ctx, sim_sum(t.sim, &sum));
    check_close(sum.momentum[0], impulse, 4.6e-3 * impulse);
    end(&t);
}

/* ---- heat by place and time ---- */

/* A closed vessel takes Q (1 + x) sin^2(wt): the energy is 3/2 Q L (t/2 - sin(2wt)/4w), whatever the gas does. */
static const char heated[] =
    "floe: 1\n"
    "coupling: ice\n"
    "constants: {h: 0.05, Q: 1e8 W/m3, w: 3000 1/s}\n"
    "domain: {dim: 1, lower: 0, upper: 1, cell: h}\n"
    "boundaries: slip\n"
    "materials: {gas: {eos: {ideal: {gamma: 1.4, specific_heat: 717}}}}\n"
    "bodies: {gas: {material: gas, shape: {box: {lower: 0, upper: 1}}, pressure: 1 bar, temperature: 300}}\n"
    "loads: {fire: {heat: {material: gas, power: \"Q * (1 + x / 1 m) * sin(w * t)^2\"}}}\n"
    "time: {end: 1}\n";

static void check_heat(const char *coupling, double tolerance)
{
    const double w = 3000.0, until = 1e-3;
    const double energy = 1.5e8 * (0.5 * until - sin(2.0 * w * until) / (4.0 * w));
    bench t;
    sim_totals before, after;
    begin_with(&t, heated, coupling, "0.05");
    check_ok(t.ctx, sim_sum(t.sim, &before));
    run_until(&t, until);
    check_ok(t.ctx, sim_sum(t.sim, &after));
    const double gained = after.internal + after.kinetic - before.internal - before.kinetic;
    check_close(gained, energy, tolerance * energy);
    end(&t);
}

/* Measured: 4.5e-4, 4.1e-4, of the middle of steps. */
static void test_heat_by_place_and_time(void **state)
{
    (void)state;
    check_heat("ice", 9e-4);
    check_heat("mpm", 8e-4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_gravity_that_swings),
        cmocka_unit_test(test_traction_in_time),
        cmocka_unit_test(test_heat_by_place_and_time),
    };
    deck_init();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
