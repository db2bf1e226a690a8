/* How a place on a body's surface meets the nodes of its group (surface_place.c). Private to the mpm module. */
#ifndef MPM_SURFACE_PLACE_H
#define MPM_SURFACE_PLACE_H

#include "mpm/mpm.h"

/* A displacement (m) of nodes of a group, by global index and component. */
typedef double node_displacement(const mpm *s, int group, const int node[MESH_MAX_DIM], int component);
/* Adds the displacement (m) of one position on a surface to out. */
void displace_position(const mpm *s, int group, const double x[3], node_displacement *displacement, double out[3]);
/* Adds a force (N) on a body's surface to nodes of its group with mass. */
void add_surface_force(const mpm *s, int group, const double x[3], const double force[3]);
/* Whether a place on a surface belongs to a support, so that loads there act on nothing. */
bool place_is_supported(const mpm *s, int group, const double x[3]);
/* The same of a marker on which gas acts: a support takes what acts in its region. */
void push_marker(const mpm *s, int group, const double x[3], const double force[3]);
/* Adds heat (W) on a body's surface to N_TEMP_CHANGE, likewise. */
void add_surface_heat(const mpm *s, int group, const double x[3], double heat);
/* The temperature (K) of a place on a body's surface by its nodes that have one. */
double surface_temperature(const mpm *s, int group, const double x[3]);
/* Motion of a position on a surface in the step (m/s): its velocity, and the velocity with which a force on it does
 * work on the nodes, the mean of start and end. */
typedef struct surface_motion {
    double velocity[3], working[3];
    double displacement[3], after[3]; /* m over the step, and m/s at its end */
} surface_motion;
surface_motion surface_motion_at(const mpm *s, int group, const double x[3]);
/* Nodes to which a force at a position is distributed, with their shares, and the part of their change of velocity in the
 * step that moves the position. */
enum { SURFACE_NODES = BASIS_MAX_SUPPORT * BASIS_MAX_SUPPORT * BASIS_MAX_SUPPORT };
typedef struct surface_shares {
    int n;
    int node[SURFACE_NODES][3];
    double w[SURFACE_NODES], moved[SURFACE_NODES];
} surface_shares;
surface_shares surface_shares_at(const mpm *s, int group, const double x[3]);

#endif
