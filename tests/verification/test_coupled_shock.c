/* Waves in a gas that meet a solid made of points: the shock that comes back from a stiff one, and the share of an acoustic pulse
 * that comes back from a solid of ten times the gas's impedance. In one dimension; uniaxial strain. */
#include "coupled_fixture.h"

static const double gamma_gas = 1.4, p_before = 1e5, rho_before = 1.16;

/* The state behind a shock of pressure ratio z that runs into gas at rest. */
typedef struct behind {
    double p, rho, u, speed;
} behind;

static behind shock_of(double z)
{
    const double g = gamma_gas, c = sqrt(g * p_before / rho_before);
    const double mach = sqrt(((g + 1.0) * z + g - 1.0) / (2.0 * g));
    return (behind){.p = z * p_before,
                    .rho = rho_before * ((g + 1.0) * z + g - 1.0) / ((g - 1.0) * z + g + 1.0),
                    .u = 2.0 / (g + 1.0) * c * (mach - 1.0 / mach),
                    .speed = mach * c};
}

static scene_body *gas_box(trial *t, int gas, double from, double to, double p, double rho, double u)
{
    scene_body *b =
        coupled_body(t, gas, make_box(t, (const double[]){from, 0.0, 0.0}, (const double[]){to, 1.0, 1.0}), 1);
    b->pressure = p;
    b->temperature = (double)NAN;
    b->density = rho;
    b->velocity[0] = u;
    return b;
}

/* Mean pressure of the cells in [from, to]. */
static double mean_pressure(const trial *t, double from, double to)
{
    const mesh *m = &t->sim->mesh;
    double sum = 0.0;
    int n = 0;
    for (int i = 0; i < m->n[0]; ++i) {
        const double x = mesh_centre(m, 0, i);
        if (x < from || x > to) continue;
        sum += field_get(t->sim->domain->fields[0], C_PRESSURE, 0, 0)[mesh_index(&m->block[0], i, 0, 0)];
        ++n;
    }
    assert_true(n > 0);
    return sum / n;
}

/* Gas in [0, 0.8], a shock of ratio z at 0.3 that runs to the right, a solid from `wall` on; run until what comes back from the solid
 * is 0.15 on its way. The mean pressure between it and the solid. */
typedef struct hit {
    const char *basis;
    double z, h, wall;
    double bulk, shear, density; /* of the solid */
} hit;

/* Speed at which the shock comes back from a rigid wall: rho2 (u2 + s) = rho5 s. */
static double speed_back(const behind *two, double ratio)
{
    const double g = gamma_gas, rho5 = two->rho * ((g + 1.0) * ratio + g - 1.0) / ((g - 1.0) * ratio + g + 1.0);
    return two->rho * two->u / (rho5 - two->rho);
}

static double reflected_ratio(double z)
{
    const double g = gamma_gas;
    return ((3.0 * g - 1.0) * z - (g - 1.0)) / ((g - 1.0) * z + g + 1.0);
}

static double pressure_after(const hit *c)
{
    const behind two = shock_of(c->z);
    const double start = 0.3;
    trial t;
    coupled_begin(&t, 1, (const double[]){0.8, 0.0, 0.0}, c->h);
    set_sides(&t, 0, BC_FREE, BC_SYMMETRY);
    set_method(&t, c->basis, STRESS_USL, 0.99);
    t.scene->has_ambient = false;
    const int gas = t.scene->ambient_material, solid = coupled_solid(&t, c->bulk, c->shear, c->density);
    gas_box(&t, gas, -1.0, start, two.p, two.rho, two.u);
    gas_box(&t, gas, start, 2.0, p_before, rho_before, 0.0); /* what the solid leaves of it */
    coupled_body(&t, solid, make_box(&t, (const double[]){c->wall, 0.0, 0.0}, (const double[]){2.0, 1.0, 1.0}), 2);
    coupled_start(&t);
    trial_run(&t, (c->wall - start) / two.speed + 0.15 / speed_back(&two, reflected_ratio(c->z)));
    assert_int_equal(t.sim->rejected, 0);
    const double p = mean_pressure(&t, c->wall - 0.1, c->wall - 3.0 * c->h);
    trial_end(&t);
    return p;
}

/* Whether a basis is tried with everything, for the others. */
static bool in_full(size_t basis)
{
    return strcmp(basis_registry[basis]->name, "quadratic") == 0;
}

/* From a stiff solid as from a wall: p5/p2 = [(3 g - 1) z - (g - 1)] / [(g - 1) z + g + 1], z = p2/p1. The solid, smeared over the
 * cells about its surface, looks up to a cell too fat (theory 5.7): measured 1.3 % low at most. */
static void test_reflected_shock(void **unused)
{
    (void)unused;
    static const double z[] = {2.0, 10.0}, offset[] = {0.0, 0.37};
    for (size_t i = 0; i < basis_registry_size; ++i)
        for (int a = 0; a < 2; ++a)
            for (int k = 0; k < 2; ++k)
                for (int fine = 1; fine <= 2; ++fine) {
                    if (a == k && !in_full(i)) continue;
                    const double h = 0.01 / fine;
                    const hit c = {basis_registry[i]->name, z[a], h, 0.6 + offset[k] * h, 100e9, 60e9, 8000.0};
                    const double ratio = pressure_after(&c) / (z[a] * p_before), expected = reflected_ratio(z[a]);
                    print_message("%-9s z = %-2g h = %-5g wall at %.4f: p5/p2 = %.4f, exact %.4f (%+.2f %%)\n", c.basis,
                                  c.z, h, c.wall, ratio, expected, 100.0 * (ratio / expected - 1.0));
                    const bool cubic = basis_is(basis_registry[i], "cubic"); /* spreads the wall: 1.25 % */
                    check_close_relative(ratio, expected, fine == 1 ? 0.02 : cubic ? 0.014 : 0.01);
                }
}

/* A weak step: (p - p2) / (p2 - p1) = (Z2 - Z1) / (Z2 + Z1), Z = rho c, c^2 = (K + 4 G / 3) / rho in the solid. */
static void test_impedance(void **unused)
{
    (void)unused;
    const double z = 1.005, z1 = rho_before * sqrt(gamma_gas * p_before / rho_before);
    static const double bulk[] = {0.5e6, 5e6, 50e6};
    for (size_t i = 0; i < basis_registry_size; ++i)
        for (int k = 0; k < 3; ++k)
            for (int fine = 1; fine <= (in_full(i) ? 4 : 2); fine *= 2) {
                const double h = 0.01 / fine, density = 100.0, modulus = bulk[k] * (1.0 + 0.8),
                             z2 = sqrt(density * modulus);
                const hit c = {basis_registry[i]->name, z, h, 0.6037, bulk[k], 0.6 * bulk[k], density};
                const double r = (pressure_after(&c) / p_before - z) / (z - 1.0), expected = (z2 - z1) / (z2 + z1);
                print_message("%-9s Z2/Z1 = %-5.3g h = %-6g R = %.4f, exact %.4f\n", c.basis, z2 / z1, h, r, expected);
                check_close(r, expected,
                            fine == 1   ? 0.14
                            : fine == 2 ? 0.05
                                        : 0.02); /* first order, at the interface */
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reflected_shock),
        cmocka_unit_test(test_impedance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
