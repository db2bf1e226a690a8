/* Heat between fluids of the cells and solids on points, smeared: two materials in every cell against the exponential, a block in a liquid
 * from slow exchange to locked, in the plane, about an axis and in space, for any blocks; nothing made or lost. */
#include "coupled_fixture.h"

static const double liquid_heat = 2.0, solid_heat = 1.5,
                    solid_density = 3.0;   /* specific heats and density; the liquid's is 1 */
static const double hot = 3.0, cold = 1.0; /* K: of the liquid and of the solid */

/* A box of cells h full of liquid between mirrors; returns the solid. */
static int begin(trial *t, int dim, const double upper[3], double h, double exchange, double conductivity)
{
    trial_begin(t, dim, upper, h);
    scene *s = t->scene;
    for (int a = 0; a < dim; ++a) set_sides(t, a, BC_SYMMETRY, BC_SYMMETRY);
    s->coupling = COUPLING_ICE_MPM;
    s->reference_pressure = s->ambient_pressure = 1.0;
    s->has_ambient = true;
    s->ambient_material = coupled_liquid(t, liquid_heat, conductivity);
    s->ambient_temperature = hot;
    s->method.heat_exchange = exchange;
    set_method(t, "quadratic", STRESS_USL, 1.0);
    const int solid = add_solid(t, "linear_elastic", 1000.0, 500.0, solid_density);
    scene_material *m = &s->material[solid];
    m->specific_heat = solid_heat;
    m->tension_switch = 1.0;
    m->conductivity = conductivity;
    return solid;
}

static double heat_of_points(const trial *t)
{
    mpm_totals sum;
    check_ok(t->ctx, mpm_sum(t->sim->mpm, &sum));
    double heat = 0.0;
    for (int b = 0; b < t->sim->mpm->n_bodies; ++b) heat += sum.heat[b];
    return heat;
}

static double mass_of_points(const trial *t)
{
    mpm_totals sum;
    check_ok(t->ctx, mpm_sum(t->sim->mpm, &sum));
    double mass = 0.0;
    for (int b = 0; b < t->sim->mpm->n_bodies; ++b) mass += sum.mass[b];
    return mass;
}

/* ---- every cell alike ---- */

/* Half of each of eight cells is solid. The difference of temperatures decays with R theta_s theta_l (1/C_s + 1/C_l), C the capacities
 * per volume of the cells. */
static void test_exponential(void **unused)
{
    (void)unused;
    const double upper[3] = {0.8, 1.0, 1.0}, R = 8.0, dt = 1e-4, end = 0.5;
    trial t;
    const int solid = begin(&t, 1, upper, 0.1, R, 0.0);
    for (int k = 0; k < 8; ++k) {
        const double lo[3] = {0.1 * k + 0.025, 0.0, 0.0}, hi[3] = {0.1 * k + 0.075, 1.0, 1.0};
        coupled_body(&t, solid, make_box(&t, lo, hi), 4)->temperature = cold;
    }
    t.scene->time.fixed_step = dt;
    coupled_start(&t);
    trial_run(&t, end);
    const double C_s = 0.5 * solid_density * solid_heat, C_l = 0.5 * liquid_heat;
    const double rate = R * 0.25 * (1.0 / C_s + 1.0 / C_l), mean = (C_s * cold + C_l * hot) / (C_s + C_l);
    const double T = heat_of_points(&t) / (mass_of_points(&t) * solid_heat);
    const double share = (mean - T) / (mean - cold); /* of the difference that is left */
    /* exchange is implicit: of first order in the step, with the error 1/2 rate^2 t dt */
    check_close(share, exp(-rate * end), 0.55 * rate * rate * end * dt * exp(-rate * end));
    check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) <= 1e-12);
    trial_end(&t);
}

/* ---- a block in a liquid ---- */

typedef struct vessel {
    int dim;
    bool radial;
    double exchange, end;
    int blocks; /* along each axis; 0: one, of larger cells */
} vessel;

static void fill_vessel(trial *t, const vessel *v)
{
    const double upper[3] = {1.0, 1.0, 1.0}, lo[3] = {v->radial ? 0.0 : 0.33, 0.35, 0.35}, hi[3] = {0.67, 0.65, 0.65};
    const int solid = begin(t, v->dim, upper, v->dim == 3 ? 0.2 : v->blocks > 0 ? 0.0625 : 0.1, v->exchange, 2.0);
    if (v->radial) t->scene->mesh.geometry = MESH_AXISYMMETRIC;
    for (int a = 0; a < v->dim; ++a) t->scene->mesh.blocks[a] = v->blocks > 0 ? v->blocks : 1;
    coupled_body(t, solid, make_box(t, lo, hi), 2)->temperature = cold;
    coupled_start(t);
}

/* K: a temperature for both, by their capacities at the start. */
static double common_temperature(const trial *t)
{
    sim_totals sum;
    check_ok(t->ctx, sim_sum(t->sim, &sum));
    const double solid = mass_of_points(t) * solid_heat, liquid = (sum.mass - mass_of_points(t)) * liquid_heat;
    return (solid * cold + liquid * hot) / (solid + liquid);
}

typedef struct spread {
    double least, most;
} spread;

static void add_temperature(void *user, const fields *f, int body, size_t k)
{
    spread *s = user;
    const double T = field_get(f, P_TEMP, body, 0)[k];
    s->least = fmin(s->least, T);
    s->most = fmax(s->most, T);
}

/* Slow, fast and locked: the warmer, the faster; locked until all has one temperature. */
static void test_block(void **unused)
{
    (void)unused;
    static const double exchange[] = {0.1, 10.0, 1e20};
    double before = cold;
    for (int k = 0; k < 3; ++k) {
        trial t;
        const vessel v = {2, false, exchange[k], k == 2 ? 6.0 : 0.5, 0};
        fill_vessel(&t, &v);
        const double common = common_temperature(&t);
        trial_run(&t, v.end);
        spread s = {INFINITY, -INFINITY};
        visit_points(&t, 0, add_temperature, &s);
        check_true(s.least > before && s.most < common * (1.0 + 1e-12));
        if (k == 2) check_close(s.least, common, 1e-10);
        before = s.most;
        check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) <= 1e-12);
        trial_end(&t);
    }
}

static void test_spaces(void **unused)
{
    (void)unused;
    static const vessel each[] = {{1, false, 50.0, 0.2, 0}, {2, true, 50.0, 0.2, 0}, {3, false, 50.0, 0.2, 0}};
    for (int k = 0; k < 3; ++k) {
        trial t;
        fill_vessel(&t, &each[k]);
        const double first = heat_of_points(&t);
        trial_run(&t, each[k].end);
        check_true(heat_of_points(&t) > 1.02 * first);
        check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) <= 1e-12);
        trial_end(&t);
    }
}

/* The same bits for any blocks. */
static void test_blocks(void **unused)
{
    (void)unused;
    static const double end = 0.05;
    trial one, four;
    const vessel v = {2, false, 10.0, end, 1}, w = {2, false, 10.0, end, 2};
    fill_vessel(&one, &v);
    fill_vessel(&four, &w);
    trial_run(&one, end);
    trial_run(&four, end);
    state a = trial_finish(&one), b = trial_finish(&four);
    same_state(&a, &b);
    state_free(&a);
    state_free(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_exponential), cmocka_unit_test(test_block),
                                       cmocka_unit_test(test_spaces), cmocka_unit_test(test_blocks)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
