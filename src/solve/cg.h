/* Conjugate gradients for symmetric positive definite systems on a solve_grid: SUNDIALS' PCG on vectors of our own. The
 * same bits for any number of threads, as long as matrix and preconditioner give them. */
#ifndef SOLVE_CG_H
#define SOLVE_CG_H

#include "solve/grid.h"

typedef struct cg cg;

/* y = M x on arrays of the solver's grid, each component g->size long. Ghosts of x may be written. */
typedef void cg_operator(void *user, double *x, double *y);

/* A solver for `components` unknowns at each place of g, which must outlive it. Errors: FLOE_NO_MEMORY. Owner: the
 * caller. */
floe_status cg_create(cg **out, context *ctx, const solve_grid *g, int components, int most_iterations);
void cg_destroy(cg **c);

typedef struct cg_result {
    int iterations;
    double residual; /* l2 norm of b - A x, weighted */
    bool converged;  /* it is below the tolerance */
} cg_result;

/* Solves A x = b from x = 0 until the l2 norm of w (b - A x) is below `tolerance`; w: 1 where `weight` is NULL.
 * `preconditioner` is symmetric and positive definite too. */
cg_result cg_solve(cg *c, cg_operator *matrix, cg_operator *preconditioner, void *user, const double *b,
                   const double *weight, double tolerance, double *x);

#endif
