/* J2 plasticity against closed forms: paths that keep their direction are met to round-off in any number of steps. */
#include "check.h"

#include "material/solid.h"

#include <math.h>
#include <string.h>

static const double K = 1.3e11, G = 4.5e10, Y = 4e8, H = 1e9, RHO = 8900.0;

typedef struct j2_values {
    double K, G, slope, grueneisen;
    double yield, hardening, strength; /* Pa */
    double failure_strain, failure_energy;
} j2_values;

static void batch_start(solid_batch *b)
{
    memset(b, 0, sizeof *b);
    b->n = 1;
    b->dt = 1.0;
    b->J[0] = b->J_old[0] = 1.0;
    b->rho0[0] = RHO;
}

/* One step of strain rate L over dt = 1. */
static void step(const j2_values *par, solid_batch *b, const double L[9])
{
    for (int k = 0; k < 9; k++) b->L[k][0] = L[k];
    b->J_old[0] = b->J[0];
    b->J[0] *= exp(L[0] + L[4] + L[8]);
    assert_int_equal(solid_find("j2")->stress(par, 0.0, b), 0);
}

/* Uniaxial strain e: q = 2 G e - 3 G alpha = Y + H alpha, sigma_xx = K e + 2/3 q, sigma_yy = sigma_zz = K e - q/3. */
static void test_uniaxial_strain(void **state)
{
    (void)state;
    const j2_values par = {K, G, 0.0, 0.0, Y, H, 0.0, 0.0, 0.0};
    const double e = 0.03;
    for (int n = 1; n <= 1000; n *= 10) {
        solid_batch b;
        batch_start(&b);
        for (int k = 0; k < n; k++) step(&par, &b, (const double[9]){e / n});
        const double alpha = (2.0 * G * e - Y) / (3.0 * G + H), q = Y + H * alpha;
        check_close_relative(b.history[0][0], alpha, 1e-12);
        check_close_relative(b.stress[0][0], K * e + 2.0 / 3.0 * q, 1e-12);
        check_close_relative(b.stress[1][0], K * e - q / 3.0, 1e-12);
        check_close_relative(b.stress[2][0], K * e - q / 3.0, 1e-12);
    }
}

/* Below yield nothing plastic happens, and the law is linear_elastic to the bit. */
static void test_elastic(void **state)
{
    (void)state;
    const j2_values par = {K, G, 0.0, 0.0, Y, H, 0.0, 0.0, 0.0};
    solid_batch b, elastic;
    batch_start(&b);
    batch_start(&elastic);
    const double L[9] = {1e-3, 2e-3, 0.5e-3, -1e-3, 0.3e-3, 1e-3, 0.7e-3, -0.2e-3, -2e-3};
    step(&par, &b, L);
    for (int k = 0; k < 9; k++) elastic.L[k][0] = L[k];
    elastic.J[0] = b.J[0];
    assert_int_equal(solid_find("linear_elastic")->stress(&par, 0.0, &elastic), 0);
    for (int k = 0; k < 6; k++) check_close(b.stress[k][0], elastic.stress[k][0], 0.0);
    check_close(b.history[0][0], 0.0, 0.0);
    check_close(b.energy[0], 0.0, 0.0);
}

/* Pure shear gamma, sqrt(3) tau = Y + H alpha, gamma = tau/G + sqrt(3) alpha; plastic work (Y + H alpha/2) alpha. */
static void test_shear(void **state)
{
    (void)state;
    const j2_values par = {K, G, 0.0, 0.0, Y, H, 0.0, 0.0, 0.0};
    const double gamma = 0.05, alpha = (sqrt(3.0) * G * gamma - Y) / (3.0 * G + H);
    for (int n = 1; n <= 100; n *= 10) {
        solid_batch b;
        batch_start(&b);
        const double half = 0.5 * gamma / n;
        for (int k = 0; k < n; k++) step(&par, &b, (const double[9]){0, half, 0, half, 0, 0, 0, 0, 0});
        check_close_relative(b.history[0][0], alpha, 1e-12);
        check_close_relative(b.stress[3][0], (Y + H * alpha) / sqrt(3.0), 1e-12);
        check_close(b.stress[0][0], 0.0, 1e-6);
        check_close_relative(RHO * b.energy[0], (Y + 0.5 * H * alpha) * alpha, 1e-12);
    }
}

/* Simple shear, in which the axes turn: the yield surface is met wherever the stress is, and the steps converge to each other
 * at first order or better. */
static void test_simple_shear(void **state)
{
    (void)state;
    const j2_values par = {K, G, 0.0, 0.0, Y, H, 0.0, 0.0, 0.0};
    double last[3] = {0};
    for (int n = 100, k = 0; k < 3; n *= 2, k++) {
        solid_batch b;
        batch_start(&b);
        for (int s = 0; s < n; s++) step(&par, &b, (const double[9]){0, 0.5 / n, 0, 0, 0, 0, 0, 0, 0});
        const double xx = b.stress[0][0], yy = b.stress[1][0], zz = b.stress[2][0], xy = b.stress[3][0];
        const double q = sqrt(0.5 * (pow(xx - yy, 2) + pow(yy - zz, 2) + pow(zz - xx, 2)) + 3.0 * xy * xy);
        check_close_relative(q, Y + H * b.history[0][0], 1e-12);
        check_close(xx + yy + zz, 0.0, 1e-6 * Y); /* no volume, no pressure */
        last[k] = xx;
    }
    check_true(log2(fabs((last[0] - last[1]) / (last[1] - last[2]))) >= 0.9);
}

/* Cycles between -a and a in pure shear, no hardening: each of them dissipates 2 tau_y (2 a - 2 tau_y/G), and the loop that
 * stress and strain draw has that area. */
static void test_cycles(void **state)
{
    (void)state;
    const j2_values par = {K, G, 0.0, 0.0, Y, 0.0, 0.0, 0.0, 0.0};
    const double a = 0.02, yield = Y / sqrt(3.0);
    const int quarter = 200;
    solid_batch b;
    batch_start(&b);
    double area = 0.0, heat = 0.0, drawn = 0.0;
    for (int k = 0; k < 9 * quarter; k++) { /* up, then two whole cycles: down and up */
        const double half = 0.5 * a / quarter * ((k + quarter) / (2 * quarter) % 2 == 0 ? 1.0 : -1.0);
        if (k == quarter || k == 5 * quarter) {
            heat = RHO * b.energy[0];
            area = drawn;
        }
        const double before = b.stress[3][0];
        step(&par, &b, (const double[9]){0, half, 0, half, 0, 0, 0, 0, 0});
        drawn += (before + b.stress[3][0]) * half;
    }
    const double expected = 2.0 * yield * (2.0 * a - 2.0 * yield / G);
    check_close_relative(RHO * b.energy[0] - heat, expected, 1e-12);
    /* the corner at yield lies inside a step, and the trapezium cuts it: twice a cycle, half a step's height at most */
    check_close(drawn - area, expected, 2.0 * 0.5 * pow(a / quarter, 2) * G);
}

/* A point pulled beyond its strength bears nothing until it has closed, then pressure alone; its energy is heat. */
static void test_tension_cut_off(void **state)
{
    (void)state;
    const double strength = 5e8;
    const j2_values par = {K, G, 0.0, 0.0, Y, H, strength, 0.0, 0.0};
    solid_batch b;
    batch_start(&b);
    const double pull = 1e-4;
    double before = 0.0;
    int n = 0;
    for (; b.history[1][0] == 0.0 && n < 100; n++) {
        before = b.stress[0][0];
        step(&par, &b, (const double[9]){pull, 0, 0, 0, pull, 0, 0, 0, pull});
    }
    check_close_relative(before, 3.0 * K * pull * (n - 1), 1e-12);
    check_true(before > strength && before <= strength + 3.0 * K * pull);
    for (int k = 0; k < 6; k++) check_close(b.stress[k][0], 0.0, 0.0);
    check_close_relative(b.history[2][0], 3.0 * pull * n, 1e-12);
    check_close_relative(RHO * b.energy[0], 0.5 * before * before / K, 0.02); /* J is up to 1.01 */

    step(&par, &b, (const double[9]){0, 1e-2, 0, 0, 0, 0, 0, 0, 0});
    check_close(b.stress[3][0], 0.0, 0.0);
    const double heat = b.energy[0], push = 1e-3;
    for (int k = 1; k <= 8; k++) {
        step(&par, &b, (const double[9]){-push, 0, 0, 0, -push, 0, 0, 0, -push});
        const double strain = 3.0 * (pull * n - push * k);
        check_close(b.stress[0][0], strain < 0.0 ? K * strain : 0.0, 1e-9 * K * push);
        check_close(b.history[2][0], strain > 0.0 ? strain : 0.0, 1e-12);
        check_close(b.stress[1][0], b.stress[0][0], 0.0);
    }
    check_true(b.stress[0][0] < -K * push);
    check_close(b.energy[0], heat, 0.0);
    check_close(b.history[1][0], 1.0, 0.0);
}

/* Failure by plastic strain, and by plastic work, which is (Y + H alpha/2) alpha: in the step after alpha has come to it. */
static void test_failure(void **state)
{
    (void)state;
    const double most = 0.02, work = (Y + 0.5 * H * most) * most;
    const j2_values par[2] = {{K, G, 0.0, 0.0, Y, H, 0.0, most, 0.0}, {K, G, 0.0, 0.0, Y, H, 0.0, 0.0, work}};
    for (int by_work = 0; by_work < 2; by_work++) {
        solid_batch b;
        batch_start(&b);
        const double half = 1e-4;
        double last = 0.0, heat = 0.0;
        for (int n = 0; n < 1000 && b.history[1][0] == 0.0; n++) {
            last = b.history[0][0];
            heat = b.energy[0];
            step(&par[by_work], &b, (const double[9]){-1e-5, half, 0, half, 0, 0, 0, 0, 0});
        }
        check_true(last >= most && last < most + 2.0 * half / sqrt(3.0) + 1e-12);
        check_close(b.history[0][0], last, 0.0);
        check_close(b.stress[3][0], 0.0, 0.0);
        check_close(b.stress[0][0], b.stress[1][0], 0.0);
        check_true(b.stress[0][0] < 0.0 && b.energy[0] > heat);
        check_close(b.history[2][0], 0.0, 0.0);
    }
}

/* The Mie-Grueneisen pressure of the equation of state: along its isentrope in compression and expansion, and, at round-off, the same in
 * shear; elastic work comes back. */
static void test_shock_pressure(void **state)
{
    (void)state;
    const double s = 1.489, gamma = 1.99;
    const j2_values par = {K, G, s, gamma, 1e12, 0.0, 0.0, 0.0, 0.0};
    const double curve[6] = {RHO, sqrt(K / RHO), s, gamma, 383.0, 0.0};
    const eos_model *law = eos_find("mie_grueneisen");
    for (int sign = -1; sign <= 1; sign += 2) {
        double error[2];
        for (int fine = 0; fine < 2; fine++) {
            const int steps = fine ? 400 : 200;
            const double strain = sign * 0.15 / 3.0 / steps;
            solid_batch b;
            batch_start(&b);
            b.heat[0] = 0.0;
            for (int n = 0; n < steps; n++) step(&par, &b, (const double[9]){strain, 0, 0, 0, strain, 0, 0, 0, strain});
            const double rho = RHO / b.J[0], none = 0.0;
            double e, p, c2, psi, c;
            law->energy(curve, 1, &rho, &none, &e);
            law->pressure(curve, 1, &rho, &e, &p, &c2);
            error[fine] = fmax(fabs(-b.stress[0][0] / p - 1.0), fabs(b.energy[0] / e - 1.0));
            solid_find("j2")->wave_speed(&par, 0.0, &b, &c);
            check_close_relative(c * c, c2 + 4.0 / 3.0 * G / rho, 1e-3);
            solid_find("j2")->strain_energy(&par, &b, &psi);
            check_close(psi, 0.0, 1e-6 * RHO * b.energy[0]);
            for (int n = 0; n < steps; n++)
                step(&par, &b, (const double[9]){-strain, 0, 0, 0, -strain, 0, 0, 0, -strain});
            check_close(b.energy[0], 0.0, 1e-12 * e);
            check_close(b.stress[0][0], 0.0, 1e-11 * K);
        }
        print_message("isentrope %s: %.1e, twice the step %.1e\n", sign < 0 ? "compressed" : "expanded", error[1],
                      error[0]);
        check_true(error[1] <= 1e-5 && error[0] >= 3.5 * error[1]);
    }
    /* a point that fails under pressure keeps it, and what shear had stored is internal energy */
    const j2_values brittle = {K, G, s, gamma, Y, H, 0.0, 1e-3, 0.0};
    solid_batch f;
    batch_start(&f);
    for (int n = 0; n < 100 && f.history[0][0] < 1e-3; n++)
        step(&brittle, &f, (const double[9]){-1e-3, 1e-3, 0, 1e-3, 0, 0, 0, 0, 0});
    double stored, energy = f.energy[0], p = -(f.stress[0][0] + f.stress[1][0] + f.stress[2][0]) / 3.0;
    solid_find("j2")->strain_energy(&brittle, &f, &stored);
    step(&brittle, &f, (const double[9]){0});
    check_close(f.history[1][0], 1.0, 0.0);
    check_close_relative(RHO * (f.energy[0] - energy), stored, 1e-9);
    check_close(-f.stress[0][0], p + gamma * stored, 1e-6 * p);
    /* heat c (T - T0) raises the pressure by Gamma rho0 of it; beyond 1 - J = 1/s there is none */
    solid_batch b;
    batch_start(&b);
    b.heat[0] = 383.0 * 100.0;
    step(&par, &b, (const double[9]){0});
    check_close_relative(-b.stress[0][0], gamma * RHO * 38300.0, 1e-12);
    batch_start(&b);
    b.J[0] = 1.0 - 1.0 / s;
    assert_int_equal(solid_find("j2")->stress(&par, 0.0, &b), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_uniaxial_strain), cmocka_unit_test(test_elastic),
        cmocka_unit_test(test_shear),           cmocka_unit_test(test_simple_shear),
        cmocka_unit_test(test_cycles),          cmocka_unit_test(test_tension_cut_off),
        cmocka_unit_test(test_failure),         cmocka_unit_test(test_shock_pressure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
