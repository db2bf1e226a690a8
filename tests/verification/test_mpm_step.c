/* The time step of points: mirrored scenes give mirrored results; limits seen from both sides; walls; a rejected step leaves no
 * trace; checked stages keep to what they say they read and write. */
#include "mpm_fixture.h"

#include "base/memory.h"

enum { MAX_POINTS = 3000, WORDS = 9 };

/* State of each point by id: position, velocity, stress, J. */
typedef struct shot {
    double (*value)[WORDS];
    size_t n;
} shot;

static void keep(void *user, const fields *f, int body, size_t k)
{
    shot *s = user;
    const size_t row = (size_t)field_get(f, P_ID, body, 0)[k];
    assert_true(row < MAX_POINTS);
    double *v = s->value[row];
    for (int a = 0; a < 2; ++a) {
        v[a] = field_get(f, P_POS, body, a)[k];
        v[2 + a] = field_get(f, P_VEL, body, a)[k];
    }
    for (int c = 0; c < 4; ++c) v[4 + c] = field_get(f, P_STRESS, body, c)[k];
    v[8] = field_get(f, P_J, body, 0)[k];
    s->n++;
}

static shot take(const trial *t)
{
    shot s = {.value = calloc(MAX_POINTS, sizeof *s.value)};
    visit_points(t, 0, keep, &s);
    return s;
}

/* A disc that hits a wall on one side, or its mirror image; the domain is [-1, 1]^2. */
static trial make_disc(const char *basis, int axis, double sign)
{
    trial t;
    const double size[3] = {1.0, 1.0, 0.0};
    trial_begin(&t, 2, size, 0.125);
    for (int a = 0; a < 2; ++a) {
        t.scene->mesh.lower[a] = -1.0;
        set_sides(&t, a, BC_NO_SLIP, BC_NO_SLIP);
    }
    set_method(&t, basis, STRESS_USL, 1.0);
    double centre[3] = {0.0, 0.0, 0.0};
    centre[axis] = 0.25 * sign;
    scene_body *b = add_body(&t, add_solid(&t, "linear_elastic", 5.0, 2.0, 1.0), make_ball(&t, centre, 0.5), 2);
    b->velocity[axis] = 0.9 * sign;
    b->velocity[1 - axis] = 0.1;
    return t;
}

/* Steps agree to round-off, whatever the direction in which the fastest point goes; so does what the walls take. */
static void test_mirror(void **state)
{
    (void)state;
    for (size_t i = 0; i < basis_registry_size; ++i)
        for (int axis = 0; axis < 2; ++axis) {
            trial t[2];
            for (int k = 0; k < 2; ++k) {
                t[k] = make_disc(basis_registry[i]->name, axis, k ? -1.0 : 1.0);
                trial_start(&t[k]);
            }
            for (int step = 0; step < 60; ++step) {
                for (int k = 0; k < 2; ++k) trial_steps(&t[k], 1);
                check_close_relative(t[0].sim->dt, t[1].sim->dt, 1e-10);
            }
            sim_totals a, b;
            check_ok(t[0].ctx, sim_sum(t[0].sim, &a));
            check_ok(t[1].ctx, sim_sum(t[1].sim, &b));
            check_close(a.momentum[axis], -b.momentum[axis], 2e-12);
            check_close(a.momentum[1 - axis], b.momentum[1 - axis], 2e-12);
            check_close_relative(a.kinetic + a.strain, b.kinetic + b.strain, 2e-12);
            check_true(a.momentum[axis] < 0.7 * 0.9 * a.mass); /* the wall was met */
            for (int k = 0; k < 2; ++k) {
                check_true(ledger_worst(&t[k], LEDGER_MASS, LEDGER_MOMENTUM_Y) <= 1e-12);
                trial_end(&t[k]);
            }
        }
}

/* The step is the stated share of h/(c + |v|), from the fastest point and the stiffest body. */
static void test_limit(void **state)
{
    (void)state;
    for (double speed = -30.0; speed <= 30.0; speed += 30.0) {
        trial t;
        const double size[3] = {1.0, 0.0, 0.0}, lo[3] = {0.2, 0.0, 0.0}, hi[3] = {0.4, 1.0, 1.0};
        trial_begin(&t, 1, size, 0.1);
        t.scene->time.cfl_mpm = 0.4;
        const int solid = add_solid(&t, "linear_elastic", 80.0, 15.0, 1.0); /* c = 10 */
        add_body(&t, solid, make_box(&t, lo, hi), 2)->velocity[0] = speed;
        trial_start(&t);
        trial_steps(&t, 1);
        check_close_relative(t.sim->dt, 0.4 * 0.1 / (10.0 + fabs(speed)), 1e-12);
        trial_end(&t);
    }
}

/* Walls that move with a velocity carry a body that fills the domain with them. */
static void test_velocity_walls(void **state)
{
    (void)state;
    for (size_t i = 0; i < basis_registry_size; ++i) {
        trial t;
        const double size[3] = {1.0, 1.0, 0.0}, lo[3] = {0.0, 0.0, 0.0}, hi[3] = {1.0, 1.0, 1.0};
        trial_begin(&t, 2, size, 0.125);
        set_sides(&t, 0, BC_PERIODIC, BC_PERIODIC);
        set_sides(&t, 1, BC_VELOCITY, BC_VELOCITY);
        for (int side = 0; side < 2; ++side) t.scene->bc.side[1][side].velocity[0] = 0.3;
        set_method(&t, basis_registry[i]->name, STRESS_USL, 1.0);
        add_body(&t, add_solid(&t, "linear_elastic", 5.0, 2.0, 1.0), make_box(&t, lo, hi), 2)->velocity[0] = 0.3;
        trial_start(&t);
        trial_run(&t, 2.0);
        sim_totals totals;
        check_ok(t.ctx, sim_sum(t.sim, &totals));
        check_close(totals.momentum[0], 0.3, 1e-11);
        check_close(totals.strain, 0.0, 1e-18);
        assert_int_equal(t.sim->ledger.count[COUNT_POINTS_LOST], 0);
        trial_end(&t);
    }
}

/* A step far beyond the limit inverts points: it is rejected, and the run goes on as if it had asked for the smaller one. */
static void test_rejection(void **state)
{
    (void)state;
    for (size_t i = 0; i < basis_registry_size; ++i)
        for (int scheme = STRESS_USL; scheme <= STRESS_MUSL; ++scheme) {
            trial t[2];
            for (int k = 0; k < 2; ++k) {
                t[k] = make_disc(basis_registry[i]->name, 0, 1.0);
                t[k].scene->method.stress = (stress_scheme)scheme;
                t[k].scene->material[0].law = solid_find("neo_hookean");
                trial_start(&t[k]);
                trial_run(&t[k], 0.5);
            }
            const long steps = t[0].sim->steps;
            const shot before = take(&t[0]);
            t[0].scene->time.fixed_step = 64.0;
            check_ok(t[0].ctx, sim_step(t[0].sim, INFINITY));
            assert_true(t[0].sim->rejected > 0);
            assert_int_equal(t[0].sim->steps, steps + 1);
            /* The other goes to the same place by asking for the step that was taken in the end. */
            t[1].scene->time.fixed_step = t[0].sim->dt;
            check_ok(t[1].ctx, sim_step(t[1].sim, INFINITY));
            const shot a = take(&t[0]), b = take(&t[1]);
            assert_int_equal(before.n, a.n);
            assert_memory_equal(a.value, b.value, MAX_POINTS * sizeof *a.value);
            check_true(ledger_worst(&t[0], LEDGER_MASS, LEDGER_MOMENTUM_Y) <= 1e-12);
            assert_memory_equal(&t[0].sim->ledger.entry, &t[1].sim->ledger.entry, sizeof t[0].sim->ledger.entry);
            free(before.value);
            free(a.value);
            free(b.value);
            for (int k = 0; k < 2; ++k) trial_end(&t[k]);
        }
}

/* What cannot be saved by smaller steps ends the run as diverged, and leaves the last good state. */
static void test_divergence(void **state)
{
    (void)state;
    trial t = make_disc("quadratic", 0, 1.0);
    trial_start(&t);
    trial_run(&t, 0.2);
    const shot before = take(&t);
    double *J = field_get(t.sim->domain->fields[0], P_J, 0, 0);
    const double kept = J[7];
    J[7] = -1.0; /* beyond any law, whatever the step */
    t.scene->time.fixed_step = 1e-3;
    check_fails(t.ctx, sim_step(t.sim, INFINITY), FLOE_DIVERGED);
    assert_int_equal(t.sim->rejected, 11);
    field_get(t.sim->domain->fields[0], P_J, 0, 0)[7] = kept;
    const shot after = take(&t);
    assert_memory_equal(before.value, after.value, MAX_POINTS * sizeof *before.value);
    check_ok(t.ctx, sim_step(t.sim, INFINITY));
    free(before.value);
    free(after.value);
    trial_end(&t);
}

/* With checking on, stages write NaN into what they will write, and sum up what they must not touch. */
static void test_checked_stages(void **state)
{
    (void)state;
    for (size_t i = 0; i < basis_registry_size; ++i)
        for (int scheme = STRESS_USL; scheme <= STRESS_MUSL; ++scheme)
            for (int law = 0; law < 2; ++law) {
                trial t = make_disc(basis_registry[i]->name, 0, 1.0);
                t.scene->method.stress = (stress_scheme)scheme;
                t.scene->material[0].law = solid_find(law ? "neo_hookean" : "linear_elastic");
                t.scene->material[0].artificial_linear = law ? 0.2 : 0.0;
                t.scene->stress_state = law ? STRESS_FULL : STRESS_PLANE;
                add_body(&t, add_gas(&t, 1.4, 1.0), make_ball(&t, (const double[]){-0.6, 0.0, 0.0}, 0.2), 2);
                t.scene->body[1].pressure = t.scene->body[1].density = 1.0;
                trial_start(&t);
                t.sim->stages.checking = true;
                trial_steps(&t, 12);
                sim_totals totals;
                check_ok(t.ctx, sim_sum(t.sim, &totals));
                check_true(isfinite(totals.kinetic + totals.strain + totals.internal));
                trial_end(&t);
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mirror),    cmocka_unit_test(test_limit),      cmocka_unit_test(test_velocity_walls),
        cmocka_unit_test(test_rejection), cmocka_unit_test(test_divergence), cmocka_unit_test(test_checked_stages),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
