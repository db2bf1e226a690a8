/* The smoother of nodes in multigrid: B, an approximate inverse of a node_matrix made of small exact ones, and Chebyshev
 * polynomials in B A. Only node_smooth.c and multigrid_nodes.c include this. */
#ifndef SOLVE_NODE_SMOOTH_H
#define SOLVE_NODE_SMOOTH_H

#include "solve/node_matrix.h"

/* Nodes about a cell at the body's edge that are solved for together. */
typedef struct node_patch {
    int unknowns;
    size_t first;  /* of its unknowns in the list of all patches */
    size_t factor; /* of the lower triangle of its Cholesky factor, by rows */
} node_patch;

typedef struct node_smoother {
    context *ctx;              /* not owned */
    const node_matrix *matrix; /* not owned */
    double *block;             /* inverses of the diagonal blocks, rows x components x components; owned */
    bool patched;              /* whether edges have patches */
    bool *covered;             /* rows that patches solve for; owned */
    node_patch *patch;         /* owned */
    int patches, patches_reserved;
    size_t *unknown; /* entries of the arrays, of all patches; owned */
    double *share;   /* square roots of how much of an unknown a patch has; owned */
    double *factor;  /* owned */
    size_t unknowns, unknowns_reserved, factors, factors_reserved;
    double largest, margin;       /* eigenvalue of B A, with a margin, as a factor */
    double *residual, *step, *to; /* scratch on the grid; owned */
} node_smoother;

/* Errors: FLOE_NO_MEMORY. `matrix` must outlive it. */
floe_status node_smoother_create(node_smoother *s, const node_matrix *matrix, bool patched);
void node_smoother_free(node_smoother *s);
/* Makes B and its bounds for the matrix as it is now. Errors: FLOE_NO_MEMORY. */
floe_status node_smoother_prepare(node_smoother *s);
/* Improves x towards A x = b; with `fresh` x is 0 at first. */
void node_smoother_relax(node_smoother *s, const double *b, double *x, bool fresh);

/* Factors the lower triangle of a symmetric matrix of n rows, stored by rows without the upper one, as L L^T in place,
 * after adding `more` to the diagonal. A row of which nothing is left becomes an empty one, which gives 0. */
void packed_factor(int n, double *a, double more);
/* Solves L L^T x = b in place. */
void packed_solve(int n, const double *a, double *b);

#endif
