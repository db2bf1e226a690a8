/* Temperature of solids on points (theory 12): from points to nodes, conduction there, and the change back to the points. */
#ifndef MPM_THERMAL_H
#define MPM_THERMAL_H

#include "mpm/mpm.h"

/* Whether the points of some body carry a temperature. */
bool has_temperature(const mpm *s);
/* Whether some body conducts heat. */
bool conducts(const mpm *s);
/* Whether a body's stress makes heat: of plastic and artificial viscous work. */
bool dissipates_heat(const mpm *s, int body);
/* Whether a body's heat goes to the nodes: it conducts, or shares cells with fluids. Others keep the heat of their own stress. */
bool heat_goes_to_nodes(const mpm *s, int body);
/* Whether that of some body of a velocity group does; group -1: of any. */
bool group_gives_heat(const mpm *s, int group);

/* Whether fluids on cells conduct heat to its surfaces (theory 7.10). */
bool takes_wall_heat(const mpm *s);

/* Share of the difference between the points of a group and their nodes that the step takes away (conduction.c). */
double conduction_relaxation(const mpm *s, int group);
/* Largest stable step of conduction (s), INFINITY where nothing conducts; *body becomes the scene's body that limits it. */
double conduction_step(const mpm *s, int *body);

/* Sides of the domain (thermal_sides.c). Sets T_i of nodes on sides with a temperature to that at time t (s). */
floe_status set_side_temperatures(mpm *s, int group, double t);
/* Gives those nodes the change that brings them to it at the end of the step; the heat goes into the ledger. */
floe_status impose_side_temperatures(mpm *s, int group);
/* The condition of a side at a place (m) of it if it is a wall with a temperature, or one with a heat flux; else NULL. */
const bc_side *wall_with_temperature(const mpm *s, int axis, int side, const double x[3]);
const bc_side *wall_with_heat_flux(const mpm *s, int axis, int side, const double x[3]);
/* Whether some wall has a heat flux. */
bool some_wall_gives_heat(const mpm *s);

#endif
