/* Properties of the sides of the domain for a velocity group (wall.c, wall_side.c). */
#ifndef MPM_SIDES_H
#define MPM_SIDES_H

#include "mpm/mpm.h"

/* Whether a side is a mirror for a group: symmetry, the axis, or slip that does not release it. */
bool wall_mirrors(const mpm *s, int group, int axis, int side);
/* Whether a side of the domain constrains a component of its nodes' velocity. */
bool wall_constrains(const mpm *s, int group, int axis, int side, int component);
/* The prescribed velocity (m/s) of that component at the end of the step. */
double wall_target(const mpm *s, int axis, int side, int component);
/* Whether a side constrains a group only in compression: slip sides, for groups of solids alone. */
bool wall_lets_go(const mpm *s, int group, int axis, int side);
/* Whether some side is unilateral for some group. */
bool walls_let_go(const mpm *s);

/* The nodes of a side's plane, from lo to below hi along each axis; a periodic axis has no node at its upper end. */
static inline void side_node_range(const mesh *m, int axis, int side, int lo[MESH_MAX_DIM], int hi[MESH_MAX_DIM])
{
    for (int a = 0; a < MESH_MAX_DIM; ++a) {
        lo[a] = a == axis && side == SIDE_UPPER ? m->n[a] : 0;
        hi[a] = a == axis ? lo[a] + 1 : m->n[a] + (a < m->dim && !m->periodic[a] ? 1 : 0);
    }
}

#endif
