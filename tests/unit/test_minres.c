/* Minimal residuals of a small system that is neither positive nor negative: -1, 2, -3, 4 ... along the diagonal, and 1 beside it. */
#include "check.h"

#include "solve/minres.h"

#include <math.h>

enum { N = 21 };

static double diagonal(size_t k)
{
    return (k % 2 ? 1.0 : -1.0) * (double)(k + 1);
}

static void multiply(void *user, double *x, double *y)
{
    (void)user;
    for (size_t k = 0; k < N; ++k) y[k] = diagonal(k) * x[k] + (k > 0 ? x[k - 1] : 0.0) + (k + 1 < N ? x[k + 1] : 0.0);
}

static void precondition(void *user, double *x, double *y)
{
    const double *sign = user;
    for (size_t k = 0; k < N; ++k) y[k] = x[k] / fabs(diagonal(k)) * (k == N / 2 ? *sign : 1.0);
}

static minres_result solve(double sign, double *error)
{
    context *ctx = context_create();
    minres *m = NULL;
    double x[N], exact[N], b[N];
    for (size_t k = 0; k < N; ++k) exact[k] = 1.0 + 0.3 * sin((double)k);
    multiply(NULL, exact, b);
    check_ok(ctx, minres_create(&m, ctx, 200));
    check_ok(ctx, minres_resize(m, N));
    const minres_system system = {multiply, precondition, &sign};
    const minres_result r = minres_solve(m, &system, 1e-13, b, x);
    *error = 0.0;
    for (size_t k = 0; k < N; ++k) *error = fmax(*error, fabs(x[k] - exact[k]));
    minres_destroy(&m);
    context_destroy(&ctx);
    return r;
}

static void an_indefinite_system_is_solved(void **unused)
{
    (void)unused;
    double error;
    const minres_result r = solve(1.0, &error);
    check_true(r.converged && r.definite);
    check_true(r.iterations <= N + 2); /* as many as there are unknowns, but for round-off */
    check_true(error <= 2e-11);
}

static void an_indefinite_preconditioner_is_said(void **unused)
{
    (void)unused;
    double error;
    const minres_result r = solve(-1.0, &error);
    check_true(!r.converged && !r.definite);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_indefinite_system_is_solved),
        cmocka_unit_test(an_indefinite_preconditioner_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
