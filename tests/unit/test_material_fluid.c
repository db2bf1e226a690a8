/* Points of fluid, artificial viscosity, and the cells' view of a metal. */
#include "check.h"

#include "material/artificial_viscosity.h"
#include "material/solid.h"

#include <math.h>
#include <string.h>

/* The parameter structs of the two gases, in the order of their tables. */
static double air[2] = {1.4, 717.5}, water[3] = {4.4, 6e8, 1000.0};

static solid_fluid_par fluid_of(const char *name, double *par)
{
    return (solid_fluid_par){.eos = {.model = eos_find(name), .par = par}};
}

static void batch_start(solid_batch *b, double rho, double e)
{
    memset(b, 0, sizeof *b);
    b->n = 3;
    b->dt = 1e-3;
    for (size_t i = 0; i < b->n; i++) {
        b->J[i] = b->J_old[i] = 1.0;
        b->rho0[i] = rho;
        b->energy[i] = e;
    }
}

/* The energy after a compression to half the volume in n steps. */
static double compressed_energy(const solid_fluid_par *fluid, double rho, double e, int n)
{
    solid_batch b;
    batch_start(&b, rho, e);
    for (int s = 1; s <= n; s++) {
        for (size_t i = 0; i < b.n; i++) {
            b.J_old[i] = b.J[i];
            b.J[i] = pow(0.5, (double)s / n);
        }
        assert_int_equal(point_fluid.stress(fluid, 0.0, &b), 0);
    }
    check_close(b.energy[0], b.energy[2], 0.0);
    return b.energy[1];
}

/* On an adiabat e - p_inf v goes as v^(1 - gamma); the error falls as the square of the step. */
static void check_adiabat(const solid_fluid_par *fluid, double gamma, double p_inf, double rho, double e)
{
    const double exact = (e - p_inf / rho) * pow(2.0, gamma - 1.0) + p_inf / (2.0 * rho);
    double before = 0.0;
    for (int n = 20; n <= 160; n *= 2) {
        const double error = fabs(compressed_energy(fluid, rho, e, n) - exact) / exact;
        if (n > 20) check_close(log2(before / error), 2.0, 0.05);
        before = error;
    }
    check_true(before < 1e-4);
}

static void test_adiabat(void **state)
{
    (void)state;
    const solid_fluid_par gas = fluid_of("ideal", air), liquid = fluid_of("stiffened", water);
    check_adiabat(&gas, 1.4, 0.0, 1.2, 2.1e5);
    check_adiabat(&liquid, 4.4, 6e8, 1000.0, 9e5);
}

/* Stress is -(p - p_ref) I + 2 mu dev D + kappa tr D I; the viscous and artificial work heat the fluid. */
static void test_viscous(void **state)
{
    (void)state;
    solid_fluid_par gas = fluid_of("ideal", air);
    gas.shear_viscosity = 2.0;
    gas.bulk_viscosity = 3.0;
    const double L[9] = {10, 40, -6, 8, -4, 12, 2, 6, 3}, rho = 1.2, e = 2.1e5, p_ref = 1e5;
    solid_batch b;
    batch_start(&b, rho, e);
    for (int k = 0; k < 9; k++) b.L[k][1] = L[k];
    const double trace = 9.0, J = exp(trace * b.dt), q = 700.0;
    b.J[1] = J;
    b.q[1] = q;
    assert_int_equal(point_fluid.stress(&gas, p_ref, &b), 0);

    const double p_old = 0.4 * rho * e, p = 0.4 * rho / J * b.energy[1];
    check_close(b.stress[0][1], -(p - p_ref) + 4.0 * (10.0 - 3.0) + 27.0, 1e-9);
    check_close(b.stress[1][1], -(p - p_ref) + 4.0 * (-4.0 - 3.0) + 27.0, 1e-9);
    check_close(b.stress[2][1], -(p - p_ref) + 4.0 * (3.0 - 3.0) + 27.0, 1e-9);
    check_close(b.stress[3][1], 2.0 * 48.0, 1e-12);
    check_close(b.stress[4][1], 2.0 * 18.0, 1e-12);
    check_close(b.stress[5][1], 2.0 * -4.0, 1e-12);

    const double dev2 = 7.0 * 7.0 + 7.0 * 7.0 + 2.0 * (24.0 * 24.0 + 9.0 * 9.0 + 2.0 * 2.0);
    const double heating = 4.0 * dev2 + 3.0 * trace * trace;
    const double work = (0.5 * (p_old + p) + q) * (J - 1.0) / rho - b.dt * heating * 0.5 * (1.0 + J) / rho;
    check_close(b.energy[1] - e, -work, 1e-9);
    /* its neighbours at rest have not changed */
    check_close(b.energy[0], e, 0.0);
    check_close(b.stress[0][2], -(p_old - p_ref), 1e-10);
}

static void test_wave_speed(void **state)
{
    (void)state;
    const solid_fluid_par gas = fluid_of("ideal", air);
    solid_batch b;
    double c[SOLID_CHUNK];
    batch_start(&b, 1.2, 2.1e5);
    point_fluid.wave_speed(&gas, 0.0, &b, c);
    check_close_relative(c[2], sqrt(1.4 * 0.4 * 2.1e5), 1e-14);
}

/* What is beyond the law is reported with its place; so is a fluid asked for plane stress. */
static void test_refusals(void **state)
{
    (void)state;
    const solid_fluid_par gas = fluid_of("ideal", air), liquid = fluid_of("stiffened", water);
    solid_batch b;
    batch_start(&b, 1.2, 2.1e5);
    b.J[1] = NAN;
    assert_int_equal(point_fluid.stress(&gas, 0.0, &b), 2);
    batch_start(&b, 1.2, 2.1e5);
    b.energy[2] = -1.0;
    assert_int_equal(point_fluid.stress(&gas, 0.0, &b), 3);
    batch_start(&b, 1000.0, 9e5);
    b.energy[0] = 5.9e5; /* T < 0 */
    assert_int_equal(point_fluid.stress(&liquid, 0.0, &b), 1);
    batch_start(&b, 1.2, 2.1e5);
    assert_int_equal(solid_stress_state(&point_fluid, &gas, 0.0, STRESS_PLANE, &b), 1);
    assert_int_equal(solid_stress_state(&point_fluid, &gas, 0.0, STRESS_FULL, &b), 0);
}

static void test_artificial_pressure(void **state)
{
    (void)state;
    check_close(artificial_pressure(2.0, 300.0, 50.0, 0.1, 0.2, 2.0), 0.0, 0.0);
    check_close(artificial_pressure(2.0, 300.0, 0.0, 0.1, 0.2, 2.0), 0.0, 0.0);
    check_close_relative(artificial_pressure(2.0, 300.0, -50.0, 0.1, 0.2, 2.0), 2.0 * (0.2 * 300.0 * 5.0 + 2.0 * 25.0),
                         1e-15);
}

/* Steel with one atmosphere as the switch: exponent 1e6. Value and slope meet at the switch, v and p stay inverse to
 * 1e-9 down to a millionth of an atmosphere, and p stays above zero as v grows. */
static void test_bulk_switch(void **state)
{
    (void)state;
    const eos_model *bulk = eos_find("bulk");
    const eos_bulk_par steel = {8900.0, 117e9, 400.0, 0.0, 101325.0, 0.0};
    const double around[2] = {101325.0 * (1.0 - 1e-12), 101325.0 * (1.0 + 1e-12)}, T[2] = {300.0, 300.0};
    double v[2], dvdp[2];
    bulk->volume(&steel, 2, around, T, v, dvdp);
    check_close_relative(v[0], v[1], 1e-15);
    check_close_relative(dvdp[0], dvdp[1], 1e-11);
    check_close_relative(-v[1] / dvdp[1], 117e9, 1e-5); /* K at the switch */

    for (double p = 1e11; p > 0.1; p *= 0.3) {
        double back, c2, e = 1.2e5;
        bulk->volume(&steel, 1, &p, T, v, dvdp);
        const double rho = 1.0 / v[0];
        bulk->pressure(&steel, 1, &rho, &e, &back, &c2);
        check_close(back, p, 4e-16 * rho * c2 + 1e-15 * p); /* round-off of rho alone */
        check_close_relative(-v[0] * v[0] / dvdp[0], c2, 1e-8);
        check_true(v[0] > 0.0 && v[0] < 1.001 / 8900.0 && dvdp[0] < 0.0);
    }
    for (double stretch = 1.0; stretch < 1e6; stretch *= 1.7) {
        double p, c2, e = 1.2e5;
        const double rho = 8900.0 / stretch;
        bulk->pressure(&steel, 1, &rho, &e, &p, &c2);
        check_true(p > 0.0 && p <= 101325.0 && c2 > 0.0);
    }
}

/* Under great pressure and tension on the normal branch the closed form keeps its digits. */
static void test_bulk_extremes(void **state)
{
    (void)state;
    const eos_model *bulk = eos_find("bulk");
    const eos_bulk_par soft = {1000.0, 1e4, 1000.0, 1e5, 1.0, 0.0}; /* p_ref ten times K: tension at the switch */
    const double T = 300.0, e = 3e5;
    for (double p = 1.5; p < 1e13; p *= 3.0) {
        double v, dvdp, back, c2;
        bulk->volume(&soft, 1, &p, &T, &v, &dvdp);
        const double rho = 1.0 / v;
        bulk->pressure(&soft, 1, &rho, &e, &back, &c2);
        check_close(back, p, 1e-15 * (p + 1e5 + rho * c2));
    }
}

/* Beside a liquid that bears 6e8 Pa of tension so does the solid: p and v are inverse down to it, and meet the normal branch at the switch. */
static void test_bulk_tension(void **state)
{
    (void)state;
    const eos_model *bulk = eos_find("bulk");
    const eos_bulk_par wood = {300.0, 6e8, 1000.0, 1e5, 1e5, -3e8};
    check_close(bulk->pressure_floor(&wood), -3e8, 0.0);
    const double around[2] = {1e5 - 1e-3, 1e5 + 1e-3}, T[2] = {300.0, 300.0}, e = 3e5;
    double v[2], dvdp[2];
    bulk->volume(&wood, 2, around, T, v, dvdp);
    check_close_relative(v[0], v[1], 1e-11);
    check_close_relative(-v[0] / dvdp[0], 6e8, 1e-11);
    for (double p = -2.99e8; p < 2e5; p += 1e7) {
        double back, c2;
        bulk->volume(&wood, 1, &p, T, v, dvdp);
        const double rho = 1.0 / v[0];
        bulk->pressure(&wood, 1, &rho, &e, &back, &c2);
        check_close(back, p, 4e-15 * (3e8 + rho * c2));
        check_close_relative(-v[0] * v[0] / dvdp[0], c2, 1e-12);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_adiabat),
        cmocka_unit_test(test_viscous),
        cmocka_unit_test(test_wave_speed),
        cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_artificial_pressure),
        cmocka_unit_test(test_bulk_switch),
        cmocka_unit_test(test_bulk_extremes),
        cmocka_unit_test(test_bulk_tension),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
