/* SUNDIALS vectors on a solve_grid: what its Krylov solvers need, with sums that have the same bits for any number of
 * threads, since they are taken within tiles and then over tiles in order (docs/structure.md, Tiles). */
#ifndef SOLVE_GRID_VECTOR_H
#define SOLVE_GRID_VECTOR_H

#include "solve/grid.h"

#include <sundials/sundials_nvector.h>

/* A zeroed vector of `components` arrays one after the other, each g->size long. g and `lost` must outlive it and its
 * clones. SUNDIALS takes no failure from a clone: where memory runs out for one, *lost becomes true, and neither the
 * clone nor what it was made for may be used. Errors: FLOE_NO_MEMORY. Owner: the caller (N_VDestroy). */
floe_status grid_vector_new(N_Vector *out, context *ctx, SUNContext sun, const solve_grid *g, int components,
                            bool *lost);
/* Its arrays. */
double *grid_vector_data(N_Vector v);

#endif
