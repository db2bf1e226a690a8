/* Water in tubes of points with air outside, the interface sharp (the default) and smeared: walls that keep fluids apart (theory 5.3), fluids
 * that slip along them, and cells of a wall that start with the fluid beside it. */
#include "coupled_fixture.h"

/* Mean gauge pressure (Pa) over the bore, r < 0.05, from z = lower to upper. */
static double mean_pressure(const trial *t, double reference, double lower, double upper)
{
    const mesh *m = &t->sim->mesh;
    double sum = 0.0, volume = 0.0;
    for (int id = 0; id < m->n_blocks; ++id) {
        const block *b = &m->block[id];
        const double *p = field_get(t->sim->domain->fields[id], C_PRESSURE, 0, 0);
        for (int j = 0; j < b->n[1]; ++j)
            for (int i = 0; i < b->n[0]; ++i) {
                const double r = mesh_centre(m, 0, b->lo[0] + i), z = mesh_centre(m, 1, b->lo[1] + j);
                if (r > 0.05 || z < lower || z > upper) continue;
                sum += r * (p[mesh_index(b, i, j, 0)] - reference);
                volume += r;
            }
    }
    return sum / volume;
}

/* Plateau behind the front of a water hammer over rho c u, of a tube of Young's modulus E, radii 0.05 and b, at 0.2 ms. */
static double plateau_of(const char *interface, double E, double b, double reference)
{
    char bulk[96], shear[96], outer[96], ambient[96], water[96], about[96], choice[64];
    const double square = 4.4 * (reference + 5e8) / 1000.0, end = 2e-4;
    const double c = sqrt(square / (1.0 + 2e3 * square / E * (b * b + 0.0025) / (b * b - 0.0025)));
    (void)snprintf(bulk, sizeof bulk, "materials.wall.law.linear_elastic.bulk_modulus=%.17g", E / 3.0);
    (void)snprintf(shear, sizeof shear, "materials.wall.law.linear_elastic.shear_modulus=%.17g", E / 2.0);
    (void)snprintf(outer, sizeof outer, "bodies.tube.shape.box.upper=[%.17g, 1]", b);
    (void)snprintf(ambient, sizeof ambient, "ambient.pressure=%.17g", reference);
    (void)snprintf(water, sizeof water, "bodies.water.pressure=%.17g", reference);
    (void)snprintf(about, sizeof about, "reference_pressure=%.17g", reference);
    (void)snprintf(choice, sizeof choice, "method.interface=%s", interface);
    const char *const set[] = {bulk, shear, outer, ambient, water, about, choice, "domain.cell=[0.005, 0.02]"};
    trial t;
    deck_begin(&t, "defaults/e10_hammer", set, 8);
    coupled_start(&t);
    trial_run(&t, end);
    const double plateau = mean_pressure(&t, reference, 0.25 * c * end, 2.0 / 3.0 * c * end) / (1000.0 * c * 0.02);
    trial_end(&t);
    return plateau;
}

static void check_hammer(const char *interface, double bound)
{
    const double low = plateau_of(interface, 200e9, 0.07, 1e5), high = plateau_of(interface, 200e9, 0.07, 1e7);
    print_message("steel tube, %s: %.4f of Korteweg's pressure at 1 bar, %.4f at 100 bar\n", interface, low, high);
    check_close(low, 1.0, bound);
    check_close(high, 1.0, bound);
    check_close(high, low, 0.2 * bound);
}

/* Steel, four cells of wall, four times as long along the tube: measured 0.9935 and 0.9920, smeared; 0.9966 and 0.9962, sharp (with half their length
 * 1.0009 and 1.0004, 1.0045 and 1.0044); 0.35 below it before walls kept water and water slipped along them. The tube breathes about Korteweg's
 * pressure, which is that of a wall without inertia. */
static void test_hammer(void **unused)
{
    (void)unused;
    check_hammer("smeared", 0.013);
    check_hammer("auto", 7.5e-3);
}

/* Water of 2 bar at rest in a tube, air of 1 bar outside: the wall bears the difference, which must stay (less what the tube's widening takes: the
 * wall of steel takes 2 rho c^2/E (b^2 + a^2)/(b^2 - a^2) = 6.8 % of it), over some breathing of the ring. */
static void check_rest(const char *interface, double bound)
{
    const char *const set[] = {interface,
                               "bodies.water.pressure=2e5",
                               "bodies.water.velocity=[0, 0]",
                               "domain.upper=[0.1, 0.02]",
                               "bodies.tube.shape.box.upper=[0.07, 0.02]",
                               "bodies.water.shape.box.upper=[0.05, 0.02]",
                               "materials.wall.law.linear_elastic.bulk_modulus=66666666667",
                               "time.end=2 ms",
                               "domain.cell=[0.005, 0.02]",
                               "materials.wall.law.linear_elastic.shear_modulus=100e9"};
    const double square = 4.4 * 5.001e8 / 1000.0, yield = 2e3 * square / 200e9 * (0.0049 + 0.0025) / (0.0049 - 0.0025);
    trial t;
    deck_begin(&t, "defaults/e10_hammer", set, 10);
    coupled_start(&t);
    double mean = 0.0;
    for (int k = 1; k <= 20; ++k) {
        trial_run(&t, 1e-3 + 5e-5 * k);
        mean += mean_pressure(&t, 1e5, 0.0, 0.02) / 20.0;
    }
    print_message("water in a ring, %s: %.4f of its gauge pressure, %.4f expected\n", interface, mean / 1e5,
                  1.0 / (1.0 + yield));
    check_close(mean / 1e5, 1.0 / (1.0 + yield), bound);
    trial_end(&t);
}

/* Measured: smeared 0.914 for 0.9365 (all gone where the faces of the wall knew the pressure alone), sharp 0.9357. */
static void test_rest(void **unused)
{
    (void)unused;
    check_rest("method.interface=smeared", 0.045);
    check_rest("method.interface=auto", 1.6e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hammer),
        cmocka_unit_test(test_rest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
