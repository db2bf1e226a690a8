/* Bodies that come to touch sides and each other, in a gas beside a sharp interface (theory 7.2). */
#include "coupled_fixture.h"

static int rubber(trial *t)
{
    const int solid = add_solid(t, "neo_hookean", 1e8, 5e7, 1000.0);
    t->scene->material[solid].specific_heat = 460.0;
    t->scene->material[solid].tension_switch = t->scene->reference_pressure;
    return solid;
}

static scene_body *put_block(trial *t, const double lo[3], const double hi[3], const double velocity[3])
{
    scene_body *b = coupled_body(t, rubber(t), make_box(t, lo, hi), 2);
    memcpy(b->velocity, velocity, 3 * sizeof *velocity);
    return b;
}

static void begin(trial *t, int dim, const double upper[3], double h, double pressure)
{
    coupled_begin(t, dim, upper, h);
    t->scene->method.interface = INTERFACE_SHARP;
    t->scene->ambient_pressure = t->scene->reference_pressure = pressure;
}

static double velocity_of(const trial *t, int body, int axis)
{
    mpm_totals totals;
    check_ok(t->ctx, mpm_sum(t->sim->mpm, &totals));
    return totals.momentum[body][axis] / totals.mass[body];
}

static double energy_of_solids(const trial *t)
{
    mpm_totals totals;
    double sum = 0.0;
    check_ok(t->ctx, mpm_sum(t->sim->mpm, &totals));
    for (int b = 0; b < t->sim->mpm->n_bodies; ++b) sum += totals.kinetic[b] + totals.strain[b];
    return sum;
}

static void check_ledger(trial *t, double most)
{
    const double mass = ledger_worst(t, LEDGER_MASS, LEDGER_MASS),
                 momentum = ledger_worst(t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_Y);
    print_message("  drift of mass %.1e, of momentum %.1e\n", mass, momentum);
    check_true(mass <= 1e-14);
    check_true(momentum <= most);
}

/* A block that hits a slip side flat, at a slant and in space gains no energy by the gas that it presses out, and flies off again. */
static void test_side(void **unused)
{
    (void)unused;
    static const double upper[3] = {0.6, 0.6, 0.6}, lo[3] = {0.15, 0.13, 0.15}, hi[3] = {0.45, 0.43, 0.45};
    static const struct {
        int dim;
        double velocity[3];
    } trials[] = {{2, {0.0, -5.0, 0.0}}, {2, {-5.0, -4.7, 0.0}}, {2, {1.7, 5.0, 0.0}}, {3, {0.5, -5.0, 0.0}}};
    for (int n = 0; n < 4; ++n) {
        trial t;
        begin(&t, trials[n].dim, upper, 0.1, COUPLED_PRESSURE);
        put_block(&t, lo, hi, trials[n].velocity);
        coupled_start(&t);
        const double before = energy_of_solids(&t);
        trial_run(&t, 0.045);
        const double back = velocity_of(&t, 0, 1) / trials[n].velocity[1], left = energy_of_solids(&t) / before;
        print_message("thrown at a side: comes back with %.3f of its velocity, %.3f of its energy\n", -back, left);
        check_close(back, -0.917, 0.02); /* with thin gaps of their own 0.89 */
        check_true(left < 0.9);
        check_ledger(&t, 1e-14);
        trial_end(&t);
    }
}

/* Two equal blocks that meet in thin gas exchange their velocities, but for what points lose without a gas too; at length on a
 * finer mesh. Measured: 7.0 and 1.6 % less. */
static double collide(bool gas, double h)
{
    static const double size[2][2][3] = {{{0.2, 0.2, 0.0}, {0.5, 0.6, 0.0}}, {{0.7, 0.2, 0.0}, {1.0, 0.6, 0.0}}};
    trial t;
    begin(&t, 2, (const double[]){1.2, 0.8, 0.0}, h, 1e3);
    t.scene->contact.enabled = true;
    t.scene->contact.kind = CONTACT_RELEASE;
    if (!gas) {
        t.scene->coupling = COUPLING_MPM;
        t.scene->has_ambient = false;
        t.scene->method.interface = INTERFACE_SMEARED;
    }
    for (int k = 0; k < 2; ++k)
        put_block(&t, size[k][0], size[k][1], (const double[]){k == 0 ? 10.0 : -10.0, 0.0, 0.0});
    coupled_start(&t);
    trial_run(&t, 0.02);
    const double v[2] = {velocity_of(&t, 0, 0), velocity_of(&t, 1, 0)};
    print_message("h %g, %s: %.4f and %.4f m/s\n", h, gas ? "thin gas" : "no gas", v[0], v[1]);
    check_close(v[0], -v[1], 1.2e-4);
    if (gas) check_ledger(&t, 1.7e-10);
    trial_end(&t);
    return v[0];
}

static void test_collide(void **unused)
{
    (void)unused;
    check_close_relative(collide(true, 0.05), collide(false, 0.05), 0.08);
    if (check_at_length()) check_close_relative(collide(true, 0.025), collide(false, 0.025), 0.025);
}

/* Lowest and highest pressure of open cells over that at the start. */
static void pressures(const trial *t, double range[2])
{
    const size_t n = mesh_cells(&t->sim->mesh);
    double *x = malloc(2 * n * sizeof *x), *open = x + n;
    assert_non_null(x);
    gather_cells(t->sim, C_PRESSURE, 0, 0, 1, x);
    gather_cells(t->sim, C_OPEN, 0, 0, 1, open);
    for (size_t k = 0; k < n; ++k) {
        if (!(open[k] > 0.0)) continue;
        range[0] = fmin(range[0], x[k] / COUPLED_PRESSURE);
        range[1] = fmax(range[1], x[k] / COUPLED_PRESSURE);
    }
    free(x);
}

/* Of two blocks in touch one leaves at 3 m/s: gas comes between them, without a vacuum, and it flies on. */
static void test_leave(void **unused)
{
    (void)unused;
    for (int n = 0; n < 2; ++n) {
        trial t;
        double range[2] = {1.0, 1.0};
        begin(&t, 2, (const double[]){1.2, 1.2, 0.0}, n == 0 ? 0.1 : 0.05, COUPLED_PRESSURE);
        t.scene->contact.enabled = true;
        t.scene->contact.kind = CONTACT_RELEASE;
        put_block(&t, (const double[]){0.4, 0.2, 0.0}, (const double[]){0.8, 0.5, 0.0},
                  (const double[]){0.0, 0.0, 0.0});
        put_block(&t, (const double[]){0.4, 0.5, 0.0}, (const double[]){0.8, 0.8, 0.0},
                  (const double[]){0.0, 3.0, 0.0});
        coupled_start(&t);
        for (int k = 1; k <= 40; ++k) {
            trial_run(&t, 1e-3 * k);
            pressures(&t, range);
        }
        print_message("leaves: %.4f m/s, pressure %.4f to %.4f\n", velocity_of(&t, 1, 1), range[0], range[1]);
        check_close(velocity_of(&t, 1, 1), 3.0, 0.045); /* with each gap a state of its own: 0.047 and 0.058 */
        check_true(range[0] > 0.9 && range[1] < 1.1);
        check_ledger(&t, 1e-14);
        trial_end(&t);
    }
}

/* A body on the floor leaves it at 3 m/s: gas comes beneath it from all sides, and it flies on. A block in the plane, half a disc that the floor cuts,
 * half a block at a mirror, and one in space. It is drawn back at most as by a vacuum until sound has come to the middle: p A (w/2)/c; a
 * fifth of that is measured. */
static void test_leave_side(void **unused)
{
    (void)unused;
    static const double upper[3] = {1.2, 0.9, 0.9}, lo[3] = {0.37, 0.0, 0.3}, hi[3] = {0.77, 0.3, 0.6},
                        up[3] = {0.0, 3.0, 0.0};
    enum { BLOCK, HALF_DISC, HALF_BLOCK, IN_SPACE, N_BODIES };
    static const struct {
        double mass, foot, way; /* kg, m2, m: to the middle */
    } body[] = {{120.0, 0.4, 0.2}, {98.2, 0.5, 0.25}, {231.0, 0.77, 0.77}, {36.0, 0.12, 0.15}};
    const double sound = sqrt(1.4 * 0.4 * 717.5 * COUPLED_TEMPERATURE);
    for (int n = BLOCK; n < N_BODIES; ++n) {
        trial t;
        double range[2] = {1.0, 1.0};
        begin(&t, n == IN_SPACE ? 3 : 2, upper, n == IN_SPACE ? 0.1 : 0.05, COUPLED_PRESSURE);
        if (n == HALF_BLOCK) t.scene->bc.side[0][SIDE_LOWER].kind = BC_SYMMETRY;
        if (n == HALF_DISC)
            memcpy(coupled_body(&t, rubber(&t), make_ball(&t, (const double[]){0.57, 0.0, 0.0}, 0.25), 2)->velocity, up,
                   sizeof up);
        else
            put_block(&t, n == HALF_BLOCK ? (const double[]){0.0, 0.0, 0.0} : lo, hi, up);
        coupled_start(&t);
        for (int k = 1; k <= 40; ++k) {
            trial_run(&t, 1e-3 * k);
            pressures(&t, range);
        }
        const double lost = 3.0 - velocity_of(&t, 0, 1),
                     most = COUPLED_PRESSURE * body[n].foot * body[n].way / sound / body[n].mass;
        print_message("leaves a side: %.4f of 3 m/s lost, by a vacuum %.4f; pressure %.4f to %.4f\n", lost, most,
                      range[0], range[1]);
        check_true(lost > 0.0 && lost < 0.3 * most);
        check_true(range[0] > 0.8 && range[1] < 1.2);
        check_ledger(&t, 1e-13);
        trial_end(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_side),
        cmocka_unit_test(test_collide),
        cmocka_unit_test(test_leave),
        cmocka_unit_test(test_leave_side),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
