/* What points must keep: momentum to round-off in flight and collision, mass exactly, a rigid translation untouched; angular
 * momentum and energy are reported. And what the ledger must hold when points leave. */
#include "mpm_fixture.h"

typedef struct sums {
    double mass, momentum[3], spin, kinetic, largest_stress, largest_velocity_error;
    double flight[3];
    size_t n;
} sums;

static void add_point(void *user, const fields *f, int body, size_t k)
{
    sums *s = user;
    const double m = field_get(f, P_MASS, body, 0)[k];
    double x[2], v[2];
    for (int a = 0; a < 2; ++a) {
        x[a] = field_get(f, P_POS, body, a)[k];
        v[a] = field_get(f, P_VEL, body, a)[k];
        s->momentum[a] += m * v[a];
        s->kinetic += 0.5 * m * v[a] * v[a];
        s->largest_velocity_error = fmax(s->largest_velocity_error, fabs(v[a] - s->flight[a]));
    }
    s->mass += m;
    s->spin += m * (x[0] * v[1] - x[1] * v[0]);
    for (int c = 0; c < 4; ++c) s->largest_stress = fmax(s->largest_stress, fabs(field_get(f, P_STRESS, body, c)[k]));
    s->n++;
}

static sums sum_points(const trial *t, const double flight[3])
{
    sums s = {.n = 0};
    if (flight) memcpy(s.flight, flight, sizeof s.flight);
    for (int body = 0; body < t->scene->n_bodies; ++body) visit_points(t, body, add_point, &s);
    return s;
}

static const double bulk = 5.0, shear = 2.0;

/* One disc across many cells: no stress but round-off, no change of velocity. */
static void test_flight(void **state)
{
    (void)state;
    const double size[3] = {3.0, 2.0, 0.0}, v[3] = {0.8, 0.31, 0.0};
    for (size_t i = 0; i < basis_registry_size; ++i)
        for (int scheme = STRESS_USL; scheme <= STRESS_MUSL; ++scheme) {
            trial t;
            trial_begin(&t, 2, size, 0.1);
            set_method(&t, basis_registry[i]->name, (stress_scheme)scheme, i % 2 ? 0.97 : 1.0);
            scene_body *b = add_body(&t, add_solid(&t, "linear_elastic", bulk, shear, 1.0),
                                     make_ball(&t, (const double[]){0.6, 0.6, 0.0}, 0.4), 2);
            memcpy(b->velocity, v, sizeof v);
            trial_start(&t);
            const sums before = sum_points(&t, v);
            trial_run(&t, 1.5);
            const sums after = sum_points(&t, v);
            assert_int_equal(before.n, after.n);
            check_true(before.mass == after.mass || fabs(before.mass - after.mass) < 1e-15);
            check_true(after.largest_velocity_error <= 1e-11);
            check_true(after.largest_stress <= 1e-10 * bulk);
            check_close(after.momentum[0], before.momentum[0], 1e-13);
            trial_end(&t);
        }
}

/* Two discs meet, deform, part (Sulsky, Chen, Schreyer 1994): momentum within 1e-13 of the sum of its sizes. */
static void collide(const char *basis, stress_scheme scheme)
{
    trial t;
    const double size[3] = {2.0, 2.0, 0.0};
    trial_begin(&t, 2, size, 0.1);
    set_method(&t, basis, scheme, 1.0);
    t.scene->time.cfl_mpm = 0.3;
    const int solid = add_solid(&t, "neo_hookean", bulk, shear, 1.0);
    scene_body *a = add_body(&t, solid, make_ball(&t, (const double[]){0.6, 0.65, 0.0}, 0.3), 3);
    scene_body *b = add_body(&t, solid, make_ball(&t, (const double[]){1.4, 1.25, 0.0}, 0.3), 3);
    a->velocity[0] = a->velocity[1] = 0.15;
    b->velocity[0] = b->velocity[1] = -0.15;
    trial_start(&t);
    const sums before = sum_points(&t, NULL);
    trial_run(&t, 4.0);
    const sums after = sum_points(&t, NULL);
    sim_totals totals;
    check_ok(t.ctx, sim_sum(t.sim, &totals));
    const double scale = 2.0 * 0.15 * before.mass;
    for (int axis = 0; axis < 2; ++axis) check_close(after.momentum[axis], before.momentum[axis], 1e-13 * scale);
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MOMENTUM_Y) <= 1e-13);
    print_message("%-9s scheme %d: angular momentum %.5f -> %.5f, kinetic %.5f -> %.5f, with strain %.5f\n", basis,
                  (int)scheme, before.spin, after.spin, before.kinetic, after.kinetic, after.kinetic + totals.strain);
    trial_end(&t);
}

static void test_collision(void **state)
{
    (void)state;
    for (size_t i = 0; i < basis_registry_size; ++i)
        for (int scheme = STRESS_USL; scheme <= STRESS_MUSL; ++scheme)
            collide(basis_registry[i]->name, (stress_scheme)scheme);
}

/* A body in flight that is damped falls behind with all its points alike, and the ledger holds what it has lost. */
static void test_damping(void **state)
{
    (void)state;
    const double size[3] = {3.0, 2.0, 2.5}, v[3] = {0.8, 0.31, -0.17}, rate = 0.7, end = 0.6;
    for (size_t i = 0; i < basis_registry_size; ++i)
        for (int dim = 2; dim <= (i == 0 ? 3 : 2); ++dim) {
            trial t;
            trial_begin(&t, dim, size, dim == 3 ? 0.25 : 0.1);
            set_method(&t, basis_registry[i]->name, (stress_scheme)(i % 3), 1.0);
            t.scene->damping.rate = rate;
            scene_body *b = add_body(&t, add_solid(&t, "linear_elastic", bulk, shear, 1.0),
                                     make_ball(&t, (const double[]){1.2, 0.9, 1.3}, 0.6), 2);
            memcpy(b->velocity, v, sizeof v);
            trial_start(&t);
            trial_run(&t, end);
            const double left = exp(-rate * t.sim->time);
            const sums after = sum_points(&t, (const double[]){left * v[0], left * v[1], left * v[2]});
            check_true(after.largest_velocity_error <= 7e-3); /* a fraction of each step */
            check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MOMENTUM_Z) <= 2e-15);
            check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) <=
                       (strcmp(basis_registry[i]->name, "linear") == 0 ? 1.2e-6 : 1e-14));
            trial_end(&t);
        }
}

/* A disc leaves through an open side: what it carried is in the ledger. */
static void test_leaving(void **state)
{
    (void)state;
    const double size[3] = {1.0, 1.0, 0.0};
    for (size_t i = 0; i < basis_registry_size; ++i) {
        trial t;
        trial_begin(&t, 2, size, 0.1);
        set_method(&t, basis_registry[i]->name, STRESS_USL, 1.0);
        scene_body *b = add_body(&t, add_solid(&t, "linear_elastic", bulk, shear, 1.0),
                                 make_ball(&t, (const double[]){0.6, 0.5, 0.0}, 0.3), 2);
        b->velocity[0] = 1.0;
        trial_start(&t);
        const size_t n = mpm_count(t.sim->mpm);
        trial_run(&t, 0.45);
        const size_t left = mpm_count(t.sim->mpm);
        check_true(left > 0 && left < n);
        assert_int_equal(t.sim->ledger.count[COUNT_POINTS_LOST], n - left);
        check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MOMENTUM_Y) <= 1e-13);
        trial_end(&t);
    }
}

/* A disc that falls and bounces: the ledger holds what the weight gives, so that momentum is kept to round-off and energy to the
 * half step between velocities and places. */
static void test_fall(void **state)
{
    (void)state;
    for (size_t i = 0; i < basis_registry_size; ++i) {
        trial t;
        trial_begin(&t, 2, (const double[]){1.6, 2.4, 0.0}, 0.1);
        set_sides(&t, 1, BC_SLIP, BC_FREE);
        set_method(&t, basis_registry[i]->name, STRESS_MUSL, 1.0);
        add_body(&t, add_solid(&t, "linear_elastic", bulk, shear, 1.0),
                 make_ball(&t, (const double[]){0.8, 1.0, 0.0}, 0.4), 2);
        scene_load *weight = add_load(&t, LOAD_BODY_FORCE, 0);
        weight->vector[0] = 0.05;
        weight->vector[1] = -0.3;
        trial_start(&t);
        trial_run(&t, 1.6); /* the wall is felt from 1.7 on */
        const double energy = ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY);
        trial_run(&t, 3.0);
        const double momentum = ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_Y);
        print_message("%s falls: momentum %.1e, energy %.1e\n", basis_registry[i]->name, momentum, energy);
        check_true(momentum <= 1e-13);
        check_true(energy <= 6e-3); /* 3.7e-3: half a step against the fall */
        trial_end(&t);
    }
}

/* A disc pressed into a corner of a mirror and a wall that holds its nodes, by points that take a part of the nodes' velocity: across the
 * mirror, the first inner node of that wall has the wall's velocity, and so has its image. */
static void test_corner(void **state)
{
    (void)state;
    for (size_t i = 0; i < basis_registry_size; ++i)
        for (int axis = 0; axis < 2; ++axis) {
            trial t;
            trial_begin(&t, 2, (const double[]){1.6, 1.6, 0.0}, 0.1);
            set_sides(&t, axis, BC_SLIP, BC_FREE);
            set_sides(&t, 1 - axis, BC_NO_SLIP, BC_FREE);
            set_method(&t, basis_registry[i]->name, STRESS_USL, 0.8);
            scene_body *b = add_body(&t, add_solid(&t, "linear_elastic", bulk, shear, 1.0),
                                     make_ball(&t, (const double[]){0.35, 0.35, 0.0}, 0.4), 2);
            b->velocity[0] = -0.3;
            b->velocity[1] = -0.2;
            trial_start(&t);
            trial_run(&t, 0.3);
            check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MOMENTUM_Y) <= 1e-13);
            trial_end(&t);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_flight),  cmocka_unit_test(test_damping), cmocka_unit_test(test_collision),
        cmocka_unit_test(test_leaving), cmocka_unit_test(test_fall),    cmocka_unit_test(test_corner),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
