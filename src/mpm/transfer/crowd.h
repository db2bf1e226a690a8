/* Where points fold over each other (points.c). Private to the mpm module. */
#ifndef MPM_CROWD_H
#define MPM_CROWD_H

#include "mpm/mpm.h"

/* Whether points [start, end) of a body in a tile, SOLID_CHUNK at most, are crowded: all bodies together are denser there than MPM_CROWD of it at
 * rest, in the plane or along the line of the scene. */
void find_crowded(const mpm *s, int body, int blk, int tile, const size_t range[2], bool *crowded);

#endif
