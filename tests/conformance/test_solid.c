/* Every law of the registry, by name of none: objectivity, Hooke's law at small strain, energy, wave speed, batches.
 *
 * Parameters: the default where there is one; else the middle of a bounded range, else a plausible size by unit, each
 * further required pressure 0.4 of the one before (so K = 1e9, G = 4e8 Pa). Times are so long that nothing relaxes,
 * but where a law is to dissipate. */
#include "check.h"

#include "material/solid.h"
#include "math/tensor.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_PAR = 64, XX = 0, YY, ZZ, XY, YZ, ZX };
static const double DENSITY = 2700.0, DT = 1e-3;

typedef struct law {
    const solid_model *model;
    double par[MAX_PAR];
    double K, G;
} law;

static double sample_parameter(const param_spec *spec, int *n_pressures)
{
    if (!isnan(spec->fallback)) return spec->fallback;
    if (spec->range == PARAM_BETWEEN) return 0.5 * (spec->lo + spec->hi);
    if (strcmp(spec->unit, "Pa") == 0) return 1e9 * pow(0.4, (*n_pressures)++);
    if (strcmp(spec->unit, "1") == 0) return 1.5;
    if (strcmp(spec->unit, "s") == 0) return 1e12;
    print_error("no sample value for '%s' in %s\n", spec->key, spec->unit);
    return NAN;
}

static void on_each(void (*check)(const law *))
{
    check_true(solid_registry_size > 0);
    for (size_t i = 0; i < solid_registry_size; i++) {
        law a = {.model = solid_registry[i]};
        assert_true(a.model->param_size <= sizeof a.par);
        int n_pressures = 0;
        for (size_t k = 0; k < a.model->n_params; k++) {
            const double x = sample_parameter(&a.model->params[k], &n_pressures);
            check_true(param_in_range(&a.model->params[k], x));
            a.par[a.model->params[k].offset / sizeof(double)] = x;
        }
        a.K = a.model->bulk_modulus(a.par);
        a.G = a.model->shear_modulus(a.par);
        check(&a);
    }
}

/* The law with other times in it. */
static law with_times(const law *a, double time)
{
    law b = *a;
    for (size_t k = 0; k < a->model->n_params; k++) {
        const param_spec *spec = &a->model->params[k];
        if (strcmp(spec->unit, "s") == 0 && isnan(spec->fallback)) b.par[spec->offset / sizeof(double)] = time;
    }
    return b;
}

/* exp(scale a) by its series: the arguments here are below 1. */
static void exponential(const double a[9], double scale, double out[9])
{
    double term[9], next[9];
    tensor_identity(term);
    tensor_identity(out);
    for (int n = 1; n < 30; n++) {
        tensor_multiply(term, a, next);
        for (int k = 0; k < 9; k++) out[k] += term[k] = next[k] * scale / n;
    }
}

/* a <- q a q^T. */
static void turn(const double q[9], double a[9])
{
    double qa[9];
    tensor_multiply(q, a, qa);
    tensor_multiply_transposed(qa, q, a);
}

static void stress_of(const solid_batch *b, size_t i, double s[9])
{
    const int at[9] = {XX, XY, ZX, XY, YY, YZ, ZX, YZ, ZZ};
    for (int k = 0; k < 9; k++) s[k] = b->stress[at[k]][i];
}

static void set_rate(solid_batch *b, size_t i, double scale, const double L[9])
{
    for (int k = 0; k < 9; k++) b->L[k][i] = scale * L[k];
}

static void set_motion(solid_batch *b, size_t i, const double L[9], const double F[9])
{
    set_rate(b, i, 1.0, L);
    for (int k = 0; k < 9; k++) b->F[k][i] = F[k];
    b->J[i] = tensor_det(F);
}

static void batch_start(solid_batch *b, size_t n)
{
    const double rest[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, still[9] = {0.0};
    memset(b, 0, sizeof *b);
    b->n = n;
    b->dt = DT;
    for (size_t i = 0; i < n; i++) {
        set_motion(b, i, still, rest);
        b->J_old[i] = 1.0;
        b->rho0[i] = DENSITY;
    }
}

/* Steps every point of the batch by its L: F <- exp(dt L) F. */
static void step(const law *a, solid_batch *b)
{
    for (size_t i = 0; i < b->n; i++) {
        double L[9], F[9], f[9], grown[9];
        for (int k = 0; k < 9; k++) {
            L[k] = b->L[k][i];
            F[k] = b->F[k][i];
        }
        exponential(L, b->dt, f);
        tensor_multiply(f, F, grown);
        b->J_old[i] = b->J[i];
        set_motion(b, i, L, grown);
    }
    assert_int_equal(a->model->stress(a->par, 0.0, b), 0);
}

static const double SOME_L[9] = {40, -75, 22, 31, -60, 55, -18, 12, 25};
static const double SOME_SPIN[9] = {0, -310, 120, 310, 0, -85, -120, 85, 0};

static void check_tensor_close(const double a[9], const double b[9], double tol)
{
    for (int k = 0; k < 9; k++) check_close(a[k], b[k], tol);
}

/* Seen from a turned frame the stress is the turned stress: at any strain, after several steps. */
static void check_frame(const law *a)
{
    solid_batch b;
    double q[9], stress[9], turned[9], turned_L[9];
    exponential(SOME_SPIN, 2e-3, q);
    tensor_copy(SOME_L, turned_L);
    turn(q, turned_L);
    batch_start(&b, 2);
    for (int n = 0; n < 5; n++) {
        set_rate(&b, 0, 1.0, SOME_L);
        set_rate(&b, 1, 1.0, turned_L);
        step(a, &b);
    }
    stress_of(&b, 0, stress);
    turn(q, stress);
    stress_of(&b, 1, turned);
    check_tensor_close(turned, stress, 1e-13 * (a->K + a->G));
}

/* A spin turns the stress with the body, and leaves its invariants to round-off. exp(W dt) is met to the law's
 * O((W dt / 2)^7) = 1e-6 of the stress here, about all axes and about z alone (a form of its own in some laws). */
static void check_spin(const law *a)
{
    for (int planar = 0; planar < 2; planar++) {
        double spin[9], q[9], before[9], after[9];
        tensor_copy(SOME_SPIN, spin);
        if (planar) spin[2] = spin[6] = spin[5] = spin[7] = 0.0;
        exponential(spin, DT, q);
        solid_batch b;
        batch_start(&b, 1);
        set_rate(&b, 0, 1.0, SOME_L);
        step(a, &b);
        stress_of(&b, 0, before);
        set_rate(&b, 0, 1.0, spin);
        step(a, &b);
        stress_of(&b, 0, after);
        const double size = a->G * 0.05;
        check_close(tensor_trace(after), tensor_trace(before), 1e-12 * size);
        check_close(tensor_det(after), tensor_det(before), 1e-12 * size * size * size);
        turn(q, before);
        check_tensor_close(after, before, 2e-5 * size);
    }
}

/* From rest by a strain of 1e-7: sigma = (K - 2G/3) tr(E) I + 2 G E, up to the strain relative. */
static void check_hooke(const law *a)
{
    const double small = 1e-6;
    solid_batch b;
    double stress[9], expected[9];
    batch_start(&b, 1);
    set_rate(&b, 0, small, SOME_L);
    step(a, &b);
    stress_of(&b, 0, stress);
    const double trace = small * DT * (SOME_L[0] + SOME_L[4] + SOME_L[8]);
    for (int k = 0; k < 9; k++) {
        expected[k] = a->G * small * DT * (SOME_L[k] + SOME_L[3 * (k % 3) + k / 3]);
        if (k % 4 == 0) expected[k] += (a->K - 2.0 / 3.0 * a->G) * trace;
    }
    /* 1e-14: round-off of moduli; strain^2 = 1e-14 times the moduli for what is not linear */
    check_tensor_close(stress, expected, 3e-14 * (a->K + a->G));

    double psi, c, energy = 0.0;
    for (int k = 0; k < 9; k++) energy += 0.5 * expected[k] * small * DT * SOME_L[k];
    if (a->model->strain_energy != NULL) {
        a->model->strain_energy(a->par, &b, &psi);
        check_close(psi, energy, 1e-5 * energy + 1e-14 * a->G);
    }
    a->model->wave_speed(a->par, 0.0, &b, &c);
    check_close_relative(DENSITY * c * c, a->K + 4.0 / 3.0 * a->G, 1e-5);
}

/* Laws of F: P = d psi / d F against differences, sigma = P F^T / J, at large strain. */
static void check_potential(const law *a)
{
    if (!(a->model->needs & SOLID_NEEDS_F) || a->model->n_history > 0 || a->model->strain_energy == NULL) return;
    const double F[9] = {1.3, 0.2, -0.1, -0.15, 0.8, 0.25, 0.05, 0.3, 1.1}, still[9] = {0.0};
    const double d = 1e-6;
    solid_batch b;
    double psi[SOLID_CHUNK];
    batch_start(&b, 19);
    for (size_t i = 0; i < b.n; i++) {
        double moved[9];
        tensor_copy(F, moved);
        if (i > 0) moved[(i - 1) / 2] += i % 2 == 1 ? d : -d;
        set_motion(&b, i, still, moved);
    }
    assert_int_equal(a->model->stress(a->par, 0.0, &b), 0);
    a->model->strain_energy(a->par, &b, psi);
    double P[9], expected[9], stress[9];
    for (int k = 0; k < 9; k++) P[k] = (psi[2 * k + 1] - psi[2 * k + 2]) / (2.0 * d);
    tensor_multiply_transposed(P, F, expected);
    for (int k = 0; k < 9; k++) expected[k] /= tensor_det(F);
    stress_of(&b, 0, stress);
    check_tensor_close(stress, expected, 1e-8 * (a->K + a->G));
}

/* Work done equals energy stored or lost along any path, to the law's order in the step: the stress power J sigma : D is
 * d psi/dt at small strain, and what relaxes. */
static void check_power(const law *given)
{
    if (given->model->strain_energy == NULL) return;
    const law relaxing = with_times(given, 50.0 * DT), *a = &relaxing;
    solid_batch b;
    double work = 0.0, psi;
    batch_start(&b, 1);
    for (int n = 0; n < 200; n++) {
        double before = 0.0, after = 0.0;
        const double rate = n < 100 ? 1e-3 : -0.5e-3;
        for (int k = 0; k < 9; k++) b.L[k][0] = rate * SOME_L[3 * (k / 3) + (k % 3 + n / 100) % 3];
        const int at[9] = {XX, XY, ZX, XY, YY, YZ, ZX, YZ, ZZ};
        for (int k = 0; k < 9; k++) before += b.J[0] * b.stress[at[k]][0] * b.L[k][0];
        step(a, &b);
        for (int k = 0; k < 9; k++) after += b.J[0] * b.stress[at[k]][0] * b.L[k][0];
        work += 0.5 * b.dt * (before + after);
    }
    a->model->strain_energy(a->par, &b, &psi);
    const double lost = a->model->needs & SOLID_HAS_ENERGY ? DENSITY * b.energy[0] : 0.0;
    check_close_relative(psi + lost, work, 0.02); /* strains reach 0.01: what is not quadratic is of that size */
}

/* Laws that dissipate: along any path, beyond yield, what is done is stored as strain energy or stays as internal energy, and
 * internal energy never falls. Strains are small, so that what is not quadratic is a few per cent. */
static void check_dissipation(const law *given)
{
    if (!(given->model->needs & SOLID_HAS_ENERGY) || given->model->strain_energy == NULL) return;
    const law relaxing = with_times(given, 50.0 * DT), *a = &relaxing;
    solid_batch b;
    double work = 0.0, psi;
    uint64_t seed = 7;
    batch_start(&b, 1);
    for (int n = 0; n < 3000; n++) {
        const double heat = b.energy[0];
        double before = 0.0, after = 0.0;
        for (int k = 0; k < 9; k++)
            b.L[k][0] = n % 300 == 0 ? check_random(&seed, -0.5, 0.5) * (k % 4 == 0 ? 0.02 : 1.0) : b.L[k][0];
        const int at[9] = {XX, XY, ZX, XY, YY, YZ, ZX, YZ, ZZ};
        for (int k = 0; k < 9; k++) before += b.J[0] * b.stress[at[k]][0] * b.L[k][0];
        step(a, &b);
        for (int k = 0; k < 9; k++) after += b.J[0] * b.stress[at[k]][0] * b.L[k][0];
        work += 0.5 * b.dt * (before + after);
        check_true(b.energy[0] >= heat);
    }
    a->model->strain_energy(a->par, &b, &psi);
    check_true(DENSITY * b.energy[0] > 0.2 * psi);
    check_close_relative(psi + DENSITY * b.energy[0], work, 0.02);
}

/* Internal energy of a solid takes the work of the artificial viscosity, -q dV. */
static void check_artificial_work(const law *a)
{
    if (!(a->model->needs & SOLID_HAS_ENERGY)) return;
    const double squeeze[9] = {-1e-3};
    solid_batch b;
    batch_start(&b, 1);
    b.q[0] = 2.5e3;
    set_rate(&b, 0, 1.0, squeeze);
    step(a, &b);
    check_close_relative(DENSITY * b.energy[0], 2.5e3 * (1.0 - b.J[0]), 1e-12);
}

/* J that is zero, negative or not a number is reported with its place. */
static void check_refusal(const law *a)
{
    const double bad[3] = {0.0, -1.0, NAN};
    for (int k = 0; k < 3; k++) {
        solid_batch b;
        batch_start(&b, SOLID_CHUNK);
        b.J[17] = bad[k];
        b.J[40] = bad[k];
        assert_int_equal(a->model->stress(a->par, 0.0, &b), 18);
    }
}

/* The bits of a point do not depend on its place in a batch nor on its neighbours. */
static void check_batches(const law *a)
{
    solid_batch b, one;
    batch_start(&b, SOLID_CHUNK - 1);
    for (size_t i = 0; i < b.n; i++) {
        for (int k = 0; k < 9; k++) b.L[k][i] = sin((double)i + 7.0 * k) * 20.0;
        if (i % 3 == 0) b.L[2][i] = b.L[5][i] = b.L[6][i] = b.L[7][i] = 0.0; /* plane among others */
    }
    solid_batch start = b;
    double psi[SOLID_CHUNK], c[SOLID_CHUNK], psi_one, c_one;
    for (int n = 0; n < 3; n++) step(a, &b);
    a->model->wave_speed(a->par, 0.0, &b, c);
    if (a->model->strain_energy != NULL) a->model->strain_energy(a->par, &b, psi);
    for (size_t i = 0; i < b.n; i++) {
        batch_start(&one, 1);
        for (int k = 0; k < 9; k++) one.L[k][0] = start.L[k][i];
        for (int n = 0; n < 3; n++) step(a, &one);
        for (int k = 0; k < 6; k++) check_close(one.stress[k][0], b.stress[k][i], 0.0);
        a->model->wave_speed(a->par, 0.0, &one, &c_one);
        check_close(c_one, c[i], 0.0);
        if (a->model->strain_energy == NULL) continue;
        a->model->strain_energy(a->par, &one, &psi_one);
        check_close(psi_one, psi[i], 0.0);
    }
}

/* At rest nothing happens: the stress stays zero to the bit. */
static void check_rest(const law *a)
{
    solid_batch b;
    batch_start(&b, 3);
    for (int n = 0; n < 3; n++) step(a, &b);
    for (int k = 0; k < 6; k++) check_close(b.stress[k][1], 0.0, 0.0);
}

/* Plane stress at small strain: sigma_xx = E/(1 - nu^2) (e_xx + nu e_yy), sigma_xy = 2 G e_xy, e_zz = -nu/(1 - nu)
 * (e_xx + e_yy); uniaxial stress: sigma_xx = E e_xx, e_yy = e_zz = -nu e_xx. */
static void check_stress_states(const law *a)
{
    const double E = 9.0 * a->K * a->G / (3.0 * a->K + a->G), nu = 0.5 * E / a->G - 1.0;
    const double exx = 3e-7, eyy = -1e-7, exy = 2e-7, tol = 1e-13 * a->K + 1e-6 * exx * a->K;
    const double L[9] = {exx / DT, exy / DT, 0, exy / DT, eyy / DT, 0, 0, 0, 0};
    const double F[9] = {1 + exx, exy, 0, exy, 1 + eyy, 0, 0, 0, 1};
    solid_batch b;
    batch_start(&b, 3);
    set_motion(&b, 1, L, F);
    assert_int_equal(solid_stress_state(a->model, a->par, 0.0, STRESS_PLANE, &b), 0);
    check_close(b.stress[ZZ][1], 0.0, 1e-13 * a->K);
    check_close(b.stress[XX][1], E / (1.0 - nu * nu) * (exx + nu * eyy), tol);
    check_close(b.stress[YY][1], E / (1.0 - nu * nu) * (eyy + nu * exx), tol);
    check_close(b.stress[XY][1], 2.0 * a->G * exy, tol);
    check_close(b.L[8][1] * DT, -nu / (1.0 - nu) * (exx + eyy), 1e-12);
    check_close(b.F[8][1], 1.0 + b.L[8][1] * DT, 1e-12);
    check_close(b.J[1], tensor_det(F) * b.F[8][1], 1e-15);

    const double L1[9] = {exx / DT}, F1[9] = {1 + exx, 0, 0, 0, 1, 0, 0, 0, 1};
    batch_start(&b, 3);
    set_motion(&b, 2, L1, F1);
    assert_int_equal(solid_stress_state(a->model, a->par, 0.0, STRESS_UNIAXIAL, &b), 0);
    check_close(b.stress[YY][2], 0.0, 1e-13 * a->K);
    check_close(b.stress[ZZ][2], 0.0, 1e-13 * a->K);
    check_close(b.stress[XX][2], E * exx, tol);
    check_close(b.L[4][2] * DT, -nu * exx, 1e-12);
    check_close(b.L[8][2] * DT, -nu * exx, 1e-12);
}

/* Large steps converge too: a point stretched threefold, or as far as the law goes, and one pressed to a third in a
 * single step. */
static void check_large_stress_states(const law *a)
{
    const double stretches[2] = {a->model->largest_stretch > 0.0 ? a->model->largest_stretch : 3.0, 1.0 / 3.0};
    for (int state = STRESS_PLANE; state <= STRESS_UNIAXIAL; state++) {
        solid_batch b;
        batch_start(&b, 2);
        for (size_t i = 0; i < 2; i++) {
            const double L[9] = {log(stretches[i]) / DT}, F[9] = {stretches[i], 0, 0, 0, 1, 0, 0, 0, 1};
            set_motion(&b, i, L, F);
        }
        assert_int_equal(solid_stress_state(a->model, a->par, 0.0, (stress_state)state, &b), 0);
        for (size_t i = 0; i < 2; i++) {
            check_close(b.stress[ZZ][i], 0.0, 1e-12 * (a->K + fabs(b.stress[XX][i])));
            if (state == STRESS_UNIAXIAL) check_close(b.stress[YY][i], 0.0, 1e-12 * (a->K + fabs(b.stress[XX][i])));
            check_true(b.stress[XX][i] * log(stretches[i]) > 0.0);
        }
    }
}

static void check_description(const law *a)
{
    check_true(solid_find(a->model->name) == a->model);
    check_true(a->model->doc[0] != '\0' && a->model->cite[0] != '\0');
    check_true(a->model->n_history >= 0 && a->model->n_history <= SOLID_MAX_HISTORY);
    for (int k = 0; k < a->model->n_history; k++) {
        const solid_history *h = &a->model->history[k];
        check_true(h->name[0] != '\0' && h->unit[0] != '\0' && h->doc[0] != '\0');
    }
    check_true(a->K > 0.0 && a->G > 0.0);
}

#define ON_EACH(check)                     \
    static void test_##check(void **state) \
    {                                      \
        (void)state;                       \
        on_each(check_##check);            \
    }
ON_EACH(description)
ON_EACH(rest)
ON_EACH(frame)
ON_EACH(spin)
ON_EACH(hooke)
ON_EACH(potential)
ON_EACH(power)
ON_EACH(dissipation)
ON_EACH(artificial_work)
ON_EACH(refusal)
ON_EACH(batches)
ON_EACH(stress_states)
ON_EACH(large_stress_states)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_description),
        cmocka_unit_test(test_rest),
        cmocka_unit_test(test_frame),
        cmocka_unit_test(test_spin),
        cmocka_unit_test(test_hooke),
        cmocka_unit_test(test_potential),
        cmocka_unit_test(test_power),
        cmocka_unit_test(test_dissipation),
        cmocka_unit_test(test_artificial_work),
        cmocka_unit_test(test_refusal),
        cmocka_unit_test(test_batches),
        cmocka_unit_test(test_stress_states),
        cmocka_unit_test(test_large_stress_states),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
