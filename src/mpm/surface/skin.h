/* What gas of the cells pushes on, as the points have it. Private to the mpm room; outline.h is for the cells' side. */
#ifndef MPM_SKIN_H
#define MPM_SKIN_H

#include "geom/outline.h"
#include "mpm/surface/traction.h"

/* ---- on membranes (outline.c) ---- */

/* Room for the forces on membranes that hold gas. */
floe_status start_push(mpm *s);
void free_push(context *ctx, struct mpm_work *w);
/* Adds the forces to N_FORCE of a group. */
void scatter_push(mpm *s, int group);

/* ---- on solids, at markers of their surfaces (skin.c) ---- */

/* The fluid of the cells beside a chain, by its number in the scene, or an mpm_no_fluid. */
int fluid_beside(const scene *s, const mesh *m, const outline *o, size_t chain);

/* Markers, laid on the shapes of solids. */
floe_status seed_skins(mpm *s);
/* Adds forces (N, two a marker) to N_FORCE of a group, by the nodes that its points bear. */
void scatter_skins(mpm *s, int group, const double *force);
/* Where the markers of a group go in the step, with which velocity, and over which way their forces work. */
void move_skins(mpm *s, int group);
/* Where they go by displacements of a group's nodes instead. */
void carry_skins(mpm *s, node_displacement *way);
/* Makes that their state. */
void commit_skins(mpm *s);
void free_skins(context *ctx, body_skin *k);

#endif
