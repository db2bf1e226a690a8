#include "solve/chain.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

floe_status chain_create(chain_matrix **out, context *ctx, size_t n, bool closed)
{
    TRY(memory_new(ctx, out, 1, sizeof **out));
    chain_matrix *m = *out;
    *m = (chain_matrix){.ctx = ctx, .n = n, .closed = closed};
    TRY(memory_new(ctx, &m->own, n, sizeof *m->own));
    TRY(memory_new(ctx, &m->next, n, sizeof *m->next));
    TRY(memory_new(ctx, &m->inverse, n, sizeof *m->inverse));
    for (int c = 0; c < 4; ++c) TRY(memory_new(ctx, &m->column[c], 2 * n, sizeof(double)));
    return FLOE_OK;
}

void chain_destroy(chain_matrix **m)
{
    if (!m || !*m) return;
    context *ctx = (*m)->ctx;
    memory_free(ctx, &(*m)->own);
    memory_free(ctx, &(*m)->next);
    memory_free(ctx, &(*m)->inverse);
    for (int c = 0; c < 4; ++c) memory_free(ctx, &(*m)->column[c]);
    memory_free(ctx, m);
}

void chain_clear(chain_matrix *m)
{
    memset(m->own, 0, m->n * sizeof *m->own);
    memset(m->next, 0, m->n * sizeof *m->next);
}

static bool invert_chain_block(const double a[4], double out[4])
{
    const double det = a[0] * a[3] - a[1] * a[2];
    if (!(det > 0.0) || !(a[0] > 0.0)) return false;
    out[0] = a[3] / det;
    out[1] = -a[1] / det;
    out[2] = -a[2] / det;
    out[3] = a[0] / det;
    return true;
}

/* y -= A x, or A^T x */
static void subtract_product(const double a[4], bool turned, const double x[2], double y[2])
{
    y[0] -= a[0] * x[0] + a[turned ? 2 : 1] * x[1];
    y[1] -= a[turned ? 1 : 2] * x[0] + a[3] * x[1];
}

static void multiply_block(const double a[4], const double x[2], double y[2])
{
    y[0] = a[0] * x[0] + a[1] * x[1];
    y[1] = a[2] * x[0] + a[3] * x[1];
}

/* Pivots of the points from `first` on: D_i - E^T D^-1 E of the one before. */
static bool eliminate_points(chain_matrix *m, size_t first)
{
    for (size_t i = first; i < m->n; ++i) {
        double pivot[4];
        memcpy(pivot, m->own[i], sizeof pivot);
        if (i > first)
            for (int c = 0; c < 2; ++c) {
                const double column[2] = {m->next[i - 1][c], m->next[i - 1][2 + c]};
                double x[2], y[2] = {0.0, 0.0};
                multiply_block(m->inverse[i - 1], column, x);
                subtract_product(m->next[i - 1], true, x, y);
                pivot[c] += y[0];
                pivot[2 + c] += y[1];
            }
        if (!invert_chain_block(pivot, m->inverse[i])) return false;
    }
    return true;
}

/* Solves for the points from `first` on, in place. */
static void substitute_back(const chain_matrix *m, size_t first, double *x)
{
    for (size_t i = first + 1; i < m->n; ++i) {
        double y[2];
        multiply_block(m->inverse[i - 1], x + 2 * (i - 1), y);
        subtract_product(m->next[i - 1], true, y, x + 2 * i);
    }
    for (size_t i = m->n; i-- > first;) {
        double y[2];
        if (i + 1 < m->n) subtract_product(m->next[i], false, x + 2 * (i + 1), x + 2 * i);
        multiply_block(m->inverse[i], x + 2 * i, y);
        memcpy(x + 2 * i, y, sizeof y);
    }
}

/* Where the chain is closed its first point is left out of the elimination: what it sees of the others, by its two
 * components, is in columns 2 and 3, and the inverse of what remains of itself in `inverse[0]`. */
static bool close_ring(chain_matrix *m)
{
    const size_t last = m->n - 1;
    double own[4];
    memcpy(own, m->own[0], sizeof own);
    for (int c = 0; c < 2; ++c) {
        double *x = m->column[2 + c];
        memset(x, 0, 2 * m->n * sizeof *x);
        for (int r = 0; r < 2; ++r) {
            x[2 + r] += m->next[0][2 * c + r];
            x[2 * last + (size_t)r] += m->next[last][2 * r + c];
        }
        substitute_back(m, 1, x);
        double y[2] = {0.0, 0.0};
        subtract_product(m->next[0], false, x + 2, y);
        subtract_product(m->next[last], true, x + 2 * last, y);
        own[c] += y[0];
        own[2 + c] += y[1];
    }
    return invert_chain_block(own, m->inverse[0]);
}

static void solve_plain(const chain_matrix *m, double *x)
{
    const size_t last = m->n - 1;
    if (!m->closed) {
        substitute_back(m, 0, x);
        return;
    }
    double rest[2] = {x[0], x[1]}, first[2];
    substitute_back(m, 1, x);
    subtract_product(m->next[0], false, x + 2, rest);
    subtract_product(m->next[last], true, x + 2 * last, rest);
    multiply_block(m->inverse[0], rest, first);
    for (size_t k = 2; k < 2 * m->n; ++k) x[k] -= m->column[2][k] * first[0] + m->column[3][k] * first[1];
    memcpy(x, first, sizeof first);
}

static double dot_of_chain(size_t n, const double *x, const double *y)
{
    double sum = 0.0;
    for (size_t k = 0; k < n; ++k) sum += x[k] * y[k];
    return sum;
}

floe_status chain_solve(chain_matrix *m, double k, const double *g, const double *b, double *x)
{
    const size_t n = 2 * m->n;
    double *z = m->column[0];
    if (!eliminate_points(m, m->closed ? 1 : 0) || (m->closed && !close_ring(m)))
        return fail(m->ctx, FLOE_RETRY, "the matrix of a chain of %zu points is not positive definite", m->n);
    memcpy(x, b, n * sizeof *x);
    solve_plain(m, x);
    if (k == 0.0) return FLOE_OK;
    memcpy(z, g, n * sizeof *z);
    solve_plain(m, z);
    const double share = k * dot_of_chain(n, g, x) / (1.0 + k * dot_of_chain(n, g, z));
    for (size_t i = 0; i < n; ++i) x[i] -= share * z[i];
    return FLOE_OK;
}
