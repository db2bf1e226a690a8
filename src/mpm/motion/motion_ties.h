/* What sticks to bodies that do not deform (motion_nodes.c). */
#ifndef MPM_MOTION_TIES_H
#define MPM_MOTION_TIES_H

#include "mpm/mpm.h"

/* Visits the nodes that such bodies reach, by global index, with each component of the velocity (m/s) that they have in the step. */
typedef void tie_visitor(void *user, const int node[MESH_MAX_DIM], int c, double velocity);
void motions_visit_ties(const mpm *s, tie_visitor *visit, void *user);
/* An impulse (N s) at x (m), and a moment (N m s) about it, on a fixed body (of ours), of what sticks to it. */
void motion_pull_fixed(const mpm *s, int body, const double x[3], const double impulse[3], const double about[3]);

#endif
