/* Light nodes, of the linear basis and GIMP with points that carry the motion about them (light_nodes.c). Private to
 * the mpm module. */
#ifndef MPM_LIGHT_NODES_H
#define MPM_LIGHT_NODES_H

#include "mpm/mpm.h"

/* Whether light nodes are accelerated as their points are. */
bool spares_light_nodes(const mpm *s);
/* v^L and a of the nodes, such that it is so; after mpm_node_acceleration. */
floe_status mpm_spare_light_nodes(mpm *s);
/* The momenta that the points of a group return if they take its residuals with their gradients (restore.c). */
void project_residuals(mpm *s, int group, bool velocities);

#endif
