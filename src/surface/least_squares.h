/* Least squares of a few unknowns, rows taken in one by one. Private to the surface module.
 *
 * Rows are turned at once into the triangle of a QR factorization (Givens; Golub and Van Loan, 4th ed., section 5.2.5),
 * so that any number of rows fits. A triangle with small pivots is then taken to GSL's complete orthogonal
 * decomposition, which finds the rank and, where that is short, the solution of least norm. The normal equations
 * (Sulsky and York 2000, equation 13) are there for comparison: they square the condition, and a singular matrix has no
 * answer but by round-off. */
#ifndef SURFACE_LEAST_SQUARES_H
#define SURFACE_LEAST_SQUARES_H

#include "surface/surface.h"

typedef enum surface_solver { SOLVE_QR, SOLVE_NORMAL_EQUATIONS } surface_solver;

enum { LEAST_SQUARES_WIDTH = SURFACE_MAX_FUNCTIONS + 1 };

typedef struct least_squares {
    surface_solver solver;
    int n;    /* unknowns, up to SURFACE_MAX_FUNCTIONS */
    int rows; /* taken in so far */
    /* Row-major, n + 1 columns, the last the right-hand side: a triangle, or the normal equations. */
    double a[LEAST_SQUARES_WIDTH * LEAST_SQUARES_WIDTH];
} least_squares;

typedef struct least_squares_solution {
    double x[SURFACE_MAX_FUNCTIONS];
    int rank;
    double residual; /* norm of what is left over; QR only, else NAN */
    /* Largest over smallest pivot within the rank (of the rows' matrix: normal equations have its square). */
    double condition;
} least_squares_solution;

void least_squares_begin(least_squares *l, surface_solver solver, int n);
/* Takes in row . x = value. */
void least_squares_add(least_squares *l, const double *row, double value);
/* False where nothing can be solved: no rows, a singular normal equation, or numbers that are not finite. */
bool least_squares_solve(const least_squares *l, least_squares_solution *out);
/* Largest over smallest singular value of the rows' matrix; INFINITY where it is singular. QR only. */
double least_squares_condition(const least_squares *l);

#endif
