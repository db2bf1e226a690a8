/* What sticks to bodies that do not deform (motion_nodes.c). */
#ifndef MPM_MOTION_TIES_H
#define MPM_MOTION_TIES_H

#include "mpm/mpm.h"

/* Visits the nodes that such bodies reach, by global index, with each component of the velocity (m/s) that they have in the step. */
typedef void tie_visitor(void *user, const int node[MESH_MAX_DIM], int c, double velocity);
void motions_visit_ties(const mpm *s, tie_visitor *visit, void *user);

#endif
