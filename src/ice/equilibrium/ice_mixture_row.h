/* Cells of a row whose materials come to one pressure; only this folder includes it. */
#ifndef ICE_MIXTURE_ROW_H
#define ICE_MIXTURE_ROW_H

#include "ice/equilibrium/ice_closure.h"

/* One row of cells, and the thread's storage. Index i counts cells from `from`. */
typedef struct mixture_row {
    ice *s;
    const ice_view *v;
    ptrdiff_t from;
    int n;
    bool owned;               /* no row of ghosts */
    const double *guess;      /* Pa: the last equilibrium pressure */
    unsigned *set;            /* of each cell, its materials: bit r is material r's */
    double *a, *b, *c, *d;    /* values of a run */
    ice_closing_cells *mixed; /* of a run */
    long cells, iterations, fallbacks;
} mixture_row;

/* Cells [from, from + n) with one set of materials. */
typedef struct mixture_run {
    ptrdiff_t from;
    int n;
    int first;                       /* of them in the row */
    int count;                       /* of materials present */
    int material[ICE_MAX_MATERIALS]; /* those present, in order */
    bool points;                     /* some of them are carried by points */
} mixture_run;

/* The isentropes through a run's states of its k-th material, in the storage of the row; NULL: at a frozen temperature. */
const isentrope *ice_choose_path(const mixture_row *q, const mixture_run *run, int k);
/* Cells of the batch near its first pressure get a frozen temperature. */
void ice_freeze_near(const mixture_row *q, const mixture_run *run);
/* Energies, volumes and temperatures at the ends of a solved run's isentropes. */
void ice_follow_paths(const mixture_row *q, const mixture_run *run);

#endif
