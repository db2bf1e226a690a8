#include "surface/least_squares.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

/* Pivots below this share of the largest are taken for zero: far above round-off, for a direction that the points
 * hardly see would be filled with their noise (York 1997, section 7.6: points on a line along the mesh). */
static const double rank_tolerance = 1e-7;
/* With all pivots above this share of the largest the rank is not in doubt, and the triangle needs no further
 * decomposition. */
static const double plain_pivot = 1e-3;

void least_squares_begin(least_squares *l, surface_solver solver, int n)
{
    l->solver = solver;
    l->n = n;
    l->rows = 0;
    memset(l->a, 0, (size_t)(n + 1) * (size_t)(n + 1) * sizeof *l->a);
}

/* Turns a row into the triangle: each rotation clears its next entry. */
static void add_to_triangle(least_squares *l, double *row)
{
    const int width = l->n + 1;
    for (int j = 0; j < width; ++j) {
        double *top = l->a + j * width;
        if (row[j] == 0.0) continue;
        const double length = sqrt(top[j] * top[j] + row[j] * row[j]), c = top[j] / length, s = row[j] / length;
        for (int k = j; k < width; ++k) {
            const double upper = top[k], lower = row[k];
            top[k] = c * upper + s * lower;
            row[k] = c * lower - s * upper;
        }
    }
}

void least_squares_add(least_squares *l, const double *row, double value)
{
    double full[LEAST_SQUARES_WIDTH];
    const int n = l->n;
    memcpy(full, row, (size_t)n * sizeof *row);
    full[n] = value;
    l->rows++;
    if (l->solver == SOLVE_QR) {
        add_to_triangle(l, full);
        return;
    }
    for (int i = 0; i < n; ++i)
        for (int j = 0; j <= n; ++j) l->a[i * (n + 1) + j] += full[i] * full[j];
}

/* The matrix, n by n, and the right-hand side. */
static void split_equations(const least_squares *l, double *matrix, double *b)
{
    const int n = l->n;
    for (int i = 0; i < n; ++i) {
        memcpy(matrix + i * n, l->a + i * (n + 1), (size_t)n * sizeof *matrix);
        b[i] = l->a[i * (n + 1) + n];
    }
}

static bool is_finite(int n, const double *x)
{
    for (int i = 0; i < n; ++i)
        if (!isfinite(x[i])) return false;
    return true;
}

/* Entries of a permutation, without an allocation. */
typedef struct small_permutation {
    size_t data[SURFACE_MAX_FUNCTIONS];
    gsl_permutation p;
} small_permutation;

static gsl_permutation *view_permutation(small_permutation *s, int n)
{
    s->p = (gsl_permutation){.size = (size_t)n, .data = s->data};
    return &s->p;
}

/* A triangle without a small pivot is solved as it stands. False where it has one. */
static bool solve_plainly(const least_squares *l, least_squares_solution *out)
{
    const int n = l->n, width = n + 1;
    double least = INFINITY, most = 0.0;
    for (int i = 0; i < n; ++i) {
        least = fmin(least, fabs(l->a[i * width + i]));
        most = fmax(most, fabs(l->a[i * width + i]));
    }
    if (!(least > plain_pivot * most)) return false;
    for (int i = n - 1; i >= 0; --i) {
        double sum = l->a[i * width + n];
        for (int k = i + 1; k < n; ++k) sum -= l->a[i * width + k] * out->x[k];
        out->x[i] = sum / l->a[i * width + i];
    }
    out->rank = n;
    out->condition = most / least;
    out->residual = fabs(l->a[width * width - 1]);
    return is_finite(n, out->x);
}

static bool solve_triangle(const least_squares *l, least_squares_solution *out)
{
    const size_t n = (size_t)l->n;
    double matrix[SURFACE_MAX_FUNCTIONS * SURFACE_MAX_FUNCTIONS], b[SURFACE_MAX_FUNCTIONS];
    double q[SURFACE_MAX_FUNCTIONS], z[SURFACE_MAX_FUNCTIONS], work[SURFACE_MAX_FUNCTIONS], rest[SURFACE_MAX_FUNCTIONS];
    small_permutation order;
    split_equations(l, matrix, b);
    gsl_matrix_view A = gsl_matrix_view_array(matrix, n, n);
    gsl_vector_view tau_q = gsl_vector_view_array(q, n), tau_z = gsl_vector_view_array(z, n);
    gsl_vector_view w = gsl_vector_view_array(work, n), r = gsl_vector_view_array(rest, n);
    gsl_vector_view x = gsl_vector_view_array(out->x, n), rhs = gsl_vector_view_array(b, n);
    gsl_permutation *p = view_permutation(&order, l->n);
    double largest = 0.0;
    for (size_t k = 0; k < n * n; ++k) largest = fmax(largest, fabs(matrix[k]));
    if (!(largest > 0.0) || !is_finite((int)(n * n), matrix)) return false;
    size_t rank = 0;
    if (gsl_linalg_COD_decomp_e(&A.matrix, &tau_q.vector, &tau_z.vector, p, rank_tolerance * largest, &rank, &w.vector))
        return false;
    if (rank == 0 ||
        gsl_linalg_COD_lssolve(&A.matrix, &tau_q.vector, &tau_z.vector, p, rank, &rhs.vector, &x.vector, &r.vector))
        return false;
    out->rank = (int)rank;
    out->residual = fabs(l->a[(l->n + 1) * (l->n + 1) - 1]);
    const double first = fabs(matrix[0]), last = fabs(matrix[(rank - 1) * n + rank - 1]);
    out->condition = fmax(first, last) / fmin(first, last);
    return is_finite(l->n, out->x);
}

static bool solve_normal_equations(const least_squares *l, least_squares_solution *out)
{
    const size_t n = (size_t)l->n;
    double matrix[SURFACE_MAX_FUNCTIONS * SURFACE_MAX_FUNCTIONS], b[SURFACE_MAX_FUNCTIONS];
    small_permutation order;
    int sign;
    split_equations(l, matrix, b);
    gsl_matrix_view A = gsl_matrix_view_array(matrix, n, n);
    gsl_vector_view rhs = gsl_vector_view_array(b, n), x = gsl_vector_view_array(out->x, n);
    gsl_permutation *p = view_permutation(&order, l->n);
    if (!is_finite((int)(n * n), matrix) || gsl_linalg_LU_decomp(&A.matrix, p, &sign)) return false;
    double largest = 0.0, least = INFINITY;
    for (size_t k = 0; k < n; ++k) {
        largest = fmax(largest, fabs(matrix[k * n + k]));
        least = fmin(least, fabs(matrix[k * n + k]));
    }
    if (!(least > 0.0) || gsl_linalg_LU_solve(&A.matrix, p, &rhs.vector, &x.vector)) return false;
    out->rank = l->n;
    out->residual = NAN;
    out->condition = sqrt(largest / least);
    return is_finite(l->n, out->x);
}

bool least_squares_solve(const least_squares *l, least_squares_solution *out)
{
    if (l->rows == 0) return false;
    if (l->solver == SOLVE_NORMAL_EQUATIONS) return solve_normal_equations(l, out);
    return solve_plainly(l, out) || solve_triangle(l, out);
}

double least_squares_condition(const least_squares *l)
{
    const size_t n = (size_t)l->n;
    double matrix[SURFACE_MAX_FUNCTIONS * SURFACE_MAX_FUNCTIONS], b[SURFACE_MAX_FUNCTIONS];
    double right[SURFACE_MAX_FUNCTIONS * SURFACE_MAX_FUNCTIONS], values[SURFACE_MAX_FUNCTIONS];
    split_equations(l, matrix, b);
    gsl_matrix_view A = gsl_matrix_view_array(matrix, n, n), V = gsl_matrix_view_array(right, n, n);
    gsl_vector_view S = gsl_vector_view_array(values, n);
    if (!is_finite((int)(n * n), matrix) || gsl_linalg_SV_decomp_jacobi(&A.matrix, &V.matrix, &S.vector))
        return (double)INFINITY;
    return values[n - 1] > 0.0 ? values[0] / values[n - 1] : (double)INFINITY;
}
