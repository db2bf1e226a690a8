/* Gas and solids about an axis: rest, momentum along the axis, energy. (Lame's cylinder and sphere: test_mpm_states.c.) */
#include "mpm_fixture.h"

typedef struct vessel {
    const char *basis;
    int per_cell;
    double kick;    /* m/s: size of the velocities at first, random */
    double scatter; /* of the points about their positions, in shares of the space that their cell leaves them */
} vessel;

static double chance(const fields *f, int body, size_t k, int number)
{
    uint64_t seed = 4 * (uint64_t)field_get(f, P_ID, body, 0)[k] + (uint64_t)number;
    return check_random(&seed, -1.0, 1.0);
}

static void disturb(void *user, const fields *f, int body, size_t k)
{
    const vessel *v = user;
    for (int a = 0; a < 2; ++a) {
        field_get(f, P_VEL, body, a)[k] += v->kick * chance(f, body, k, a);
        field_get(f, P_POS, body, a)[k] += v->scatter * 0.05 / v->per_cell * chance(f, body, k, 2 + a);
    }
}

/* Gas of density and pressure 1 (c = 1.18) at rest in a closed cylinder of radius 1, height 1.6. */
static void fill_vessel(trial *t, const vessel *v)
{
    const double corner[3] = {0}, end[3] = {1.0, 1.6, 0.0};
    trial_begin(t, 2, end, 0.1);
    t->scene->mesh.geometry = MESH_AXISYMMETRIC;
    set_sides(t, 0, BC_SYMMETRY, BC_SLIP);
    set_sides(t, 1, BC_SLIP, BC_SLIP);
    set_method(t, v->basis, STRESS_USL, 1.0);
    scene_body *b = add_body(t, add_gas(t, 1.4, 2.5), make_box(t, corner, end), v->per_cell);
    b->density = b->pressure = 1.0;
    trial_start(t);
    vessel copy = *v;
    visit_points(t, 0, disturb, &copy);
}

typedef struct largest {
    double speed, pressure;
} largest;

static void find_largest(void *user, const fields *f, int body, size_t k)
{
    largest *m = user;
    for (int a = 0; a < 2; ++a) m->speed = fmax(m->speed, fabs(field_get(f, P_VEL, body, a)[k]));
    m->pressure = fmax(m->pressure, fabs(field_get(f, P_STRESS, body, 0)[k] + 1.0));
}

static largest vessel_run(const vessel *v, double until)
{
    trial t;
    fill_vessel(&t, v);
    trial_run(&t, until);
    largest m = {0};
    visit_points(&t, 0, find_largest, &m);
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MASS) <= 1e-14);
    check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) <= 4.5e-5);
    print_message("%s, %d a cell, kick %g, scatter %g, t = %g: speed %.1e, pressure off by %.1e\n", v->basis,
                  v->per_cell, v->kick, v->scatter, until, m.speed, m.pressure);
    trial_end(&t);
    return m;
}

/* Uniform pressure gives no force, at the axis neither. The quadratic basis with two points a cell integrates the first node off
 * the axis to 3 % only, at any spacing: gas there settles 4 % off its pressure; with the cubic one it always does. */
static void test_rest(void **state)
{
    (void)state;
    for (size_t i = 0; i < basis_registry_size; ++i)
        for (int n = 1; n <= 3; ++n) {
            const bool off = basis_is(basis_registry[i], "quadratic") && n == 2;
            const largest m = vessel_run(&(vessel){basis_registry[i]->name, n, 0.0, 0.0}, 1.0);
            const double cubic[] = {0.16, 0.045, 0.02}; /* 0.15, 0.040, 0.018 */
            const double pressure = basis_is(basis_registry[i], "cubic") ? cubic[n - 1] : off ? 0.05 : 1e-12;
            check_true(m.speed <= (pressure > 1e-3 ? 0.1 * pressure : 1e-13));
            check_true(m.pressure <= pressure);
        }
}

/* With the linear basis gas pushes nothing wherever in their cells its points are, and small motions stay small: with the hoop
 * terms at the points, not at the centres, they doubled within four crossings, and reached the speed of sound within ten. What is
 * kicked here swings on without a wall's or a viscosity's damping: at most 0.0096 at any time. */
static void test_disorder(void **state)
{
    (void)state;
    for (int n = 1; n <= 3; ++n) {
        check_true(vessel_run(&(vessel){"linear", n, 0.0, 1.0}, 0.2).speed <= 1e-13);
        check_true(vessel_run(&(vessel){"linear", n, 0.004, 0.0}, 4.0).speed <= 0.012);
    }
}

static const double height = 0.7; /* m: the ball's centre at first */

/* Velocity (a r, -2 a (z - height)) on top of the flight: the ball swings between flat and long. */
static void squeeze(void *user, const fields *f, int body, size_t k)
{
    const double a = *(const double *)user;
    field_get(f, P_VEL, body, 0)[k] += a * field_get(f, P_POS, body, 0)[k];
    field_get(f, P_VEL, body, 1)[k] -= 2.0 * a * (field_get(f, P_POS, body, 1)[k] - height);
}

/* An elastic ball flies along the axis of a pipe that closes on itself, vibrating: momentum along the axis to round-off; energy, which
 * goes to and fro between the three normal stresses and motion, to the order of the method. */
static void test_flight(void **state)
{
    (void)state;
    for (size_t i = 0; i < basis_registry_size; ++i) {
        trial t;
        trial_begin(&t, 2, (const double[]){0.8, 1.6, 0.0}, 0.05);
        t.scene->mesh.geometry = MESH_AXISYMMETRIC;
        set_sides(&t, 0, BC_SYMMETRY, BC_FREE);
        set_sides(&t, 1, BC_PERIODIC, BC_PERIODIC);
        set_method(&t, basis_registry[i]->name, STRESS_USL, 1.0);
        t.scene->time.cfl_mpm = 0.2;
        const int rubber = add_solid(&t, "neo_hookean", 50.0, 20.0, 2.0);
        add_body(&t, rubber, make_ball(&t, (const double[]){0.0, height, 0.0}, 0.5), 2)->velocity[1] = 1.0;
        trial_start(&t);
        double rate = 0.5;
        visit_points(&t, 0, squeeze, &rate);
        check_ok(t.ctx, sim_open_ledger(t.sim)); /* the account begins after the squeeze */
        trial_run(&t, 2.0);
        const double energy = ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY);
        print_message("%s: energy drift %.1e\n", basis_registry[i]->name, energy);
        check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MASS) <= 1e-14);
        check_true(ledger_worst(&t, LEDGER_MOMENTUM_Y, LEDGER_MOMENTUM_Y) <= 1e-13);
        /* 3.5e-2 and 6.9e-3 with the smooth bases at h = 0.1 and 0.05, 2.6e-2 with the linear one; plane strain has the same */
        check_true(energy <= (basis_is(basis_registry[i], "linear")  ? 0.035
                              : basis_is(basis_registry[i], "cubic") ? 0.015
                                                                     : 0.01));
        trial_end(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rest),
        cmocka_unit_test(test_disorder),
        cmocka_unit_test(test_flight),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
