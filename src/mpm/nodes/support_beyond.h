/* Nodes beside fixed bodies that lead what sticks to them (theory 4.13). */
#ifndef MPM_SUPPORT_BEYOND_H
#define MPM_SUPPORT_BEYOND_H

#include "mpm/mpm.h"

/* Whether a node of a group beside a fixed body does not have that body's velocity: the body constrains the group at its surface, by the nodes that it leads. */
bool clear_of_bodies(const mpm *s, int group, const int node[MESH_MAX_DIM]);
/* Finds those nodes anew, from the nodes that are led. Errors: FLOE_NO_MEMORY. */
floe_status find_clear_nodes(mpm *s);

#endif
