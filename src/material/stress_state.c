/* Plane and uniaxial stress: any law, run with the free stretches for which the free stresses vanish.
 *
 * The unknown x of a free axis is the logarithm of the stretch that it adds to the step: its row of F and J grow by
 * exp(x), its L by x/dt. Each point is solved by Broyden's method (in plane stress, one unknown: the secant method),
 * started from the law's moduli at rest, so that a law that is linear in the step takes one correction. A point that
 * has converged keeps its x while the rest of the batch goes on: its bits do not depend on its neighbours. */
#include "material/solid.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { MAX_ITERATIONS = 60, MAX_FREE = 2 };

static const double LARGEST_STEP = 0.5; /* in x: the guard against a wild secant */

typedef struct free_axes {
    int n;
    int axis[MAX_FREE]; /* also the index of its normal stress */
} free_axes;

static free_axes free_axes_of(stress_state state)
{
    if (state == STRESS_PLANE) return (free_axes){.n = 1, .axis = {2, 0}};
    if (state == STRESS_UNIAXIAL) return (free_axes){.n = 2, .axis = {1, 2}};
    return (free_axes){.n = 0};
}

/* The unknowns of one batch. */
typedef struct free_solve {
    double x[MAX_FREE][SOLID_CHUNK];
    double step[MAX_FREE][SOLID_CHUNK];
    double residual[MAX_FREE][SOLID_CHUNK];          /* Pa: the free stresses */
    double inverse[MAX_FREE][MAX_FREE][SOLID_CHUNK]; /* of d residual / d x, 1/Pa */
    bool done[SOLID_CHUNK];
    double longitudinal; /* K + 4 G / 3 at rest, Pa */
} free_solve;

static void solve_start(free_solve *s, const free_axes *f, size_t n, double K, double G)
{
    const double m = K + 4.0 / 3.0 * G, l = K - 2.0 / 3.0 * G;
    const double own = f->n == 1 ? 1.0 / m : m / (m * m - l * l);
    const double other = f->n == 1 ? 0.0 : -l / (m * m - l * l);
    memset(s, 0, sizeof *s);
    s->longitudinal = m;
    for (int r = 0; r < MAX_FREE; r++) {
        for (int c = 0; c < MAX_FREE; c++) {
            for (size_t i = 0; i < n; i++) s->inverse[r][c][i] = r == c ? own : other;
        }
    }
}

/* What solve_apply puts back, and what stands before it: a law pays for the rows of history that it has. */
static void copy_batch(const solid_model *model, const solid_batch *from, solid_batch *to)
{
    memcpy(to, from, offsetof(solid_batch, history) + (size_t)model->n_history * sizeof *from->history);
}

/* Puts the trial stretches into the batch, which is otherwise put back to `start`. */
static void solve_apply(const free_solve *s, const free_axes *f, const solid_model *model, const solid_batch *start,
                        solid_batch *b)
{
    const double over_dt = b->dt > 0.0 ? 1.0 / b->dt : 0.0;
    memcpy(b->stress, start->stress, sizeof b->stress);
    memcpy(b->energy, start->energy, sizeof b->energy);
    memcpy(b->history, start->history, (size_t)model->n_history * sizeof *b->history);
    memcpy(b->J, start->J, sizeof b->J);
    for (int k = 0; k < f->n; k++) {
        const int axis = f->axis[k];
        for (size_t i = 0; i < b->n; i++) {
            const double growth = exp(s->x[k][i]);
            b->L[4 * axis][i] = start->L[4 * axis][i] + s->x[k][i] * over_dt;
            b->J[i] *= growth;
            for (int c = 0; c < 3; c++) b->F[3 * axis + c][i] = start->F[3 * axis + c][i] * growth;
        }
    }
}

/* Inverse Broyden update: H += (s - H y)(s^T H)/(s^T H y), for the step s that changed the residual by y. */
static void broyden_update(free_solve *s, const free_axes *f, const double y[MAX_FREE], size_t i)
{
    double hy[MAX_FREE] = {0.0}, sh[MAX_FREE] = {0.0}, shy = 0.0;
    for (int r = 0; r < f->n; r++) {
        for (int c = 0; c < f->n; c++) {
            hy[r] += s->inverse[r][c][i] * y[c];
            sh[c] += s->step[r][i] * s->inverse[r][c][i];
        }
    }
    double s2 = 0.0;
    for (int r = 0; r < f->n; r++) {
        shy += s->step[r][i] * hy[r];
        s2 += s->step[r][i] * s->step[r][i];
    }
    if (!(fabs(shy) > 1e-3 * s2)) return; /* a secant too flat or reversed tells nothing: keep the slope */
    for (int r = 0; r < f->n; r++) {
        for (int c = 0; c < f->n; c++) s->inverse[r][c][i] += (s->step[r][i] - hy[r]) * sh[c] / shy;
    }
}

/* What round-off in the law allows: stresses are differences of terms of the size of the modulus. */
static double free_stress_tolerance(const free_solve *s, const solid_batch *b, size_t i)
{
    double largest = s->longitudinal;
    for (int k = 0; k < 6; k++) largest = fmax(largest, fabs(b->stress[k][i]));
    return 64.0 * DBL_EPSILON * largest;
}

static void next_step(free_solve *s, const free_axes *f, size_t i)
{
    double largest = 0.0;
    for (int r = 0; r < f->n; r++) {
        double step = 0.0;
        for (int c = 0; c < f->n; c++) step -= s->inverse[r][c][i] * s->residual[c][i];
        s->step[r][i] = step;
        largest = fmax(largest, fabs(step));
    }
    const double scale = largest > LARGEST_STEP ? LARGEST_STEP / largest : 1.0;
    for (int r = 0; r < f->n; r++) {
        s->step[r][i] *= scale;
        s->x[r][i] += s->step[r][i];
    }
}

/* Takes the stresses of the trial in; moves the points that need it. Returns 0 when all are done, else 1 + the first
 * that is not. The first trial is never taken as it is, or the free stress of many small steps would add up to the
 * tolerance. */
static size_t solve_advance(free_solve *s, const free_axes *f, const solid_batch *b, bool first)
{
    size_t open = 0;
    for (size_t i = 0; i < b->n; i++) {
        if (s->done[i]) continue;
        double change[MAX_FREE] = {0.0}, largest = 0.0;
        bool number = true;
        for (int k = 0; k < f->n; k++) {
            const double residual = b->stress[f->axis[k]][i];
            change[k] = residual - s->residual[k][i];
            s->residual[k][i] = residual;
            largest = fmax(largest, fabs(residual));
            number = number && isfinite(residual);
        }
        s->done[i] = !first && number && largest <= free_stress_tolerance(s, b, i);
        if (s->done[i]) continue;
        if (open == 0) open = i + 1;
        if (!number) continue; /* x stays, so that the point ends as the one that fails */
        if (!first) broyden_update(s, f, change, i);
        next_step(s, f, i);
    }
    return open;
}

size_t solid_stress_state(const solid_model *model, const void *par, double p_ref, stress_state state, solid_batch *b)
{
    const free_axes f = free_axes_of(state);
    if (f.n == 0) return model->stress(par, p_ref, b);

    const double K = model->bulk_modulus(par), G = model->shear_modulus(par);
    if (!(K > 0.0) || !(G > 0.0))
        return b->n > 0 ? 1 : 0; /* a fluid has no free stretch that takes its pressure away */
    solid_batch start;
    copy_batch(model, b, &start);
    free_solve solve;
    solve_start(&solve, &f, b->n, K, G);
    size_t open = 0;
    for (int iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
        solve_apply(&solve, &f, model, &start, b);
        const size_t beyond = model->stress(par, p_ref, b);
        if (beyond != 0) return beyond;
        open = solve_advance(&solve, &f, b, iteration == 0);
        if (open == 0) return 0;
    }
    return open;
}
