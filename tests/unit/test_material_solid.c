/* Laws of solids against closed forms of their own. */
#include "check.h"
#include "solid_batch_fixture.h"

#include "material/strain_from_stress.h"
#include "math/tensor.h"

#include <math.h>
#include <string.h>

/* K, G, and what laws that yield take next: a yield stress above all stresses here. */
static double moduli[8] = {1e9, 4e8, 1e9};

/* Simple shear of gamma in n steps. */
static void shear(const solid_model *law, double gamma, int n, solid_batch *b)
{
    batch_start(b, 1.0 / n);
    b->L[1][0] = gamma;
    for (int s = 1; s <= n; s++) {
        b->F[1][0] = gamma * s / n;
        assert_int_equal(law->stress(moduli, 0.0, b), 0);
    }
}

/* The Jaumann rate in simple shear gives sigma_xy = G sin(gamma), sigma_xx = -sigma_yy = G (1 - cos(gamma)); the steps
 * are second order. */
static void test_jaumann_shear(void **state)
{
    (void)state;
    const solid_model *law = solid_find("linear_elastic");
    const double gamma = 1.2;
    double before = 0.0;
    for (int n = 10; n <= 80; n *= 2) {
        solid_batch b;
        shear(law, gamma, n, &b);
        const double error =
            fmax(fabs(b.stress[3][0] / moduli[1] - sin(gamma)), fabs(b.stress[0][0] / moduli[1] - (1.0 - cos(gamma))));
        check_close(b.stress[0][0], -b.stress[1][0], 1e-12 * moduli[1]);
        check_close(b.stress[2][0], 0.0, 0.0);
        if (n > 10) check_close(log2(before / error), 2.0, 0.02);
        before = error;
    }
}

/* Neo-Hookean simple shear: sigma_xy = mu gamma, sigma_xx = mu gamma^2, J = 1. */
static void test_neo_hookean_shear(void **state)
{
    (void)state;
    solid_batch b;
    shear(solid_find("neo_hookean"), 1.2, 3, &b);
    check_close_relative(b.stress[3][0], 1.2 * moduli[1], 1e-14);
    check_close_relative(b.stress[0][0], 1.44 * moduli[1], 1e-14);
    check_close(b.stress[1][0], 0.0, 0.0);
}

/* Neo-Hookean uniaxial strain: P = mu (F - 1/F) + lambda ln F / F is the Cauchy stress there, and rho0 c^2 = F^2 dP/dF. */
static void test_neo_hookean_uniaxial_strain(void **state)
{
    (void)state;
    const solid_model *law = solid_find("neo_hookean");
    const double lambda = moduli[0] - 2.0 / 3.0 * moduli[1], mu = moduli[1];
    for (double F = 0.25; F < 4.0; F *= 1.3) {
        solid_batch b;
        double c;
        batch_start(&b, 0.0);
        b.F[0][0] = b.J[0] = F;
        assert_int_equal(law->stress(moduli, 0.0, &b), 0);
        check_close(b.stress[0][0], mu * (F - 1.0 / F) + lambda * log(F) / F, 1e-13 * (mu + lambda) / F);
        law->wave_speed(moduli, 0.0, &b, &c);
        const double slope = mu * (1.0 + 1.0 / (F * F)) + lambda * (1.0 - log(F)) / (F * F);
        /* exact along the stretch; when pressed, waves across are faster by mu (1 - F^2) at most */
        check_true(1000.0 * c * c >= F * F * slope * (1.0 - 1e-14));
        check_true(1000.0 * c * c <= F * F * slope + 2.0 * mu);
        if (F >= 1.0) check_close_relative(1000.0 * c * c, F * F * slope, 1e-13);
    }
}

/* St. Venant-Kirchhoff uniaxial strain: P = (lambda + 2 mu) F (F^2 - 1)/2 is the Cauchy stress along the bar, lambda (F^2 -
 * 1)/(2 F) that across; stretched, rho0 c^2 = F^2 dP/dF. */
static void test_st_venant_kirchhoff_uniaxial_strain(void **state)
{
    (void)state;
    const solid_model *law = solid_find("st_venant_kirchhoff");
    const double lambda = moduli[0] - 2.0 / 3.0 * moduli[1], mu = moduli[1];
    for (double F = 0.6; F < 2.0; F *= 1.1) {
        solid_batch b;
        double c;
        batch_start(&b, 0.0);
        b.F[0][0] = b.J[0] = F;
        assert_int_equal(law->stress(moduli, 0.0, &b), 0);
        check_close(b.stress[0][0], 0.5 * (lambda + 2.0 * mu) * F * (F * F - 1.0), 1e-14 * (lambda + mu));
        check_close(b.stress[1][0], 0.5 * lambda * (F * F - 1.0) / F, 1e-14 * (lambda + mu));
        law->wave_speed(moduli, 0.0, &b, &c);
        const double square = 0.5 * F * F * (lambda + 2.0 * mu) * (3.0 * F * F - 1.0);
        check_true(1000.0 * c * c >= square * (1.0 - 1e-14));
        if (F >= 1.0) check_close_relative(1000.0 * c * c, square, 1e-13);
    }
}

/* Mooney-Rivlin: incompressible uniaxial tension sigma = 2 (s^2 - 1/s)(c1 + c2/s), the difference of the stresses along and
 * across; simple shear sigma_xy = 2 (c1 + c2) gamma, sigma_xx - sigma_zz = 2 c1 gamma^2, sigma_yy - sigma_zz = -2 c2 gamma^2
 * (Rivlin); volume alone K/2 (J - 1/J). */
static void test_mooney_rivlin_closed_forms(void **state)
{
    (void)state;
    const solid_model *law = solid_find("mooney_rivlin");
    double par[3] = {1e9, 3e5, 1e5};
    for (double s = 0.3; s < 4.0; s *= 1.25) {
        solid_batch b;
        batch_start(&b, 0.0);
        b.F[0][0] = s;
        b.F[4][0] = b.F[8][0] = 1.0 / sqrt(s);
        assert_int_equal(law->stress(par, 0.0, &b), 0);
        const double tension = 2.0 * (s * s - 1.0 / s) * (par[1] + par[2] / s);
        check_close(b.stress[0][0] - b.stress[1][0], tension, 1e-9 * (fabs(tension) + par[1]));
    }
    solid_batch b;
    batch_start(&b, 0.0);
    b.F[1][0] = 1.2;
    assert_int_equal(law->stress(par, 0.0, &b), 0);
    check_close_relative(b.stress[3][0], 2.0 * (par[1] + par[2]) * 1.2, 1e-13);
    check_close_relative(b.stress[0][0] - b.stress[2][0], 2.0 * par[1] * 1.44, 1e-12);
    check_close_relative(b.stress[1][0] - b.stress[2][0], -2.0 * par[2] * 1.44, 1e-12);
    batch_start(&b, 0.0);
    for (int k = 0; k < 9; k += 4) b.F[k][0] = 1.1;
    b.J[0] = 1.331;
    assert_int_equal(law->stress(par, 0.0, &b), 0);
    check_close_relative(b.stress[1][0], 0.5 * par[0] * (1.331 - 1.0 / 1.331), 1e-13);
}

/* Half the second difference of the strain energy as a point is strained by e a n F, with a and n of any direction, is
 * a.Q(n)a / 2 for the acoustic tensor Q: no wave is faster than the law says. */
static void test_bounds_of_wave_speeds(void **state)
{
    (void)state;
    static const char *const names[] = {"neo_hookean", "st_venant_kirchhoff", "mooney_rivlin"};
    static const double stretched[3][9] = {{1.8, 0, 0, 0, 0.7, 0, 0, 0, 0.9},
                                           {0.7, 0.3, 0, -0.2, 1.1, 0.1, 0, 0.2, 1.6},
                                           {1.3, 0, 0, 0, 1.3, 0, 0, 0, 0.8}};
    double par[8] = {1e9, 4e8, 3e8};
    uint64_t seed = 11;
    for (int m = 0; m < 3; m++) {
        const solid_model *law = solid_find(names[m]);
        for (int k = 0; k < 3; k++) {
            solid_batch b, moved;
            double c, fastest = 0.0;
            batch_start(&b, 0.0);
            for (int q = 0; q < 9; q++) b.F[q][0] = stretched[k][q];
            b.J[0] = tensor_det(stretched[k]);
            law->wave_speed(par, 0.0, &b, &c);
            for (int trial = 0; trial < 2000; trial++) {
                double a[3], n[3], psi[3];
                const double e = 1e-3;
                for (int q = 0; q < 3; q++)
                    a[q] = check_random(&seed, -1.0, 1.0), n[q] = check_random(&seed, -1.0, 1.0);
                vec_normalize(a);
                vec_normalize(n);
                batch_start(&moved, 0.0);
                moved.n = 3;
                for (int side = -1; side <= 1; side++) {
                    double more[9], F[9];
                    for (int q = 0; q < 9; q++) more[q] = (q % 4 == 0) + side * e * a[q / 3] * n[q % 3];
                    tensor_multiply(more, stretched[k], F);
                    for (int q = 0; q < 9; q++) moved.F[q][side + 1] = F[q];
                    moved.J[side + 1] = tensor_det(F);
                }
                law->strain_energy(par, &moved, psi);
                fastest = fmax(fastest, (psi[2] - 2.0 * psi[1] + psi[0]) / (e * e));
            }
            check_true(1000.0 * c * c >= fastest * (1.0 - 1e-5));
            check_true(1000.0 * c * c <= 2.5 * fastest);
        }
    }
}

/* Neo-Hookean plane stress at a large stretch: the free stretch solves mu (s^2 - 1) + lambda ln(J) = 0. */
static void test_neo_hookean_plane_stress(void **state)
{
    (void)state;
    const double lambda = moduli[0] - 2.0 / 3.0 * moduli[1], mu = moduli[1];
    solid_batch b;
    batch_start(&b, 1e-3);
    b.F[0][0] = 2.0;
    b.F[4][0] = 1.5;
    b.J[0] = 3.0;
    assert_int_equal(solid_stress_state(solid_find("neo_hookean"), moduli, 0.0, STRESS_PLANE, &b), 0);
    const double s = b.F[8][0];
    check_close(mu * (s * s - 1.0) + lambda * log(3.0 * s), 0.0, 1e-12 * moduli[0]);
    check_close_relative(b.J[0], 3.0 * s, 1e-14);
    check_close_relative(b.L[8][0], log(s) / 1e-3, 1e-12);
}

/* A law that cannot be pressed to zero stress in a step of no length, or a stress that is no number, is reported. */
static void test_stress_state_failure(void **state)
{
    (void)state;
    solid_batch b;
    batch_start(&b, 0.0);
    b.stress[2][0] = 1e6;
    assert_int_equal(solid_stress_state(solid_find("linear_elastic"), moduli, 0.0, STRESS_PLANE, &b), 1);
    batch_start(&b, 1e-3);
    b.n = 2;
    b.J[1] = b.J_old[1] = 1.0;
    b.L[0][1] = NAN;
    assert_int_equal(solid_stress_state(solid_find("linear_elastic"), moduli, 0.0, STRESS_UNIAXIAL, &b), 2);
}

/* Parameters of a law: defaults; else those of `moduli` in turn, the middle of what is bounded, times in which nothing relaxes. */
static void fill_parameters(const solid_model *law, double *par, size_t size)
{
    assert_true(law->param_size <= size);
    param_fill_defaults(law->params, law->n_params, par);
    size_t next = 0;
    for (size_t k = 0; k < law->n_params; k++) {
        const param_spec *spec = &law->params[k];
        double *at = par + spec->offset / sizeof *par;
        if (!isnan(*at)) continue;
        *at = spec->range == PARAM_BETWEEN ? 0.5 * (spec->lo + spec->hi) : strcmp(spec->unit, "s") == 0 ? 1e12 : 1.5;
        if (strcmp(spec->unit, "Pa") == 0) *at = moduli[next < 2 ? next++ : 2];
    }
}

/* A thousand small steps of plane stress leave no stress behind. */
static void test_plane_stress_does_not_drift(void **state)
{
    (void)state;
    for (size_t m = 0; m < solid_registry_size; m++) {
        solid_batch b;
        double par[32] = {0.0};
        fill_parameters(solid_registry[m], par, sizeof par);
        batch_start(&b, 1e-6);
        for (int s = 0; s < 1000; s++) {
            b.L[0][0] = 1e-3;
            b.L[8][0] = 0.0; /* the caller's F and J have not been stretched along z yet */
            b.F[0][0] *= 1.0 + 1e-9;
            b.J_old[0] = b.J[0];
            b.J[0] *= 1.0 + 1e-9;
            assert_int_equal(solid_stress_state(solid_registry[m], par, 0.0, STRESS_PLANE, &b), 0);
        }
        const double K = solid_registry[m]->bulk_modulus(par), G = solid_registry[m]->shear_modulus(par);
        const double E = 9.0 * K * G / (3.0 * K + G), nu = 0.5 * E / G - 1.0;
        check_close(b.stress[2][0], 0.0, 1e-13 * K);
        check_close_relative(b.stress[0][0], E / (1.0 - nu * nu) * 1e-6, 1e-5);
    }
}

/* A law that goes by F has its stress back from the strain that is found for it, up to a tenth of its moduli; a stress that no strain has
 * is told. */
static void test_strain_from_stress(void **state)
{
    (void)state;
    const solid_model *law = solid_find("neo_hookean");
    static const double stress[3][6] = {
        {3e7, -2e7, 1e7, 5e6, -1e6, 2e6}, {-5e7, -5e7, -5e7, 0, 0, 0}, {0, 0, 0, 4e7, 0, 0}};
    for (int k = 0; k < 3; ++k) {
        solid_batch b;
        double F[9];
        batch_start(&b, 1.0);
        assert_true(strain_from_stress(law, moduli, stress[k], F));
        for (int c = 0; c < 9; ++c) b.F[c][0] = F[c];
        b.J[0] = tensor_det(F);
        assert_int_equal(law->stress(moduli, 0.0, &b), 0);
        for (int c = 0; c < 6; ++c) assert_true(fabs(b.stress[c][0] - stress[k][c]) <= 1e-4);
        check_close(F[1], F[3], 0.0);
    }
    double F[9];
    /* Stresses of any size below that: what round-off of the strain leaves of a small one is no reason to refuse it. */
    for (double size = 1.0; size > 1e-12; size *= 0.7) {
        double small[6];
        for (int c = 0; c < 6; ++c) small[c] = size * stress[0][c];
        assert_true(strain_from_stress(law, moduli, small, F));
    }
    const double beyond[6] = {-1e13, 0.0, 0.0, 0.0, 0.0, 0.0}, torn[6] = {NAN, 0.0, 0.0, 0.0, 0.0, 0.0};
    assert_false(strain_from_stress(law, moduli, beyond, F));
    assert_false(strain_from_stress(law, moduli, torn, F));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_strain_from_stress),
        cmocka_unit_test(test_jaumann_shear),
        cmocka_unit_test(test_neo_hookean_shear),
        cmocka_unit_test(test_neo_hookean_uniaxial_strain),
        cmocka_unit_test(test_st_venant_kirchhoff_uniaxial_strain),
        cmocka_unit_test(test_mooney_rivlin_closed_forms),
        cmocka_unit_test(test_bounds_of_wave_speeds),
        cmocka_unit_test(test_neo_hookean_plane_stress),
        cmocka_unit_test(test_stress_state_failure),
        cmocka_unit_test(test_plane_stress_does_not_drift),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
