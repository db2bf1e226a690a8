/* Chains of points, open and closed, against the product with their matrix. */
#include "check.h"

#include "solve/chain.h"

#include <math.h>

enum { N = 7 };

static double entry(int k)
{
    return sin(12.9898 * k + 1.0);
}

static void fill(chain_matrix *m)
{
    chain_clear(m);
    for (int i = 0; i < N; ++i) {
        m->own[i][0] = 5.0 + entry(i);
        m->own[i][3] = 6.0 + entry(20 + i);
        m->own[i][1] = m->own[i][2] = entry(40 + i);
        for (int c = 0; c < 4 && (m->closed || i + 1 < N); ++c) m->next[i][c] = entry(60 + 4 * i + c);
    }
}

/* (A + k g g^T) x */
static void product(const chain_matrix *m, double k, const double *g, const double *x, double *y)
{
    double along = 0.0;
    for (int i = 0; i < 2 * N; ++i) along += g[i] * x[i];
    for (int i = 0; i < 2 * N; ++i) y[i] = k * along * g[i];
    for (int i = 0; i < N; ++i) {
        const int to = (i + 1) % N;
        for (int r = 0; r < 2; ++r)
            for (int c = 0; c < 2; ++c) {
                y[2 * i + r] += m->own[i][2 * r + c] * x[2 * i + c] + m->next[i][2 * r + c] * x[2 * to + c];
                y[2 * to + c] += m->next[i][2 * r + c] * x[2 * i + r];
            }
    }
}

static void solves(void **unused)
{
    (void)unused;
    for (int closed = 0; closed < 2; ++closed)
        for (int k = 0; k < 2; ++k) {
            context *ctx = context_create();
            chain_matrix *m;
            double g[2 * N], b[2 * N], x[2 * N], y[2 * N];
            check_ok(ctx, chain_create(&m, ctx, N, closed));
            fill(m);
            for (int i = 0; i < 2 * N; ++i) {
                g[i] = entry(100 + i);
                b[i] = entry(200 + i);
            }
            check_ok(ctx, chain_solve(m, 30.0 * k, g, b, x));
            product(m, 30.0 * k, g, x, y);
            for (int i = 0; i < 2 * N; ++i) check_close(y[i], b[i], 1e-13);
            m->own[3][0] = -1.0;
            check_fails(ctx, chain_solve(m, 0.0, g, b, x), FLOE_RETRY);
            chain_destroy(&m);
            context_destroy(&ctx);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(solves)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
