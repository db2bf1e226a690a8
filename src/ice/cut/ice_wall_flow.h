/* The flow beside embedded boundaries that viscous and heat-conducting fluids see (theory 7.7, 7.10): velocities and temperatures at the centres of cells that
 * boundaries cut, and their gradients at the boundaries. Only this folder includes it. */
#ifndef ICE_WALL_FLOW_H
#define ICE_WALL_FLOW_H

#include "ice/cut/ice_merged_cells.h"

/* A place on a boundary in a cut cell. */
typedef struct wall_place {
    const int *cell;   /* global */
    double x[3], v[3]; /* m; m/s: its own velocity */
    double area[3];    /* m2: outward from the fluid */
    double T;          /* K: its temperature; NAN: it is insulated */
} wall_place;

/* Whether some fluid sees the boundaries so: it is viscous, or heat passes them. */
bool ice_sees_walls(const ice *s);
/* Fits the flow of a region about its cut cells, from the state and the boundaries at t^n; the velocities at centres of cells of viscous fluids go to
 * C_VEL_CENTRED. */
floe_status ice_find_wall_flow(ice *s, const ice_region *g);
/* Force (N) by which the viscous stress of the region's fluid r, were it alone there, drags the boundary. */
void ice_wall_drag(const ice *s, const ice_region *g, int r, const wall_place *w, double drag[3]);
/* The same of temperatures: the fits, the temperatures at centres of cells into C_DIFFUSION_T, and the heat (W) that fluid r, were it alone there, conducts to
 * a place on the boundary. */
void ice_find_wall_heat(ice *s, const ice_region *g);
void ice_centre_temperatures(ice *s, const ice_region *g);
double ice_wall_heat(const ice *s, const ice_region *g, int r, const wall_place *w);
/* Temperature (K) of a piece of a boundary; NAN: it is insulated. */
double ice_wall_temperature(const ice *s, const ice_embedded_boundary *line, const cut_piece *q);
/* Difference of the fit from the merged cell's centroid to a place given from the centre of member k's cell. */
void ice_wall_flow_difference(const ice *s, const ice_region *g, int k, const double from_centre[3], double du[3]);
void ice_wall_flow_destroy(context *ctx, struct ice_wall_flow **w);

#endif
