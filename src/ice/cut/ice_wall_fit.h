/* Fits about the cells that embedded boundaries cut (theory 7.7): which cells have one, what the boundary has near them, and polynomials of second degree by
 * least squares. Of velocities in ice_wall_flow.c, of temperatures in ice_wall_heat.c; only these and ice_wall_fit.c include it. */
#ifndef ICE_WALL_FIT_H
#define ICE_WALL_FIT_H

#include "ice/cut/ice_wall_flow.h"

enum {
    FIT_TERMS = 10, /* 1, x, xx, y, yy, xy, z, zz, yz, zx: as many as the mesh has dimensions, 3, 6 or 10 */
    FIT_AROUND = 2  /* cells to each side */
};

/* Velocities of a fluid: its own, what the fit misses there, and the coefficients. */
typedef struct fluid_fit {
    double u[3], miss[3], term[3][FIT_TERMS];
} fluid_fit;

/* The same of its temperature (K). */
typedef struct heat_fit {
    double T, miss, term[FIT_TERMS];
} heat_fit;

/* A cell with a fit. */
typedef struct fit_cell {
    int cell[3], host;             /* global; the fit whose state a covered cell starts from; itself where it is open */
    double centre[3], centroid[3]; /* m: of the fit; of the state of its merged cells */
    double outward[3], wall[3];    /* normal of the wall beside it and a place there; 0 where none is near */
} fit_cell;

/* A piece of a boundary at t^n. */
typedef struct wall_sample {
    wall_place place;
    double size;
    int next; /* in the same cell; -1: none */
} wall_sample;

typedef struct ice_wall_flow {
    int *fit_of;         /* of every global cell; -1: it has none; owned */
    int *first;          /* of each fit the first piece in its cell; -1: none; owned */
    fit_cell *cell;      /* owned */
    fluid_fit *fluid;    /* of each fit, as many as fluids in the region; NULL: none is viscous; owned */
    heat_fit *heat;      /* the same; NULL: no heat passes the boundaries; owned */
    wall_sample *sample; /* owned */
    int n, n_samples;
    size_t reserved, reserved_samples;
} ice_wall_flow;

/* Least squares of up to three components at once. */
typedef struct fit_squares {
    double matrix[FIT_TERMS][FIT_TERMS], right[3][FIT_TERMS], weight;
    int components;
    int samples; /* of fluid */
} fit_squares;

/* The fit of the cell that a place lies in, or of the open cell that a covered one belongs to; -1: there is none. */
int fit_at(const ice *s, const ice_wall_flow *w, const wall_place *at);
/* The view of the block that owns a cell, and its index there. */
const ice_view *fit_view(const ice *s, const int cell[3], ptrdiff_t *at);
/* Steps to the cells around, up to `reach` to each side: for (int n = 0; fit_next_step(dim, reach, &n, step);). */
bool fit_next_step(int dim, int reach, int *n, int step[3]);
/* Another cell by steps along the axes, around periodic sides; false beyond the others. shift: m, of its place from where it
 * seems to be. */
bool fit_find_cell(const mesh *m, const int from[3], const int step[3], int cell[3], double shift[3]);
/* The image of a place (m) that is nearest to the fit: its host may lie beyond a periodic side. */
void fit_bring_near(const mesh *m, const fit_cell *f, double x[3]);
/* The terms at a place, and their slopes (1/m) along the axes. */
void fit_terms(const mesh *m, const fit_cell *f, const double x[3], double t[FIT_TERMS]);
void fit_slopes(const mesh *m, const fit_cell *f, const double x[3], double slope[3][FIT_TERMS]);
/* Adds a value at x beside the cell's wall, not beyond it. */
void fit_add(const mesh *m, const fit_cell *f, const double x[3], double share, const double *value, fit_squares *q);
/* Weight of a piece of the boundary. */
double fit_wall_share(const mesh *m, const wall_sample *p);
/* The coefficients of each component. */
void fit_solve(fit_squares *q, int dim, double (*term)[FIT_TERMS]);
double fit_sum(const double t[FIT_TERMS], const double term[FIT_TERMS]);
double fit_length(const double a[3]);
/* The distance (m) from a place on a wall over which the fluid's own value acts on it. */
double fit_distance(const mesh *m, const fit_cell *f, const wall_place *w);

/* Temperatures at the centres of the cells of a region that have fits, ghosts left out (ice_wall_heat.c). */
void fit_centre_temperatures(const ice *s, const ice_region *g);

#endif
