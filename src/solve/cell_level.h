/* One level of a hierarchy of cells, and what is done on it and between it and the next. Only cell_*.c and multigrid_cells.c include this. */
#ifndef SOLVE_CELL_LEVEL_H
#define SOLVE_CELL_LEVEL_H

#include "base/compiler.h"
#include "solve/multigrid.h"

/* Arrays on its grid; owned by the multigrid. */
typedef struct cell_level {
    solve_grid grid;
    link_system system;
    double *diagonal, *inverse;   /* of the matrix; inverse 0 where a cell takes no part */
    double *y, *residual;         /* y: the solution, by turns with x */
    double *share;                /* of a cell's value that comes from the coarse cell beyond, not from its own */
    int axis;                     /* the next level has half the cells along it; -1: the coarsest */
    double first, memory, second; /* of the Chebyshev polynomial: weight of the first step, the two of the second */
    bool smoothed;                /* else the level is passed through, on the way to coarsening another axis as well */
} cell_level;

/* The diagonal and its inverse from the links. */
void cell_level_complete(cell_level *l);
/* Links, sinks and shares of l for the next level. */
void cell_level_coarsen(cell_level *l, cell_level *coarse);

/* y = A x. */
void cell_level_apply(const cell_level *l, double *x, double *y);
/* r = b - A x. */
void cell_level_residual(const cell_level *l, double *x, const double *b, double *r);
/* out = 0 and x = step D^-1 b: the first step of relaxation from 0. */
void cell_level_start(const cell_level *l, const double *b, double step, double *x, double *out);
/* out = x + memory (x - out) + step D^-1 (b - A x). */
void cell_level_relax(const cell_level *l, double *x, double *out, const double *b, double memory, double step);

/* b = the transpose of the interpolation on r. */
void cell_level_restrict(const cell_level *l, double *r, const cell_level *coarse, double *b);
/* x += the interpolation of the coarse solution; with `fresh` x = it. */
void cell_level_prolong(const cell_level *l, double *x, const cell_level *coarse, double *from, bool fresh);

#endif
