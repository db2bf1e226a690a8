/* What lies in the domain, and at its sides, at the start. */
#ifndef SCENE_SCENE_REACH_H
#define SCENE_SCENE_REACH_H

#include "scene/scene.h"

/* false: the inside of the shape lies wholly outside the domain. */
bool scene_meets_domain(const scene *s, const shape *part);
/* Whether a body reaches a side, to a cell. */
bool body_reaches_side(const scene *s, const scene_body *b, int axis, int side);
/* Whether a fluid that bears tension does: a body of it, or the ambient. */
bool liquid_reaches_side(const scene *s, int axis, int side);
/* 'x', or 'r' about an axis. */
char axis_letter(const scene *s, int axis);

#endif
