/* Conditions on parts of the sides of the domain. */
#ifndef SCENE_SIDE_PARTS_H
#define SCENE_SIDE_PARTS_H

#include "scene/scene.h"

/* The condition of a side at a place on it: that of the first part that the place is in, else of the side. */
const bc_side *scene_condition_at(const scene *s, int axis, int side, const double x[3]);
/* Whether conditions of a side change along it: it has parts, or formulas of place or time give its numbers. */
bool scene_side_varies(const scene *s, int axis, int side);
/* Conditions of all sides, parts last: the i-th, and its key; false at the end. */
typedef struct scene_condition {
    const bc_side *side;
    int axis, end;
    const char *part; /* its name; NULL: of the whole side */
} scene_condition;
bool scene_next_condition(const scene *s, int *i, scene_condition *out);

#endif
