/* What a quantity without an exact solution is said to be off by, on sequences f = 1 + c h^p whose limit and order are known. */
#include "check.h"

#include "study/tolerance/tolerance.h"

#include <math.h>
#include <string.h>

static void sequence(double *h, double *f, size_t n, double ratio, double c, double p)
{
    for (size_t k = 0; k < n; ++k) {
        h[k] = 0.8 * pow(ratio, -(double)k);
        f[k] = 1.0 + c * pow(h[k], p);
    }
}

/* One value says nothing, nor does a last value of 0; two say three times what a method of first order has left. */
static void too_few(void **state)
{
    (void)state;
    double h[2], f[2];
    for (double ratio = 1.5; ratio < 5.0; ratio *= 2.0) {
        sequence(h, f, 2, ratio, 0.3, 1.0);
        const tolerance_estimate e = tolerance_estimate_of(2, h, f);
        check_close(e.relative, 3.0 * (f[1] - 1.0) / f[1], 1e-14);
        check_true(!e.sure && isnan(e.order));
    }
    check_true(isnan(tolerance_estimate_of(1, h, f).relative));
    f[1] = 0.0;
    check_true(isnan(tolerance_estimate_of(2, h, f).relative));
}

/* Four values of one order: 1.25 times the error; slower than 0.5: three times, by that order. Three cannot agree on one: three times, with an
 * order of one at most. */
static void of_one_order(void **state)
{
    (void)state;
    static const double order[] = {0.25, 0.45, 0.55, 1.0, 1.5, 2.0};
    double h[4], f[4];
    for (size_t k = 0; k < sizeof order / sizeof *order; ++k)
        for (int sign = -1; sign <= 1; sign += 2) {
            const double p = order[k];
            sequence(h, f, 4, 2.0, 1e-3 * sign, p);
            const tolerance_estimate e = tolerance_estimate_of(4, h, f);
            const double error = fabs(f[3] - 1.0) / fabs(f[3]);
            check_true(e.sure);
            check_close(e.order, p, 1e-8);
            check_close(e.relative, (p < 0.5 ? 3.0 : 1.25) * error, 1e-8 * error);
        }
}

/* Faster than the methods are, or turning round: twice the span of the last three; a next value like the last would be off by twice the last step. */
static void of_no_order(void **state)
{
    (void)state;
    static const double turns[3][3] = {{1.0, 1.2, 1.1}, {1.2, 1.0, 1.1}, {5.0, 1.3, 1.31}};
    static const double span[] = {0.2, 0.2, 3.7}, step[] = {0.1, 0.1, 0.01};
    double h[4], f[4];
    for (int k = 0; k < 3; ++k) {
        sequence(h, f, 3, 2.0, 1.0, 1.0);
        const tolerance_estimate e = tolerance_estimate_of(3, h, turns[k]);
        check_close(e.relative, 2.0 * span[k] / turns[k][2], 1e-14);
        check_close(e.settled, 2.0 * step[k] / turns[k][2], 1e-14);
    }
    sequence(h, f, 4, 2.0, 0.1, 3.0);
    const tolerance_estimate e = tolerance_estimate_of(4, h, f);
    check_close(e.relative, 2.0 * (f[1] - f[3]) / f[3], 1e-14);
    check_true(e.sure);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(too_few),
        cmocka_unit_test(of_one_order),
        cmocka_unit_test(of_no_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
