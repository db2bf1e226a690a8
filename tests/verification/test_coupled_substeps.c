/* Sub-steps of points beside a sharp interface (time.substeps): what the gas gives in its step the points get in theirs, to round-off; a shock gives a plate of
 * steel what it should, a stiff ring comes to the rest that it comes to without; one sub-step is none; the same bits for any
 * blocks, any threads and after a restart. */
#include "coupled_fixture.h"

#include "io/checkpoint/checkpoint.h"
#include "io/io.h"

#include <string.h>

static void begin(trial *t, const char *deck, const char *const *set, size_t n)
{
    deck_begin(t, deck, set, n);
    coupled_start(t);
}

#define STEEL                                                                                             \
    "materials.plate={density: 7850, law: {linear_elastic: {bulk_modulus: 160e9, shear_modulus: 80e9}}, " \
    "specific_heat: 460}"

/* ---- a shock on steel ---- */

/* Pressure (Pa) behind the shock that comes back from a wall of impedance Z, by Rankine and Hugoniot: the gas behind the first shock (p, rho, u)
 * is brought to the wall's velocity (p2 - p1)/Z. */
static double pressure_on(double Z)
{
    const double gamma = 1.4, p = 2e5, rho = 1.8873403, u = 181.97633, p1 = 1e5;
    double low = p, high = 10.0 * p;
    for (int k = 0; k < 200; ++k) {
        const double mid = 0.5 * (low + high);
        const double stop = (mid - p) * sqrt(2.0 / rho / ((gamma + 1.0) * mid + (gamma - 1.0) * p));
        *(u - stop > (mid - p1) / Z ? &low : &high) = mid;
    }
    return low;
}

/* The plate is free, and gains the impulse of the shock that comes back since 0.642 ms. Measured at 1 ms: off by 0.48 % in 1649 steps without
 * sub-steps, by 0.16 % in 192 with; momentum of the whole by 3e-16. */
static void test_shock(void **unused)
{
    (void)unused;
    const char *set[] = {STEEL, "domain.upper=[1.6, 0.02]", "boundaries.x=free",
                         "bodies.plate.shape={box: {lower: [0.6037, 0], upper: [1.4963, 0.02]}}", NULL};
    const double Z = sqrt(7850.0 * (160e9 + 4.0 / 3.0 * 80e9));
    const double expected = (pressure_on(Z) - 1e5) * 0.02 * (1e-3 - 0.641884e-3);
    double steps[2];
    for (int k = 0; k < 2; ++k) {
        trial t;
        mpm_totals m;
        set[4] = k ? "time.substeps=auto" : "time.substeps=1";
        begin(&t, "shock_plate", set, 5);
        trial_run(&t, 1e-3);
        check_ok(t.ctx, mpm_sum(t.sim->mpm, &m));
        steps[k] = (double)t.sim->steps;
        print_message(
            "shock on steel, %s: %g steps, impulse off by %.3g, momentum of the whole by %.2g, energy by %.2g\n",
            k ? t.sim->substeps_reason : "no sub-steps", steps[k], m.momentum[0][0] / expected - 1.0,
            ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_X), ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY));
        check_close_relative(m.momentum[0][0], expected, 5e-3);
        check_true(ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_X) < 1e-13);
        check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) < 5e-10);
        trial_end(&t);
    }
    check_true(steps[1] < 0.2 * steps[0]);
}

/* ---- a stiff ring ---- */

typedef struct stress_sum {
    double error, weight;
} stress_sum;

static void add_trace(void *user, const fields *f, int body, size_t k)
{
    const double expected = 2.0 * 2e5 * 0.25 / 0.75;
    stress_sum *s = user;
    s->error +=
        fabs(fabs(field_get(f, P_STRESS, body, 0)[k] + field_get(f, P_STRESS, body, 1)[k]) - expected) / expected;
    s->weight += 1.0;
}

/* Equation 13 of the ring once it has come to rest; n_set: 1 with sub-steps, 2 without. */
static double ring_error(size_t n_set, double *steps)
{
    static const char *const set[] = {"domain.cell=0.2", "time.substeps=1"};
    trial t;
    stress_sum s = {0.0, 0.0};
    begin(&t, "stiff_cylinder", set, n_set);
    trial_run(&t, 2.5e-3);
    visit_points(&t, 0, add_trace, &s);
    *steps = (double)t.sim->steps;
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MASS) < 1e-13);
    check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) < 5e-11);
    trial_end(&t);
    return s.error / s.weight;
}

static void test_ring(void **unused)
{
    (void)unused;
    double steps[2];
    const double many = ring_error(2, &steps[0]), few = ring_error(1, &steps[1]);
    print_message("stiff ring: equation 13 %.8f in %g steps, %.8f in %g with sub-steps\n", many, steps[0], few,
                  steps[1]);
    check_close_relative(few, many, 1.2e-6);
    check_true(steps[1] < 0.04 * steps[0]);
}

/* ---- bits ---- */

/* Where the points' own step is the longer one, `auto` asks for one sub-step: the same bits as without the key. */
static void test_one_is_none(void **unused)
{
    (void)unused;
    static const char *const set[] = {"materials.plate.law.linear_elastic={bulk_modulus: 6e6, shear_modulus: 3e6}",
                                      "time.substeps=auto"};
    state s[2];
    for (int k = 0; k < 2; ++k) {
        trial t;
        begin(&t, "shock_plate", set, (size_t)k + 1);
        trial_steps(&t, 150);
        assert_int_equal(t.sim->n_substeps, 1);
        s[k] = trial_finish(&t);
    }
    same_state(&s[0], &s[1]);
    for (int k = 0; k < 2; ++k) state_free(&s[k]);
}

static void ring_begin(trial *t, int blocks)
{
    static const char *const set[] = {"domain.cell=0.1"};
    deck_begin(t, "stiff_cylinder", set, 1);
    for (int a = 0; a < 2; ++a) t->scene->mesh.blocks[a] = blocks;
}

static state run(int blocks, int threads, const char *path)
{
    trial t;
    ring_begin(&t, blocks);
    use_threads(threads);
    coupled_start(&t);
    trial_steps(&t, 3);
    if (path) { /* written, and read into another run with other blocks */
        check_ok(t.ctx, io_init(t.ctx));
        write_checkpoint(&t, path);
        trial_end(&t);
        ring_begin(&t, 1);
        coupled_start(&t);
        read_checkpoint(&t, path);
    }
    trial_steps(&t, 3);
    return trial_finish(&t);
}

static void test_bits(void **unused)
{
    (void)unused;
    same_bits_however_run(run);
}

/* ---- where there are none ---- */

typedef struct refusal {
    const char *deck;
    scene_coupling coupling;
    size_t n;
    const char *set[4]; /* the last of n: four sub-steps */
} refusal;

#define OTHER                                                                                            \
    "materials.other={density: 7800, law: {linear_elastic: {bulk_modulus: 1e9, shear_modulus: 0.5e9}}, " \
    "specific_heat: "                                                                                    \
    "460}"

/* Asked for by number they are refused, and `auto` says why there is one. */
static void test_refused(void **unused)
{
    (void)unused;
    static const refusal list[] = {
        {"shock_plate", COUPLING_ICE_MPM, 2, {"method.interface=smeared", "time.substeps=4"}},
        {"moving_walls",
         COUPLING_ICE_MPM,
         4,
         {OTHER, "bodies.right.material=other", "contact={kind: stick}", "time.substeps=4"}},
        {"shock_plate", COUPLING_ICE_MPM, 2, {"materials.plate.density=1.5", "time.substeps=4"}},
        {"membrane_circle", COUPLING_ICE_MPM, 2, {"domain.cell=0.25", "time.substeps=4"}},
        {"pressurized_cylinder", COUPLING_MPM, 2, {"domain.cell=0.1", "time.substeps=4"}},
        {"sod", COUPLING_ICE, 2, {"domain.cell=0.02", "time.substeps=4"}}};
    for (size_t k = 0; k < sizeof list / sizeof *list; ++k) {
        trial t;
        deck_begin(&t, list[k].deck, list[k].set, list[k].n);
        check_fails(t.ctx, sim_create(&t.sim, t.ctx, t.scene, list[k].coupling), FLOE_BAD_INPUT);
        t.scene->time.substeps = 0;
        check_ok(t.ctx, sim_create(&t.sim, t.ctx, t.scene, list[k].coupling));
        print_message("%s\n", t.sim->substeps_reason);
        assert_int_equal(strncmp(t.sim->substeps_reason, "1: ", 3), 0);
        assert_int_equal(t.sim->most_substeps, 1);
        trial_end(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shock), cmocka_unit_test(test_ring),    cmocka_unit_test(test_one_is_none),
        cmocka_unit_test(test_bits),  cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
