/* Geometric multigrid, the preconditioner of conjugate gradients: one V cycle, symmetric, with Chebyshev polynomials that smooth. No order
 * of unknowns matters, hence the same bits for any threads. Two kinds of matrices:
 *
 * Cells that are linked through their faces (the implicit pressure),
 *
 *     (A x)_c = sink_c x_c + sum_f link_f (x_c - x_nb),     sink, link >= 0,
 *
 * an M-matrix. Beyond a side that is not periodic lies x = 0: a link there is a Dirichlet condition, none a wall. A cell without sink and
 * links takes no part and stays 0. Levels are coarsened by pairs along the axis of the strongest links, so that stretched cells and any
 * number of cells will do, down to one cell. Values between coarse cells follow the flux through the links between them, and coarse links
 * are the fine ones in series, so that jumps of the coefficients do no harm.
 *
 * Nodes (node_matrix.h: static and implicit steps of material points). Levels have half the nodes along every axis, values between them
 * are linear in between, and coarse matrices are the fine one as coarse values see it (Galerkin), so that they know where the body ends.
 * The polynomial is in B A, B the inverse of the matrix's diagonal blocks. At the body's edge, nodes of which points fill but a sliver of
 * the support make A as bad as they are small, and no diagonal cures that: on the finest level the nodes about a cell with such a node are
 * solved for together (de Prenter et al. 2017, Comput. Methods Appl. Mech. Engrg. 316, 297), each such patch weighted by how many it
 * shares its nodes with. */
#ifndef SOLVE_MULTIGRID_H
#define SOLVE_MULTIGRID_H

#include "solve/node_matrix.h"

typedef struct multigrid multigrid;

/* A matrix of cells. link[axis] lies on the lower face of a cell; that of unknown n[axis] is the upper side's,
 * and on a periodic axis is not read (it is the link of unknown 0). */
typedef struct link_system {
    double *sink, *link[MESH_MAX_DIM];
} link_system;

/* Hierarchy for cells on g (copied). strength: of the links along each axis, to a common factor (1/h^2 on cells of
 * width h); it sets the order in which the axes are coarsened. Errors: FLOE_NO_MEMORY. Owner: the caller. */
floe_status multigrid_of_cells(multigrid **out, context *ctx, const solve_grid *g, const double *strength);
/* The finest matrix of cells, for the caller to fill; zero at first. */
link_system multigrid_links(multigrid *m);

/* Hierarchy for nodes on g (copied), matrices of that many components, that width and arm. Errors: FLOE_NO_MEMORY. Owner: the caller. */
floe_status multigrid_of_nodes(multigrid **out, context *ctx, const solve_grid *g, int components, int width, int arm);
/* The finest matrix of nodes, for the caller to shape and fill. */
node_matrix *multigrid_matrix(multigrid *m);

/* Of nodes: the largest eigenvalues, which smoothers estimate from below, are taken to be larger by this factor (1.1 at first). With too small a one the
 * cycle is not positive definite. From the next preparation on. */
void multigrid_widen(multigrid *m, double margin);

void multigrid_destroy(multigrid **m);

/* Coarsens the finest matrix; to be called whenever it has changed. Errors: FLOE_NO_MEMORY, of nodes alone. */
floe_status multigrid_prepare(multigrid *m);
/* y = A x of the finest level, of cells once prepared. A cg_operator; user: the multigrid. */
void multigrid_apply(void *user, double *x, double *y);
/* y = one V cycle on A y = x from 0. A cg_operator; user: the multigrid. */
void multigrid_cycle(void *user, double *x, double *y);

#endif
