/* Walls and supports: sums of ghost nodes are folded into the mesh, and velocities of nodes are constrained. Private to
 * the mpm module. */
#ifndef MPM_WALL_H
#define MPM_WALL_H

#include "mpm/work.h"

/* Folds N_MASS, with N_MOMENTUM and N_FORCE if requested. */
void fold_walls(mpm *s, int group, bool momentum, bool force);
/* Whether a side of the domain constrains a component of its nodes' velocity. */
bool wall_constrains(const mpm *s, int group, int axis, int side, int component);
/* The prescribed velocity (m/s) of that component at the end of the step. */
double wall_target(const mpm *s, int axis, int side, int component);
/* Folds a field of ghost nodes beyond the sides into the mesh. */
void fold_field(mpm *s, int group, field_id id);
/* The same, with components of a vector as scalars: mirrors keep their sum. */
void fold_numbers(mpm *s, int group, field_id id);
/* Removes a change of velocity from constrained components; `share` of that impulse is entered into the ledger. */
void constrain_change(mpm *s, int group, field_id change, double share);
/* The same of supports alone. */
void constrain_supports(mpm *s, int group, field_id change, double share);
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
/* Sets ghost nodes beyond the sides, from which points near them interpolate: mirrored, or extrapolated. */
void extend_to_ghosts(mpm *s, int group, field_id id);
/* Enters the momentum that mirrors give into the ledger: after accelerations are known, before ghosts are set. */
void enter_mirrors(mpm *s, int group);
/* The same for points that take only a share of their velocity from the nodes. */
void enter_mirrored_momenta(mpm *s, int group, double share);
/* Whether a side is a mirror for a group: symmetry, the axis, or slip that does not release it. */
bool wall_mirrors(const mpm *s, int group, int axis, int side);

typedef void wall_node_visitor(void *user, ptrdiff_t at, ptrdiff_t inward);
/* Visits the nodes of a side's plane, transverse ghosts included. */
void wall_visit(const block *b, int axis, int side, wall_node_visitor *visit, void *user);
typedef void wall_side_visitor(void *user, int blk, const int node[MESH_MAX_DIM], ptrdiff_t at, ptrdiff_t inward);
/* Visits each node of a side's plane once, in global order, in the block that owns it. */
void wall_visit_once(const mesh *m, int axis, int side, wall_side_visitor *visit, void *user);

/* ---- unilateral sides (wall_side.c) ---- */

/* Whether a side constrains a group only in compression: slip sides, for groups of solids alone. */
bool wall_lets_go(const mpm *s, int group, int axis, int side);
/* Whether some side is unilateral for some group. */
bool walls_let_go(const mpm *s);
/* Adds the contact forces of such sides to their nodes, and enters them into the ledger. */
void push_off_sides(mpm *s, int group);
/* Removes the velocity into such a side from nodes where bodies yield: of v^L; of other velocities everywhere.
 * `entered`: as impose_walls. */
void stop_flowing(mpm *s, int axis, int side, int group, field_id velocity, double entered);
/* Updates the overlaps at the nodes of such sides from the velocities that move the points. */
void follow_sides(mpm *s);

/* ---- supports (support.c) ---- */

/* Finds the nodes that they constrain. */
floe_status start_supports(mpm *s);
/* Sets their prescribed velocities; `entered` as impose_walls. */
void impose_supports(mpm *s, int group, field_id velocity, double entered);

#endif
