/* Surfaces under traction, or beside rooms of gas: massless points with an area, moved by the nodes (traction.c).
 * Private to the mpm room. */
#ifndef MPM_TRACTION_H
#define MPM_TRACTION_H

#include "mpm/work.h"

/* Surface points, laid on the shapes. Errors: FLOE_BAD_INPUT where a load has no surface, FLOE_NO_MEMORY. */
floe_status seed_surfaces(mpm *s);
/* Adds the loads on the surfaces of a group to its N_FORCE. */
void scatter_surfaces(mpm *s, int group);
/* The share of a fluid body's surface, as its shape has it inside the mesh, that solids face. */
double surface_enclosed(const mpm *s, int body);
/* The force of a unit of pressure of a room, on top of what N_FORCE holds. */
void scatter_room(mpm *s, int room);
/* Moves the surface points of a group with its nodes. */
void move_surfaces(mpm *s, int group);
/* Moves them by displacements of a group's nodes, given by global index and component, instead of velocities. */
typedef double node_displacement(const mpm *s, int group, const int node[MESH_MAX_DIM], int component);
void carry_surfaces(mpm *s, node_displacement *way);
/* Adds the displacement (m) of one place of a surface to out. */
void carry_place(const mpm *s, int group, const double x[3], node_displacement *way, double out[3]);
/* A force (N) on a body's surface, on nodes of its group that its points bear. */
void push_surface(const mpm *s, int group, const double x[3], const double force[3]);
/* How a place of a surface moves in the step: with which velocity it goes on, and with which a force on it works on the
 * nodes, in the mean of the step's start and end (m/s). */
typedef struct surface_motion {
    double velocity[3], working[3];
} surface_motion;
surface_motion surface_motion_at(const mpm *s, int group, const double x[3]);

#endif
