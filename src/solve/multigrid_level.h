/* What a kind of matrices gives to the cycle (multigrid.c). Only multigrid*.c include this. */
#ifndef SOLVE_MULTIGRID_LEVEL_H
#define SOLVE_MULTIGRID_LEVEL_H

#include "solve/multigrid.h"

enum { MULTIGRID_LEVELS = 3 * 31 };

/* One level of the hierarchy. */
typedef struct multigrid_level {
    void *own;     /* what the kind keeps of it; owned */
    size_t size;   /* entries of an array */
    double *x, *b; /* owned; b is NULL on the finest level: it is the caller's */
} multigrid_level;

typedef struct multigrid_kind {
    void (*apply)(const multigrid_level *l, double *x, double *y); /* y = A x */
    /* Improves l->x towards A x = b, from 0 where `fresh`. */
    void (*smooth)(const multigrid_level *l, const double *b, bool fresh);
    /* b of the next level from the residual of l->x. */
    void (*restrict_residual)(const multigrid_level *l, const double *b, const multigrid_level *coarse);
    /* Adds the next level's x to l->x. */
    void (*prolong_correction)(const multigrid_level *l, const multigrid_level *coarse);
    void (*solve)(const multigrid_level *l, const double *b); /* l->x of the last level */
    /* Whether a level is solved for; else it is coarsened. */
    bool (*is_last)(const multigrid_level *l);
    /* The matrix of the next level, and what smoothing needs; what solving the last one needs. */
    floe_status (*coarsen)(const multigrid_level *l, const multigrid_level *coarse);
    floe_status (*prepare_last)(const multigrid_level *l);
    void (*free)(context *ctx, void *own);
} multigrid_kind;

struct multigrid {
    context *ctx;
    const multigrid_kind *kind;
    int n, last; /* levels; the one that is solved for */
    multigrid_level level[MULTIGRID_LEVELS];
};

floe_status multigrid_new(multigrid **out, context *ctx, const multigrid_kind *kind);
/* The next level, with `bytes` of its kind's. Errors: FLOE_NO_MEMORY. */
floe_status multigrid_add(multigrid *m, size_t size, size_t bytes, void *own);

#endif
