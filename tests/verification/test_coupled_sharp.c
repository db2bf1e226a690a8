/* Solids whose surface cuts the cells of gas (method.interface: sharp): nothing passes it or is left behind, what the gas gives the
 * solid gets, a shock gives a plate what it should, walls compress gas along the adiabat, a pressurised ring is as good as under tractions; the
 * same bits for any blocks, any threads and after a restart. */
#include "coupled_fixture.h"

static void begin(trial *t, const char *deck, const char *const *set, size_t n)
{
    deck_begin(t, deck, set, n);
    check_ok(t->ctx, sim_create(&t->sim, t->ctx, t->scene, COUPLING_ICE_MPM));
}

/* ---- free stream ---- */

/* A soft disc and the gas about it go along together. The disc must stay unloaded; what its surface covers and uncovers in a step is right to the square
 * of the step (theory, Faces). Measured: pressure 2.2e-7, velocity of the disc 2e-10 of themselves. */
static void test_stream(void **unused)
{
    (void)unused;
    const char *set[] = {
        "domain={dim: 2, stress_state: plane_strain, lower: [0, 0], upper: [1, 0.8], cell: 0.05}",
        "boundaries={x: {lower: {inlet: {velocity: [30, 0], material: air, pressure: 1e5, temperature: 300}}, upper: "
        "free}, "
        "y: slip}",
        "bodies.behind={material: air, shape: {box: {lower: [0, 0], upper: [1, 1]}}, pressure: 1e5, temperature: 300, "
        "velocity: [30, 0]}",
        "bodies.plate={material: plate, shape: {ball: {centre: [0.4, 0.41], radius: 0.22}}, points: 2, velocity: [30, "
        "0]}",
        "materials.plate.law={linear_elastic: {bulk_modulus: 10 MPa, shear_modulus: 5 MPa}}"};
    trial t;
    begin(&t, "shock_plate", set, 5);
    trial_run(&t, 0.004);
    const size_t n = mesh_cells(&t.sim->mesh);
    double *x = malloc(2 * n * sizeof *x), *open = x + n, worst = 0.0;
    assert_non_null(x);
    gather_cells(t.sim, C_PRESSURE, 0, 0, 1, x);
    gather_cells(t.sim, C_OPEN, 0, 0, 1, open);
    for (size_t k = 0; k < n; ++k)
        if (open[k] > 0.0) worst = fmax(worst, fabs(x[k] / 1e5 - 1.0));
    free(x);
    mpm_totals m;
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &m));
    print_message("stream: pressure off by %.2g, velocity by %.2g of themselves\n", worst,
                  fabs(m.momentum[0][0] / m.mass[0] / 30.0 - 1.0));
    check_true(worst < 4e-7);
    check_close_relative(m.momentum[0][0], 30.0 * m.mass[0], 4e-10);
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MASS) < 1e-13);
    check_true(ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_X) < 1e-13);
    check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) < 2e-12);
    check_close(ice_mass_beyond(t.sim->ice, 0), 0.0, 0.0);
    trial_end(&t);
}

/* ---- walls ---- */

/* Half of the way: from 0.8137 to 0.6137 m, p V^1.4 = const. Measured: 1.4e-5; the waves in the gas are of 2 %. */
static void test_walls(void **unused)
{
    (void)unused;
    trial t;
    double pressure, place[2];
    mpm_totals m;
    ice_totals before, after;
    begin(&t, "moving_walls", NULL, 0);
    check_ok(t.ctx, ice_sum(t.sim->ice, &before));
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &m));
    for (int b = 0; b < 2; ++b) place[b] = m.moment[b][0] / m.mass[b];
    trial_run(&t, 0.02);
    check_ok(t.ctx, ice_sum(t.sim->ice, &after));
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &m));
    check_ok(t.ctx, ice_mean_pressure(t.sim->ice, 0, NULL, &pressure));
    const double shut = m.moment[0][0] / m.mass[0] - place[0] + place[1] - m.moment[1][0] / m.mass[1];
    const double expected = 1e5 * pow(0.8137 / (0.8137 - shut), 1.4);
    print_message("walls: closed by %.6f m, pressure off by %.2g\n", shut, pressure / expected - 1.0);
    check_close(shut, 0.2, 5e-14);
    check_close_relative(pressure, expected, 5e-5);
    check_close_relative(after.mass[0], before.mass[0], 1e-13);
    check_close(ice_mass_beyond(t.sim->ice, 0), 0.0, 0.0);
    trial_end(&t);
}

/* ---- a shock on a plate ---- */

/* The impulse of 2.74664e5 Pa since 0.641884 ms (the deck says where from). Measured: -0.12 %, at half the spacing -0.06; smeared 3.0. */
static void test_shock(void **unused)
{
    (void)unused;
    trial t;
    mpm_totals m;
    begin(&t, "shock_plate", NULL, 0);
    trial_run(&t, 1.4e-3);
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &m));
    const double expected = 2.74664e5 * 0.02 * (1.4e-3 - 0.641884e-3);
    print_message("shock: impulse off by %.2g\n", m.momentum[0][0] / expected - 1.0);
    check_close_relative(m.momentum[0][0], expected, 1.8e-3);
    check_true(ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_X) < 1e-13);
    trial_end(&t);
}

/* ---- the pressurised ring ---- */

typedef struct stress_sum {
    double error, weight;
} stress_sum;

static void add_trace(void *user, const fields *f, int body, size_t k)
{
    const double expected = 2.0 * 19.4e6 * 0.25 / 0.75;
    stress_sum *s = user;
    s->error +=
        fabs(fabs(field_get(f, P_STRESS, body, 0)[k] + field_get(f, P_STRESS, body, 1)[k]) - expected) / expected;
    s->weight += 1.0;
}

/* Equation 13 of Guilkey et al. 2003 with cells of 0.1: 3.6 %; under exact tractions on the bore (annulus_traction) 3.7 %, smeared 5.8 %. */
static void test_ring(void **unused)
{
    (void)unused;
    const char *set[] = {"domain.cell=0.1", "method={basis: quadratic, interface: sharp}"};
    trial t;
    stress_sum s = {0.0, 0.0};
    begin(&t, "pressurized_cylinder", set, 2);
    trial_run(&t, 0.7e-3); /* outward: the scale of the drifts */
    check_ok(t.ctx, sim_update_ledger(t.sim));
    trial_run(&t, 4e-3);
    visit_points(&t, 0, add_trace, &s);
    print_message("ring: equation 13 %.4f\n", s.error / s.weight);
    check_true(s.error / s.weight < 0.03);
    check_true(ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_Y) < 1e-12);
    check_close(ice_mass_beyond(t.sim->ice, 0), 0.0, 0.0);
    trial_end(&t);
}

typedef struct mean_sum {
    double found, expected;
} mean_sum;

/* By Lamé the sum of the stresses is the same everywhere in a sphere: 3 p r_i^3 / (r_o^3 - r_i^3). */
static void add_sum(void *user, const fields *f, int body, size_t k)
{
    const double r = hypot(field_get(f, P_POS, body, 0)[k], field_get(f, P_POS, body, 1)[k]), cube = 0.125;
    mean_sum *s = user;
    const double trace =
        field_get(f, P_STRESS, body, 0)[k] + field_get(f, P_STRESS, body, 1)[k] + field_get(f, P_STRESS, body, 2)[k];
    if (r < 0.6 || r > 0.9) return;
    s->found += trace;
    s->expected += 3.0 * 19.4e6 * cube / (1.0 - cube);
}

/* About the axis: the mean stress within the wall of a pressurised sphere. Measured with cells of 0.1: 0.34 %. */
static void test_sphere(void **unused)
{
    (void)unused;
    const char *set[] = {"domain.cell=0.1", "method={basis: quadratic, interface: sharp}"};
    trial t;
    mean_sum s = {0.0, 0.0};
    begin(&t, "pressurized_sphere", set, 2);
    trial_run(&t, 0.7e-3); /* outward: the scale of the drifts */
    check_ok(t.ctx, sim_update_ledger(t.sim));
    trial_run(&t, 4e-3);
    visit_points(&t, 0, add_sum, &s);
    print_message("sphere: mean stress off by %.2g\n", s.found / s.expected - 1.0);
    check_close_relative(s.found, s.expected, 0.01);
    check_true(ledger_worst(&t, LEDGER_MOMENTUM_Y, LEDGER_MOMENTUM_Y) < 1e-12);
    check_close(ice_mass_beyond(t.sim->ice, 0), 0.0, 0.0);
    trial_end(&t);
}

/* ---- the same bits ---- */

static void ring_begin(trial *t, int blocks)
{
    const char *set[] = {"domain.cell=0.05", "method={basis: quadratic, interface: sharp}"};
    deck_begin(t, "pressurized_cylinder", set, 2);
    for (int a = 0; a < 2; ++a) t->scene->mesh.blocks[a] = blocks;
}

static state run(int blocks, int threads, const char *path)
{
    return run_in_halves(ring_begin, 30, blocks, threads, path);
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
    static const char *const sets[][2] = {
        {"method={interface: sharp, pressure: auto}", "title=auto"},
        {"bodies.plate.shape={box: {lower: [-1, -1], upper: [2, 1]}}", "title=no surface"},
        {"bodies.plate.shape={box: {lower: [0.603, 0], upper: [0.608, 0.02]}}", "title=thin"},
        {"bodies.more={material: plate, shape: {box: {lower: [0.5, 0], upper: [0.7, 0.02]}}, points: 2}",
         "title=two in one place"}};
    for (size_t k = 0; k < sizeof sets / sizeof *sets; ++k) {
        trial t;
        deck_begin(&t, "shock_plate", sets[k], 2);
        check_fails(t.ctx, sim_create(&t.sim, t.ctx, t.scene, COUPLING_ICE_MPM), FLOE_BAD_INPUT);
        trial_end(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stream),  cmocka_unit_test(test_walls),  cmocka_unit_test(test_shock),
        cmocka_unit_test(test_ring),    cmocka_unit_test(test_sphere), cmocka_unit_test(test_bits),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
