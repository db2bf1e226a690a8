/* Geometric multigrid for cells that are linked through their faces: the preconditioner of the implicit pressure.
 *
 *     (A x)_c = sink_c x_c + sum_f link_f (x_c - x_nb),     sink, link >= 0,
 *
 * symmetric, an M-matrix. Beyond a side that is not periodic lies x = 0: a link there is a Dirichlet condition, none a
 * wall. A cell without sink and links takes no part and stays 0.
 *
 * One V cycle, symmetric: levels are coarsened by pairs along the axis of the strongest links, so that stretched cells
 * and any number of cells will do, down to one cell, which is solved exactly. Values between coarse cells follow the
 * flux through the links between them, and coarse links are the fine ones in series, so that jumps of the coefficients
 * do no harm. Smoothing is a Chebyshev polynomial of degree 2 in D^-1 A: no order of cells, hence the same bits for any
 * threads. */
#ifndef SOLVE_MULTIGRID_H
#define SOLVE_MULTIGRID_H

#include "solve/grid.h"

typedef struct multigrid multigrid;

/* A matrix on a solve_grid. link[axis] lies on the lower face of a cell; that of unknown n[axis] is the upper side's,
 * and on a periodic axis is not read (it is the link of unknown 0). */
typedef struct link_system {
    double *sink, *link[MESH_MAX_DIM];
} link_system;

/* Hierarchy for systems on g (copied). strength: of the links along each axis, to a common factor (1/h^2 on cells of
 * width h); it sets the order in which the axes are coarsened. Errors: FLOE_NO_MEMORY. Owner: the caller. */
floe_status multigrid_create(multigrid **out, context *ctx, const solve_grid *g, const double *strength);
void multigrid_destroy(multigrid **m);

/* The arrays of the finest matrix, for the caller to fill; zero at first. */
link_system multigrid_system(multigrid *m);
/* Coarsens the finest matrix; to be called whenever it has changed. */
void multigrid_prepare(multigrid *m);

/* y = A x of the finest level, once prepared. A cg_operator; user: the multigrid. */
void multigrid_apply(void *user, double *x, double *y);
/* y = one V cycle on A y = x from 0. A cg_operator; user: the multigrid. */
void multigrid_cycle(void *user, double *x, double *y);

#endif
