/* The elastic flag of Turek and Hron's benchmark under its weight (CSM1, CSM2): the displacement of its tip. */
#include "coupled_fixture.h"

#include "sim/tracer.h"

static void tip_displacement(double shear, double u[2])
{
    char bulk[128], g[128];
    (void)snprintf(bulk, sizeof bulk, "materials.rubber.law.st_venant_kirchhoff.bulk_modulus=%.17g",
                   14.0 / 3.0 * shear);
    (void)snprintf(g, sizeof g, "materials.rubber.law.st_venant_kirchhoff.shear_modulus=%.17g", shear);
    const char *set[] = {"domain.cell=0.01", bulk, g};
    trial t;
    deck_begin(&t, "turek_hron_csm", set, 3);
    check_ok(t.ctx, sim_create(&t.sim, t.ctx, t.scene, t.scene->coupling));
    trial_run(&t, 1.0);
    tracer_value tip[SCENE_MAX_TRACERS];
    tracers_read(t.sim, tip);
    for (int a = 0; a < 2; ++a) u[a] = tip[0].displacement[a];
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
        check_close_relative(u[1], published[k][1], 0.0094);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_rest_under_weight)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
