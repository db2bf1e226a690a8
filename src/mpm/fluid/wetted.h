/* Where fluid points meet solids: each has a velocity field of its own at the nodes, and at the wall both have one velocity.
 *
 * With one field a node that has a small part of a steel wall is steel, and the gas of one to two cells beside it does not move. Two fields
 * with equal velocities node by node are no better where the fluid presses. The constraint is therefore on the velocity *of the wall*. The
 * fluid's nodes have the areas N_i = sum_p V_p grad S_ip, the integral of S_i n over the fluid's surface by the points' own quadrature. For
 * the nodes j of a grid line across the wall sum_j N_j . (v_j^fluid - v_j^solid) = 0, and the same along the wall with |N_j| for viscous
 * fluids; others slip. First the fluid's nodes lose P N_j and the solid's get it, with P from sum_j N_j . (f_j - P N_j) = 0: under uniform
 * pressure no other force acts on the fluid's nodes, to round-off, wherever its points are, and a solid at rest has the same load as with
 * one field. The remaining closing velocity is removed in proportion to areas, not to masses: by masses the lightest node would take all
 * of it, and accelerate the points in its support without bound. */
#ifndef MPM_WETTED_H
#define MPM_WETTED_H

#include "mpm/mpm.h"

floe_status wetted_create(mpm *s);
/* Losses of lines in the step (J/kg of fluid), added to N_LOSS. */
floe_status wetted_add_losses(mpm *s);
void wetted_free(mpm *s);
/* Velocity field of the fluid. */
int wetted_fluid(const mpm *s);

#endif
