/* Geometric multigrid for matrices of nodes (node_matrix.h): the preconditioner of static and implicit steps of
 * material points.
 *
 * One V cycle, symmetric. Levels have half the nodes along every axis, values between them are linear in between, and
 * coarse matrices are the fine one as coarse values see it (Galerkin), so that they know where the body ends.
 * Smoothing is a Chebyshev polynomial in B A, B the inverse of the matrix's diagonal blocks. At the body's edge, nodes
 * of which points fill but a sliver of the support make A as bad as they are small, and no diagonal cures that: on the
 * finest level the nodes about a cell with such a node are solved for together (de Prenter et al. 2017, Comput.
 * Methods Appl. Mech. Engrg. 316, 297), each such patch weighted by how many it shares its nodes with. The same bits
 * for any threads. */
#ifndef SOLVE_NODE_MULTIGRID_H
#define SOLVE_NODE_MULTIGRID_H

#include "solve/node_matrix.h"

typedef struct node_multigrid node_multigrid;

/* For matrices on g (copied) of that many components, that width and arm. Errors: FLOE_NO_MEMORY. Owner: the caller. */
floe_status node_multigrid_create(node_multigrid **out, context *ctx, const solve_grid *g, int components, int width,
                                  int arm);
void node_multigrid_destroy(node_multigrid **m);

/* The finest matrix, for the caller to shape and fill. */
node_matrix *node_multigrid_matrix(node_multigrid *m);
/* Coarsens the finest matrix; to be called whenever it has changed. Errors: FLOE_NO_MEMORY. */
floe_status node_multigrid_prepare(node_multigrid *m);

/* y = A x of the finest level. A cg_operator; user: the node_multigrid. */
void node_multigrid_apply(void *user, double *x, double *y);
/* y = one V cycle on A y = x from 0. A cg_operator; user: the node_multigrid. */
void node_multigrid_cycle(void *user, double *x, double *y);

#endif
