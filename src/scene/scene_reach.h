/* What lies in the domain, and at its sides, at the start. */
#ifndef SCENE_SCENE_REACH_H
#define SCENE_SCENE_REACH_H

#include "scene/scene.h"

/* false: the inside of the shape lies wholly outside the domain. */
bool scene_meets_domain(const scene *s, const shape *part);
/* Whether a body reaches a side, to a cell. */
bool body_reaches_side(const scene *s, const scene_body *b, int axis, int side);
/* Whether a solid stands on a slip side from which it may part, so that gas comes between them (theory 7.2). Bodies that touch count as one, and what
 * reaches the side across, too, slides along both. Not in a corner of two such sides, nor beside liquids and with the implicit pressure, which stall at thin
 * films. */
bool scene_can_leave_side(const scene *s, const scene_body *b, int axis, int side);
/* Of a cell: bodies that are nearer than this to each other, or to a side, touch. */
#define BODIES_TOUCH 1e-6
/* Whether the boxes about two bodies meet, to a share of a cell; a body without bounds is everywhere. */
bool bodies_meet(const scene *s, const scene_body *a, const scene_body *b, double share);
/* Whether a body belongs to another's group. */
typedef bool body_relation(const scene *s, const scene_body *a, const scene_body *b);
/* Marks a body, and those that hang together with it by a relation; returns how many. */
int scene_mark_group(const scene *s, int first, body_relation *joined, bool of[SCENE_MAX_BODIES]);
/* Whether a body touches a side. */
bool body_stands_on_side(const scene *s, const scene_body *b, int axis, int side);
/* Whether some body, or what surrounds them, is a liquid. */
bool scene_has_liquid(const scene *s);
/* Whether a fluid that bears tension does: a body of it, or the ambient. */
bool liquid_reaches_side(const scene *s, int axis, int side);
/* 'x', or 'r' about an axis. */
char axis_letter(const scene *s, int axis);

#endif
