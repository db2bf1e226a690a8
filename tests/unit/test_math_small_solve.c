/* Dense solves: residuals at round-off for every size, and refusal of what cannot be solved. */
#include "check.h"

#include "math/small_solve.h"

#include <float.h>
#include <string.h>

enum { MAX = SMALL_SOLVE_MAX, TRIALS = 50 };

/* Every |a x - b| within round-off of the sums that make it, times the size. */
static void check_residual(int n, const double *a, const double *x, const double *b, double factor)
{
    for (int i = 0; i < n; i++) {
        double sum = 0.0, size = fabs(b[i]);
        for (int j = 0; j < n; j++) {
            sum += a[i * n + j] * x[j];
            size += fabs(a[i * n + j] * x[j]);
        }
        check_close(sum, b[i], factor * n * DBL_EPSILON * size);
    }
}

/* Diagonally dominant, symmetric, with entries over many orders of magnitude. */
static void random_positive(uint64_t *seed, int n, double *a)
{
    for (int i = 0; i < n; i++) a[i * n + i] = pow(10.0, check_random(seed, -6.0, 0.0));
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < i; j++) {
            const double k = pow(10.0, check_random(seed, -6.0, 6.0));
            a[i * n + j] = a[j * n + i] = -k;
            a[i * n + i] += k;
            a[j * n + j] += k;
        }
    }
}

static void solves_symmetric(void **state)
{
    (void)state;
    uint64_t seed = 11;
    for (int n = 1; n <= MAX; n++) {
        for (int trial = 0; trial < TRIALS; trial++) {
            double a[MAX * MAX], factors[MAX * MAX], b[MAX], x[MAX];
            random_positive(&seed, n, a);
            for (int i = 0; i < n; i++) x[i] = b[i] = check_random(&seed, -1.0, 1.0);
            memcpy(factors, a, sizeof a);
            check_true(small_solve_symmetric(n, factors, x));
            check_residual(n, a, x, b, 4.0);
        }
    }
}

static void symmetric_reads_lower_triangle_only(void **state)
{
    (void)state;
    double a[4] = {4.0, (double)NAN, 2.0, 3.0}, b[2] = {8.0, 7.0};
    check_true(small_solve_symmetric(2, a, b));
    check_close(b[0], 1.25, 4 * DBL_EPSILON);
    check_close(b[1], 1.5, 4 * DBL_EPSILON);
}

static void solves_general(void **state)
{
    (void)state;
    uint64_t seed = 12;
    for (int n = 1; n <= MAX; n++) {
        for (int trial = 0; trial < TRIALS; trial++) {
            double a[MAX * MAX], factors[MAX * MAX], b[MAX], x[MAX];
            for (int k = 0; k < n * n; k++) a[k] = check_random(&seed, -1.0, 1.0);
            for (int i = 0; i < n; i++) x[i] = b[i] = check_random(&seed, -1.0, 1.0);
            memcpy(factors, a, sizeof a);
            check_true(small_solve_general(n, factors, x));
            check_residual(n, a, x, b, 16.0);
        }
    }
}

/* Each of the n unknowns is its right-hand side, in another row: fails without exchanges. */
static void general_exchanges_rows(void **state)
{
    (void)state;
    for (int n = 2; n <= MAX; n++) {
        double a[MAX * MAX] = {0.0}, b[MAX];
        for (int i = 0; i < n; i++) {
            a[i * n + (i + 1) % n] = 1.0;
            b[i] = i;
        }
        check_true(small_solve_general(n, a, b));
        for (int i = 0; i < n; i++) check_close(b[(i + 1) % n], i, 0.0);
    }
}

static void refuses(void **state)
{
    (void)state;
    int pivot[MAX];
    double zero[4] = {0.0}, singular[4] = {1.0, 2.0, 2.0, 4.0}, copy[4] = {1.0, 2.0, 2.0, 4.0};
    double nan[4] = {1.0, 0.0, 0.0, (double)NAN}, infinite[1] = {(double)INFINITY};
    check_true(!small_ldl_factor(2, zero) && !small_lu_factor(2, zero, pivot));
    check_true(!small_ldl_factor(2, singular) && !small_lu_factor(2, copy, pivot));
    check_true(!small_ldl_factor(2, nan) && !small_lu_factor(2, nan, pivot));
    check_true(!small_ldl_factor(1, infinite) && !small_lu_factor(1, infinite, pivot));
    check_true(!small_ldl_factor(0, zero) && !small_lu_factor(0, zero, pivot));
    check_true(!small_ldl_factor(MAX + 1, zero) && !small_lu_factor(MAX + 1, zero, pivot));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solves_symmetric), cmocka_unit_test(symmetric_reads_lower_triangle_only),
        cmocka_unit_test(solves_general),   cmocka_unit_test(general_exchanges_rows),
        cmocka_unit_test(refuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
