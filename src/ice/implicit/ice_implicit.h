/* The implicit pressure's own: the linear system and the passes over the blocks. Only ice_implicit*.c include this. */
#ifndef ICE_ICE_IMPLICIT_H
#define ICE_ICE_IMPLICIT_H

#include "ice/ice_internal.h"
#include "solve/cg.h"
#include "solve/multigrid.h"

struct ice_implicit {
    solve_grid grid; /* the cells of the mesh */
    multigrid *m;    /* owned; holds the matrix */
    cg *c;           /* owned */
    double *b, *x;   /* owned; on the grid: right side, solution */
    double *weight;  /* owned; of the norm: 1/w, w the volume of a cell over that of its box. NULL where all are 1 */
    double *tile;    /* owned; largest residual of every row of the grid */
};

/* What sound does to u* and P before any step of pressure is known (rows of theory 3 with dP = 0). */
floe_status ice_implicit_begin(ice *s);
/* Adds a step of pressure, from the array of P with its ghosts filled, to u*. */
void ice_implicit_push(const ice *s);
/* The right side: b = w (-S y / phi - dt div F); returns the largest |b/w|, the error of a volume as a fraction,
 * DBL_MAX where it is no number. */
double ice_implicit_residual(ice *s);
/* The matrix of the present u*. */
void ice_implicit_matrix(ice *s);
/* The solution as a step of pressure into the array of P, ghosts filled, and onto the sum of steps. */
void ice_implicit_take(ice *s);
/* The last step's sum of steps as the first guess, likewise. */
void ice_implicit_guess(ice *s);
/* dP from the fluxes, and P. */
void ice_implicit_finish(ice *s);

#endif
