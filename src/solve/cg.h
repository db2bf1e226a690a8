/* Conjugate gradients for symmetric positive definite systems: of cells (the implicit pressure), of nodes (steps of points that are
 * solved for) and of lists of nodes (edges of solids). The same bits for any number of threads, as long as matrix and
 * preconditioner give them. */
#ifndef SOLVE_CG_H
#define SOLVE_CG_H

#include "solve/grid.h"

typedef struct cg cg;

/* y = M x on arrays of the solver's grid, each component g->size long. Ghosts of x may be written. */
typedef void cg_operator(void *user, double *x, double *y);

/* What the size of a residual r is taken as. */
typedef enum cg_norm {
    CG_WEIGHTED,      /* |w r|, w: 1 where there is no weight */
    CG_PRECONDITIONED /* the root of r . B r, B the preconditioner, which costs nothing */
} cg_norm;

typedef struct cg_system {
    cg_operator *matrix, *preconditioner; /* both symmetric and positive definite */
    void *user;
    cg_norm norm;
    const double *weight; /* NULL: 1 */
} cg_system;

/* A solver for `components` unknowns at each place of g, which is copied. Errors: FLOE_NO_MEMORY. Owner: the caller. */
floe_status cg_create(cg **out, context *ctx, const solve_grid *g, int components, int most_iterations);
void cg_destroy(cg **c);
/* Makes it one for another grid. Errors: FLOE_NO_MEMORY. */
floe_status cg_resize(cg *c, const solve_grid *g, int components);

typedef struct cg_result {
    int iterations;
    double residual; /* its size */
    bool converged;  /* it is below the tolerance */
} cg_result;

/* Improves x until the size of its residual is `tolerance` at most: r = b - A x, now and after the last iteration. */
cg_result cg_solve(cg *c, const cg_system *s, double tolerance, double *r, double *x);
/* The same from x = 0, where r = b. */
cg_result cg_solve_afresh(cg *c, const cg_system *s, double tolerance, double *b, double *x);

#endif
