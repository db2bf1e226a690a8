/* Every basis of the registry, by name of none: partition of unity, linear fields, derivatives against differences, positivity,
 * smoothness; and the same once nodes beyond a wall are folded into the mesh (theory 4.3). */
#include "check.h"

#include "mpm/basis/basis.h"

#include <math.h>

enum { SAMPLES = 2000, NODES = 8 };

static const double h = 0.25; /* m */

/* Weights at x in cells, spread over NODES nodes of which the first is node -2. */
typedef struct spread {
    double w[NODES], dw[NODES];
} spread;

static spread spread_at(const basis_model *b, double x, double half)
{
    spread s = {{0.0}, {0.0}};
    double w[BASIS_MAX_SUPPORT], dw[BASIS_MAX_SUPPORT];
    const double cell = floor(x);
    const int first = b->weights(x - cell, half, 1.0 / h, w, dw) + (int)cell + 2;
    assert_in_range(first, 0, NODES - b->support);
    for (int k = 0; k < b->support; ++k) {
        s.w[first + k] = w[k];
        s.dw[first + k] = dw[k];
    }
    return s;
}

/* Folds node -1 into nodes 0 and 1, as u_-1 = 2 u_0 - u_1 implies. */
static spread folded_at(const basis_model *b, double x, double half)
{
    spread s = spread_at(b, x, half);
    s.w[2] += 2.0 * s.w[1];
    s.w[3] -= s.w[1];
    s.dw[2] += 2.0 * s.dw[1];
    s.dw[3] -= s.dw[1];
    s.w[1] = s.dw[1] = 0.0;
    return s;
}

/* Sums to one, reproduces x, never negative; eps is round-off of a few operations. */
static void check_sums(const spread *s, double x)
{
    double one = 0.0, place = 0.0, zero = 0.0, slope = 0.0;
    for (int k = 0; k < NODES; ++k) {
        check_true(s->w[k] >= -1e-16);
        one += s->w[k];
        place += s->w[k] * (k - 2);
        zero += s->dw[k];
        slope += s->dw[k] * (k - 2) * h;
    }
    check_close(one, 1.0, 4e-15);
    check_close(place, x, 2e-14);
    check_close(zero, 0.0, 1e-13);
    check_close(slope, 1.0, 2e-14);
}

static void test_sums(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (size_t i = 0; i < basis_registry_size; ++i)
        for (int n = 0; n < SAMPLES; ++n) {
            const double x = check_random(&seed, 0.0, 3.0), half = check_random(&seed, 0.02, 0.5);
            const spread s = spread_at(basis_registry[i], x, half);
            check_sums(&s, x);
        }
}

static void test_wall(void **state)
{
    (void)state;
    uint64_t seed = 2;
    for (size_t i = 0; i < basis_registry_size; ++i) {
        const basis_model *b = basis_registry[i];
        assert_in_range(b->reach, 0, 1);
        for (int n = 0; n < SAMPLES; ++n) {
            const double x = check_random(&seed, 0.0, 3.0), half = check_random(&seed, 0.02, 0.5);
            const spread s = folded_at(b, x, half);
            check_sums(&s, x);
        }
        const spread wall = folded_at(b, 0.0, 0.3);
        check_close(wall.w[2], 1.0, 4e-16); /* interpolates at the wall */
        check_close(wall.w[3], 0.0, 4e-16);
    }
}

/* Weights and slopes that are means over a domain: of the hats at its ends, and of the slope between them. */
static void check_average(const basis_model *b, double x, double half)
{
    const basis_model *linear = basis_find("linear");
    const spread s = spread_at(b, x, half), above = spread_at(linear, x + half, half),
                 below = spread_at(linear, x - half, half);
    for (int k = 0; k < NODES; ++k) {
        check_close(s.w[k], 0.5 * (above.w[k] + below.w[k]), 4e-16);
        check_close(s.dw[k] * h, (above.w[k] - below.w[k]) / (2.0 * half), 1e-14);
    }
}

/* Central differences of a piecewise quadratic: exact but for round-off, except across a knot. */
static void test_derivatives(void **state)
{
    (void)state;
    const double step = 1e-6;
    uint64_t seed = 3;
    for (size_t i = 0; i < basis_registry_size; ++i)
        for (int n = 0; n < SAMPLES; ++n) {
            const double x = check_random(&seed, 0.01, 2.99), half = 0.3;
            if (basis_registry[i]->averaged) {
                check_average(basis_registry[i], x, half);
                continue;
            }
            double knot = INFINITY; /* GIMP's lie at half of its domain from the nodes, the splines' at half a cell */
            const double knots[] = {0.0, 0.5, half, 1.0 - half, 1.0};
            for (int k = 0; k < 5; ++k) knot = fmin(knot, fabs(x - floor(x) - knots[k]));
            if (knot < 2.0 * step) continue;
            const spread s = spread_at(basis_registry[i], x, half);
            const spread above = spread_at(basis_registry[i], x + step, half);
            const spread below = spread_at(basis_registry[i], x - step, half);
            for (int k = 0; k < NODES; ++k) check_close(s.dw[k] * h, (above.w[k] - below.w[k]) / (2.0 * step), 1e-9);
        }
}

/* Jumps of the weights and of their slopes over the whole support. */
static void test_smoothness(void **state)
{
    (void)state;
    const double step = 1e-9;
    for (size_t i = 0; i < basis_registry_size; ++i) {
        const basis_model *b = basis_registry[i];
        double jump = 0.0, slope_jump = 0.0;
        for (int n = 1; n < 60; ++n) { /* multiples of a twentieth: every knot is one of them */
            const double x = n / 20.0;
            const spread above = spread_at(b, x + step, 0.25), below = spread_at(b, x - step, 0.25);
            for (int k = 0; k < NODES; ++k) {
                jump = fmax(jump, fabs(above.w[k] - below.w[k]));
                slope_jump = fmax(slope_jump, h * fabs(above.dw[k] - below.dw[k]));
            }
        }
        check_true(jump < 1e-8);
        check_true(b->smoothness > 0 ? slope_jump < 1e-7 : slope_jump > 0.5);
    }
}

static void test_registry(void **state)
{
    (void)state;
    for (size_t i = 0; i < basis_registry_size; ++i) {
        const basis_model *b = basis_registry[i];
        assert_ptr_equal(basis_find(b->name), b);
        check_true(b->doc[0] != '\0' && b->cite[0] != '\0');
        check_true(b->support <= BASIS_MAX_SUPPORT);
    }
    assert_null(basis_find("cubism"));
}

/* Integral of r^power times a node's weight over [0, end] cells, by Simpson's rule between the knots. */
static double integral_of(const basis_model *b, int node, int power, int end)
{
    double sum = 0.0;
    for (int k = 0; k < 2 * end; ++k)
        for (int n = 0; n <= 20; ++n) {
            const double x = fmin(0.5 * k + 0.025 * n, 0.5 * (k + 1) - 1e-13);
            const double rule = n == 0 || n == 20 ? 1.0 : n % 2 ? 4.0 : 2.0;
            sum += rule * 0.025 / 3.0 * pow(x, power) * spread_at(b, x, 0.5).w[node + 2];
        }
    return sum;
}

/* What a descriptor says of shares beyond a side and about the axis are integrals of its weights. Boxes of points vary, and have those of
 * the hats that they are means of. */
static void test_facts(void **state)
{
    (void)state;
    for (size_t i = 0; i < basis_registry_size; ++i) {
        const basis_model *b = basis_registry[i], *of = b->fact.sized ? basis_find("linear") : b;
        check_close(b->fact.ghost_share, integral_of(of, -1, 0, 1), 1e-7);
        check_close(b->fact.axis_moment, integral_of(of, 0, 1, 2), 1e-7);
        assert_in_range(b->fact.edge_taps, 3, 5);
        check_true(b->fact.least_mass > 0.0 && b->fact.least_mass < 1e-6);
        check_true(b->fact.sized || !b->fact.shaped);
        check_true(b->fact.usl_share > 0.0 && b->fact.usl_share <= 1.0);
        check_true(b->fact.carried_share >= b->fact.usl_share && b->fact.carried_share <= 1.0);
        for (int k = 0; k < 4; ++k) {
            check_true(b->fact.restored_share[k] > 0.0);
            check_true(b->fact.restored_share[k] <= (k > 0 ? b->fact.restored_share[k - 1] : b->fact.carried_share));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_registry), cmocka_unit_test(test_sums),        cmocka_unit_test(test_facts),
        cmocka_unit_test(test_wall),     cmocka_unit_test(test_derivatives), cmocka_unit_test(test_smoothness),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
