/* Nodes of bodies that do not deform, for the files of this folder. */
#ifndef MPM_MOTION_PARTS_H
#define MPM_MOTION_PARTS_H

#include "mpm/motion/motion.h"

/* What a body's nodes take: a rigid field, or nothing of a change. */
typedef struct imposed {
    field_id field;
    bool now, zero;
} imposed;
void rigid_at(const mpm *s, const body_motion *m, const imposed *what, const double x[3], double v[3]);

/* Visits every node of every block, ghosts included, by its local index and place. */
typedef void motion_node_visitor(mpm *s, int blk, ptrdiff_t at, const double x[3], void *user);
void motion_visit_nodes(mpm *s, motion_node_visitor *visit, void *user);
/* Sums of what is added at each node, once in the mesh, in the order of tiles. */
typedef void motion_node_adder(mpm *s, int blk, ptrdiff_t at, const double x[3], const void *user, double *sum);
void motion_sum_nodes(mpm *s, motion_node_adder *add, const void *user, int count, double *sum);

/* The group with a motion to which others stick at a node: that of the largest mass there; -1: there is none. */
int leader_at(const mpm *s, const fields *f, ptrdiff_t at);
/* Whether a group that deforms sticks to them: contact, cells and walls of fluid points have rules of their own. */
bool sticks_to_motions(const mpm *s, int group);

/* The common motion of each free body and all that sticks to it (motion_free.c). */
void join_free_bodies(mpm *s);
/* Contact has been found as if free bodies could not be moved: shares what it gives between them and the others. */
void share_contacts(mpm *s);

#endif
