/* Every law of the registry of membranes: rest, wave speed, energy, freedom across, one-way response.
 *
 * Parameters: the default where there is one, but 0.3 for a ratio; else 1e6 for a pressure. */
#include "check.h"

#include "material/membrane.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_PAR = 16, TRIALS = 200 };

typedef struct law {
    const membrane_model *model;
    double par[MAX_PAR];
} law;

static void on_each(void (*check)(const law *))
{
    check_true(membrane_registry_size > 0);
    for (size_t i = 0; i < membrane_registry_size; i++) {
        law a = {.model = membrane_registry[i]};
        assert_true(a.model->param_size <= sizeof a.par);
        assert_ptr_equal(membrane_find(a.model->name), a.model);
        assert_true(a.model->doc && a.model->cite && a.model->cite[0]);
        for (size_t k = 0; k < a.model->n_params; k++) {
            const param_spec *p = &a.model->params[k];
            const double x = strcmp(p->unit, "Pa") == 0 ? 1e6 : strstr(p->key, "ratio") ? 0.3 : p->fallback;
            check_true(param_in_range(p, x));
            a.par[p->offset / sizeof(double)] = x;
        }
        check(&a);
    }
    assert_null(membrane_find("no such law"));
}

static membrane_response response(const law *a, bool one_way, membrane_section section)
{
    return (membrane_response){.model = a->model, .par = a->par, .one_way = one_way, .section = section};
}

static void stress_of(const membrane_response *r, double e1, double e2, double s[2])
{
    membrane_stress(r, 1, &e1, &e2, &s[0], &s[1]);
}

static void check_rest(const law *a)
{
    double s[2];
    const membrane_response r = response(a, false, SECTION_THICKNESS);
    stress_of(&r, 0.0, 0.0, s);
    check_close(s[0], 0.0, 0.0);
    check_close(s[1], 0.0, 0.0);
    check_close(membrane_energy(&r, 0.0, 0.0), 0.0, 0.0);
}

/* No slope of a stress at rest, in any direction of strain, is above the modulus that steps are taken by; some slope is half of it. */
static void check_modulus(const law *a)
{
    const membrane_response r = response(a, false, SECTION_THICKNESS);
    const double modulus = a->model->modulus(a->par, true), step = 1e-7, pi = 3.14159265358979;
    double steepest = 0.0;
    for (int k = 0; k < 64; k++) {
        double s[2];
        const double angle = pi * k / 32.0;
        stress_of(&r, step * cos(angle), step * sin(angle), s);
        steepest = fmax(steepest, hypot(s[0], s[1]) / step);
    }
    check_close_relative(steepest, modulus, 2e-3); /* 64 directions: a quarter of (pi / 64)^2 */
    double s[2];
    stress_of(&r, step, 0.0, s);
    check_close_relative(s[0] / step, a->model->modulus(a->par, false), 1e-6);
}

/* The energy's derivative along a single strain is the stress times the volume ratio. */
static void check_energy(const law *a)
{
    uint64_t seed = 5;
    for (int section = SECTION_THICKNESS; section <= SECTION_VOLUME; section++)
        for (int trial = 0; trial < TRIALS; trial++) {
            const membrane_response r = response(a, trial % 2 == 1, (membrane_section)section);
            const double e = check_random(&seed, -0.3, 0.3), step = 1e-4;
            double s[2];
            if (fabs(e) < 2.0 * step) continue; /* one-way laws have their corner there */
            stress_of(&r, e, 0.0, s);
            const double slope =
                (membrane_energy(&r, e + step, 0.0) - membrane_energy(&r, e - step, 0.0)) / (2.0 * step);
            const double J = membrane_volume_ratio(r.section, e, 0.0);
            check_close(slope, J * s[0], 1e-7 * a->model->modulus(a->par, true));
        }
}

static void check_free_across(const law *a)
{
    uint64_t seed = 6;
    const double modulus = a->model->modulus(a->par, true);
    for (int trial = 0; trial < TRIALS; trial++) {
        const double e = check_random(&seed, -0.5, 0.5);
        double s[2];
        const membrane_response r = response(a, false, SECTION_THICKNESS);
        stress_of(&r, e, a->model->free_across(a->par, e), s);
        check_close(s[1], 0.0, 1e-14 * modulus);
        membrane_response free = r;
        free.free_across = true;
        double t[2];
        stress_of(&free, e, 0.123, t); /* whatever the strain across */
        check_close(t[0], s[0], 1e-14 * modulus);
        check_close(t[1], 0.0, 0.0);
    }
}

/* No compression; as the two-way law where that pulls in both directions; nothing where no strain is positive; never more than
 * the two-way law pulls; continuous. */
static void check_one_way(const law *a)
{
    uint64_t seed = 7;
    const membrane_response two = response(a, false, SECTION_THICKNESS), one = response(a, true, SECTION_THICKNESS);
    const double modulus = a->model->modulus(a->par, true), step = 1e-9;
    for (int trial = 0; trial < 20 * TRIALS; trial++) {
        const double e1 = check_random(&seed, -0.2, 0.2), e2 = check_random(&seed, -0.2, 0.2);
        double s[2], t[2], near[2];
        stress_of(&one, e1, e2, s);
        stress_of(&two, e1, e2, t);
        check_true(s[0] >= 0.0 && s[1] >= 0.0);
        if (t[0] >= 0.0 && t[1] >= 0.0) {
            check_close(s[0], t[0], 0.0);
            check_close(s[1], t[1], 0.0);
        }
        if (e1 <= 0.0 && e2 <= 0.0) {
            check_close(s[0], 0.0, 0.0);
            check_close(s[1], 0.0, 0.0);
        }
        stress_of(&one, e1 + step, e2 - step, near);
        check_close(near[0], s[0], 3.0 * modulus * step);
        check_close(near[1], s[1], 3.0 * modulus * step);
        check_true(membrane_energy(&one, e1, e2) >= 0.0);
    }
}

static void test_rest(void **state)
{
    (void)state;
    on_each(check_rest);
}

static void test_modulus(void **state)
{
    (void)state;
    on_each(check_modulus);
}

static void test_energy(void **state)
{
    (void)state;
    on_each(check_energy);
}

static void test_free_across(void **state)
{
    (void)state;
    on_each(check_free_across);
}

static void test_one_way(void **state)
{
    (void)state;
    on_each(check_one_way);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rest),        cmocka_unit_test(test_modulus), cmocka_unit_test(test_energy),
        cmocka_unit_test(test_free_across), cmocka_unit_test(test_one_way),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
