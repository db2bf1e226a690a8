/* The thick cylinder of Guilkey et al. (2003), section 3, loaded by a traction on its bore: the solid's part of the error, without
 * gas. A quarter in plane strain, ramped, damped to rest; the error of their eq. 13 over all points. */
#include "mpm_fixture.h"

static const double bore = 0.5, outside = 1.0, pressure = 19.4e6;

typedef struct annulus {
    const char *basis;
    double h;
    int per_cell;
    seed_method seeding;
} annulus;

static void make_annulus(trial *t, const annulus *a)
{
    const double upper = ceil(1.05 / a->h) * a->h, size[3] = {upper, upper, 0.0};
    trial_begin(t, 2, size, a->h);
    for (int axis = 0; axis < 2; ++axis) set_sides(t, axis, BC_SYMMETRY, BC_FREE);
    set_method(t, a->basis, STRESS_USL, 0.99);
    t->scene->time.growth = 1.1;
    t->scene->damping.rate = 1.2e4;
    t->scene->rest = (scene_rest){true, 1e-6, 1.1e-3, 1.4e-3};
    const int steel = add_solid(t, "linear_elastic", 117e9, 43.8e9, 8900.0);
    add_body(t, steel, make_ring(t, bore, outside), a->per_cell)->seeding = a->seeding;
    scene_load *load = add_load(t, LOAD_TRACTION, 0);
    load->region = make_ball(t, (const double[]){0.0, 0.0, 0.0}, bore);
    load->ramp = 1.4e-3;
    load->target = pressure;
    trial_start(t);
}

typedef struct sums {
    double *value;
    size_t n;
} sums;

static void add_sum(void *user, const fields *f, int body, size_t k)
{
    sums *s = user;
    s->value[s->n++] = field_get(f, P_STRESS, body, 0)[k] + field_get(f, P_STRESS, body, 1)[k];
}

static double error_of(const annulus *a)
{
    trial t;
    make_annulus(&t, a);
    trial_settle(&t, 12e-3);
    sums s = {.value = calloc(mpm_count(t.sim->mpm), sizeof(double))};
    visit_points(&t, 0, add_sum, &s);
    const double error = 100.0 * guilkey_eq13(s.n, s.value, pressure, bore, outside);
    free(s.value);
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MASS) == 0.0);
    check_true(ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_Y) <= 1e-10);
    print_message("%s h = %g, %d x %d points a cell: %.2f %%, momentum ledger %.1e\n", a->basis, a->h, a->per_cell,
                  a->per_cell, error, ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_Y));
    trial_end(&t);
    return error;
}

/* A static solution with the same points as quadrature, solved directly, has 22.6, 11.3, 6.4 % (the load on nodes without
 * points dropped; here others take it). */
static void test_linear_lattice(void **state)
{
    (void)state;
    const double expected[] = {22.6, 11.3, 6.4}, h[] = {0.1, 0.05, 0.025};
    double error[3];
    order_fit fit;
    context *ctx = context_create();
    for (int k = 0; k < 3; ++k) {
        error[k] = error_of(&(annulus){"linear", h[k], 2, SEED_LATTICE});
        check_close(error[k], expected[k], 0.5);
    }
    check_ok(ctx, order_fit_power(ctx, 3, h, error, &fit));
    check_true(fit.order >= 0.85); /* 0.90; Guilkey et al.: 0.89 */
    context_destroy(&ctx);
}

/* Bars: 5, 4, 2.5 %; measured 3.7, 2.3, 1.7. */
static void test_quadratic_fitted(void **state)
{
    (void)state;
    check_true(error_of(&(annulus){"quadratic", 0.1, 2, SEED_FITTED}) <= 5.0);
    check_true(error_of(&(annulus){"quadratic", 0.05, 2, SEED_FITTED}) <= 3.0);
    if (check_at_length()) check_true(error_of(&(annulus){"quadratic", 0.025, 2, SEED_FITTED}) <= 2.5);
}

/* Spacings at which a point stands at the very edge of a loaded node's support: 2.8, 2.3 and 2.2 % (6.5, 16.6 and 9.5 % when
 * that node takes the load that the basis gives it, with 10 to 75 times the stress at the point). */
static void test_slivers(void **state)
{
    (void)state;
    check_true(error_of(&(annulus){"quadratic", 0.04, 2, SEED_FITTED}) <= 3.5);
    check_true(error_of(&(annulus){"quadratic", 0.04, 3, SEED_FITTED}) <= 3.0);
    if (check_at_length()) check_true(error_of(&(annulus){"quadratic", 0.025, 3, SEED_FITTED}) <= 2.0);
}

/* Domains of fitted points do not tile; the order of linear elements stays. */
static void test_gimp(void **state)
{
    (void)state;
    check_true(error_of(&(annulus){"gimp", 0.05, 2, SEED_LATTICE}) <= 14.0);
    check_true(error_of(&(annulus){"gimp", 0.05, 2, SEED_FITTED}) <= 14.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_linear_lattice),
        cmocka_unit_test(test_quadratic_fitted),
        cmocka_unit_test(test_slivers),
        cmocka_unit_test(test_gimp),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
