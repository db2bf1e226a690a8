#include "solve/minres.h"

#include <math.h>
#include <string.h>

enum { LANES = 8 }; /* partial sums that are kept apart, so that the loop vectorises without reordering any addition */

struct minres {
    context *ctx;
    int most_iterations;
    size_t n, reserved;
    double *v, *y, *older, *old;                   /* Lanczos vectors, before and after the preconditioner; owned */
    double *direction, *direction_1, *direction_2; /* of search, of this iteration and of the two before; owned */
};

enum { ARRAYS = 7 };

static void arrays_of(minres *m, double **array[ARRAYS])
{
    double **all[ARRAYS] = {&m->v, &m->y, &m->older, &m->old, &m->direction, &m->direction_1, &m->direction_2};
    memcpy(array, all, sizeof all);
}

floe_status minres_create(minres **out, context *ctx, int most_iterations)
{
    TRY(memory_new(ctx, out, 1, sizeof **out));
    **out = (minres){.ctx = ctx, .most_iterations = most_iterations};
    return FLOE_OK;
}

void minres_destroy(minres **m)
{
    if (!m || !*m) return;
    double **array[ARRAYS];
    arrays_of(*m, array);
    for (int k = 0; k < ARRAYS; ++k) memory_free((*m)->ctx, array[k]);
    memory_free((*m)->ctx, m);
}

floe_status minres_resize(minres *m, size_t n)
{
    double **array[ARRAYS];
    m->n = n;
    if (n <= m->reserved) return FLOE_OK;
    arrays_of(m, array);
    for (int k = 0; k < ARRAYS; ++k) TRY(memory_resize(m->ctx, array[k], n, sizeof(double)));
    m->reserved = n;
    return FLOE_OK;
}

static double dot_of_lanes(size_t n, const double *restrict x, const double *restrict y)
{
    double lane[LANES] = {0.0}, sum = 0.0;
    size_t k = 0;
    for (; k + LANES <= n; k += LANES)
        for (size_t l = 0; l < LANES; ++l) lane[l] += x[k + l] * y[k + l];
    for (; k < n; ++k) sum += x[k] * y[k];
    for (int l = 0; l < LANES; ++l) sum += lane[l];
    return sum;
}

static void add_scaled(size_t n, double a, const double *restrict x, double *restrict y)
{
    for (size_t k = 0; k < n; ++k) y[k] += a * x[k];
}

static void swap_arrays(double **a, double **b)
{
    double *kept = *a;
    *a = *b;
    *b = kept;
}

/* The next Lanczos vector, from y = B old of length `beta`: y becomes B of it, and `alfa` the diagonal entry. Returns the square of its length. */
static double extend_basis(minres *m, const minres_system *s, double beta, double beta_before, double *alfa)
{
    for (size_t k = 0; k < m->n; ++k) m->v[k] = m->y[k] / beta;
    s->matrix(s->user, m->v, m->y);
    if (beta_before > 0.0) add_scaled(m->n, -beta / beta_before, m->older, m->y);
    *alfa = dot_of_lanes(m->n, m->v, m->y);
    add_scaled(m->n, -*alfa / beta, m->old, m->y);
    swap_arrays(&m->older, &m->old);
    swap_arrays(&m->old, &m->y);
    s->preconditioner(s->user, m->old, m->y);
    return dot_of_lanes(m->n, m->old, m->y);
}

/* The rotation that the factors of the tridiagonal matrix have come to. */
typedef struct rotation {
    double cosine, sine, corner, far; /* corner: the entry that the next rotation turns; far: two above the diagonal */
} rotation;

/* Turns the next column, and takes the step along its direction; returns the share of the residual that is left. */
static double take_step(minres *m, rotation *r, double alfa, double beta, double residual, double *x)
{
    const double far = r->far, above = r->cosine * r->corner + r->sine * alfa;
    const double own = r->sine * r->corner - r->cosine * alfa, length = hypot(own, beta);
    r->far = r->sine * beta;
    r->corner = -r->cosine * beta;
    if (!(length > 0.0)) return residual;
    r->cosine = own / length;
    r->sine = beta / length;
    swap_arrays(&m->direction_1, &m->direction_2);
    swap_arrays(&m->direction_1, &m->direction);
    for (size_t k = 0; k < m->n; ++k)
        m->direction[k] = (m->v[k] - far * m->direction_2[k] - above * m->direction_1[k]) / length;
    add_scaled(m->n, r->cosine * residual, m->direction, x);
    return r->sine * residual;
}

minres_result minres_solve(minres *m, const minres_system *s, double tolerance, const double *b, double *x)
{
    minres_result out = {0};
    const size_t bytes = m->n * sizeof(double);
    memset(x, 0, bytes);
    memset(m->direction, 0, bytes);
    memset(m->direction_1, 0, bytes);
    memset(m->direction_2, 0, bytes);
    memset(m->older, 0, bytes);
    memcpy(m->old, b, bytes);
    s->preconditioner(s->user, m->old, m->y);
    double square = dot_of_lanes(m->n, m->old, m->y), before = 0.0;
    double beta = sqrt(fmax(0.0, square)), left = beta;
    const double all = beta;
    rotation r = {.cosine = -1.0};
    while (left > tolerance * all && beta > 0.0 && out.iterations < m->most_iterations) {
        double alfa;
        square = extend_basis(m, s, beta, before, &alfa);
        const double next = sqrt(fmax(0.0, square));
        left = take_step(m, &r, alfa, next, left, x);
        before = beta;
        beta = next;
        out.iterations++;
    }
    out.residual = all > 0.0 ? left / all : 0.0;
    out.definite = square >= 0.0;
    out.converged = out.definite && left <= tolerance * all;
    return out;
}
