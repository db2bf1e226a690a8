/* Dense solves of a few unknowns, in place, without allocation. Matrices are row-major, n by n, rows contiguous:
 * a[i*n+j]; 1 <= n <= SMALL_SOLVE_MAX. For larger systems use a library. */
#ifndef MATH_SMALL_SOLVE_H
#define MATH_SMALL_SOLVE_H

#include <math.h>
#include <stdbool.h>

enum { SMALL_SOLVE_MAX = 16 };

/* Factors a symmetric matrix as L D L^T without pivoting; only the lower triangle is read. On return it holds L (unit
 * diagonal not stored) below D on the diagonal. Stable for positive definite matrices and their like (diagonal plus
 * graph Laplacian), where it also keeps small differences that pivoting would lose. False at a pivot that is 0 or not
 * finite, or for n out of range. Golub and Van Loan, Matrix Computations, 4th ed., section 4.1.2. */
static inline bool small_ldl_factor(int n, double *a)
{
    if (n < 1 || n > SMALL_SOLVE_MAX) return false;
    for (int j = 0; j < n; j++) {
        double work[SMALL_SOLVE_MAX]; /* D L^T, column j */
        double pivot = a[j * n + j];
        for (int k = 0; k < j; k++) {
            work[k] = a[j * n + k] * a[k * n + k];
            pivot -= a[j * n + k] * work[k];
        }
        if (pivot == 0.0 || !isfinite(pivot)) return false;
        a[j * n + j] = pivot;
        for (int i = j + 1; i < n; i++) {
            double sum = a[i * n + j];
            for (int k = 0; k < j; k++) sum -= a[i * n + k] * work[k];
            a[i * n + j] = sum / pivot;
        }
    }
    return true;
}

/* Solves L D L^T x = b with the factors of small_ldl_factor; b[n] becomes x. */
static inline void small_ldl_solve(int n, const double *factors, double *b)
{
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < i; k++) b[i] -= factors[i * n + k] * b[k];
    }
    for (int i = 0; i < n; i++) b[i] /= factors[i * n + i];
    for (int i = n - 1; i >= 0; i--) {
        for (int k = i + 1; k < n; k++) b[i] -= factors[k * n + i] * b[k];
    }
}

/* The row at or below `column` whose entry in that column is largest; -1 when all are 0 or one is NaN. */
static inline int small_lu_pivot_row_(int n, const double *a, int column)
{
    int row = -1;
    double largest = 0.0;
    for (int i = column; i < n; i++) {
        const double size = fabs(a[i * n + column]);
        if (!isfinite(size)) return -1;
        if (size > largest) {
            largest = size;
            row = i;
        }
    }
    return row;
}

static inline void small_swap_rows_(int n, double *a, int p, int q)
{
    if (p == q) return;
    for (int j = 0; j < n; j++) {
        const double value = a[p * n + j];
        a[p * n + j] = a[q * n + j];
        a[q * n + j] = value;
    }
}

/* Factors a general matrix as P a = L U with partial pivoting: U on and above the diagonal, L (unit diagonal not
 * stored) below; pivot[n] is the row exchanged with row j at step j. False for a matrix that is singular to the last
 * digit or not finite, or for n out of range. */
static inline bool small_lu_factor(int n, double *a, int *pivot)
{
    if (n < 1 || n > SMALL_SOLVE_MAX) return false;
    for (int j = 0; j < n; j++) {
        const int row = small_lu_pivot_row_(n, a, j);
        if (row < 0) return false;
        pivot[j] = row;
        small_swap_rows_(n, a, j, row);
        for (int i = j + 1; i < n; i++) {
            const double factor = a[i * n + j] / a[j * n + j];
            a[i * n + j] = factor;
            for (int k = j + 1; k < n; k++) a[i * n + k] -= factor * a[j * n + k];
        }
    }
    return true;
}

/* Solves a x = b with the factors and exchanges of small_lu_factor; b[n] becomes x. */
static inline void small_lu_solve(int n, const double *factors, const int *pivot, double *b)
{
    for (int j = 0; j < n; j++) {
        const double value = b[j];
        b[j] = b[pivot[j]];
        b[pivot[j]] = value;
    }
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < i; k++) b[i] -= factors[i * n + k] * b[k];
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int k = i + 1; k < n; k++) b[i] -= factors[i * n + k] * b[k];
        b[i] /= factors[i * n + i];
    }
}

/* Solves the symmetric a x = b at once; a is overwritten by its factors, b by x. False as small_ldl_factor. */
static inline bool small_solve_symmetric(int n, double *a, double *b)
{
    if (!small_ldl_factor(n, a)) return false;
    small_ldl_solve(n, a, b);
    return true;
}

/* Solves the general a x = b at once; a is overwritten by its factors, b by x. False as small_lu_factor. */
static inline bool small_solve_general(int n, double *a, double *b)
{
    int pivot[SMALL_SOLVE_MAX];
    if (!small_lu_factor(n, a, pivot)) return false;
    small_lu_solve(n, a, pivot, b);
    return true;
}

#endif
