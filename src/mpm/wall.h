/* Walls and supports: sums are folded into the nodes of the mesh, and nodes are held to a velocity. Private to the mpm room. */
#ifndef MPM_WALL_H
#define MPM_WALL_H

#include "mpm/work.h"

/* Folds N_MASS with N_MOMENTUM, and N_FORCE, where asked for. */
void fold_walls(mpm *s, int group, bool momentum, bool force);
/* Whether a side of the domain holds a component of its nodes' velocity, whatever comes. */
bool wall_holds(const mpm *s, int group, int axis, int side, int component);
/* The velocity (m/s) that it then has at the end of the step. */
double wall_target(const mpm *s, int axis, int side, int component);
/* Folds a field of the nodes that points reached beyond the sides. */
void fold_field(mpm *s, int group, field_id id);
/* The same, components of a vector as numbers: mirrors keep their sum. */
void fold_numbers(mpm *s, int group, field_id id);
/* Takes a change of the nodes' velocities away where walls and supports hold them; `share` of that impulse goes into the ledger. */
void hold_change(mpm *s, int group, field_id change, double share);
/* The same of supports alone. */
void hold_supports(mpm *s, int group, field_id change, double share);
/* `share` of the momentum that mirrors give points which take a change of velocities from the nodes, into the ledger; `given`: and give
 * back what the ghosts have in N_MOMENTUM. */
void enter_mirrored_change(mpm *s, int group, field_id change, double share, bool given);
/* Gives the nodes of walls and supports their velocity; `entered` of the impulse goes into the ledger (0: none of it). */
void impose_walls(mpm *s, int group, field_id velocity, double entered);
/* Nodes that walls hold do not accelerate. */
void still_walls(mpm *s, int group);
/* A node on a mirror bears the image's mass as well: doubles the masses of such nodes in a tile's window. */
void mirror_masses(const mpm *s, int group, const tile_box *t, double *window);
/* Values of the ghost nodes beyond the sides, which points near them take from: mirrored, or extrapolated. */
void extend_to_ghosts(mpm *s, int group, field_id id);
/* Momentum that mirrors give, into the ledger: after accelerations are known, before ghosts are extended. */
void enter_mirrors(mpm *s, int group);
/* The same of points that take a share of their velocity from the nodes, and nothing else. */
void enter_mirrored_momenta(mpm *s, int group, double share);
/* Whether a side is a mirror to a group: symmetry, the axis, or slip that does not let it go. */
bool wall_mirrors(const mpm *s, int group, int axis, int side);

typedef void wall_node_visitor(void *user, ptrdiff_t at, ptrdiff_t inward);
/* Visits the nodes of a side's plane, transverse ghosts included. */
void wall_visit(const block *b, int axis, int side, wall_node_visitor *visit, void *user);
typedef void wall_side_visitor(void *user, int blk, const int node[MESH_MAX_DIM], ptrdiff_t at, ptrdiff_t inward);
/* Visits each node of a side's plane once, in global order, in the block that owns it. */
void wall_visit_once(const mesh *m, int axis, int side, wall_side_visitor *visit, void *user);

/* ---- sides that let go (wall_side.c) ---- */

/* Whether a side stops a group only where it has come and goes on: slip, and a group of solids alone. */
bool wall_lets_go(const mpm *s, int group, int axis, int side);
/* Whether some side does so with some group. */
bool walls_let_go(const mpm *s);
/* Adds what such sides push to the forces of their nodes, and to the ledger. */
void push_off_sides(mpm *s, int group);
/* Takes the velocity into such a side from its nodes where bodies flow: of v^L; of other velocities all of it. `entered`: as
 * impose_walls. */
void stop_flowing(mpm *s, int axis, int side, int group, field_id velocity, double entered);
/* How far bodies have given way at their nodes, from the velocities that points take. */
void follow_sides(mpm *s);

/* ---- supports (support.c) ---- */

/* Finds the nodes that they hold. */
floe_status start_supports(mpm *s);
/* Gives these their velocity; `entered` as impose_walls. */
void impose_supports(mpm *s, int group, field_id velocity, double entered);

#endif
