/* The linear system of the implicit pressure and the passes over the blocks; only this folder includes it. */
#ifndef ICE_IMPLICIT_ROWS_H
#define ICE_IMPLICIT_ROWS_H

#include "ice/implicit/ice_implicit.h"
#include "solve/cg.h"
#include "solve/multigrid.h"

typedef struct ice_implicit {
    solve_grid grid; /* the cells of the mesh */
    multigrid *m;    /* owned; holds the matrix */
    cg *c;           /* owned */
    double *b, *x;   /* owned; on the grid: right side, solution */
    double *weight;  /* owned; of the norm: 1/w, w the volume of a cell over that of its box. NULL where all are 1 */
    double *tile;    /* owned; largest residual of every row of the grid */
} ice_implicit;

/* What sound does to u* and P before any step of pressure is known (rows of theory 3 with dP = 0). */
floe_status ice_implicit_begin(ice *s, const ice_region *g);
/* Adds a step of pressure, from the array of P with its ghosts filled, to u*. */
void ice_implicit_push(const ice *s, const ice_region *g);
/* The right side: b = w (-S y / phi - dt div F); returns the largest |b/w|, the error of a volume as a fraction,
 * DBL_MAX where it is no number. */
double ice_implicit_residual(ice *s, const ice_region *g);
/* The matrix of the present u*. */
floe_status ice_implicit_matrix(ice *s, const ice_region *g);
/* The solution as a step of pressure into the array of P, ghosts filled, and onto the sum of steps. */
void ice_implicit_take(ice *s, const ice_region *g);
/* The last step's sum of steps as the first guess, likewise. */
void ice_implicit_guess(ice *s, const ice_region *g);
/* dP from the fluxes, and P. */
void ice_implicit_finish(ice *s, const ice_region *g);

#endif
