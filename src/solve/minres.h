/* Paige and Saunders' minimal residuals (SIAM J. Numer. Anal. 12 (1975) 617) for symmetric indefinite systems, with a positive definite
 * preconditioner: steps of nearly incompressible solids, whose unknowns are displacements and pressures. Sums go over the entries in order:
 * the same bits for any number of threads. */
#ifndef SOLVE_MINRES_H
#define SOLVE_MINRES_H

#include "base/memory.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct minres minres;

/* y = M x on arrays of all unknowns. x may be changed where it takes no part. */
typedef void minres_operator(void *user, double *x, double *y);

typedef struct minres_system {
    minres_operator *matrix, *preconditioner; /* both symmetric, the preconditioner positive definite */
    void *user;
} minres_system;

/* A solver, for no unknowns as yet. Errors: FLOE_NO_MEMORY. Owner: the caller. */
floe_status minres_create(minres **out, context *ctx, int most_iterations);
void minres_destroy(minres **m);
/* Makes it one for n unknowns. Errors: FLOE_NO_MEMORY. */
floe_status minres_resize(minres *m, size_t n);

typedef struct minres_result {
    int iterations;
    double residual; /* over that at the start, both in the norm of the preconditioner */
    bool converged;  /* it is `tolerance` at most */
    bool definite;   /* the preconditioner has shown no direction in which it is negative; it ends there */
} minres_result;

/* Solves from x = 0 until the residual is that share of b. */
minres_result minres_solve(minres *m, const minres_system *s, double tolerance, const double *b, double *x);

#endif
