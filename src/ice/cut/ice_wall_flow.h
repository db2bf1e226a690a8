/* The flow beside embedded boundaries that viscous fluids see (theory 7.7): velocities at the centres of cells that boundaries cut, and
 * its gradient at the boundaries. Only this folder includes it. */
#ifndef ICE_WALL_FLOW_H
#define ICE_WALL_FLOW_H

#include "ice/cut/ice_merged_cells.h"

/* A place on a boundary in a cut cell. */
typedef struct wall_place {
    const int *cell;   /* global */
    double x[3], v[3]; /* m; m/s: its own velocity */
    double area[3];    /* m2: outward from the fluid */
} wall_place;

/* Fits the flow of a region about its cut cells, from the state and the boundaries at t^n, and stores the velocities at centres of cells in
 * C_VEL_CENTRED. */
floe_status ice_find_wall_flow(ice *s, const ice_region *g);
/* Force (N) by which the viscous stress of the region's fluid r, were it alone there, drags the boundary. */
void ice_wall_drag(const ice *s, const ice_region *g, int r, const wall_place *w, double drag[3]);
void ice_wall_flow_destroy(context *ctx, struct ice_wall_flow **w);

#endif
