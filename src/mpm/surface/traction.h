/* Surfaces under loads, beside enclosed gas and in contact: facets between massless corners that the nodes move (surface_seed.c,
 * traction.c). Private to the mpm module. */
#ifndef MPM_TRACTION_H
#define MPM_TRACTION_H

#include "mpm/surface/surface_place.h"

/* Places facets on the shapes. Errors: FLOE_BAD_INPUT where a load has no surface, FLOE_NO_MEMORY. */
floe_status seed_surfaces(mpm *s);
/* The share of a fluid body's surface inside the mesh that solids face. */
double surface_enclosed(const mpm *s, int body);
/* Adds the loads on the surfaces of a group to its N_FORCE. */
void scatter_surfaces(mpm *s, int group);
/* Adds the forces of a unit pressure of an enclosed gas (implicit.h) to N_FORCE of a group. */
void scatter_gas_pressure(mpm *s, int group, int gas);
/* Volume (m3) over which the walls of an enclosed gas pass in the step that is solved for. */
double surface_swept(const mpm *s, int gas);
/* Moves the corners of a group with its nodes. */
void move_surfaces(mpm *s, int group);
/* Moves those of all groups by nodal displacements instead of velocities. */
void displace_surfaces(mpm *s, node_displacement *displacement);

#endif
