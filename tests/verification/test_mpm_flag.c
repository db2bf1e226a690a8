/* The elastic flag of Turek and Hron's benchmark under its weight (CSM1, CSM2): the displacement of its tip. */
#include "coupled_fixture.h"

enum { MOST_POINTS = 4096 };

/* Places at the start, by the number of the point in its body. */
typedef struct start_places {
    double x[MOST_POINTS], y[MOST_POINTS];
} start_places;

static size_t number_of(const fields *f, int body, size_t k)
{
    return (size_t)fmod(field_get(f, P_ID, body, 0)[k], 0x1p40);
}

static void note_start(void *user, const fields *f, int body, size_t k)
{
    start_places *start = user;
    const size_t n = number_of(f, body, k);
    assert_true(n < MOST_POINTS);
    start->x[n] = field_get(f, P_POS, body, 0)[k];
    start->y[n] = field_get(f, P_POS, body, 1)[k];
}

/* Sums for a straight line through displacements over x, of the points near the tip; those above and below its middle
 * are alike in number, so that the line is that of the middle. */
typedef struct tip_fit {
    const start_places *start;
    double n, x, xx, u[2], xu[2];
} tip_fit;

static void add_near_tip(void *user, const fields *f, int body, size_t k)
{
    tip_fit *fit = user;
    const size_t n = number_of(f, body, k);
    const double x = fit->start->x[n] - 0.6;
    if (x < -0.03) return;
    const double start[2] = {fit->start->x[n], fit->start->y[n]};
    fit->n += 1.0;
    fit->x += x;
    fit->xx += x * x;
    for (int a = 0; a < 2; ++a) {
        const double u = field_get(f, P_POS, body, a)[k] - start[a];
        fit->u[a] += u;
        fit->xu[a] += x * u;
    }
}

static void tip_displacement(double shear, double u[2])
{
    static start_places start;
    char bulk[128], g[128];
    (void)snprintf(bulk, sizeof bulk, "materials.rubber.law.st_venant_kirchhoff.bulk_modulus=%.17g",
                   14.0 / 3.0 * shear);
    (void)snprintf(g, sizeof g, "materials.rubber.law.st_venant_kirchhoff.shear_modulus=%.17g", shear);
    const char *set[] = {"domain.cell=0.01", bulk, g};
    trial t;
    deck_begin(&t, "turek_hron_csm", set, 3);
    check_ok(t.ctx, sim_create(&t.sim, t.ctx, t.scene, t.scene->coupling));
    visit_points(&t, 0, note_start, &start);
    trial_run(&t, 1.0);
    tip_fit fit = {.start = &start};
    visit_points(&t, 0, add_near_tip, &fit);
    for (int a = 0; a < 2; ++a) u[a] = (fit.xx * fit.u[a] - fit.x * fit.xu[a]) / (fit.n * fit.xx - fit.x * fit.x);
    trial_end(&t);
}

static void test_rest_under_weight(void **unused)
{
    (void)unused;
    static const double shear[2] = {0.5e6, 2e6}, published[2][2] = {{-7.187e-3, -66.10e-3}, {-0.4690e-3, -16.97e-3}};
    for (int k = 0; k < 2; ++k) {
        double u[2];
        tip_displacement(shear[k], u);
        print_message("G = %g Pa: tip displaced by %.3f, %.3f mm, published %.3f, %.3f\n", shear[k], 1e3 * u[0],
                      1e3 * u[1], 1e3 * published[k][0], 1e3 * published[k][1]);
        check_close_relative(u[0], published[k][0], 0.016);
        check_close_relative(u[1], published[k][1], 0.004);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_rest_under_weight)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
