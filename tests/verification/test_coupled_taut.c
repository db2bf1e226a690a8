/* Membranes that are taut at the start around gas, with what floe takes where a deck says nothing: they start in balance, and breathe with
 * their exact period. */
#include "deck_run_fixture.h"

#define GAS "gas: {eos: {ideal: {gamma: 1.4, specific_heat: 1}}}"

/* A quarter of a circle. Tension sigma t = 5e5 x 0.01 balances p R = 1e4 x 0.5. */
static const char circle[] =
    "floe: 1\nunits: none\ncoupling: ice-mpm\n"
    "domain: {dim: 2, lower: [0, 0], upper: [1, 1], cell: 0.1}\n"
    "boundaries: {x: {lower: symmetry, upper: free}, y: {lower: symmetry, upper: free}}\n"
    "materials: {" GAS ", skin: {membrane: {string: {modulus: 1e6}}, density: 100}}\n"
    "bodies:\n"
    "  gas: {material: gas, shape: {ball: {centre: [0, 0], radius: 0.5}}, pressure: 1e4, density: 1, "
    "velocity: [2 * x, 2 * y]}\n"
    "  skin: {material: skin, velocity: [2 * x, 2 * y], membrane: {curve: {arc: {centre: [0, 0], radius: 0.5, from: 0, "
    "to: 1.5707963267948966}}, thickness: 0.01, slack: -0.5, encloses: gas}}\n"
    "time: {end: 1}\n";

/* An eighth of a sphere: 2 sigma t = 2 x 2.5e5 x 0.01 balances p R. */
static const char sphere[] =
    "floe: 1\nunits: none\ncoupling: ice-mpm\n"
    "domain: {dim: 3, lower: [0, 0, 0], upper: [0.7, 0.7, 0.7], cell: 0.1}\n"
    "boundaries: {x: {lower: symmetry, upper: free}, y: {lower: symmetry, upper: free}, z: {lower: symmetry, upper: "
    "free}}\n"
    "materials: {" GAS ", skin: {membrane: {plane_stress: {modulus: 1e6}}, density: 100}}\n"
    "bodies:\n"
    "  gas: {material: gas, shape: {ball: {centre: [0, 0, 0], radius: 0.5}}, pressure: 1e4, density: 1, "
    "velocity: [2 * x, 2 * y, 2 * z]}\n"
    "  skin: {material: skin, velocity: [2 * x, 2 * y, 2 * z], membrane: {surface: {sphere: {centre: [0, 0, 0], "
    "radius: "
    "0.5}}, thickness: 0.01, slack: -0.25, encloses: gas}}\n"
    "time: {end: 1}\n";

/* Half of the sphere about its axis. */
static const char around[] =
    "floe: 1\nunits: none\ncoupling: ice-mpm\n"
    "domain: {dim: 2, geometry: axisymmetric, lower: [0, 0], upper: [0.7, 0.7], cell: 0.1}\n"
    "boundaries: {r: {upper: free}, z: {lower: symmetry, upper: free}}\n"
    "materials: {" GAS ", skin: {membrane: {plane_stress: {modulus: 1e6}}, density: 100}}\n"
    "bodies:\n"
    "  gas: {material: gas, shape: {ball: {centre: [0, 0], radius: 0.5}}, pressure: 1e4, density: 1, "
    "velocity: [2 * r, 2 * z]}\n"
    "  skin: {material: skin, velocity: [2 * r, 2 * z], membrane: {curve: {arc: {centre: [0, 0], radius: 0.5, from: 0, "
    "to: 1.5707963267948966}}, thickness: 0.01, slack: -0.25, encloses: gas}}\n"
    "time: {end: 1}\n";

/* The mean period of the momentum along an axis, between its first and its fifth change of sign, and the drift of energy until then: what strains by rate creep. */
typedef struct breath {
    double period, drift;
} breath;

static breath breathe(const char *deck, int axis, const char *const *set, size_t n)
{
    enum { TURNS = 5 };
    double turn[TURNS], before = 0.0, at = 0.0;
    bench t;
    begin(&t, deck, set, n);
    for (int found = 0; found < TURNS;) {
        sim_totals sum;
        check_ok(t.ctx, sim_step(t.sim, 1.0));
        check_ok(t.ctx, sim_sum(t.sim, &sum));
        if (sum.momentum[axis] * before < 0.0)
            turn[found++] = at + (t.sim->time - at) * before / (before - sum.momentum[axis]);
        before = sum.momentum[axis];
        at = t.sim->time;
        assert_true(at < 0.1);
    }
    check_ok(t.ctx, sim_update_ledger(t.sim));
    const double drift = fabs(ledger_largest_drift(&t.sim->ledger, LEDGER_ENERGY));
    end(&t);
    return (breath){(turn[TURNS - 1] - turn[0]) * 2.0 / (TURNS - 1), drift};
}

/* m R w^2 + p - gamma p k R J_0(k R)/J_1(k R) - E t/R = 0 with k = w/c and m = rho t e^-0.5, since the skin has its density at rest. */
static void test_circle(void **state)
{
    const double exact = 0.01963634;
    const char *const fine[] = {"domain.cell=0.05"};
    (void)state;
    const breath coarse = breathe(circle, 0, NULL, 0), half = breathe(circle, 0, fine, 1);
    print_message("a round membrane breathes %.2e and %.2e too slowly, drift %.2e and %.2e\n",
                  coarse.period / exact - 1.0, half.period / exact - 1.0, coarse.drift, half.drift);
    check_true(fabs(coarse.period / exact - 1.0) < 0.0047 && fabs(half.period / exact - 1.0) < 0.0052);
    check_true(coarse.drift < 3.6e-4 && half.drift < 4.7e-4);
}

/* m w^2 + p/R - gamma p k j_0(k R)/j_1(k R) - 2 E t/R^2 = 0, m = rho t e^-0.5. */
static void test_sphere(void **state)
{
    const double exact = 0.01403711;
    (void)state;
    const breath off = breathe(sphere, 0, NULL, 0);
    print_message("a sphere breathes %.2e too slowly, drift %.2e\n", off.period / exact - 1.0, off.drift);
    check_true(fabs(off.period / exact - 1.0) < 0.015 && off.drift < 4.6e-4);
    const char *const places[] = {"bodies.skin.membrane.strain=positions"};
    for (int k = 0; k < 2; ++k) {
        const breath turned = breathe(around, 1, places, (size_t)k);
        print_message("about an axis %.2e, drift %.2e\n", turned.period / exact - 1.0, turned.drift);
        check_true(fabs(turned.period / exact - 1.0) < 0.0053 && turned.drift < 4.9e-4);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_circle), cmocka_unit_test(test_sphere)};
    deck_init();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
