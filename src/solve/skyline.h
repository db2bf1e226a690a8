/* Exact solution of a symmetric positive definite node_matrix, by Cholesky's method within its envelope: for bodies of so few nodes that the same
 * matrix is solved with many times. Nodes are numbered along the body (Cuthill and McKee 1969, Proc. 24th Nat. Conf. ACM, 157), so that what is slender
 * has a narrow envelope. */
#ifndef SOLVE_SKYLINE_H
#define SOLVE_SKYLINE_H

#include "solve/node_matrix.h"

typedef struct skyline skyline;

/* Without a matrix. Errors: FLOE_NO_MEMORY. Owner: the caller. */
floe_status skyline_create(skyline **out, context *ctx);
void skyline_destroy(skyline **s);
/* Numbers the unknowns of a matrix of which `fixed` (an array for each component, in order) does not say that they stay 0. Errors: FLOE_NO_MEMORY. */
floe_status skyline_shape(skyline *s, const node_matrix *m, const bool *fixed);
/* Multiplications that its factors take. */
double skyline_work(const skyline *s);
/* Factors that matrix. An unknown without a positive pivot is fixed. */
floe_status skyline_factor(skyline *s, const node_matrix *m);
/* x of A x = b on arrays of all components; 0 where nothing is solved for. x may be b. */
void skyline_solve(skyline *s, const double *b, double *x);

#endif
