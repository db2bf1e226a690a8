/* The implicit pressure (theory 3): the linear system of each region and the passes over the blocks that make it. Beside
 * embedded boundaries cut/ice_cut_implicit.c puts the search together from them, with cut cells and walls (theory 7.8). */
#ifndef ICE_IMPLICIT_H
#define ICE_IMPLICIT_H

#include "ice/ice_view.h"
#include "solve/cg.h"
#include "solve/multigrid.h"

typedef struct ice_implicit {
    solve_grid grid; /* the cells of the mesh */
    multigrid *m;    /* owned; holds the matrix */
    cg *c;           /* owned; NULL beside embedded boundaries */
    double *b, *x;   /* owned; on the grid: right side, solution */
    double *weight;  /* owned; of the norm: 1/w, w the volume of a cell over that of its box. NULL where all are 1 */
    double *tile;    /* owned; largest residual of every row of the grid */
} ice_implicit;

/* Storage, one system a region; none in scenes without it. */
floe_status ice_implicit_create(ice *s);
void ice_implicit_destroy(context *ctx, struct ice_implicit **w, int n_regions);
floe_status ice_implicit_pressure_of(ice *s, const ice_region *g);

/* The linear residual that is asked for, of the largest error of a volume that there is. */
double ice_implicit_tolerance(const ice *s, const ice_implicit *w, double residual);
/* How a search ends: FLOE_RETRY, as it does not come to the tolerance; or counted, with its iterations. */
floe_status ice_implicit_give_up(const ice *s, double residual, double best, int outer);
void ice_implicit_tally(const ice *s, int outer, int iterations);
/* What sound does to P before any step of pressure is known: into the array of dP. */
floe_status ice_implicit_begin(ice *s, const ice_region *g);
/* u*_0 from the explicit u* and that, whose ghosts it fills (rows of theory 3 with dP = 0). */
void ice_implicit_centre(ice *s, const ice_region *g);
/* The upwind theta^r,f of several fluids by the present u*, and the volume flux that they make. */
void ice_implicit_fractions(const ice *s, const ice_region *g);
/* Adds a step of pressure, from the array of P with its ghosts filled, to u*. */
void ice_implicit_push(const ice *s, const ice_region *g);
/* The right side: b = w (-S y / phi - dt div F); returns the largest |b/w|, the error of a volume as a fraction,
 * DBL_MAX where it is no number. */
double ice_implicit_residual(ice *s, const ice_region *g);
/* Sinks and links of the present u*; and the matrix of them, without cells that are constrained. */
void ice_implicit_links(ice *s, const ice_region *g);
floe_status ice_implicit_matrix(ice *s, const ice_region *g);
/* The solution as a step of pressure into the array of P, ghosts filled, and onto the sum of steps. */
void ice_implicit_take(ice *s, const ice_region *g);
/* The last step's sum of steps as the first guess, likewise. */
void ice_implicit_guess(ice *s, const ice_region *g);
/* dP from the fluxes, and P; and what other fluids and ghosts have of it. */
void ice_implicit_advance(ice *s, const ice_region *g);
void ice_implicit_finish(ice *s, const ice_region *g);

#endif
