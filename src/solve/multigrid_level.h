/* One level of the hierarchy, and what is done on it and between it and the next. Only multigrid*.c include this. */
#ifndef SOLVE_MULTIGRID_LEVEL_H
#define SOLVE_MULTIGRID_LEVEL_H

#include "base/compiler.h"
#include "solve/multigrid.h"

/* Arrays on its grid; owned by the multigrid. */
typedef struct level {
    solve_grid grid;
    link_system system;
    double *diagonal, *inverse; /* of the matrix; inverse 0 where a cell takes no part */
    double *x, *y;              /* the solution, by turns */
    double *b, *residual;       /* b is NULL on the finest level: it is the caller's */
    double *share;              /* of a cell's value that comes from the coarse cell beyond, not from its own */
    int axis;                   /* the next level has half the cells along it; -1: the coarsest */
    bool smoothed;              /* else the level is passed through, on the way to coarsening another axis as well */
} level;

/* The diagonal and its inverse from the links. */
void level_complete(level *l);
/* Links, sinks and shares of l for the next level. */
void level_coarsen(level *l, level *coarse);

/* y = A x. */
void level_apply(const level *l, double *x, double *y);
/* r = b - A x. */
void level_residual(const level *l, double *x, const double *b, double *r);
/* out = 0 and x = step D^-1 b: the first step of relaxation from 0. */
void level_start(const level *l, const double *b, double step, double *x, double *out);
/* out = x + memory (x - out) + step D^-1 (b - A x). */
void level_relax(const level *l, double *x, double *out, const double *b, double memory, double step);

/* coarse->b = the transpose of the interpolation on r. */
void level_restrict(const level *l, double *r, const level *coarse);
/* x += the interpolation of the coarse solution; with `fresh` x = it. */
void level_prolong(const level *l, double *x, const level *coarse, double *from, bool fresh);

#endif
