/* Symmetric systems of a chain of points in a plane: 2 x 2 blocks on the diagonal and between a point and the next,
 * open or closed in a ring, and a term k g g^T on top, by which all of them are connected (the volume inside a
 * membrane). Solved exactly, by elimination along the chain. */
#ifndef SOLVE_CHAIN_H
#define SOLVE_CHAIN_H

#include "base/context.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct chain_matrix {
    context *ctx; /* not owned */
    size_t n;     /* points, at least 3 */
    bool closed;
    double (*own)[4]; /* of a point with itself, row-major; owned */
    /* Of a point (rows) with the one after it (columns); of the last with the first where closed. Owned. */
    double (*next)[4];
    double (*inverse)[4], *column[4]; /* scratch of the solution; owned */
} chain_matrix;

/* Errors: FLOE_NO_MEMORY. */
floe_status chain_create(chain_matrix **out, context *ctx, size_t n, bool closed);
void chain_destroy(chain_matrix **m);
/* All entries 0. */
void chain_clear(chain_matrix *m);
/* Solves (A + k g g^T) x = b for 2 n numbers; positive definite. Errors: FLOE_RETRY where a pivot is not positive. */
floe_status chain_solve(chain_matrix *m, double k, const double *g, const double *b, double *x);

#endif
