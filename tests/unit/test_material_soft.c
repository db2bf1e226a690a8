/* Laws of soft materials and soils against closed forms: Ogden, Drucker-Prager, viscoelastic. */
#include "check.h"
#include "solid_batch_fixture.h"

#include "math/tensor.h"

#include <math.h>
#include <string.h>

enum { XX, YY, ZZ, XY, YZ, ZX };

static void set_F(solid_batch *b, size_t i, const double F[9])
{
    for (int k = 0; k < 9; k++) b->F[k][i] = F[k];
    b->J[i] = tensor_det(F);
    b->rho0[i] = 1000.0;
}

/* ---- Ogden ---- */

typedef struct ogden_values {
    double K, mu_1, alpha_1, mu_2, alpha_2, mu_3, alpha_3;
} ogden_values;

/* Ogden's fit (1972) of Treloar's measurements (1944) on vulcanised rubber; K is a thousand shear moduli. */
static const ogden_values treloar = {4.2e8, 6.3e5, 1.3, 1.2e3, 5.0, -1e4, -2.0};

static double ogden_sum(const ogden_values *a, double x, double y)
{
    return a->mu_1 * (pow(x, a->alpha_1) - pow(y, a->alpha_1)) + a->mu_2 * (pow(x, a->alpha_2) - pow(y, a->alpha_2)) +
           a->mu_3 * (pow(x, a->alpha_3) - pow(y, a->alpha_3));
}

/* Uniaxial and equibiaxial tension and pure shear at constant volume: differences of principal stresses, in any directions. */
static void test_ogden_closed_forms(void **state)
{
    (void)state;
    const solid_model *law = solid_find("ogden");
    const double spin[9] = {0, -0.7, 0.3, 0.7, 0, -1.1, -0.3, 1.1, 0};
    double q[9];
    tensor_exp(spin, q);
    for (double s = 0.4; s < 7.0; s *= 1.37) {
        const double stretch[3][3] = {{s, 1.0 / sqrt(s), 1.0 / sqrt(s)}, {s, s, 1.0 / (s * s)}, {s, 1.0, 1.0 / s}};
        for (int load = 0; load < 3; load++) {
            const double *l = stretch[load];
            const double U[9] = {l[0], 0, 0, 0, l[1], 0, 0, 0, l[2]};
            double F[9], s6[6], turned[6], back[9];
            solid_batch b;
            batch_start(&b, 0.0);
            tensor_multiply(q, U, F);
            set_F(&b, 0, F);
            assert_int_equal(law->stress(&treloar, 0.0, &b), 0);
            for (int k = 0; k < 6; k++) s6[k] = b.stress[k][0];
            tensor_transpose(q, back);
            symmetric_congruence(back, s6, turned);
            const double size = 1e-15 * treloar.K + 1e-12 * fabs(ogden_sum(&treloar, l[0], l[2]));
            check_close(turned[XX] - turned[ZZ], ogden_sum(&treloar, l[0], l[2]), 30.0 * size);
            check_close(turned[YY] - turned[ZZ], ogden_sum(&treloar, l[1], l[2]), 30.0 * size);
            check_close(turned[XY], 0.0, 30.0 * size);
        }
    }
}

/* With exponents 2 and -2 it is Mooney and Rivlin's, whose stress and energy need no principal directions. */
static void test_ogden_is_mooney_rivlin(void **state)
{
    (void)state;
    const solid_model *law = solid_find("ogden"), *other = solid_find("mooney_rivlin");
    const double c1 = 3e5, c2 = 1e5, K = 1e9, mooney[3] = {K, c1, c2};
    const ogden_values par = {K, -2.0 * c2, -2.0, 2.0 * c1, 2.0, 0.0, 0.0};
    static const double strained[4][9] = {{1.8, 0, 0, 0, 0.7, 0, 0, 0, 0.9},
                                          {0.7, 0.3, 0, -0.2, 1.1, 0.1, 0, 0.2, 1.6},
                                          {1.3, 0, 0, 0, 1.3, 1e-9, 0, 0, 0.6},
                                          {0.8, 0, 0, 0, 0.8, 0, 0, 0, 0.8}};
    check_close_relative(law->shear_modulus(&par), 2.0 * (c1 + c2), 1e-15);
    for (int m = 0; m < 4; m++) {
        solid_batch a, b;
        double psi[2];
        batch_start(&a, 0.0);
        set_F(&a, 0, strained[m]);
        b = a;
        assert_int_equal(law->stress(&par, 0.0, &a), 0);
        assert_int_equal(other->stress(mooney, 0.0, &b), 0);
        for (int k = 0; k < 6; k++) check_close(a.stress[k][0], b.stress[k][0], 2e-15 * K);
        law->strain_energy(&par, &a, &psi[0]);
        other->strain_energy(mooney, &b, &psi[1]);
        check_close(psi[0], psi[1], 2e-15 * K);
    }
}

/* No wave is faster than the law says (as test_material_solid): second differences of the energy along a n F. */
static double fastest_wave(const solid_model *law, const void *par, const solid_batch *at, uint64_t *seed)
{
    double fastest = 0.0, F0[9];
    for (int k = 0; k < 9; k++) F0[k] = at->F[k][0];
    for (int trial = 0; trial < 3000; trial++) {
        const double e = 1e-3;
        double a[3], n[3], psi[3];
        solid_batch moved = *at;
        for (int q = 0; q < 3; q++) a[q] = check_random(seed, -1.0, 1.0), n[q] = check_random(seed, -1.0, 1.0);
        if (trial % 3 == 0) memcpy(a, n, sizeof a);
        vec_normalize(a);
        vec_normalize(n);
        moved.n = 3;
        for (int side = 0; side < 3; side++) {
            double more[9], F[9];
            for (int q = 0; q < 9; q++) more[q] = (q % 4 == 0) + (side - 1) * e * a[q / 3] * n[q % 3];
            tensor_multiply(more, F0, F);
            set_F(&moved, (size_t)side, F);
            for (int h = 0; h < law->n_history; h++) moved.history[h][side] = at->history[h][0];
        }
        law->strain_energy(par, &moved, psi);
        fastest = fmax(fastest, (psi[2] - 2.0 * psi[1] + psi[0]) / (e * e));
    }
    return fastest;
}

static void test_ogden_wave_speed(void **state)
{
    (void)state;
    const solid_model *law = solid_find("ogden");
    static const double strained[6][9] = {{1.8, 0, 0, 0, 0.7, 0, 0, 0, 0.9}, {0.7, 0.3, 0, -0.2, 1.1, 0.1, 0, 0.2, 1.6},
                                          {1.3, 0, 0, 0, 1.3, 0, 0, 0, 0.8}, {4.5, 0, 0, 0, 0.5, 0.1, 0, 0, 0.45},
                                          {0.2, 0, 0, 0, 2.4, 0, 0, 0, 2.2}, {1.0, 2.5, 0, 0, 1.0, 0, 0, 0, 1.0}};
    const ogden_values soft[4] = {{1e6, 6.3e5, 1.3, 1.2e3, 5.0, -1e4, -2.0},
                                  {1e6, 4e5, 2.0, 0.0, 0.0, 0.0, 0.0},
                                  {3e5, -2e5, -3.0, 0.0, 0.0, 1e4, 6.0},
                                  {3e5, 2e6, 0.4, 0.0, 0.0, 0.0, 0.0}};
    uint64_t seed = 5;
    for (int p = 0; p < 4; p++)
        for (int m = 0; m < 6; m++) {
            solid_batch b;
            double c;
            batch_start(&b, 0.0);
            set_F(&b, 0, strained[m]);
            law->wave_speed(&soft[p], 0.0, &b, &c);
            const double found = fastest_wave(law, &soft[p], &b, &seed);
            check_true(1000.0 * c * c >= found * (1.0 - 1e-5));
            check_true(1000.0 * c * c <= 2.0 * found);
        }
    /* pressed on all sides it is as it was at rest, but for its volume */
    for (int p = 0; p < 4; p++) {
        solid_batch b;
        double c;
        batch_start(&b, 0.0);
        set_F(&b, 0, (const double[9]){0.8, 0, 0, 0, 0.8, 0, 0, 0, 0.8});
        law->wave_speed(&soft[p], 0.0, &b, &c);
        const double bulk = 0.5 * soft[p].K * (b.J[0] * b.J[0] + 1.0);
        check_close_relative(1000.0 * c * c, bulk + 4.0 / 3.0 * law->shear_modulus(&soft[p]), 1e-12);
    }
}

/* A strain of 1e-9 keeps nine digits of the deviator beside a bulk modulus a thousand times as large, and stretches that differ by
 * round-off have the stress of equal ones. */
static void test_ogden_small_and_equal(void **state)
{
    (void)state;
    const solid_model *law = solid_find("ogden");
    const double e = 1e-9, G = law->shear_modulus(&treloar);
    solid_batch b;
    batch_start(&b, 0.0);
    const double small[9] = {1, e, 0, 0, 1, 0, 0, 0, 1};
    set_F(&b, 0, small);
    assert_int_equal(law->stress(&treloar, 0.0, &b), 0);
    check_close_relative(b.stress[XY][0], G * e, 1e-7);
    for (double gap = 1e-15; gap < 1e-3; gap *= 100.0) {
        const double near[9] = {2.0 + gap, 0.3 * gap, 0, 0, 2.0, 0, 0, 0, 0.25},
                     equal[9] = {2, 0, 0, 0, 2, 0, 0, 0, 0.25};
        solid_batch a;
        batch_start(&a, 0.0);
        batch_start(&b, 0.0);
        set_F(&a, 0, near);
        set_F(&b, 0, equal);
        a.J[0] = b.J[0] = 1.0;
        assert_int_equal(law->stress(&treloar, 0.0, &a) + law->stress(&treloar, 0.0, &b), 0);
        for (int k = 0; k < 6; k++) check_close(a.stress[k][0], b.stress[k][0], 4.0 * G * gap + 1e-14 * treloar.K);
    }
}

static void test_ogden_refusals(void **state)
{
    (void)state;
    const solid_model *law = solid_find("ogden");
    const ogden_values bad[4] = {{1e9, 4e5, -1.3, 0, 0, 0, 0},
                                 {1e9, 4e5, 1.3, 1e3, -5.0, 0, 0},
                                 {1e9, 4e5, 1.3, 0, 0, 1e3, 0.0},
                                 {1e9, 4e5, 0.0, 1e3, 2.0, 0, 0}};
    static const char *const words[4] = {"mu_1 alpha_1", "mu_2 alpha_2", "mu_3 and alpha_3", "mu_1 and alpha_1"};
    assert_null(law->check(&treloar));
    for (int k = 0; k < 4; k++) {
        const char *why = law->check(&bad[k]);
        assert_non_null(why);
        assert_non_null(strstr(why, words[k]));
    }
}

/* ---- Drucker-Prager ---- */

typedef struct soil {
    double K, G, friction, cohesion, dilation;
} soil;

static void strain_step(const solid_model *law, const void *par, solid_batch *b, const double L[9])
{
    for (int k = 0; k < 9; k++) b->L[k][0] = L[k];
    b->J_old[0] = b->J[0];
    b->J[0] *= exp(b->dt * (L[0] + L[4] + L[8]));
    assert_int_equal(law->stress(par, 0.0, b), 0);
}

/* Triaxial compression under a lateral stress that is kept: the axial stress ends at Mohr and Coulomb's
 * sigma_1 = sigma_3 (1 + sin phi)/(1 - sin phi) + 2 c cos phi/(1 - sin phi); the ratio of plastic volume to shear is Mbar. */
static void test_triaxial_compression(void **state)
{
    (void)state;
    const solid_model *law = solid_find("drucker_prager");
    const soil a = {3e7, 1.4e7, 0.61, 1.3e4, 0.2};
    const double lateral = 8.3e4, sine = sin(a.friction);
    const double expected = lateral * (1.0 + sine) / (1.0 - sine) + 2.0 * a.cohesion * cos(a.friction) / (1.0 - sine);
    solid_batch b;
    batch_start(&b, 1.0);
    for (int k = 0; k < 3; k++) b.stress[k][0] = -lateral;
    double dilation = 0.0, strain = 0.0;
    for (int n = 0; n < 400; n++) {
        /* the lateral rate that keeps the lateral stress, by the secant of two trials */
        double out = 0.3e-4, residual[2], trial[2] = {0.0, out};
        const solid_batch start = b;
        for (int round = 0; round < 30; round++) {
            b = start;
            strain_step(law, &a, &b, (const double[9]){-1e-4, 0, 0, 0, out, 0, 0, 0, out});
            const double left = b.stress[YY][0] + lateral;
            if (fabs(left) < 1e-10 * lateral) break;
            residual[1] = left;
            trial[1] = out;
            out = round == 0 ? 1.1 * out : trial[1] - residual[1] * (trial[1] - trial[0]) / (residual[1] - residual[0]);
            residual[0] = residual[1];
            trial[0] = trial[1];
        }
        if (n == 199) dilation = b.history[1][0], strain = b.history[0][0];
    }
    check_close_relative(-b.stress[XX][0], expected, 1e-9);
    const double flow = 6.0 * sin(a.dilation) / (3.0 - sin(a.dilation));
    check_true(strain > 0.01);
    check_close_relative((b.history[1][0] - dilation) / (b.history[0][0] - strain), flow, 1e-9);
    check_close(b.history[2][0], 0.0, 0.0);
}

/* Shear beyond yield in one step: on the cone at the pressure that the flow leaves, normal to nothing else. */
static void test_return_to_cone(void **state)
{
    (void)state;
    const solid_model *law = solid_find("drucker_prager");
    const soil a = {3e7, 1.4e7, 0.55, 1e3, 0.3};
    const double M = 6.0 * sin(a.friction) / (3.0 - sin(a.friction)),
                 flow = 6.0 * sin(a.dilation) / (3.0 - sin(a.dilation));
    const double k = 6.0 * a.cohesion * cos(a.friction) / (3.0 - sin(a.friction)), p = 5e4, gamma = 0.02;
    solid_batch b;
    batch_start(&b, 1.0);
    for (int c = 0; c < 3; c++) b.stress[c][0] = -p;
    strain_step(law, &a, &b, (const double[9]){0, 0.5 * gamma, 0, 0.5 * gamma, 0, 0, 0, 0, 0});
    const double trial = sqrt(3.0) * a.G * gamma, strain = (trial - M * p - k) / (3.0 * a.G + a.K * M * flow);
    const double end_p = p + a.K * flow * strain, end_q = trial - 3.0 * a.G * strain;
    check_close_relative(b.stress[XY][0], end_q / sqrt(3.0), 1e-13);
    check_close_relative(b.stress[XX][0], -end_p, 1e-13);
    check_close_relative(end_q, M * end_p + k, 1e-13);
    check_close_relative(1000.0 * b.energy[0], (end_q - flow * end_p) * strain, 1e-12);
}

/* Pulled apart it bears the tension of its apex, k/M = c cot(phi), and what opens closes again without pressure. */
static void test_apex(void **state)
{
    (void)state;
    const solid_model *law = solid_find("drucker_prager");
    for (int cohesive = 0; cohesive < 2; cohesive++) {
        const soil a = {3e7, 1.4e7, 0.55, cohesive ? 2e3 : 0.0, 0.0};
        const double apex = a.cohesion / tan(a.friction), rate = 1e-3;
        const double open[9] = {rate, 0.7 * rate, 0, 0, rate, 0, 0, 0, rate};
        const double close[9] = {-rate, 0, 0, 0, -rate, 0, 0, 0, -rate};
        solid_batch b;
        batch_start(&b, 1.0);
        for (int n = 0; n < 20; n++) strain_step(law, &a, &b, open);
        for (int k = 0; k < 3; k++) check_close(b.stress[k][0], apex, 1e-9);
        check_close(b.stress[XY][0], 0.0, 1e-9);
        check_close_relative(b.history[2][0], 0.06 - apex / a.K, 1e-12);
        check_close_relative(1000.0 * b.energy[0] + 1e-30, apex * (0.06 - apex / a.K) + 1e-30, 0.04); /* 0.06: J */
        const double heat = b.energy[0];
        for (int n = 0; n < 10; n++) strain_step(law, &a, &b, close);
        check_close(b.stress[XX][0], 0.0, 1e-9);
        check_close_relative(b.history[2][0], 0.03, 1e-9);
        check_close(b.energy[0], heat, 0.0);
        for (int n = 0; n < 20; n++) strain_step(law, &a, &b, close);
        check_close_relative(b.stress[XX][0], -0.03 * a.K, 1e-9);
        check_close(b.history[2][0], 0.0, 0.0);
    }
}

static void test_soil_refusals(void **state)
{
    (void)state;
    const solid_model *law = solid_find("drucker_prager");
    const soil loose = {3e7, 1.4e7, 0.5, 0.0, 0.51}, fluid = {3e7, 1.4e7, 0.0, 0.0, 0.0},
               clay = {3e7, 1.4e7, 0.0, 1e3, 0.0};
    assert_non_null(strstr(law->check(&loose), "dilation_angle"));
    assert_non_null(strstr(law->check(&fluid), "cohesion"));
    assert_null(law->check(&clay));
    check_close_relative(law->yield_stress(&clay), 2e3, 1e-14); /* unconfined 2 c, in compression and in tension */
    const soil rock = {3e7, 1.4e7, 0.5, 1e3, 0.0};
    const double pulled[9] = {1e-3}, F[9] = {1.001, 0, 0, 0, 1, 0, 0, 0, 1};
    solid_batch b;
    batch_start(&b, 1.0);
    set_F(&b, 0, F);
    for (int k = 0; k < 9; k++) b.L[k][0] = pulled[k];
    assert_int_equal(solid_stress_state(law, &rock, 0.0, STRESS_UNIAXIAL, &b), 0);
    check_close_relative(b.stress[XX][0], law->yield_stress(&rock), 1e-6);
}

/* ---- viscoelastic ---- */

typedef struct rubber {
    double K, G, g_1, tau_1, g_2, tau_2, g_3, tau_3, g_4, tau_4;
} rubber;

static const rubber two_terms = {1e9, 4e5, 0.3, 0.7, 0.0, 0.0, 0.45, 0.02, 0.0, 0.0};

static double prony(const rubber *a, double t)
{
    return a->G * (1.0 - a->g_1 - a->g_3 + a->g_1 * exp(-t / a->tau_1) + a->g_3 * exp(-t / a->tau_3));
}

/* Simple shear from gamma_old to gamma in a step. */
static void shear_to(const rubber *a, solid_batch *b, double gamma)
{
    const solid_model *law = solid_find("viscoelastic");
    b->L[1][0] = (gamma - b->F[1][0]) / b->dt;
    b->F[1][0] = gamma;
    assert_int_equal(law->stress(a, 0.0, b), 0);
}

/* A sudden shear of any size: sigma_xy = G(t) gamma, sigma_xx - sigma_yy = G(t) gamma^2 (Lodge), whatever the steps. */
static void test_relaxation(void **state)
{
    (void)state;
    const solid_model *law = solid_find("viscoelastic");
    const double gamma = 1.3;
    for (int n = 1; n <= 64; n *= 8) {
        solid_batch b;
        double psi[2];
        batch_start(&b, 1e-12);
        shear_to(&two_terms, &b, gamma);
        law->strain_energy(&two_terms, &b, &psi[0]);
        b.dt = 0.31 / n;
        for (int k = 0; k < n; k++) shear_to(&two_terms, &b, gamma);
        check_close_relative(b.stress[XY][0], prony(&two_terms, 0.31) * gamma, 1e-10);
        check_close_relative(b.stress[XX][0] - b.stress[YY][0], prony(&two_terms, 0.31) * gamma * gamma, 1e-9);
        law->strain_energy(&two_terms, &b, &psi[1]);
        check_close_relative(psi[1], 0.5 * prony(&two_terms, 0.31) * gamma * gamma, 1e-9);
        check_close_relative(1000.0 * b.energy[0], psi[0] - psi[1], 1e-8);
    }
    /* in uniaxial tension at constant volume the difference of stresses is G(t) (s^2 - 1/s) */
    const double s = 2.2, across = 1.0 / sqrt(s);
    solid_batch b;
    batch_start(&b, 0.0);
    set_F(&b, 0, (const double[9]){s, 0, 0, 0, across, 0, 0, 0, across});
    b.dt = 0.05;
    for (int k = 0; k < 3; k++) assert_int_equal(law->stress(&two_terms, 0.0, &b), 0);
    check_close_relative(b.stress[XX][0] - b.stress[YY][0], prony(&two_terms, 0.15) * (s * s - 1.0 / s), 1e-8);
}

/* Under a constant shear stress a standard solid creeps by sigma/G_0 (1 - g exp(-(1 - g) t/tau)). */
static double creep_error(int n)
{
    const rubber a = {1e9, 4e5, 0.6, 0.05, 0, 0, 0, 0, 0, 0};
    const double sigma = 1.2e5, end = 0.1, lasting = a.G * (1.0 - a.g_1);
    solid_batch b;
    batch_start(&b, 1e-14);
    shear_to(&a, &b, sigma / a.G);
    for (int k = 0; k < n; k++) {
        b.dt = end / n;
        const solid_batch start = b;
        const double gamma = b.F[1][0];
        double at[2];
        for (int side = 0; side < 2; side++) {
            b = start;
            shear_to(&a, &b, gamma + side * 0.1);
            at[side] = b.stress[XY][0];
        }
        b = start;
        shear_to(&a, &b, gamma + 0.1 * (sigma - at[0]) / (at[1] - at[0]));
        check_close_relative(b.stress[XY][0], sigma, 1e-10);
    }
    return b.F[1][0] / (sigma / lasting * (1.0 - a.g_1 * exp(-(1.0 - a.g_1) * end / a.tau_1))) - 1.0;
}

static void test_creep(void **state)
{
    (void)state;
    const double coarse = fabs(creep_error(20)), fine = fabs(creep_error(40));
    check_true(coarse < 2e-3);
    check_close(log2(coarse / fine), 2.0, 0.1);
}

/* Cyclic shear of amplitude 0.8: storage and loss modulus, and the heat of a cycle pi gamma^2 G''. */
static void test_complex_modulus(void **state)
{
    (void)state;
    const double gamma = 0.8, pi = acos(-1.0);
    const int steps = 200;
    for (double omega = 0.5; omega < 300.0; omega *= 5.0) {
        const double x = omega * two_terms.tau_1, y = omega * two_terms.tau_3;
        const double storage =
            two_terms.G * (1.0 - two_terms.g_1 - two_terms.g_3 + two_terms.g_1 * x * x / (1 + x * x) +
                           two_terms.g_3 * y * y / (1 + y * y));
        const double loss = two_terms.G * (two_terms.g_1 * x / (1 + x * x) + two_terms.g_3 * y / (1 + y * y));
        const int cycles = 2 + (int)ceil(12.0 * two_terms.tau_1 * omega / (2.0 * pi));
        double in = 0.0, out = 0.0, heat = 0.0;
        solid_batch b;
        batch_start(&b, 2.0 * pi / omega / steps);
        for (int n = 1; n <= cycles * steps; n++) {
            const double phase = 2.0 * pi * n / steps;
            if (n == (cycles - 1) * steps + 1) heat = b.energy[0];
            shear_to(&two_terms, &b, gamma * sin(phase));
            if (n <= (cycles - 1) * steps) continue;
            in += 2.0 / steps / gamma * b.stress[XY][0] * sin(phase);
            out += 2.0 / steps / gamma * b.stress[XY][0] * cos(phase);
        }
        check_close_relative(in, storage, 2e-4);
        check_close_relative(out, loss, 2e-4);
        check_close_relative(1000.0 * (b.energy[0] - heat), pi * gamma * gamma * loss, 4e-4);
    }
}

/* Along random motions in steps from a thousandth to a thousand relaxation times: never does a network make energy, its trace stays
 * above that at rest, and waves stay below the law's speed. */
static void test_thermodynamics(void **state)
{
    (void)state;
    const solid_model *law = solid_find("viscoelastic");
    const rubber a = {2e6, 4e5, 0.3, 0.7, 0.0, 0.0, 0.45, 0.02, 0.2, 1e-5};
    uint64_t seed = 3;
    solid_batch b;
    batch_start(&b, 1.0);
    for (int n = 0; n < 4000; n++) {
        double L[9], change[9], F[9], grown[9], psi, c;
        b.dt = pow(10.0, check_random(&seed, -5.0, 1.0));
        for (int k = 0; k < 9; k++) L[k] = check_random(&seed, -0.3, 0.3);
        for (int k = 0; k < 9; k += 4) L[k] -= 0.1 * log(b.J[0]); /* back to about its volume */
        tensor_exp(L, change);
        for (int k = 0; k < 9; k++) {
            F[k] = b.F[k][0];
            b.L[k][0] = L[k] / b.dt;
        }
        if (n % 40 == 0) tensor_identity(F); /* as if it were another point: jumps, too, only lose */
        tensor_multiply(change, F, grown);
        const double heat = b.energy[0];
        b.J_old[0] = b.J[0];
        set_F(&b, 0, grown);
        assert_int_equal(law->stress(&a, 0.0, &b), 0);
        check_true(b.energy[0] >= heat);
        law->strain_energy(&a, &b, &psi);
        check_true(psi >= 0.0);
        if (n % 400 != 0) continue;
        law->wave_speed(&a, 0.0, &b, &c);
        check_true(1000.0 * c * c >= fastest_wave(law, &a, &b, &seed) * (1.0 - 1e-5));
    }
}

static void test_rubber_refusals(void **state)
{
    (void)state;
    const solid_model *law = solid_find("viscoelastic");
    const rubber flows = {1e9, 4e5, 0.6, 0.1, 0.4, 0.2, 0, 0, 0, 0},
                 timeless = {1e9, 4e5, 0.6, 0.1, 0.2, 0.0, 0, 0, 0, 0};
    assert_null(law->check(&two_terms));
    assert_non_null(strstr(law->check(&flows), "below 1"));
    assert_non_null(strstr(law->check(&timeless), "tau"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ogden_closed_forms),
        cmocka_unit_test(test_ogden_is_mooney_rivlin),
        cmocka_unit_test(test_ogden_wave_speed),
        cmocka_unit_test(test_ogden_small_and_equal),
        cmocka_unit_test(test_ogden_refusals),
        cmocka_unit_test(test_triaxial_compression),
        cmocka_unit_test(test_return_to_cone),
        cmocka_unit_test(test_apex),
        cmocka_unit_test(test_soil_refusals),
        cmocka_unit_test(test_relaxation),
        cmocka_unit_test(test_creep),
        cmocka_unit_test(test_complex_modulus),
        cmocka_unit_test(test_thermodynamics),
        cmocka_unit_test(test_rubber_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
