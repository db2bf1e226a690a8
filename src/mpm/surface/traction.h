/* Surfaces under traction or beside enclosed gas: massless points with an area, moved by the nodes (surface_seed.c, traction.c).
 * Private to the mpm module. */
#ifndef MPM_TRACTION_H
#define MPM_TRACTION_H

#include "mpm/surface/surface_place.h"

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
/* Moves them by nodal displacements of a group instead of velocities. */
void displace_surfaces(mpm *s, node_displacement *displacement);

#endif
