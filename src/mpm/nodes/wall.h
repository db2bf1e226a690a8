/* Walls at the nodes: velocities are constrained, and impulses entered into the ledger (wall.c). Unilateral sides are in
 * wall_side.c. */
#ifndef MPM_WALL_H
#define MPM_WALL_H

#include "grid/tile_box.h"
#include "mpm/mpm.h"

/* Removes a change of velocity from constrained components; `share` of that impulse is entered into the ledger. */
void constrain_change(mpm *s, int group, field_id change, double share);
/* Enters `share` of the momentum that mirrors give to points which take a change of velocity from the nodes; `given`:
 * and of what ghosts return in N_MOMENTUM. */
void enter_mirrored_change(mpm *s, int group, field_id change, double share, bool given);
/* Sets the prescribed velocities of nodes on walls and supports; the share `entered` of the impulse goes into the
 * ledger. */
void impose_walls(mpm *s, int group, field_id velocity, double entered);
/* Sets the acceleration of nodes that walls constrain to zero. */
void still_walls(mpm *s, int group);
/* Doubles the masses of nodes on mirrors in a tile's window: they include those of the images. */
void mirror_masses(const mpm *s, int group, const tile_box *t, double *window);
/* Enters the momentum that mirrors give into the ledger: after accelerations are known, before ghosts are set. */
void enter_mirrors(mpm *s, int group);
/* The same for points that take only a share of their velocity from the nodes. */
void enter_mirrored_momenta(mpm *s, int group, double share);

typedef void wall_side_visitor(void *user, int blk, const int node[MESH_MAX_DIM], ptrdiff_t at, ptrdiff_t inward);
/* Visits each node of a side's plane once, in global order, in the block that owns it. */
void wall_visit_once(const mesh *m, int axis, int side, wall_side_visitor *visit, void *user);

/* ---- unilateral sides (wall_side.c) ---- */

/* Adds the contact forces of such sides to their nodes, and enters them into the ledger. */
void push_off_sides(mpm *s, int group);
/* Removes the velocity into such a side from nodes where bodies yield: of v^L; of other velocities everywhere.
 * `entered`: as impose_walls. */
void stop_flowing(mpm *s, int axis, int side, int group, field_id velocity, double entered);
/* Updates the overlaps at the nodes of such sides from the velocities that move the points. */
void follow_sides(mpm *s);

#endif
