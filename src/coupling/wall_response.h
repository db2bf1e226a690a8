/* Response of the fluids' pressure on walls to the motion of the walls in the step (theory 7.6): the fluid cells at a wall, and the vertices
 * of the wall on which their pressure acts. The fluids describe the response, the solids solve for the changes of pressure, and both
 * apply them. */
#ifndef COUPLING_WALL_RESPONSE_H
#define COUPLING_WALL_RESPONSE_H

#include "base/context.h"

#include <math.h>

/* What a cell's pressure does to a vertex. */
typedef struct wall_push {
    int vertex;
    double area[3]; /* m2: out of the fluid; of the pieces of the wall that the vertex moves, by their shares */
    int next;       /* push of the same cell; -1: none */
} wall_push;

/* A cell, or several that have one pressure. With y (m3/s) more flux out of it its pressure changes by
 * -stiffness y + q(squeeze - per_flux y) - q(squeeze), q(w) = linear w + square w^2 where w > 0. */
typedef struct wall_cell {
    int first;             /* push; -1: none */
    double stiffness;      /* Pa s/m3 */
    double squeeze;        /* m/s: rate of compression over a cell; below 0 it expands */
    double per_flux;       /* 1/m2 */
    double linear, square; /* Pa s/m, Pa s2/m2: of the bulk viscosity */
    double change, flux;   /* Pa, m3/s: found */
} wall_cell;

/* How the walls move, as the solids have found it in the step, for fluids whose cells hang together (theory 7.8). Numbers
 * are of the cells of a wall_response, in their order. */
typedef struct wall_motion {
    const void *walls;
    const double *flux; /* m3/s: more flux out of each cell than the fluids have taken it to be, by the forces so far */
    /* Change of these fluxes by changes of pressure (Pa): linear, symmetric, not negative. */
    void (*flux_of)(const void *walls, const double *pressure, double *flux);
    double (*own_flux)(const void *walls, int cell); /* of a cell by 1 Pa of its own */
} wall_motion;

/* Finds the changes of pressure. Errors: those of the solver. */
typedef floe_status wall_solver(void *fluids, const wall_motion *motion, double *pressure);

typedef struct wall_response {
    context *ctx;       /* not owned */
    wall_solver *solve; /* NULL: each cell gives way by itself */
    void *fluids;       /* for solve; not owned */
    wall_cell *cell;    /* owned */
    wall_push *push;    /* owned */
    int n_cells, n_pushes, reserved_cells, reserved_pushes;
} wall_response;

void wall_response_free(wall_response *w);
/* Empties it. */
void wall_response_clear(wall_response *w);
/* Adds `n` cells without forces on vertices and without pressures. */
floe_status wall_response_add_cells(wall_response *w, int n);
/* Adds an area (m2, three numbers) of a cell to what it has at a vertex. */
floe_status wall_response_add_push(wall_response *w, int cell, int vertex, const double area[3]);

static inline double wall_bulk_pressure(const wall_cell *c, double squeeze)
{
    return squeeze > 0.0 ? squeeze * (c->linear + c->square * squeeze) : 0.0;
}

/* Change of pressure (Pa) with y (m3/s) more flux, and what it falls by per flux (Pa s/m3, above 0). */
static inline double wall_pressure_change(const wall_cell *c, double y)
{
    return -c->stiffness * y + wall_bulk_pressure(c, c->squeeze - c->per_flux * y) - wall_bulk_pressure(c, c->squeeze);
}

static inline double wall_pressure_slope(const wall_cell *c, double y)
{
    const double squeeze = c->squeeze - c->per_flux * y;
    return c->stiffness + (squeeze > 0.0 ? c->per_flux * (c->linear + 2.0 * c->square * squeeze) : 0.0);
}

#endif
