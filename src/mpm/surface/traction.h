/* Surfaces under traction or beside enclosed gas: massless points with an area, moved by the nodes (traction.c).
 * Private to the mpm module. */
#ifndef MPM_TRACTION_H
#define MPM_TRACTION_H

#include "mpm/mpm.h"

/* Places surface points on the shapes. Errors: FLOE_BAD_INPUT where a load has no surface, FLOE_NO_MEMORY. */
floe_status seed_surfaces(mpm *s);
/* Adds the loads on the surfaces of a group to its N_FORCE. */
void scatter_surfaces(mpm *s, int group);
/* The share of a fluid body's surface inside the mesh that solids face. */
double surface_enclosed(const mpm *s, int body);
/* Adds the forces of a unit pressure of an enclosed gas to N_FORCE. */
void scatter_gas_pressure(mpm *s, int enclosed);
/* Moves the surface points of a group with its nodes. */
void move_surfaces(mpm *s, int group);
/* Moves them by nodal displacements of a group, given by global index and component, instead of velocities. */
typedef double node_displacement(const mpm *s, int group, const int node[MESH_MAX_DIM], int component);
void displace_surfaces(mpm *s, node_displacement *displacement);
/* Adds the displacement (m) of one position on a surface to out. */
void displace_position(const mpm *s, int group, const double x[3], node_displacement *displacement, double out[3]);
/* Adds a force (N) on a body's surface to nodes of its group with mass. */
void add_surface_force(const mpm *s, int group, const double x[3], const double force[3]);
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
