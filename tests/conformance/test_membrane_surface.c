/* Membranes as surfaces in space: every isotropic law of the registry under any stretch, in any plane, seen from anywhere. */
#include "check.h"

#include "material/sheet.h"
#include "math/tensor.h"

#include <math.h>
#include <string.h>

enum { TRIALS = 300 };

static const double modulus = 1e6, ratio = 0.3;

/* A surface with principal stretches exp(e) along m, m[2] its normal; the vectors lie at an angle to them. */
typedef struct sample {
    double e[2], m[3][3];
    sheet_point p;
} sample;

static double any_angle(uint64_t *seed)
{
    return check_random(seed, -3.2, 3.2);
}

static void any_frame(uint64_t *seed, double m[3][3])
{
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 3; i++) m[k][i] = check_random(seed, -1.0, 1.0);
    vec_normalize(m[0]);
    vec_add_scaled(-vec_dot(m[0], m[1]), m[0], m[1]);
    vec_normalize(m[1]);
    vec_cross(m[0], m[1], m[2]);
}

static sample sample_of(uint64_t *seed, double e1, double e2)
{
    sample s = {.e = {e1, e2}};
    any_frame(seed, s.m);
    const double angle = any_angle(seed), c = cos(angle), n = sin(angle);
    const double N[2][2] = {{c, n}, {-n, c}};
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 3; i++) s.p.a[k][i] = exp(e1) * N[0][k] * s.m[0][i] + exp(e2) * N[1][k] * s.m[1][i];
    return s;
}

static membrane_response response(const membrane_model *model, const double *par, bool one_way,
                                  membrane_section section)
{
    return (membrane_response){.model = model, .par = par, .one_way = one_way, .biaxial = true, .section = section};
}

/* s1 m1 (x) m1 + s2 m2 (x) m2. */
static void check_stress(const double found[6], const sample *s, double s1, double s2, double tolerance)
{
    static const int row[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
    for (int c = 0; c < 6; c++)
        check_close(found[c],
                    s1 * s->m[0][row[c][0]] * s->m[0][row[c][1]] + s2 * s->m[1][row[c][0]] * s->m[1][row[c][1]],
                    tolerance);
}

static void on_each(void (*check)(const membrane_model *, const double *))
{
    const double par[2] = {modulus, ratio};
    int found = 0;
    for (size_t i = 0; i < membrane_registry_size; i++) {
        if (!membrane_registry[i]->isotropic) continue;
        assert_true(membrane_registry[i]->param_size <= sizeof par);
        found++;
        check(membrane_registry[i], par);
    }
    check_true(found > 0);
}

/* Whatever the frames: the stresses of the law along the principal directions, nothing across the surface; with one direction held
 * that is the line in a plane scene. */
static void check_any_stretch(const membrane_model *model, const double *par)
{
    uint64_t seed = 3;
    for (int trial = 0; trial < TRIALS; trial++) {
        const double e1 = check_random(&seed, -0.4, 0.4), e2 = trial % 3 == 0 ? 0.0 : check_random(&seed, -0.4, 0.4);
        const sample s = sample_of(&seed, e1, e2);
        for (int way = 0; way < 4; way++) {
            const membrane_response r = response(model, par, way % 2 == 1, (membrane_section)(way / 2));
            double stress[6], J, s1, s2;
            sheet_stress(&r, &s.p, stress, &J);
            membrane_stress(&r, 1, &e1, &e2, &s1, &s2);
            check_stress(stress, &s, s1, s2, 1e-13 * modulus);
            check_close_relative(J, membrane_volume_ratio(r.section, e1, e2), 1e-13);
            check_close(sheet_energy(&r, &s.p), membrane_energy(&r, e1, e2), 1e-13 * modulus);
        }
    }
}

/* Taut, wrinkled, slack; uniaxial and biaxial in closed form for the linear law. */
static void test_linear_law(void **state)
{
    (void)state;
    const double par[2] = {modulus, ratio};
    const membrane_response r = response(membrane_find("plane_stress"), par, true, SECTION_VOLUME);
    uint64_t seed = 4;
    double stress[6], J;
    const sample both = sample_of(&seed, 0.2, 0.2);
    sheet_stress(&r, &both.p, stress, &J);
    check_stress(stress, &both, 0.2 * modulus / (1.0 - ratio), 0.2 * modulus / (1.0 - ratio), 1e-13 * modulus);
    const sample free_across = sample_of(&seed, 0.2, -ratio * 0.2);
    sheet_stress(&r, &free_across.p, stress, &J);
    check_stress(stress, &free_across, 0.2 * modulus, 0.0, 1e-13 * modulus);
    const sample shear = sample_of(&seed, 0.1, -0.03 + 0.01); /* taut: -0.02 > -nu e */
    sheet_stress(&r, &shear.p, stress, &J);
    const double plane = modulus / (1.0 - ratio * ratio);
    check_stress(stress, &shear, plane * (0.1 - 0.02 * ratio), plane * (0.1 * ratio - 0.02), 1e-13 * modulus);
    const sample wrinkled = sample_of(&seed, 0.1, -0.2);
    sheet_stress(&r, &wrinkled.p, stress, &J);
    check_stress(stress, &wrinkled, 0.1 * modulus, 0.0, 1e-13 * modulus);
    const sample slack = sample_of(&seed, -0.01, -0.2);
    sheet_stress(&r, &slack.p, stress, &J);
    for (int c = 0; c < 6; c++) check_close(stress[c], 0.0, 0.0);
    check_close(sheet_energy(&r, &slack.p), 0.0, 0.0);
}

/* With constant volume the energy is a potential: its change is the power of the stress, shear in the plane included, also where the
 * membrane is wrinkled. */
static void check_power(const membrane_model *model, const double *par)
{
    uint64_t seed = 5;
    const double step = 1e-5;
    for (int trial = 0; trial < TRIALS; trial++) {
        const membrane_response r = response(model, par, trial % 2 == 1, SECTION_VOLUME);
        const sample s = sample_of(&seed, check_random(&seed, -0.3, 0.3), check_random(&seed, -0.3, 0.3));
        double stress[6], J, L[9], psi[2], full[9];
        for (int c = 0; c < 9; c++) L[c] = check_random(&seed, -1.0, 1.0);
        sheet_stress(&r, &s.p, stress, &J);
        for (int way = 0; way < 2; way++) {
            sheet_point p = s.p;
            check_true(sheet_stretch(L, way == 0 ? -step : step, &p));
            psi[way] = sheet_energy(&r, &p);
        }
        const int at[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};
        double power = 0.0;
        for (int c = 0; c < 9; c++) full[c] = stress[at[c]];
        for (int c = 0; c < 9; c++) power += full[c] * L[c];
        check_close((psi[1] - psi[0]) / (2.0 * step), power,
                    1e-4 * modulus); /* step * second derivatives at a corner */
    }
}

static void test_any_stretch(void **state)
{
    (void)state;
    on_each(check_any_stretch);
}

static void test_power(void **state)
{
    (void)state;
    on_each(check_power);
}

/* Vectors at the start are unit, across the normal and each other, times the slack. */
static void test_start(void **state)
{
    (void)state;
    uint64_t seed = 6;
    for (int trial = 0; trial < TRIALS; trial++) {
        double m[3][3];
        sheet_point p;
        any_frame(&seed, m);
        sheet_start(m[2], 0.9, &p);
        for (int k = 0; k < 2; k++) {
            check_close(vec_norm(p.a[k]), 0.9, 1e-14);
            check_close(vec_dot(p.a[k], m[2]), 0.0, 1e-14);
        }
        check_close(vec_dot(p.a[0], p.a[1]), 0.0, 1e-14);
    }
}

/* Turned through any planes in turn, from either side of them, a surface keeps its strains, and lies in the last. */
static void test_turn(void **state)
{
    (void)state;
    uint64_t seed = 7;
    sample s = sample_of(&seed, 0.3, -0.1);
    for (int trial = 0; trial < TRIALS; trial++) {
        double m[3][3], strain[2], direction[2][3];
        any_frame(&seed, m);
        double old[3];
        vec_cross(s.p.a[0], s.p.a[1], old);
        vec_normalize(old);
        if (fabs(vec_dot(old, m[2])) < 2e-3) continue; /* left as it is: no way is the shortest */
        sheet_turn(m[2], &s.p);
        for (int k = 0; k < 2; k++) check_close(vec_dot(s.p.a[k], m[2]), 0.0, 1e-13);
        sheet_strain(&s.p, strain, direction);
        check_close(strain[0], 0.3, 1e-12);
        check_close(strain[1], -0.1, 1e-12);
    }
    const sheet_point before = s.p;
    sheet_turn((const double[]){0.0, 0.0, 0.0}, &s.p);
    assert_memory_equal(&before, &s.p, sizeof before);
}

/* A patch that is pulled along its first direction while it tumbles, by the rates of that motion: strain 0.2 along it, none across, to the
 * first order of the step: straight ways of a step lengthen what turns (as they do the ways of the points). */
static double error_of_motion(int steps)
{
    const double rate[3] = {1.1, -0.7, 0.4}, dt = 1.0 / steps;
    double m[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}, strain[2], direction[2][3];
    sheet_point p;
    sheet_start(m[2], 1.0, &p);
    for (int k = 0; k < steps; k++) {
        double L[9], half[3][3];
        const double spin[9] = {0, -rate[2], rate[1], rate[2], 0, -rate[0], -rate[1], rate[0], 0};
        for (int v = 0; v < 3; v++) { /* the frame in the middle and at the end of the step, to high order */
            for (int part = 0; part < 2; part++) {
                double a[3], term[3];
                memcpy(a, m[v], sizeof a);
                memcpy(term, m[v], sizeof term);
                const double way = part == 0 ? 0.5 * dt : dt;
                for (int n = 1; n < 12; n++) {
                    double next[3];
                    for (int i = 0; i < 3; i++) next[i] = way / n * vec_dot(spin + 3 * (ptrdiff_t)i, term);
                    memcpy(term, next, sizeof term);
                    vec_add_scaled(1.0, term, a);
                }
                memcpy(part == 0 ? half[v] : m[v], a, sizeof a);
            }
        }
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) L[3 * i + j] = spin[3 * i + j] + 0.2 * half[0][i] * half[0][j];
        check_true(sheet_stretch(L, dt, &p));
        sheet_turn(m[2], &p);
    }
    sheet_strain(&p, strain, direction);
    check_close(fabs(vec_dot(direction[0], m[0])), 1.0, 0.1 * dt);
    return hypot(strain[0] - 0.2, strain[1]);
}

static void test_motion(void **state)
{
    (void)state;
    const double coarse = error_of_motion(50), fine = error_of_motion(100);
    print_message("strain of a patch that tumbles: error %.2e in 50 steps, %.2e in 100\n", coarse, fine);
    check_true(coarse < 0.05);
    check_true(fine < 0.6 * coarse);
}

/* What is crushed to nothing, or no number, is told. */
static void test_crushed(void **state)
{
    (void)state;
    sheet_point p;
    const double L[9] = {-1.0, 0, 0, 0, 0, 0, 0, 0, 0}, wild[9] = {NAN};
    sheet_start((const double[]){0.0, 0.0, 1.0}, 1.0, &p);
    check_true(!sheet_stretch(L, 1.0, &p));
    sheet_start((const double[]){0.0, 0.0, 1.0}, 1.0, &p);
    check_true(!sheet_stretch(wild, 1.0, &p));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_any_stretch), cmocka_unit_test(test_linear_law), cmocka_unit_test(test_power),
        cmocka_unit_test(test_start),       cmocka_unit_test(test_turn),       cmocka_unit_test(test_motion),
        cmocka_unit_test(test_crushed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
