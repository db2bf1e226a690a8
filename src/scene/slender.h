/* Solids that are long and thin, and bend: how many points they have across (theory 4.7). */
#ifndef SCENE_SLENDER_H
#define SCENE_SLENDER_H

#include "scene/scene.h"

/* Points across from which on nothing is missed, and those of a cell, across, that slender solids with less have by default. */
enum { SLENDER_ENOUGH = 10, SLENDER_POINTS = 4 };

/* How many points a solid that is long and thin would have across with so many a cell, and the axis across it, -1 where it leans. INFINITY for others,
 * for those that reach from side to side or lie on a side, which nothing bends, and for the walls of tubes about the axis. */
double slender_across(const scene *s, const scene_body *b, const int per_cell[3], int *axis);
/* Gives such a solid its points, where the deck does not. */
void slender_seed(const scene *s, scene_body *b);

#endif
