/* Constraints of nodes, whoever solves for their motion: components whose velocity sides of the mesh or supports prescribe. */
#ifndef MPM_CONSTRAINTS_H
#define MPM_CONSTRAINTS_H

#include "mpm/mpm.h"

/* Bits of the components of a node (by global index) that sides constrain for a group, and that sides or supports do. */
unsigned side_constraints(const mpm *s, int group, const int node[MESH_MAX_DIM]);
unsigned node_constraints(const mpm *s, int group, const int node[MESH_MAX_DIM]);
static inline bool is_constrained(unsigned components, int c)
{
    return ((components >> c) & 1u) != 0;
}

/* Calls for every constrained component of every node, with its velocity (m/s) at the end of the step: first by sides in the order of
 * axes, then by supports; where a component has several, the last is to hold. Nodes at periodic ends are those of the lower end. */
typedef void constraint_visitor(void *user, const int node[MESH_MAX_DIM], int component, double velocity);
void visit_constraints(const mpm *s, int group, constraint_visitor *visit, void *user);

#endif
